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
KeplerOrbit<Wide> widened(const KeplerOrbit<double>& o) {
  return {o.semi_major_axis_m, o.eccentricity, o.mean_motion_rad_s, o.mean_anomaly_rad,
          o.gravity_m3_s2,     widened(o.P),   widened(o.Q)};
}
SecularOrbit<Wide> widened(const SecularOrbit<double>& o) {
  const OrbitElements<double>& e = o.at_start;
  return {{e.semi_major_axis_m, e.eccentricity, e.inclination_rad, e.right_ascension_rad,
           e.argument_of_periapsis_rad, e.mean_anomaly_rad, e.gravity_m3_s2},
          o.node_rate_rad_s,
          o.periapsis_rate_rad_s,
          o.anomaly_rate_rad_s,
          {o.tilt.sin, o.tilt.cos}};
}
FixedPosition<Wide> widened(const FixedPosition<double>& o) {
  return {{widened(o.position.direction_I), o.position.distance_m}, o.gravity_m3_s2};
}
std::shared_ptr<const Ephemeris<Wide>> widened(const std::shared_ptr<const Ephemeris<double>>& o) {
  Ephemeris<Wide> wide;
  for (const EphemerisRow<double>& row : o->rows) {
    wide.rows.push_back({row.t_s, widened(row.r_I), widened(row.v_I)});
  }
  wide.method = o->method;
  wide.degree = o->degree;
  wide.gravity_m3_s2 = o->gravity_m3_s2;
  wide.least_distance_m = o->least_distance_m;
  wide.greatest_speed_m_s = o->greatest_speed_m_s;
  return std::make_shared<const Ephemeris<Wide>>(std::move(wide));
}
Orbit<Wide> widened(const Orbit<double>& orbit) {
  return std::visit([](const auto& o) -> Orbit<Wide> { return widened(o); }, orbit);
}
GravityGradient<Wide> widened(const GravityGradient<double>& m) {
  const Sym3<double>& J = m.inertia_B;
  return {widened(m.orbit), {J.xx, J.yy, J.zz, J.xy, J.xz, J.yz}, m.spread_kg_m2};
}
EarthRotation<Wide> widened(const EarthRotation<double>& r) {
  return {widened(r.Q_x), widened(r.Q_y), widened(r.Q_z), r.angle_rad, r.rate_rad_s};
}
FieldOnOrbit<Wide> widened(const FieldOnOrbit<double>& f) {
  MagneticField<Wide> field;
  field.rotation = widened(f.field.rotation);
  field.dipole = {widened(f.field.dipole.g_T)};
  if (f.field.harmonics) {
    field.harmonics = std::make_shared<const HarmonicField<Wide>>(*f.field.harmonics);
  }
  return {widened(f.orbit), field};
}
ResidualDipole<Wide> widened(const ResidualDipole<double>& m) {
  return {widened(m.dipole_B_A_m2), std::make_shared<const FieldOnOrbit<Wide>>(widened(*m.field))};
}
Facets<Wide> widened(const Facets<double>& facets) {
  std::vector<Facet<Wide>> wide;
  for (const Facet<double>& f : *facets) {
    wide.push_back({f.area_m2, widened(f.normal_B), widened(f.centre_B_m), f.drag_coefficient,
                    f.specular, f.diffuse});
  }
  return make_facets(std::move(wide));
}
Aerodynamic<Wide> widened(const Aerodynamic<double>& m) {
  return {widened(m.orbit), widened(m.rotation), widened(m.facets), m.density_factor};
}
SolarPressure<Wide> widened(const SolarPressure<double>& m) {
  return {widened(m.orbit),  {m.sun.days_since_J2000_at_start},
          widened(m.facets), m.shadow,
          m.seasonal,        m.pressure_N_m2};
}
/// Nobody commands here, but a schedule does.
Thruster<Wide> widened(const Thruster<double>& m) {
  Thruster<Wide> wide;
  wide.torque_n_m = widened(m.torque_n_m);
  wide.minimum_on_ns = m.minimum_on_ns;
  wide.schedule = m.schedule;
  return wide;
}
Magnetorquer<Wide> widened(const Magnetorquer<double>& m) {
  Coils<Wide> coils;
  for (std::size_t i = 0; i < coils.axes_B.size(); ++i) {
    coils.axes_B[i] = widened(m.coils->axes_B[i]);
  }
  coils.limit_A_m2 = widened(m.coils->limit_A_m2);
  coils.step_A_m2 = widened(m.coils->step_A_m2);
  coils.lag_s = m.coils->lag_s;
  coils.field = widened(m.coils->field);
  Magnetorquer<Wide> wide;
  wide.coils = std::make_shared<const Coils<Wide>>(std::move(coils));
  return wide;
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

multibody::LinkedFlight<Wide> widened_flight(const scene::Spacecraft& craft) {
  const scene::LinkedBodies& from = *craft.linked;
  const auto turn = [](const Quat<double>& q) { return Quat<Wide>{q.w, q.x, q.y, q.z}; };
  const auto frame = [&](const multibody::JointFrame<double>& f) {
    return multibody::JointFrame<Wide>{widened(f.point_B), turn(f.q_BF)};
  };
  std::vector<multibody::BodySpec<Wide>> bodies;
  for (const multibody::BodySpec<double>& b : from.bodies) {
    bodies.push_back({b.name, b.mass_kg, b.inertia_B.cast<Wide>(), widened(b.x_I), turn(b.q_IB),
                      widened(b.v_I), widened(b.omega_B)});
  }
  std::vector<multibody::Joint<Wide>> joints;
  for (const multibody::Joint<double>& j : from.joints) {
    multibody::Joint<Wide> joint{j.name, j.kind, j.body_a, j.body_b, frame(j.a), frame(j.b), {}};
    for (std::size_t k = 0; k < j.laws.size(); ++k) {
      const multibody::CoordinateLaw<double>& law = j.laws[k];
      joint.laws[k] = {law.stiffness, law.rest,  law.damping,        law.stops,
                       law.lower,     law.upper, law.stop_stiffness, law.stop_dissipation};
    }
    joints.push_back(std::move(joint));
  }
  multibody::LinkedFlight<Wide> flight(
      multibody::Assembly<Wide>(bodies, std::move(joints), {from.formulation, {}}));
  for (const multibody::CoordinateMotor<double>& motor : from.motors) {
    flight.motors.push_back({motor.joint, motor.coordinate, motor.standing, {}});
  }
  flight.first_torque = craft.first_torque;
  for (const Torque<double>& torque : craft.torques) {
    if (std::holds_alternative<GravityGradient<double>>(torque)) {
      flight.tide = {widened(*craft.orbit)};
    }
  }
  return flight;
}

State<Wide> in_closed_form(const scene::Spacecraft& craft, std::int64_t t_ns) {
  State<Wide> state = widened_start(craft);
  FreeExact::step(BodyOf<FreeExact, Wide>(widened_body(craft)), state, seconds<Wide>(t_ns),
                  NoTorque{});
  return state;
}

}  // namespace adstar::trade
