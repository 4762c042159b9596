#pragma once
// Vehicles of linked bodies, stepped one by one; what the rest of the service sees of them is the hub's attitude and
// the momentum of the whole.

#include <memory>
#include <string_view>

#include "service/runtime/fleet.hpp"

namespace adstar::runtime {

/// Null when the spacecraft is one body.
std::unique_ptr<multibody::LinkedFlight<double>> make_linked(const scene::Spacecraft& craft);

/// Sets q_IB, H_I, impulse and work of the vehicle's state from those of its bodies.
void mirror(Vehicle& vehicle) noexcept;

/// Throws std::invalid_argument for a scheme that does not step linked bodies.
std::unique_ptr<Stepper> make_linked_stepper(std::string_view scheme, const StepLimits& limits);

}  // namespace adstar::runtime
