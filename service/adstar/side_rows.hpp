#pragma once
// What `adstar propagate` writes beside the motion, each to a file of its own: a row a wheel, a row a spacecraft that
// points.

#include <cstdint>

#include "service/adstar/output.hpp"
#include "service/runtime/fleet.hpp"
#include "service/scene/scene.hpp"

namespace adstar::cli {

inline constexpr const char* kWheelColumns =
    "spacecraft,wheel,step,time_s,speed_rad_s,momentum_n_m_s,motor_torque_n_m,friction_torque_n_"
    "m\n";

void write_wheels(Output& output, const scene::Scene& scene, const runtime::Fleet& fleet,
                  std::uint64_t step, std::int64_t time_ns);

/// Empty where the scene has no orbit, or no target.
inline constexpr const char* kPointingColumns =
    "spacecraft,step,time_s,position_inertial_x_m,position_inertial_y_m,position_inertial_z_m,"
    "velocity_inertial_x_m_s,velocity_inertial_y_m_s,velocity_inertial_z_m_s,"
    "attitude_body_to_orbital_w,attitude_body_to_orbital_x,attitude_body_to_orbital_y,"
    "attitude_body_to_orbital_z,angular_velocity_to_orbital_body_x_rad_s,"
    "angular_velocity_to_orbital_body_y_rad_s,angular_velocity_to_orbital_body_z_rad_s,"
    "pointing_error_body_x_rad,pointing_error_body_y_rad,pointing_error_body_z_rad\n";

void write_pointing(Output& output, const scene::Scene& scene, const runtime::Fleet& fleet,
                    std::uint64_t step, std::int64_t time_ns);

inline constexpr const char* kBodyColumns =
    "spacecraft,body,step,time_s,attitude_body_to_inertial_w,attitude_body_to_inertial_x,"
    "attitude_body_to_inertial_y,attitude_body_to_inertial_z,angular_velocity_body_x_rad_s,"
    "angular_velocity_body_y_rad_s,angular_velocity_body_z_rad_s,position_inertial_x_m,"
    "position_inertial_y_m,position_inertial_z_m,velocity_inertial_x_m_s,velocity_inertial_y_m_s,"
    "velocity_inertial_z_m_s\n";

void write_bodies(Output& output, const scene::Scene& scene, const runtime::Fleet& fleet,
                  std::uint64_t step, std::int64_t time_ns);

/// Coordinates that a joint does not have are empty.
inline constexpr const char* kJointColumns =
    "spacecraft,joint,step,time_s,coordinate_1,coordinate_2,coordinate_3,rate_1,rate_2,rate_3,"
    "motor_torque_1,motor_torque_2,motor_torque_3,force_inertial_x_n,force_inertial_y_n,"
    "force_inertial_z_n,couple_inertial_x_n_m,couple_inertial_y_n_m,couple_inertial_z_n_m\n";

void write_joints(Output& output, const scene::Scene& scene, runtime::Fleet& fleet,
                  std::uint64_t step, std::int64_t time_ns);

}  // namespace adstar::cli
