#include "service/trade/widened.hpp"

#include <variant>

#include "adstar/integrators/free_exact.hpp"

namespace adstar::trade {
namespace {

Vec3<Wide> widened(const Vec3<double>& v) { return {v.x, v.y, v.z}; }

Constant<Wide> widened(const Constant<double>& m) { return {m.frame, widened(m.torque_n_m)}; }
Harmonic<Wide> widened(const Harmonic<double>& m) {
  return {m.frame, widened(m.amplitude_n_m), widened(m.angular_frequency_rad_s),
          widened(m.phase_rad)};
}
Table<Wide> widened(const Table<double>& m) {
  Table<Wide> wide{m.frame, m.interpolation, m.after_end, m.time_ns, {}};
  for (const Vec3<double>& torque : m.torque_n_m) {
    wide.torque_n_m.push_back(widened(torque));
  }
  return wide;
}
Damping<Wide> widened(const Damping<double>& m) { return {widened(m.coefficient_n_m_s_rad)}; }
GravityGradient<Wide> widened(const GravityGradient<double>& m) {
  const KeplerOrbit<double>& o = m.orbit;
  const Sym3<double>& J = m.inertia_B;
  return {{o.semi_major_axis_m, o.eccentricity, o.mean_motion_rad_s, o.mean_anomaly_rad,
           o.gravity_m3_s2, widened(o.P), widened(o.Q)},
          {J.xx, J.yy, J.zz, J.xy, J.xz, J.yz},
          m.spread_kg_m2};
}
/// Nobody commands here.
Commanded<Wide> widened(const Commanded<double>& m) {
  Commanded<Wide> wide;
  wide.frame = m.frame;
  return wide;
}

}  // namespace

std::vector<Torque<Wide>> widened(const std::vector<Torque<double>>& torques) {
  std::vector<Torque<Wide>> wide;
  for (const Torque<double>& torque : torques) {
    wide.push_back(std::visit([](const auto& m) -> Torque<Wide> { return widened(m); }, torque));
  }
  return wide;
}

std::vector<SpinningWheel<Wide>> widened_wheels(const scene::Spacecraft& craft) {
  std::vector<SpinningWheel<Wide>> wheels;
  for (const scene::NamedWheel& named : craft.wheels) {
    const SpinningWheel<double>& from = named.at_start;
    const Wheel<double>& w = from.wheel;
    SpinningWheel<Wide> to;
    to.wheel = {widened(w.axis_B),   w.spin_inertia_kg_m2, w.constant_speed,
                w.max_torque_n_m,    w.max_speed_rad_s,    w.speed_gain_n_m_s_rad,
                w.viscous_n_m_s_rad, w.coulomb_n_m,        w.coulomb_speed_rad_s};
    to.motor.standing = {from.motor.standing.of_speed, from.motor.standing.value};
    to.h = {from.h.value, from.h.carry};
    wheels.push_back(to);
  }
  return wheels;
}

/// The start as the double-precision run has it, to the bit.
State<Wide> widened_start(const scene::Spacecraft& craft) {
  const State<double>& s = craft.initial;
  return make_state(Quat<Wide>{s.q_IB.w, s.q_IB.x, s.q_IB.y, s.q_IB.z}, widened(s.H_I.value()));
}

RigidBody<Wide> widened_body(const scene::Spacecraft& craft) {
  return RigidBody<Wide>(craft.inertia_body_kg_m2.cast<Wide>());
}

State<Wide> in_closed_form(const scene::Spacecraft& craft, std::int64_t t_ns) {
  State<Wide> state = widened_start(craft);
  FreeExact::step(BodyOf<FreeExact, Wide>(widened_body(craft)), state, seconds<Wide>(t_ns),
                  NoTorque{});
  return state;
}

}  // namespace adstar::trade
