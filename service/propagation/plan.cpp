#include "service/propagation/plan.hpp"

#include <algorithm>
#include <limits>
#include <string_view>

#include <fmt/format.h>

#include "adstar/gyrostat.hpp"
#include "adstar/integrators/all.hpp"
#include "service/scene/nearest.hpp"

namespace adstar::propagation {
namespace {

using scene::format_duration;

std::uint64_t whole_steps(const std::string& what, const char* option, const Words& words,
                          std::int64_t ns, std::int64_t step_ns) {
  const std::int64_t below = ns / step_ns;
  if (below * step_ns == ns) {
    return static_cast<std::uint64_t>(below);
  }
  std::string choices;
  if (below > 0) {
    choices = words.time(below * step_ns);
  }
  if (below < std::numeric_limits<std::int64_t>::max() / step_ns) {
    choices += (choices.empty() ? "" : " or ") + words.time((below + 1) * step_ns);
  }
  throw Refused(fmt::format("{} is not whole steps of {}; try {}{}{}", what,
                            format_duration(step_ns), option, words.sets, choices));
}

}  // namespace

void require_scheme(const std::string& name, const char* option, const scene::Scene& scene) {
  const auto known = scheme_names();
  if (std::find(known.begin(), known.end(), name) == known.end()) {
    const auto near = scene::nearest_plausible(name, known);
    throw Refused(fmt::format("{}: got '{}', expected one of {}; try {}", option, name,
                              scene::joined(known), near.value_or(known.front())));
  }
  if (const scene::Spacecraft* forced = scene::first_forced(scene.spacecraft);
      forced != nullptr && claims_of(name).free_only) {
    throw Refused(
        fmt::format("{}: got '{}', which knows no torque, and the scene's '{}' "
                    "has one; try {}",
                    option, name, forced->name, known.front()));
  }
  if (const scene::Spacecraft* with_wheels = scene::first_with_wheels(scene.spacecraft);
      with_wheels != nullptr && !carries_wheels(name)) {
    throw Refused(
        fmt::format("{}: got '{}', which carries no wheels, and the scene's '{}' "
                    "has some; try {}",
                    option, name, with_wheels->name, known.front()));
  }
  if (const scene::Spacecraft* linked = scene::first_linked(scene.spacecraft);
      linked != nullptr && !multibody::links_bodies(name)) {
    throw Refused(
        fmt::format("{}: got '{}', which does not step linked bodies, and the "
                    "scene's '{}' has some; try {}",
                    option, name, linked->name, known.front()));
  }
}

Plan make_plan(const scene::Scene& scene, const Request& request, const Words& words) {
  const scene::Simulation& simulation = scene.simulation;
  const auto given = [&](const char* option, std::int64_t ns) {
    return fmt::format("{}{}{}", option, words.sets, words.time(ns));
  };
  Plan plan;
  plan.step_ns = request.step_ns.value_or(simulation.step_ns);
  plan.scheme = request.scheme.value_or(simulation.scheme);
  require_scheme(plan.scheme, words.scheme, scene);
  if (!request.duration_ns && !simulation.duration_ns) {
    throw Refused(fmt::format("the scene is endless; say how long, for example {}",
                              given(words.duration, 100'000'000'000)));
  }
  const std::int64_t duration_ns =
      request.duration_ns ? *request.duration_ns : *simulation.duration_ns;
  plan.steps =
      whole_steps(request.duration_ns ? given(words.duration, duration_ns)
                                      : "the scene's duration " + format_duration(duration_ns),
                  words.duration, words, duration_ns, plan.step_ns);
  if (request.every_ns) {
    plan.every = whole_steps(given(words.every, *request.every_ns), words.every, words,
                             *request.every_ns, plan.step_ns);
  }
  return plan;
}

}  // namespace adstar::propagation
