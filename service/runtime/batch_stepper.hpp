#pragma once
// Steps a fleet as many vehicles at a time as a register has lanes; each has the bits that it would
// have alone.
//
// Every vehicle of a step is one of: free, under a torque constant in its body, under torques linear
// in time, under these and harmonic ones, or with an edge inside the step. The first four wait in
// queues for their kernel; the last, and whatever a kernel leaves (a step to be split, a state that
// is no number), is stepped alone.

#include <memory>
#include <span>
#include <string_view>

#include "service/batch/kernels.hpp"
#include "service/runtime/fleet.hpp"

namespace adstar::runtime {

/// Null when there are no kernels for that scheme. `set` must run here. Throws std::bad_alloc.
std::unique_ptr<Stepper> make_batch_stepper(std::span<const Vehicle> vehicles,
                                            std::string_view scheme, const StepLimits& limits,
                                            batch::InstructionSet set);

}  // namespace adstar::runtime
