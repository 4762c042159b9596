#pragma once
// [[spacecraft.wheel]]: the wheels that a block of the scene gives each spacecraft of its fleet.

#include <string>
#include <vector>

#include "adstar/bodies/rigid_body.hpp"
#include "service/scene/keys.hpp"
#include "service/scene/scene.hpp"

namespace adstar::scene {

struct WheelPlan {
  std::string name;
  Wheel<double> wheel;
  MotorOrder<double> standing;
  double speed_rad_s = 0;  ///< at t = 0, relative to the body
  bool commanded = false;
};

/// `value` is the "wheel" of a spacecraft, which may be absent; `actuators`: names that are taken. Whatever was
/// refused is left out.
std::vector<WheelPlan> read_wheels(const Value& value, std::vector<std::string> actuators);

/// Gives the spacecraft, whose inertia is known, the wheels of the plan at their speeds and momenta for omega_B.
/// Its actuators gain those that are commanded.
void add_wheels(const std::vector<WheelPlan>& plan, const Vec3<double>& omega_B,
                Spacecraft& spacecraft);

/// Σ a_i J_i Omega_i: what the wheels have beside J_B omega_B [N m s].
Vec3<double> momentum_relative_to_body(const std::vector<WheelPlan>& plan);

/// Whether the wheels leave a body with inertia about every axis.
bool leaves_a_body(const std::vector<WheelPlan>& plan, const RigidBody<double>& body);

}  // namespace adstar::scene
