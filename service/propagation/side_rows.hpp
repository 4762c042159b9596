#pragma once
// What is told beside the motion, each a table of its own: a row a wheel, a row a spacecraft that points, a row a linked
// body and a row a joint.

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "service/report/fields.hpp"
#include "service/runtime/fleet.hpp"
#include "service/scene/scene.hpp"

namespace adstar::propagation {

inline constexpr const char* kWheelColumns =
    "spacecraft,wheel,step,time_s,speed_rad_s,momentum_n_m_s,motor_torque_n_m,friction_torque_n_m";

/// Unknown where the scene has no orbit, or no target.
inline constexpr const char* kPointingColumns =
    "spacecraft,step,time_s,position_inertial_x_m,position_inertial_y_m,position_inertial_z_m,"
    "velocity_inertial_x_m_s,velocity_inertial_y_m_s,velocity_inertial_z_m_s,"
    "attitude_body_to_orbital_w,attitude_body_to_orbital_x,attitude_body_to_orbital_y,"
    "attitude_body_to_orbital_z,angular_velocity_to_orbital_body_x_rad_s,"
    "angular_velocity_to_orbital_body_y_rad_s,angular_velocity_to_orbital_body_z_rad_s,"
    "pointing_error_body_x_rad,pointing_error_body_y_rad,pointing_error_body_z_rad";

inline constexpr const char* kBodyColumns =
    "spacecraft,body,step,time_s,attitude_body_to_inertial_w,attitude_body_to_inertial_x,"
    "attitude_body_to_inertial_y,attitude_body_to_inertial_z,angular_velocity_body_x_rad_s,"
    "angular_velocity_body_y_rad_s,angular_velocity_body_z_rad_s,position_inertial_x_m,"
    "position_inertial_y_m,position_inertial_z_m,velocity_inertial_x_m_s,velocity_inertial_y_m_s,"
    "velocity_inertial_z_m_s";

/// Coordinates that a joint does not have are unknown.
inline constexpr const char* kJointColumns =
    "spacecraft,joint,step,time_s,coordinate_1,coordinate_2,coordinate_3,rate_1,rate_2,rate_3,"
    "motor_torque_1,motor_torque_2,motor_torque_3,force_inertial_x_n,force_inertial_y_n,"
    "force_inertial_z_n,couple_inertial_x_n_m,couple_inertial_y_n_m,couple_inertial_z_n_m";

/// Hears a row; it is lent for the call.
using HearsRow = std::function<void(const report::Fields&)>;

struct SideTable {
  const char* name;     ///< "wheels"
  const char* columns;  ///< between commas
  /// The first spacecraft with rows in it; null: there is none.
  const scene::Spacecraft* (*first)(const std::vector<scene::Spacecraft>& spacecraft);
  const char* none;  ///< what to say then
  void (*rows)(const scene::Scene& scene, runtime::Fleet& fleet, std::uint64_t step,
               std::int64_t time_ns, const HearsRow& hears);
};

/// wheels, pointing, bodies, joints
std::span<const SideTable> side_tables();

}  // namespace adstar::propagation
