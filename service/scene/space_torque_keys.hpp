#pragma once
// The models of [[spacecraft.torque]] that ask where the spacecraft is, and the actuators in space.

#include "service/scene/torque_keys.hpp"

namespace adstar::scene {

TorquePlan read_gravity_gradient(Keys& keys, const TorqueContext& context);
TorquePlan read_residual_dipole(Keys& keys, const TorqueContext& context);
TorquePlan read_magnetorquer(Keys& keys, const TorqueContext& context);
TorquePlan read_aerodynamic(Keys& keys, const TorqueContext& context);
TorquePlan read_solar_pressure(Keys& keys, const TorqueContext& context);
TorquePlan read_thruster(Keys& keys, const TorqueContext& context);

/// No component below zero; complains of those that are. True when all is well.
bool refuse_negative(const Value& value, std::string_view expected);

}  // namespace adstar::scene
