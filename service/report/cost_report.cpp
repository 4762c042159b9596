#include "service/report/cost_report.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include <fmt/format.h>

#include "service/report/numbers.hpp"
#include "service/report/torque_estimate.hpp"
#include "service/runtime/fleet.hpp"

namespace adstar::report {
namespace {

/// Nanoseconds a step of it, from t = 0: the median of several stretches, of fewer where a step is long.
double step_cost_ns(const scene::Spacecraft& craft, const scene::Simulation& simulation) {
  using Clock = std::chrono::steady_clock;
  constexpr std::size_t kStretches = 11;
  constexpr auto kStretch = std::chrono::milliseconds(2), kInAll = std::chrono::milliseconds(500);
  runtime::Fleet fleet({craft}, simulation.scheme, simulation.limits, runtime::Lanewise::alone);
  std::vector<double> costs;
  int batch = 1;  // of steps between two looks at the clock
  const auto began = Clock::now();
  for (auto now = began; costs.empty() || (costs.size() < kStretches && now - began < kInAll);) {
    int steps = 0;
    const auto begun = now;
    for (; now - begun < kStretch; now = Clock::now()) {
      for (int k = 0; k < batch; ++k, ++steps) {
        fleet.step(k * simulation.step_ns, simulation.step_ns);
      }
      batch = std::min(2 * batch, 64);
    }
    costs.push_back(std::chrono::duration<double, std::nano>(now - begun).count() / steps);
  }
  const auto middle = costs.begin() + static_cast<std::ptrdiff_t>(costs.size() / 2);
  std::nth_element(costs.begin(), middle, costs.end());
  return *middle;
}

scene::Spacecraft without_models(scene::Spacecraft craft) {
  craft.torques.clear();
  craft.wheels.clear();
  craft.actuators.clear();
  craft.linked.reset();
  craft.first_torque.clear();
  if (craft.initial.H_I.value() == Vec3<double>{}) {
    const RigidBody<double> body(craft.inertia_body_kg_m2);
    craft.initial = make_state(craft.initial.q_IB, body.momentum({0.01, 0.01, 0.01}));
  }
  return craft;
}

std::string models_of(const scene::Spacecraft& craft) {
  std::string models;
  for (const Torque<double>& torque : craft.torques) {
    models += std::visit([](const auto& model) { return std::string(model.kName) + " "; }, torque);
  }
  return models + std::to_string(craft.linked ? craft.linked->bodies.size() : 0) + " " +
         std::to_string(craft.wheels.size());
}

std::string costs_of(const scene::Spacecraft& craft, const scene::Simulation& simulation) {
  const scene::Spacecraft bare = without_models(craft);
  const double base = step_cost_ns(bare, simulation);
  std::string text = fmt::format("    {:<20} {:>7.0f} ns\n", "rigid body", base);
  std::set<std::string_view> told;
  for (const Torque<double>& torque : craft.torques) {
    // Of linked bodies each has its own gravity, and its own outside.
    const std::string_view name =
        std::visit([](const auto& m) -> std::string_view { return m.kName; }, torque);
    if (craft.linked && !told.insert(name).second) {
      continue;
    }
    scene::Spacecraft one = bare;
    one.torques.push_back(torque);
    const double cost = step_cost_ns(one, simulation) - base;
    text += fmt::format("    {:<20} {:>+7.0f} ns\n",
                        std::visit([](const auto& model) { return model.kName; }, torque), cost);
  }
  if (!craft.wheels.empty()) {
    scene::Spacecraft turning = bare;
    turning.wheels = craft.wheels;
    turning.initial = craft.initial;
    text += fmt::format("    {:<20} {:>+7.0f} ns\n",
                        craft.wheels.size() == 1
                            ? std::string("wheel")
                            : fmt::format("{} wheels", counted(craft.wheels.size())),
                        step_cost_ns(turning, simulation) - base);
  }
  if (craft.linked) {
    scene::Spacecraft links = craft;
    links.torques.clear();
    std::fill(links.first_torque.begin(), links.first_torque.end(), 0);
    text += fmt::format("    {:<20} {:>+7.0f} ns\n",
                        fmt::format("{} linked bodies", counted(craft.linked->bodies.size())),
                        step_cost_ns(links, simulation) - base);
  }
  if (craft.torques.size() + (craft.wheels.empty() ? 0 : 1) + (craft.linked ? 1 : 0) > 1) {
    text +=
        fmt::format("    {:<20} {:>7.0f} ns\n", "all together", step_cost_ns(craft, simulation));
  }
  return text;
}

/// Whether a part may turn by more than the whole does.
bool has_moving_joints(const scene::Spacecraft& craft) {
  return craft.linked && std::any_of(craft.linked->joints.begin(), craft.linked->joints.end(),
                                     [](const multibody::Joint<double>& joint) {
                                       return joint.kind != multibody::JointKind::fixed;
                                     });
}

std::string worth_of(const TorqueEstimate& estimate, const scene::Spacecraft& craft,
                     const std::optional<double>& accuracy) {
  if (!estimate.torque_n_m) {
    return "not estimable about another body than the Earth";
  }
  const bool joints_move = has_moving_joints(craft);
  const std::string_view limit = estimate.modelled ? "at most" : "about";
  std::string text =
      fmt::format("{} {:.0e} N m, turns {} by {} {:.0e} rad", limit, *estimate.torque_n_m,
                  craft.linked ? "the whole" : "it", limit, estimate.turn_rad);
  if (joints_move && estimate.turn_rad < std::numbers::pi) {
    text += ", a joint perhaps by more";
  }
  if (accuracy && estimate.modelled && estimate.turn_rad < *accuracy && !joints_move) {
    text += fmt::format(": WARNING, below the {:.0e} rad asked for; leave it out", *accuracy);
  } else if (accuracy && !estimate.modelled && estimate.turn_rad > *accuracy) {
    text += fmt::format(": WARNING, above the {:.0e} rad asked for; name it", *accuracy);
  }
  return text;
}

std::string worths_of(const scene::Spacecraft& craft, const scene::Simulation& simulation) {
  const double horizon = horizon_of(simulation, craft);
  std::string text = fmt::format("over {} s{}\n", short_number(horizon),
                                 craft.linked ? ", the joints as at the start" : "");
  if (!craft.orbit) {
    return text + "    not estimable without an orbit\n";
  }
  for (const TorqueEstimate& estimate : estimates_of(craft, horizon)) {
    text += fmt::format("    {:<17} {:<12} {}\n", estimate.model,
                        estimate.modelled ? "modelled" : "left out",
                        worth_of(estimate, craft, simulation.accuracy_rad));
  }
  return text;
}

std::string more_text(std::size_t kinds, std::size_t shown) {
  return kinds > shown
             ? fmt::format("  {} more kinds of spacecraft are not shown\n", counted(kinds - shown))
             : "";
}

}  // namespace

std::string cost_report(const scene::Scene& scene) {
  constexpr std::size_t kMostKinds = 5;
  const scene::Simulation& simulation = scene.simulation;
  std::string text =
      "cost of a step, measured here (each model alone on the rigid body; median of up to 11)\n";
  std::string worth;
  std::set<std::string> costly, kinds;  // spacecraft that differ in what is said of them
  for (const scene::Spacecraft& craft : scene.spacecraft) {
    if (costly.insert(models_of(craft)).second && costly.size() <= kMostKinds) {
      text += fmt::format("  '{}'\n", craft.name) + costs_of(craft, simulation);
    }
    const std::string estimates = worths_of(craft, simulation);
    if (kinds.insert(models_of(craft) + estimates).second && kinds.size() <= kMostKinds) {
      worth += fmt::format("  '{}', ", craft.name) + estimates;
    }
  }
  return text + more_text(costly.size(), kMostKinds) +
         "torques of the surroundings, to an order of magnitude" +
         (simulation.accuracy_rad ? "" : " (simulation.accuracy_rad says what matters)") + "\n" +
         worth + more_text(kinds.size(), kMostKinds);
}

}  // namespace adstar::report
