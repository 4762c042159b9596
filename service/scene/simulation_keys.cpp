// [simulation]

#include <array>
#include <limits>

#include "adstar/integrators/all.hpp"
#include "service/scene/duration_key.hpp"
#include "service/scene/nearest.hpp"
#include "service/scene/sections.hpp"

namespace adstar::scene {
namespace {

std::optional<std::int64_t> read_run_length(const Value& value, std::int64_t step_ns) {
  if (!value || value.node().text == "endless") {
    return std::nullopt;
  }
  const auto ns = read_duration(value, "100s");
  if (!ns || step_ns == 0 || *ns % step_ns == 0) {
    return ns;
  }
  const std::int64_t below = *ns - *ns % step_ns;
  std::string remedy = below > 0 ? in_quotes(format_duration(below)) : "";
  if (below <= std::numeric_limits<std::int64_t>::max() - step_ns) {
    remedy += (remedy.empty() ? "" : " or ") + in_quotes(format_duration(below + step_ns));
  }
  value.refuse("a whole multiple of the step " + format_duration(step_ns), remedy);
  return std::nullopt;
}

Pace read_pace(const Value& value) {
  constexpr std::array<std::string_view, 3> kPaces{"clock", "free", "lockstep"};
  return static_cast<Pace>(read_choice(value, kPaces).value_or(0));
}

void read_lockstep_timeout(const Value& value, Simulation& simulation) {
  if (!value) {
    return;
  }
  if (simulation.pace != Pace::lockstep) {
    value.refuse("no lockstep_timeout beside pace = " + in_quotes(name_of(simulation.pace)),
                 "removing it, or pace = \"lockstep\"");
  } else {
    read_duration_or_off(value, "10s", simulation.lockstep_timeout_ns);
  }
}

void read_rate(const Value& value, Simulation& simulation) {
  constexpr double kSlowest = 1e-6, kFastest = 1e6;
  const Want want{"a number from 1e-06 to 1e+06, simulated seconds per second", "1.0"};
  const bool positive = value && value.node().is_number() && value.node().real > 0.0;
  const auto rate = positive ? read_number(value, NumberRange{kSlowest, kFastest}, want)
                             : read_positive(value, want);
  if (rate && simulation.pace != Pace::clock) {
    value.refuse("no rate beside pace = " + in_quotes(name_of(simulation.pace)),
                 "removing it, or pace = \"clock\"");
  }
  simulation.rate = rate.value_or(simulation.rate);
}

/// A grid of whole nanoseconds on a clock that stands for the time of day: neither free of it nor faster.
void read_phase_reference(const Value& value, Simulation& simulation) {
  constexpr std::array<std::string_view, 3> kReferences{"none", "realtime", "tai"};
  simulation.phase_reference =
      static_cast<PhaseReference>(read_choice(value, kReferences).value_or(0));
  if (simulation.phase_reference == PhaseReference::none) {
    return;
  }
  if (simulation.pace != Pace::clock || simulation.rate != 1.0) {
    value.refuse("phase_reference only beside pace = \"clock\" and rate = 1.0", "removing it");
  }
}

void read_epochs(Keys& keys, Simulation& simulation) {
  const Value utc = keys.optional("epoch_utc");
  const Value tai = keys.optional("epoch_tai");
  simulation.epoch = read_epoch(utc, TimeScale::utc);
  const auto epoch_tai = read_epoch(tai, TimeScale::tai);
  if (epoch_tai) {
    simulation.epoch = epoch_tai;
  }
  if ((utc || tai) && !simulation.epoch) {
    simulation.epoch =
        "2026-01-01T00:00:00 UTC";  // refused: a stand-in, so that nobody else asks for a date
  }
  if (utc && tai) {
    tai.refuse_as("a second epoch", "epoch_utc or epoch_tai, not both", "removing one of the two");
  }
}

void read_limits(Keys& keys, StepLimits& limits) {
  constexpr double kWidest =
      3.0;  // dexpinv is singular at 2π, and its coefficients are proven to π
  constexpr IntegerRange kParts{1, 100'000};
  const Want count{"an integer from 1 to 100000", "64"};
  limits.substep_angle_rad = read_positive(keys.optional("substep_angle_limit_rad"),
                                           {"an angle above 0 and at most 3 rad", "1.0"}, kWidest)
                                 .value_or(limits.substep_angle_rad);
  limits.substeps =
      read_integer(keys.optional("substep_limit"), kParts, count).value_or(limits.substeps);
  limits.edges = read_integer(keys.optional("edge_limit"), kParts, count).value_or(limits.edges);
}

}  // namespace

SimulationSection read_simulation(Keys& root) {
  Keys keys = root.section("simulation", "[simulation] on a line of its own");
  SimulationSection section;
  Simulation& simulation = section.simulation;
  simulation.step_ns =
      read_duration(keys.required("step", {kDurationRule, "\"10ms\""}), "10ms").value_or(0);
  const std::vector<std::string_view> schemes = scheme_names();
  section.scheme = keys.optional("scheme");
  if (const auto scheme = read_choice(section.scheme, schemes)) {
    simulation.scheme = schemes[*scheme];
  }
  simulation.duration_ns = read_run_length(keys.optional("duration"), simulation.step_ns);
  simulation.pace = read_pace(keys.optional("pace"));
  read_lockstep_timeout(keys.optional("lockstep_timeout"), simulation);
  read_rate(keys.optional("rate"), simulation);
  read_phase_reference(keys.optional("phase_reference"), simulation);
  read_epochs(keys, simulation);
  simulation.accuracy_rad =
      read_positive(keys.optional("accuracy_rad"), {"an angle above 0 rad", "1e-6"});
  read_limits(keys, simulation.limits);
  keys.refuse_unknown();
  return section;
}

}  // namespace adstar::scene
