// What is told of a vehicle, its wheels, its place in orbit, its linked bodies and their joints.

#include <algorithm>
#include <cmath>

#include "adstar/orbit/orbital_frame.hpp"
#include "service/runtime/fleet.hpp"

namespace adstar::runtime {
namespace {

Vec3<double> momentum_residual(const Vehicle& vehicle) noexcept {
  return (vehicle.state.H_I.value() - vehicle.H_0) - vehicle.state.impulse_I.value();
}

template <std::size_t N>
void assign(std::array<double, N>& target, const Vec3<double>& v) noexcept {
  target = {v.x, v.y, v.z};
}

}  // namespace

TelemetryRecord sample(const Vehicle& vehicle) noexcept {
  TelemetryRecord record;
  const State<double>& state = vehicle.state;
  const Vec3<double> Pi_B = body_momentum(state);
  record.flags = vehicle.flags;
  record.q_IB = {state.q_IB.w, state.q_IB.x, state.q_IB.y, state.q_IB.z};
  assign(record.omega_B_rad_s, angular_velocity_of(vehicle));
  assign(record.H_I_n_m_s, state.H_I.value());
  assign(record.Pi_B_n_m_s, Pi_B);
  record.rotational_energy_j = energy_of(vehicle);
  record.work_j = state.work.value;
  record.energy_residual_j = (record.rotational_energy_j - vehicle.E_0) - record.work_j;
  assign(record.momentum_residual_I_n_m_s, momentum_residual(vehicle));
  return record;
}

WheelRecord sample(const SpinningWheel<double>& spinning, const Vec3<double>& omega_B) noexcept {
  WheelRecord record;
  record.speed_rad_s = spinning.speed(omega_B);
  record.momentum_n_m_s = spinning.h.value;
  if (!spinning.wheel.constant_speed) {
    const MotorTorque<double> motor =
        motor_torque(spinning.wheel, spinning.order, record.speed_rad_s);
    record.motor_torque_n_m = motor.given;
    record.friction_torque_n_m = friction_torque(spinning.wheel, record.speed_rad_s);
    record.flags = (motor.torque_limited ? kWheelTorqueLimited : 0U) |
                   (motor.speed_limited ? kWheelSpeedLimited : 0U);
  }
  return record;
}

void observe(Vehicle& vehicle, std::int64_t t_ns) noexcept {
  multibody::LinkedFlight<double>& flight = *vehicle.linked;
  const std::span<const Torque<double>> torques(vehicle.torques);
  multibody::set_motors(flight, t_ns);
  for (std::size_t i = 0; i < flight.segments.size(); ++i) {
    flight.segments[i] =
        adstar::detail::make_segment(multibody::torques_of(flight, torques, i), t_ns);
  }
  multibody::observe(flight.assembly, flight.work, flight.state, flight.motor_torques.data(),
                     multibody::FlightLoad<double>{flight, torques, seconds<double>(t_ns)});
}

BodyRecord sample_body(const Vehicle& vehicle, std::size_t body) noexcept {
  BodyRecord record;
  const multibody::LinkedFlight<double>& flight = *vehicle.linked;
  const multibody::BodyMotion<double> motion =
      multibody::motion_of(flight.assembly, flight.state, body);
  record.body = static_cast<std::uint32_t>(body);
  record.flags = vehicle.flags;
  record.q_IB = {motion.q_IB.w, motion.q_IB.x, motion.q_IB.y, motion.q_IB.z};
  assign(record.omega_B_rad_s, rotate_inverse(motion.q_IB, motion.omega_I));
  assign(record.position_I_m, motion.x_I);
  assign(record.velocity_I_m_s, motion.v_I);
  return record;
}

JointRecord sample_joint(const Vehicle& vehicle, std::size_t joint) noexcept {
  JointRecord record;
  const multibody::LinkedFlight<double>& flight = *vehicle.linked;
  const multibody::JointKind kind = flight.assembly.joints()[joint].kind;
  record.joint = static_cast<std::uint32_t>(joint);
  record.flags = vehicle.flags;
  record.coordinates = static_cast<std::uint32_t>(multibody::shape_of(kind).coordinates);
  record.coordinate = flight.state.coordinates[joint];
  record.rate = multibody::joint_rates(kind, flight.work.joints[joint]);
  record.motor_torque = flight.motor_torques[joint];
  assign(record.force_I_n, flight.work.loads[joint].force);
  assign(record.couple_I_n_m, flight.work.loads[joint].couple);
  return record;
}

PointingRecord pointing(const Vehicle& vehicle, double t_s) noexcept {
  PointingRecord record;
  const Reference& reference = *vehicle.reference;
  const Quat<double> q_IB = normalised(vehicle.state.q_IB);
  Quat<double> q_IO{};
  if (reference.orbit) {
    const OrbitMotion<double> motion = motion_at(*reference.orbit, t_s);
    const OrbitalFrame<double> frame = orbital_frame_at(*reference.orbit, t_s);
    q_IO = frame.q_IO;
    const Quat<double> q_OB = Quat<double>{q_IO.w, -q_IO.x, -q_IO.y, -q_IO.z} * q_IB;
    record.flags |= kPointingOrbit;
    assign(record.position_I_m, motion.r_I);
    assign(record.velocity_I_m_s, motion.v_I);
    record.q_OB = {q_OB.w, q_OB.x, q_OB.y, q_OB.z};
    assign(record.omega_B_to_O_B_rad_s,
           angular_velocity_of(vehicle) - rotate_inverse(q_OB, frame.omega_O));
  }
  if (reference.target) {
    const Quat<double>& asked = reference.target->attitude;
    record.flags |= kPointingTarget;
    assign(record.error_B_rad,
           rotation_vector(reference.target->orbital ? q_IO * asked : asked, q_IB));
  }
  return record;
}

double momentum_residual_relative(const Vehicle& vehicle) noexcept {
  const double scale =
      std::max(norm(vehicle.state.H_I.value()), norm(vehicle.state.impulse_I.value()));
  return scale == 0 ? 0 : norm(momentum_residual(vehicle)) / scale;
}

}  // namespace adstar::runtime
