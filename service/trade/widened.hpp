#pragma once
// A spacecraft of a scene in the arithmetic that the truth is told in, to the bit.

#include <vector>

#include "adstar/bodies/wheel.hpp"
#include "service/trade/truth.hpp"

namespace adstar::trade {

std::vector<Torque<Wide>> widened(const std::vector<Torque<double>>& torques);
std::vector<SpinningWheel<Wide>> widened_wheels(const scene::Spacecraft& craft);
State<Wide> widened_start(const scene::Spacecraft& craft);
RigidBody<Wide> widened_body(const scene::Spacecraft& craft);

/// Of a spacecraft that has linked bodies.
multibody::LinkedFlight<Wide> widened_flight(const scene::Spacecraft& craft);

/// Free motion, in one shot.
State<Wide> in_closed_form(const scene::Spacecraft& craft, std::int64_t t_ns);

}  // namespace adstar::trade
