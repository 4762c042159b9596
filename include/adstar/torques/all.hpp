#pragma once
// The torque models there are. To add one: its header beside this file, one line here, its scene
// keys in service/scene/torque_keys.cpp.

#include <variant>

#include "adstar/torques/aerodynamic.hpp"
#include "adstar/torques/commanded.hpp"
#include "adstar/torques/constant.hpp"
#include "adstar/torques/damping.hpp"
#include "adstar/torques/gravity_gradient.hpp"
#include "adstar/torques/harmonic.hpp"
#include "adstar/torques/magnetorquer.hpp"
#include "adstar/torques/residual_dipole.hpp"
#include "adstar/torques/solar_pressure.hpp"
#include "adstar/torques/table.hpp"
#include "adstar/torques/thruster.hpp"

namespace adstar {

template <class T>
using Torque =
    std::variant<Constant<T>, Harmonic<T>, Table<T>, Commanded<T>, Damping<T>, GravityGradient<T>,
                 ResidualDipole<T>, Magnetorquer<T>, Aerodynamic<T>, SolarPressure<T>, Thruster<T>>;

}  // namespace adstar
