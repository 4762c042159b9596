#pragma once
// Vehicles that all have wheels, stepped one by one.

#include <memory>
#include <string_view>

#include "service/runtime/fleet.hpp"

namespace adstar::runtime {

/// Throws std::invalid_argument for a scheme that does not carry wheels.
std::unique_ptr<Stepper> make_wheel_stepper(std::string_view scheme, const StepLimits& limits);

}  // namespace adstar::runtime
