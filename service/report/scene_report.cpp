#include "service/report/scene_report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include <fmt/format.h>

#include "adstar/gyrostat.hpp"
#include "adstar/integrators/all.hpp"
#include "service/report/numbers.hpp"
#include "service/report/ros2_report.hpp"
#include "service/report/spacecraft_report.hpp"
#include "service/scene/dds_domain.hpp"

namespace adstar::report {
namespace {

struct SchemeFacts {
  int order = 0;
  double stage_reach = 1;
  Sensitivity sensitivity;
};

SchemeFacts facts_of(const std::string& scheme) {
  SchemeFacts facts;
  with_scheme(scheme, [&](auto s) {
    facts = {decltype(s)::kOrder, static_cast<double>(decltype(s)::kStageReach),
             sensitivity_of<decltype(s)>()};
  });
  return facts;
}

std::string pace_text(const scene::Simulation& simulation) {
  switch (simulation.pace) {
    case scene::Pace::clock:
      return fmt::format("clock, rate {}", short_number(simulation.rate));
    case scene::Pace::free:
      return "free, as fast as it can";
    case scene::Pace::lockstep:
      return "lockstep, a step for every one that a StepRequest asks for";
  }
  return scene::name_of(simulation.pace);
}

std::string simulation_report(const scene::Simulation& simulation) {
  std::string text = fmt::format(
      "simulation\n  step      {}, scheme {} of order {}\n  duration  {}\n  pace      {}\n",
      scene::format_duration(simulation.step_ns), simulation.scheme,
      facts_of(simulation.scheme).order,
      simulation.duration_ns ? scene::format_duration(*simulation.duration_ns) : "endless",
      pace_text(simulation));
  if (simulation.epoch) {
    text += fmt::format("  epoch     {} at t = 0\n", *simulation.epoch);
  }
  if (simulation.accuracy_rad) {
    text += fmt::format("  accuracy  {} rad asked for\n", short_number(*simulation.accuracy_rad));
  }
  return text;
}

/// With wheels the hub's energy is the bound (adstar/gyrostat.hpp).
double speed_bound_squared(const RigidBody<double>& hub,
                           const std::vector<SpinningWheel<double>>& wheels,
                           const Vec3<double>& Pi_B) {
  const Vec3<double> hub_Pi_B = Pi_B - wheel_momentum(std::span(wheels));
  return wheels.empty() ? angular_speed_bound_squared(hub, Pi_B, 0.0)
                        : 2 * hub.energy(hub_Pi_B) * hub.inverse_moments()[0];
}

SubstepCount count_with_wheels(const std::string& scheme, const RigidBody<double>& hub,
                               const std::vector<SpinningWheel<double>>& wheels,
                               const Vec3<double>& Pi_B, double decay, double h,
                               const StepLimits& limits) {
  SubstepCount count;
  with_scheme(scheme, [&](auto s) {
    if constexpr (TakesWheels<decltype(s)>) {
      count = adstar::detail::count_gyrostat_parts<decltype(s), double>(hub, wheels, Pi_B, 0.0,
                                                                        decay, h, limits);
    }
  });
  return count;
}

/// Of linked bodies the fastest at the start [rad/s]; what springs and dampers ask for beside it only a step knows.
double fastest_rate(const scene::LinkedBodies& linked) {
  double fastest = 0;
  for (const auto& body : linked.bodies) {
    fastest = std::max(fastest, norm(body.omega_B));
  }
  return fastest;
}

/// The largest turn in one step, from what the spacecraft have at the start.
std::string turn_report(const scene::Scene& scene) {
  const StepLimits limits = limits_for(scene.simulation.scheme, scene.simulation.limits);
  const double h = seconds<double>(scene.simulation.step_ns);
  const SchemeFacts facts = facts_of(scene.simulation.scheme);
  double largest = 0;
  const scene::Spacecraft* fastest = &scene.spacecraft.front();
  std::int64_t parts = 1;
  bool resolved = true;
  for (const scene::Spacecraft& craft : scene.spacecraft) {
    if (craft.linked) {
      const double turn = h * fastest_rate(*craft.linked);
      if (turn > largest) {
        largest = turn;
        fastest = &craft;
      }
      const double wanted = std::ceil(turn / limits.substep_angle_rad);
      resolved = resolved && wanted <= static_cast<double>(limits.substeps);
      parts = std::max(
          parts, static_cast<std::int64_t>(std::min(wanted, static_cast<double>(limits.substeps))));
      continue;
    }
    const std::vector<SpinningWheel<double>> wheels = scene::spinning_wheels(craft);
    const RigidBody<double> body = hub_of(RigidBody<double>(craft.inertia_body_kg_m2),
                                          std::span<const SpinningWheel<double>>(wheels));
    const Vec3<double> Pi_B = body_momentum(craft.initial);
    const double turn = h * std::sqrt(speed_bound_squared(body, wheels, Pi_B));
    if (turn > largest) {
      largest = turn;
      fastest = &craft;
    }
    const Vec3<double> damping =
        adstar::detail::make_segment(std::span<const Torque<double>>(craft.torques), 0).damping;
    const double decay = decay_rate(body, damping);
    const SubstepCount count =
        wheels.empty()
            ? count_substeps(body, Pi_B, 0.0, h, facts.stage_reach, limits, facts.sensitivity,
                             decay)
            : count_with_wheels(scene.simulation.scheme, body, wheels, Pi_B, decay, h, limits);
    parts = std::max(parts, count.parts);
    resolved = resolved && count.within_limit;
  }
  const char* const format =
      "turn in a step\n  |omega| h at most {} rad without torque ('{}'); a part of a step may turn "
      "{} rad: {}\n";
  std::string verdict = "no sub-steps at the start";
  if (!resolved) {
    verdict = fmt::format(
        "WARNING, {} sub-steps (simulation.substep_limit) do not suffice; take a shorter step",
        limits.substeps);
  } else if (parts > 1) {
    verdict = fmt::format("{} sub-steps at the start, at most {}", parts, limits.substeps);
  }
  return fmt::format(fmt::runtime(format), short_number(largest), fastest->name,
                     short_number(limits.substep_angle_rad), verdict);
}

std::string topic_line(const char* topic, std::uint64_t every, std::int64_t step_ns,
                       const std::string& of) {
  const std::string rate =
      every == 0
          ? "off"
          : fmt::format("{} Hz, {}",
                        short_number(1.0 / (static_cast<double>(every) * seconds<double>(step_ns))),
                        of);
  return fmt::format("  adstar/{:<15} {}\n", topic, rate);
}

std::string telemetry_report(const scene::Scene& scene) {
  const scene::Telemetry& telemetry = scene.telemetry;
  const std::int64_t step_ns = scene.simulation.step_ns;
  const std::string watched = fmt::format("{} of {} spacecraft", counted(telemetry.watched.size()),
                                          counted(scene.spacecraft.size()));
  std::string text = "telemetry (per simulated second)\n";
  text += topic_line("attitude_state", telemetry.attitude_every, step_ns, watched);
  text += topic_line("momentum_state", telemetry.momentum_every, step_ns, watched);
  if (telemetry.wheel_every > 0) {
    text += topic_line("wheel_state", telemetry.wheel_every, step_ns, watched);
  }
  if (telemetry.linked_every > 0) {
    text += topic_line("body_state", telemetry.linked_every, step_ns, watched);
    text += topic_line("joint_state", telemetry.linked_every, step_ns, watched);
  }
  if (telemetry.pointing_every > 0) {
    text += topic_line("pointing_state", telemetry.pointing_every, step_ns, watched);
  }
  text += topic_line("fleet_state", telemetry.fleet_every, step_ns, "all spacecraft");
  return text;
}

std::string dds_report(const scene::Scene& scene) {
  const scene::Dds& dds = scene.dds;
  std::string text = fmt::format(
      "dds\n  domain {}, {}, interface {}\n", dds.domain,
      dds.partition.empty() ? "default partition" : "partition " + dds.partition, dds.interface);
  if (dds.domain > scene::kMostSafeDomain) {
    text += fmt::format(
        "  WARNING: Linux hands the ports of a domain above {} to any program, and the service "
        "does "
        "not start while one is taken\n",
        scene::kMostSafeDomain);
  }
  if (dds.interface == "lo") {
    text += "  loopback only: nothing outside this machine hears or commands it\n";
  } else if (!dds.security) {
    text += fmt::format(
        "  WARNING: whoever reaches interface {} can command these spacecraft; set interface = "
        "\"lo\", or see deploy/security/README.md\n",
        dds.interface);
  }
  if (dds.security) {
    text += fmt::format("  DDS Security: certificate {}, permissions {}\n",
                        dds.security->identity_certificate.string(),
                        dds.security->permissions.string());
  }
  return text;
}

/// The models that no spacecraft of the scene names.
std::string left_out(const scene::Scene& scene) {
  const auto any = [&](const auto& has) {
    return std::any_of(scene.spacecraft.begin(), scene.spacecraft.end(), has);
  };
  const auto names = [&](const auto& is_one) {
    return any([&](const scene::Spacecraft& craft) {
      return std::any_of(craft.torques.begin(), craft.torques.end(), is_one);
    });
  };
  std::vector<std::string> absent;
  if (!any([](const scene::Spacecraft& craft) { return craft.orbit.has_value(); })) {
    absent.emplace_back("orbit");
  }
  if (scene::first_linked(scene.spacecraft) == nullptr) {
    absent.emplace_back("translation");
    absent.emplace_back("linked bodies");
  }
  const auto list = [&]<class Model>(const char* what) {
    if (!names([](const Torque<double>& t) { return std::holds_alternative<Model>(t); })) {
      absent.emplace_back(what);
    }
  };
  list.operator()<GravityGradient<double>>("gravity gradient");
  list.operator()<ResidualDipole<double>>("residual dipole");
  list.operator()<Magnetorquer<double>>("magnetorquers");
  list.operator()<Aerodynamic<double>>("aerodynamic torque");
  list.operator()<SolarPressure<double>>("solar-radiation torque");
  list.operator()<Thruster<double>>("thrusters");
  if (scene::first_with_wheels(scene.spacecraft) == nullptr) {
    absent.emplace_back("wheels");
  }
  absent.emplace_back("flexible bodies");
  absent.emplace_back("fuel slosh");
  std::string text = "not modelled\n";
  std::string line = " ";
  constexpr std::size_t kWidth = 100;
  for (std::size_t i = 0; i < absent.size(); ++i) {
    const std::string word = " " + absent[i] + (i + 1 < absent.size() ? "," : "");
    if (line.size() + word.size() > kWidth) {
      text += line + "\n";
      line = " ";
    }
    line += word;
  }
  return text + line + "\n";
}

}  // namespace

std::string scene_report(const scene::Scene& scene) {
  const double end_of_run_s = scene.simulation.duration_ns
                                  ? seconds<double>(*scene.simulation.duration_ns)
                                  : std::numeric_limits<double>::max();
  return simulation_report(scene.simulation) + spacecraft_report(scene.spacecraft, end_of_run_s) +
         turn_report(scene) + telemetry_report(scene) + dds_report(scene) + ros2_report(scene) +
         left_out(scene);
}

}  // namespace adstar::report
