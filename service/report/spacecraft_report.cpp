#include "service/report/spacecraft_report.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <numbers>
#include <span>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "adstar/bodies/gyrostat.hpp"
#include "adstar/earth/rotation.hpp"
#include "adstar/multibody/forced.hpp"
#include "service/report/numbers.hpp"

namespace adstar::report {
namespace {

struct Range {
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();

  void add(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
  std::string text() const {
    return least == most ? short_number(least) : short_number(least) + " to " + short_number(most);
  }
};

struct Group {
  std::string first, last;
  std::size_t count = 0;
  std::array<Range, 3> moments;
  Range rate, momentum;
  std::string torques;  ///< a line each
};

const char* frame_name(Frame frame) { return frame == Frame::body ? "body" : "inertial"; }

std::string vector_text(const Vec3<double>& v) {
  return fmt::format("[{}, {}, {}]", short_number(v.x), short_number(v.y), short_number(v.z));
}

std::string details(const Constant<double>& model) {
  return vector_text(model.torque_n_m) + " N m";
}
std::string details(const Harmonic<double>& model) {
  return fmt::format("amplitude {} N m, angular frequency {} rad/s",
                     vector_text(model.amplitude_n_m), vector_text(model.angular_frequency_rad_s));
}
std::string details(const Damping<double>& model) {
  return fmt::format("-c omega, c {} N m s/rad", vector_text(model.coefficient_n_m_s_rad));
}
std::string details(const GravityGradient<double>& model) {
  return fmt::format("at most {} N m", short_number(model.bound()));
}
std::string details(const ResidualDipole<double>& model) {
  return fmt::format("{} A m^2, at most {} N m", vector_text(model.dipole_B_A_m2),
                     short_number(model.bound()));
}
std::string details(const Aerodynamic<double>& model) {
  return fmt::format("{} facets, at most {} N m", model.facets->size(),
                     short_number(model.bound()));
}
std::string details(const SolarPressure<double>& model) {
  return fmt::format("{} facets, at most {} N m", model.facets->size(),
                     short_number(model.bound()));
}
std::string details(const Thruster<double>& model) {
  std::string text = vector_text(model.torque_n_m) + " N m while it is on";
  if (model.schedule) {
    text += fmt::format(", {} times", counted(model.schedule->size()));
  }
  if (model.minimum_on_ns > 0) {
    text += fmt::format(", {} at the least", scene::format_duration(model.minimum_on_ns));
  }
  return text;
}
std::string details(const Magnetorquer<double>& model) {
  const Coils<double>& coils = *model.coils;
  std::string text = fmt::format("at most {} A m^2", vector_text(coils.limit_A_m2));
  if (coils.step_A_m2.x > 0) {
    text += fmt::format(" in steps of {}", short_number(coils.step_A_m2.x));
  }
  if (coils.lag_s > 0) {
    text += fmt::format(", lag {} s", short_number(coils.lag_s));
  }
  return text;
}
std::string details(const Table<double>& model) {
  const bool hold = model.interpolation == Interpolation::hold;
  return fmt::format("{} rows from {} s to {} s, {}, then {}", counted(model.time_ns.size()),
                     seconds_text(model.time_ns.front()), seconds_text(model.time_ns.back()),
                     hold ? "held" : "joined by lines",
                     model.after_end == AfterEnd::hold ? "the last value" : "zero");
}

/// What Spacecraft::torques[i] is, its actuator's name first where it has one.
std::string torque_text(const scene::Spacecraft& craft, std::size_t i) {
  const auto actuator =
      std::find_if(craft.actuators.begin(), craft.actuators.end(), [&](const scene::Actuator& a) {
        return a.kind != scene::ActuatorKind::wheel && a.kind != scene::ActuatorKind::joint &&
               a.index == i;
      });
  return std::visit(
      [&](const auto& model) -> std::string {
        if constexpr (std::is_same_v<std::decay_t<decltype(model)>, Commanded<double>>) {
          return fmt::format("actuator '{}', at most {} N m", actuator->name,
                             vector_text(actuator->limit));
        } else if (actuator != craft.actuators.end()) {
          return fmt::format("actuator '{}', {}", actuator->name, details(model));
        } else {
          return details(model);
        }
      },
      craft.torques[i]);
}

/// Of linked bodies: on which one it acts, and whether to tell of it: gravity acts on each, and is told of once, as is
/// what pushes many.
std::string acts_on(const scene::Spacecraft& craft, std::size_t i, bool& tell) {
  const auto next = std::upper_bound(craft.first_torque.begin(), craft.first_torque.end(), i);
  const auto body = static_cast<std::size_t>(next - craft.first_torque.begin()) - 1;
  if (std::holds_alternative<GravityGradient<double>>(craft.torques[i])) {
    tell = body == 0;
    return ", of the hub; on each body its own, and the tide between them";
  }
  constexpr std::ptrdiff_t kFew = 4;
  const auto& all = craft.torques;
  const auto alike = [&](const Torque<double>& other) { return other.index() == all[i].index(); };
  const auto count = std::count_if(all.begin(), all.end(), alike);
  std::string on = fmt::format(", on '{}'", craft.linked->bodies[body].name);
  std::visit(
      [&](const auto& model) {
        if constexpr (requires { model.force_bound(); }) {
          on += fmt::format(" with at most {} N", short_number(model.force_bound()));
        }
      },
      all[i]);
  if (multibody::pushes(all[i]) && count > kFew) {
    tell =
        std::find_if(all.begin(), all.end(), alike) - all.begin() == static_cast<std::ptrdiff_t>(i);
    on += fmt::format(" and {} others, each by its own outside", count - 1);
  }
  return on;
}

std::string torque_lines(const scene::Spacecraft& craft) {
  std::string text;
  for (std::size_t i = 0; i < craft.torques.size(); ++i) {
    bool tell = true;
    const std::string on = craft.linked ? acts_on(craft, i, tell) : "";
    if (tell) {
      text += std::visit(
          [&](const auto& model) {
            return fmt::format("    torque    {} ({} frame): {}{}\n", model.kName,
                               frame_name(model.frame), torque_text(craft, i), on);
          },
          craft.torques[i]);
    }
  }
  const char* const none = craft.linked ? "    torque    none but those of the joints\n"
                                        : "    torque    none: free rotation\n";
  return text.empty() ? none : text;
}

std::string motor_text(const SpinningWheel<double>& spinning, bool commanded) {
  const Wheel<double>& wheel = spinning.wheel;
  if (wheel.constant_speed) {
    return ", at constant speed";
  }
  if (!(wheel.max_torque_n_m > 0)) {
    return ", no motor";
  }
  const MotorOrder<double>& order = spinning.motor.standing;
  return fmt::format(", motor {} N m up to {} rad/s, {}{}", short_number(wheel.max_torque_n_m),
                     short_number(wheel.max_speed_rad_s),
                     order.of_speed ? "holds " + short_number(order.value) + " rad/s"
                                    : "gives " + short_number(order.value) + " N m",
                     commanded ? " unless commanded" : "");
}

std::string ellipse_text(double semi_major_axis_m, double eccentricity, double mean_motion_rad_s) {
  constexpr double kTurn = 2 * std::numbers::pi;
  return fmt::format("semi-major axis {} m, eccentricity {}, period {} s",
                     short_number(semi_major_axis_m), short_number(eccentricity),
                     short_number(kTurn / mean_motion_rad_s));
}

std::string text_of(const KeplerOrbit<double>& o) {
  return "Kepler, " + ellipse_text(o.semi_major_axis_m, o.eccentricity, o.mean_motion_rad_s);
}
std::string text_of(const SecularOrbit<double>& o) {
  constexpr double kDegreesADay = 86400 * 180 / std::numbers::pi;
  return "Kepler with J2, " +
         ellipse_text(o.at_start.semi_major_axis_m, o.at_start.eccentricity, o.anomaly_rate_rad_s) +
         fmt::format(", node {} deg/day", short_number(kDegreesADay * o.node_rate_rad_s));
}
std::string text_of(const FixedPosition<double>& o) {
  return fmt::format("fixed, {} m from the centre", short_number(o.position.distance_m));
}
std::string text_of(const std::shared_ptr<const Ephemeris<double>>& o) {
  const auto missed = left_out_error(*o);
  return fmt::format(
      "a table of {} epochs, from {} s to {} s{}", counted(o->rows.size()),
      short_number(o->rows.front().t_s), short_number(o->rows.back().t_s),
      missed ? fmt::format("; from every other one it meets the rest within {:.0e} m", *missed)
             : "; too few to tell how well it is met between them");
}

/// Outside its table the spacecraft stands still, which nobody asked for.
std::string span_warning(const Orbit<double>& orbit, double end_of_run_s) {
  const auto [begin, end] = span_s(orbit);
  if (begin <= 0 && end_of_run_s <= end) {
    return {};
  }
  return fmt::format(
      "    WARNING   its orbit is known from {} s to {} s, and not over the whole run\n",
      short_number(begin), short_number(end));
}

std::string spacing_warning(const Orbit<double>& orbit) {
  constexpr double kMost_m = 1000;
  const auto* const table = std::get_if<std::shared_ptr<const Ephemeris<double>>>(&orbit);
  return table != nullptr && left_out_error(**table).value_or(0) > kMost_m
             ? "    WARNING   its polynomial follows the epochs badly: more of them, a higher "
               "degree, or there is a manoeuvre between two\n"
             : "";
}

std::string surface_warning(const Orbit<double>& orbit) {
  const double least = least_distance(orbit);
  return is_about_the_earth(orbit) && least < kEarthPolarRadius_m
             ? fmt::format(
                   "    WARNING   its orbit comes within {} m of the centre, which is "
                   "below the Earth's surface\n",
                   short_number(least))
             : "";
}

std::string orbit_line(const scene::Spacecraft& craft, double end_of_run_s) {
  std::string text;
  if (craft.orbit) {
    text = "    orbit     " +
           std::visit([](const auto& orbit) { return text_of(orbit); }, *craft.orbit) + "\n" +
           span_warning(*craft.orbit, end_of_run_s) + surface_warning(*craft.orbit) +
           spacing_warning(*craft.orbit);
  }
  if (craft.target) {
    const Quat<double>& q = craft.target->attitude;
    text += fmt::format("    pointing  to [{}, {}, {}, {}] in the {} frame\n", short_number(q.w),
                        short_number(q.x), short_number(q.y), short_number(q.z),
                        craft.target->orbital ? "orbital" : "inertial");
  }
  return text;
}

std::string wheel_lines(const scene::Spacecraft& craft) {
  std::string text;
  for (std::size_t i = 0; i < craft.wheels.size(); ++i) {
    const Wheel<double>& wheel = craft.wheels[i].at_start.wheel;
    const bool commanded = std::any_of(
        craft.actuators.begin(), craft.actuators.end(), [&](const scene::Actuator& actuator) {
          return actuator.kind == scene::ActuatorKind::wheel && actuator.index == i;
        });
    std::string friction;
    if (wheel.viscous_n_m_s_rad > 0 || wheel.coulomb_n_m > 0) {
      friction =
          fmt::format(", friction {} N m s/rad + {} N m", short_number(wheel.viscous_n_m_s_rad),
                      short_number(wheel.coulomb_n_m));
    }
    text += fmt::format("    wheel     '{}' about {}, {} kg m^2{}{}\n", craft.wheels[i].name,
                        vector_text(wheel.axis_B), short_number(wheel.spin_inertia_kg_m2),
                        motor_text(craft.wheels[i].at_start, commanded), friction);
  }
  return text;
}

std::string linked_lines(const scene::Spacecraft& craft) {
  if (!craft.linked) {
    return {};
  }
  const scene::LinkedBodies& linked = *craft.linked;
  double mass = 0;
  for (const auto& body : linked.bodies) {
    mass += body.mass_kg;
  }
  std::string text =
      fmt::format("    linked    {} bodies of {} kg, {} joints, on {}\n",
                  counted(linked.bodies.size()), short_number(mass), counted(linked.joints.size()),
                  linked.formulation == multibody::Formulation::se3 ? "SE(3)" : "R3 x SO(3)");
  constexpr std::size_t kShown = 8;
  for (std::size_t i = 0; i < std::min(kShown, linked.joints.size()); ++i) {
    const auto& joint = linked.joints[i];
    const auto motors = std::count_if(linked.motors.begin(), linked.motors.end(),
                                      [&](const auto& motor) { return motor.joint == i; });
    text += fmt::format("    joint     '{}', {}, from '{}' to '{}'{}\n", joint.name,
                        multibody::kind_name(joint.kind),
                        linked.bodies[static_cast<std::size_t>(joint.body_a)].name,
                        linked.bodies[static_cast<std::size_t>(joint.body_b)].name,
                        motors > 0 ? ", with a motor" : "");
  }
  if (linked.joints.size() > kShown) {
    text += fmt::format("    ... {} more joints\n", counted(linked.joints.size() - kShown));
  }
  const multibody::Assembly<double> assembly(linked.bodies, linked.joints,
                                             {linked.formulation, {}});
  for (const auto& loop : assembly.loops()) {
    text += fmt::format("    loop      {}\n",
                        loop.describe(linked.joints[static_cast<std::size_t>(loop.joint)].kind));
  }
  return text;
}

void add(Group& group, const scene::Spacecraft& craft) {
  const RigidBody<double> body(craft.inertia_body_kg_m2);
  group.first = group.count == 0 ? craft.name : group.first;
  group.last = craft.name;
  ++group.count;
  for (std::size_t i = 0; i < 3; ++i) {
    group.moments[i].add(body.moments()[i]);
  }
  const std::vector<SpinningWheel<double>> wheels = scene::spinning_wheels(craft);
  const std::span<const SpinningWheel<double>> all(wheels);
  group.rate.add(
      craft.linked ? norm(craft.linked->bodies.front().omega_B)
                   : norm(angular_velocity(hub_of(body, all), all, body_momentum(craft.initial))));
  group.momentum.add(norm(craft.initial.H_I.value()));
}

std::string text_of(const Group& group) {
  const char* const between = group.count == 2 ? ", " : " ... ";
  std::string title = group.first;
  if (group.count > 1) {
    title += between + group.last + fmt::format(" ({})", counted(group.count));
  }
  return fmt::format(
      "  {}\n"
      "    body      rigid, principal moments {} | {} | {} kg m^2\n"
      "    at t = 0  |omega| {} rad/s, |H| {} N m s\n"
      "{}",
      title, group.moments[0].text(), group.moments[1].text(), group.moments[2].text(),
      group.rate.text(), group.momentum.text(), group.torques);
}

}  // namespace

std::string spacecraft_report(const std::vector<scene::Spacecraft>& spacecraft,
                              double end_of_run_s) {
  std::vector<Group> groups;
  std::map<std::string, std::size_t> by_torques;
  for (const scene::Spacecraft& craft : spacecraft) {
    std::string torques = orbit_line(craft, end_of_run_s) + torque_lines(craft) +
                          wheel_lines(craft) + linked_lines(craft);
    const auto [place, fresh] = by_torques.emplace(torques, groups.size());
    if (fresh) {
      groups.emplace_back();
      groups.back().torques = std::move(torques);
    }
    add(groups[place->second], craft);
  }
  constexpr std::size_t kShown = 20;
  std::string text = fmt::format("spacecraft: {}\n", counted(spacecraft.size()));
  for (std::size_t i = 0; i < std::min(kShown, groups.size()); ++i) {
    text += text_of(groups[i]);
  }
  if (groups.size() > kShown) {
    text += fmt::format("  ... {} more sets of torques\n", counted(groups.size() - kShown));
  }
  return text;
}

}  // namespace adstar::report
