#pragma once
// Steps parts of a fleet on threads of their own. Each vehicle belongs to one part for good and is
// stepped as it would be alone, so the bits do not depend on the number of threads.

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "service/runtime/fleet.hpp"

namespace adstar::runtime {

/// Makes the stepper of one part.
using StepperMaker = std::function<std::unique_ptr<Stepper>(std::span<const Vehicle>)>;

/// `threads` ≥ 1 of them, the caller's being one; fewer when the fleet is small. Throws
/// std::system_error when the system has no more threads.
std::unique_ptr<Stepper> make_threaded_stepper(std::span<const Vehicle> vehicles,
                                               std::size_t threads, const StepperMaker& make);

}  // namespace adstar::runtime
