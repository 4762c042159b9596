#include "service/adstar/propagate_plan.hpp"

#include <algorithm>
#include <limits>
#include <string_view>

#include <fmt/format.h>

#include "adstar/gyrostat.hpp"
#include "adstar/integrators/all.hpp"
#include "service/adstar/failure.hpp"
#include "service/scene/nearest.hpp"

namespace adstar::cli {
namespace {

using scene::format_duration;

std::uint64_t whole_steps(std::string_view what, std::string_view option, std::int64_t ns,
                          std::int64_t step_ns) {
  const std::int64_t below = ns / step_ns;
  if (below * step_ns == ns) {
    return static_cast<std::uint64_t>(below);
  }
  std::string choices;
  if (below > 0) {
    choices = format_duration(below * step_ns);
  }
  if (below < std::numeric_limits<std::int64_t>::max() / step_ns) {
    choices += (choices.empty() ? "" : " or ") + format_duration((below + 1) * step_ns);
  }
  throw Failure(kUsage,
                fmt::format("{} {} is not whole steps of {}; try {} {}", what, format_duration(ns),
                            format_duration(step_ns), option, choices));
}

}  // namespace

void require_scheme(const std::string& name, const char* option, const scene::Scene& scene) {
  const auto known = scheme_names();
  if (std::find(known.begin(), known.end(), name) == known.end()) {
    const auto near = scene::nearest_plausible(name, known);
    throw Failure(kUsage, fmt::format("{}: got '{}', expected one of {}; try {}", option, name,
                                      scene::joined(known), near.value_or(known.front())));
  }
  if (const scene::Spacecraft* forced = scene::first_forced(scene.spacecraft);
      forced != nullptr && claims_of(name).free_only) {
    throw Failure(kUsage, fmt::format("{}: got '{}', which knows no torque, and the scene's '{}' "
                                      "names one; try {}",
                                      option, name, forced->name, known.front()));
  }
  if (const scene::Spacecraft* with_wheels = scene::first_with_wheels(scene.spacecraft);
      with_wheels != nullptr && !carries_wheels(name)) {
    throw Failure(kUsage, fmt::format("{}: got '{}', which carries no wheels, and the scene's '{}' "
                                      "has some; try {}",
                                      option, name, with_wheels->name, known.front()));
  }
  if (const scene::Spacecraft* linked = scene::first_linked(scene.spacecraft);
      linked != nullptr && !multibody::links_bodies(name)) {
    throw Failure(kUsage, fmt::format("{}: got '{}', which does not step linked bodies, and the "
                                      "scene's '{}' has some; try {}",
                                      option, name, linked->name, known.front()));
  }
}

PropagatePlan make_plan(const scene::Scene& scene, const PropagateRequest& request) {
  const scene::Simulation& simulation = scene.simulation;
  PropagatePlan plan;
  plan.step_ns = request.step_ns.value_or(simulation.step_ns);
  plan.scheme = request.scheme.value_or(simulation.scheme);
  require_scheme(plan.scheme, "--scheme", scene);
  if (!request.duration_ns && !simulation.duration_ns) {
    throw Failure(kUsage, "the scene is endless; say how long, for example --duration 100s");
  }
  plan.steps = request.duration_ns
                   ? whole_steps("--duration", "--duration", *request.duration_ns, plan.step_ns)
                   : whole_steps("the scene's duration", "--duration", *simulation.duration_ns,
                                 plan.step_ns);
  if (request.every_ns) {
    plan.every = whole_steps("--every", "--every", *request.every_ns, plan.step_ns);
  }
  return plan;
}

}  // namespace adstar::cli
