// What is told of a spacecraft, its wheels, bodies and joints, record to sample.

#include <algorithm>
#include <array>
#include <cmath>

#include "service/dds/convert.hpp"

namespace adstar::dds {

static_assert(runtime::kFlagUnresolvedAngle == adstar_FLAG_UNRESOLVED_ANGLE);
static_assert(runtime::kFlagUnresolvedEdges == adstar_FLAG_UNRESOLVED_EDGES);
static_assert(runtime::kFlagFinal == adstar_FLAG_FINAL);
static_assert(runtime::kFlagUnresolvedDamping == adstar_FLAG_UNRESOLVED_DAMPING);
static_assert(runtime::kWheelTorqueLimited == adstar_WHEEL_TORQUE_LIMITED);
static_assert(runtime::kWheelSpeedLimited == adstar_WHEEL_SPEED_LIMITED);
static_assert(runtime::kFlagJointOpen == adstar_FLAG_JOINT_OPEN);
static_assert(runtime::kPointingOrbit == adstar_POINTING_ORBIT);
static_assert(runtime::kPointingTarget == adstar_POINTING_TARGET);
static_assert(runtime::kFlagLightAxis == adstar_FLAG_LIGHT_AXIS);
static_assert(runtime::kFlagSeparatrix == adstar_FLAG_SEPARATRIX);
static_assert(runtime::kFlagAttitudeLost == adstar_FLAG_ATTITUDE_LOST);

namespace {

adstar_Vector3 vector(const std::array<double, 3>& v) noexcept { return {v[0], v[1], v[2]}; }

adstar_Quaternion quaternion(const std::array<double, 4>& q) noexcept {
  return {q[0], q[1], q[2], q[3]};
}

/// What every sample of a spacecraft begins with.
template <class Sample, class Record>
Sample begun(const Record& record, std::string_view spacecraft, std::string_view service) noexcept {
  Sample sample{};
  set_text(sample.spacecraft, spacecraft);
  set_text(sample.service, service);
  sample.step = record.step;
  sample.time_ns = record.time_ns;
  sample.flags = record.flags;
  return sample;
}

}  // namespace

adstar_AttitudeState to_attitude(const runtime::TelemetryRecord& record,
                                 std::string_view spacecraft, std::string_view service) noexcept {
  auto sample = begun<adstar_AttitudeState>(record, spacecraft, service);
  sample.attitude_body_to_inertial = quaternion(record.q_IB);
  sample.angular_velocity_body_rad_s = vector(record.omega_B_rad_s);
  return sample;
}

adstar_MomentumState to_momentum(const runtime::TelemetryRecord& record,
                                 std::string_view spacecraft, std::string_view service) noexcept {
  auto sample = begun<adstar_MomentumState>(record, spacecraft, service);
  sample.momentum_inertial_n_m_s = vector(record.H_I_n_m_s);
  sample.momentum_body_n_m_s = vector(record.Pi_B_n_m_s);
  sample.rotational_energy_j = record.rotational_energy_j;
  sample.work_j = record.work_j;
  sample.energy_residual_j = record.energy_residual_j;
  sample.momentum_residual_inertial_n_m_s = vector(record.momentum_residual_I_n_m_s);
  return sample;
}

adstar_WheelState to_sample(const runtime::WheelRecord& record, std::string_view spacecraft,
                            std::string_view wheel, std::string_view service) noexcept {
  auto sample = begun<adstar_WheelState>(record, spacecraft, service);
  set_text(sample.wheel, wheel);
  sample.speed_rad_s = record.speed_rad_s;
  sample.momentum_n_m_s = record.momentum_n_m_s;
  sample.motor_torque_n_m = record.motor_torque_n_m;
  sample.friction_torque_n_m = record.friction_torque_n_m;
  return sample;
}

adstar_PointingState to_sample(const runtime::PointingRecord& record, std::string_view spacecraft,
                               std::string_view service) noexcept {
  auto sample = begun<adstar_PointingState>(record, spacecraft, service);
  sample.position_inertial_m = vector(record.position_I_m);
  sample.velocity_inertial_m_s = vector(record.velocity_I_m_s);
  sample.attitude_body_to_orbital = quaternion(record.q_OB);
  sample.angular_velocity_to_orbital_body_rad_s = vector(record.omega_B_to_O_B_rad_s);
  sample.pointing_error_body_rad = vector(record.error_B_rad);
  const std::array<double, 3>& e = record.error_B_rad;
  sample.pointing_error_rad = std::sqrt(e[0] * e[0] + e[1] * e[1] + e[2] * e[2]);
  return sample;
}

adstar_BodyState to_sample(const runtime::BodyRecord& record, std::string_view spacecraft,
                           std::string_view body, std::string_view service) noexcept {
  auto sample = begun<adstar_BodyState>(record, spacecraft, service);
  set_text(sample.body, body);
  sample.attitude_body_to_inertial = quaternion(record.q_IB);
  sample.angular_velocity_body_rad_s = vector(record.omega_B_rad_s);
  sample.position_inertial_m = vector(record.position_I_m);
  sample.velocity_inertial_m_s = vector(record.velocity_I_m_s);
  return sample;
}

adstar_JointState to_sample(const runtime::JointRecord& record, std::string_view spacecraft,
                            std::string_view joint, std::string_view service) noexcept {
  auto sample = begun<adstar_JointState>(record, spacecraft, service);
  set_text(sample.joint, joint);
  sample.coordinates = record.coordinates;
  std::copy(record.coordinate.begin(), record.coordinate.end(), sample.coordinate);
  std::copy(record.rate.begin(), record.rate.end(), sample.rate);
  std::copy(record.motor_torque.begin(), record.motor_torque.end(), sample.motor_torque);
  sample.force_inertial_n = vector(record.force_I_n);
  sample.couple_inertial_n_m = vector(record.couple_I_n_m);
  return sample;
}

adstar_FleetMember to_member(const runtime::FleetRecord& record) noexcept {
  adstar_FleetMember member{};
  member.attitude_body_to_inertial = quaternion(record.q_IB);
  member.angular_velocity_body_rad_s = vector(record.omega_B_rad_s);
  member.momentum_inertial_n_m_s = vector(record.H_I_n_m_s);
  member.rotational_energy_j = record.rotational_energy_j;
  member.energy_residual_j = record.energy_residual_j;
  member.flags = static_cast<std::uint32_t>(record.flags);
  return member;
}

}  // namespace adstar::dds
