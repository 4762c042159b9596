#include "service/propagation/unresolved.hpp"

#include <fmt/format.h>

#include "adstar/integrators/all.hpp"
#include "service/report/numbers.hpp"

namespace adstar::propagation {
namespace {

constexpr std::size_t kNamed = 3;

}  // namespace

void Unresolved::note(const runtime::Fleet& fleet, std::int64_t time_ns) {
  if (!any_) {
    any_ = true;
    first_ns_ = time_ns;
  }
  for (std::size_t i = 0; i < flags_.size(); ++i) {
    flags_[i] |= fleet.vehicles()[i].flags;
  }
}

std::string Unresolved::warning(const scene::Scene& scene, const Plan& plan,
                                const Words& words) const {
  std::string text;
  const auto say = [&](std::uint32_t flag, const std::string& fault, const std::string& remedy) {
    std::string names;
    std::size_t count = 0;
    for (std::size_t i = 0; i < flags_.size(); ++i) {
      if ((flags_[i] & flag) != 0 && ++count <= kNamed) {
        names += (names.empty() ? "" : ", ") + scene.spacecraft[i].name;
      }
    }
    if (count > 0) {
      text += fmt::format(
          "{}{} of {} spacecraft ({}{}) {}, first in the step to {} s: their rows are not to be "
          "trusted; {}",
          text.empty() ? "" : "\n", report::counted(count), report::counted(flags_.size()), names,
          count > kNamed ? ", ..." : "", fault, report::seconds_text(first_ns_), remedy);
    }
  };
  // What it takes beside the turn, where that is what some had too much of.
  const auto reach = [&] {
    std::uint32_t flags = 0;
    for (const std::uint32_t each : flags_) {
      flags |= each;
    }
    return (flags & runtime::kFlagJointOpen) != 0 ? "follow with its joints closed"
           : (flags & runtime::kFlagSeparatrix) != 0
               ? "follow beside the separatrix, where errors grow"
           : (flags & runtime::kFlagLightAxis) != 0 ? "follow while an axis is so light"
                                                    : "reach";
  };
  const StepLimits limits = limits_for(plan.scheme, scene.simulation.limits);
  const auto shorter = [&](const char* limit) {
    return fmt::format("take a shorter {}, or raise simulation.{}", words.step, limit);
  };
  const std::string step = scene::format_duration(plan.step_ns);
  say(runtime::kFlagUnresolvedAngle,
      fmt::format("turned further in {} than {} sub-steps of {} rad {}", step, limits.substeps,
                  report::short_number(limits.substep_angle_rad), reach()),
      shorter("substep_limit"));
  say(runtime::kFlagUnresolvedDamping,
      fmt::format("are damped too stiffly for {} sub-steps in {}", limits.substeps, step),
      shorter("substep_limit"));
  say(runtime::kFlagUnresolvedEdges,
      fmt::format("met more than {} torque edges in one step of {}", limits.edges, step),
      shorter("edge_limit"));
  return text;
}

}  // namespace adstar::propagation
