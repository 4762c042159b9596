// [simulation]

#include <algorithm>
#include <array>
#include <limits>

#include "adstar/integrators/all.hpp"
#include "service/scene/decimal.hpp"
#include "service/scene/nearest.hpp"
#include "service/scene/sections.hpp"

namespace adstar::scene {
namespace {

constexpr std::string_view kDurationRule =
    "a duration above zero in whole nanoseconds (units ns, us, ms, s, min, h, d)";

/// Units people write that are not ours.
struct Alias {
  std::string_view written, unit;
};
constexpr std::array<Alias, 20> kAliases{
    {{"nsec", "ns"}, {"nanoseconds", "ns"}, {"usec", "us"},         {"microseconds", "us"},
     {"msec", "ms"}, {"millisecond", "ms"}, {"milliseconds", "ms"}, {"S", "s"},
     {"sec", "s"},   {"secs", "s"},         {"second", "s"},        {"seconds", "s"},
     {"m", "min"},   {"mins", "min"},       {"minute", "min"},      {"minutes", "min"},
     {"hr", "h"},    {"hour", "h"},         {"hours", "h"},         {"days", "d"}}};

/// The nearest duration to a text that is none.
std::string duration_remedy(const Node& node, std::string_view example) {
  const std::string fallback = in_quotes(example);
  if (node.is_number()) {
    const auto seconds = exact_ns(number_text(node.real), kSecond);
    return seconds && *seconds > 0 ? in_quotes(format_duration(*seconds)) + " if seconds are meant"
                                   : fallback;
  }
  const std::string_view text = node.text;
  const std::size_t end = text.find_first_not_of("0123456789.");
  if (end == 0 || end == std::string_view::npos) {
    return end == 0 || text.empty() ? fallback
                                    : in_quotes(node.text + "s") + " if seconds are meant";
  }
  const std::string number(text.substr(0, end));
  std::string_view unit = text.substr(end);
  unit.remove_prefix(std::min(unit.find_first_not_of(' '), unit.size()));
  for (const Alias& alias : kAliases) {
    const std::string meant = number + std::string(alias.unit);
    if (alias.written == unit && parse_duration(meant).value_or(0) > 0) {
      return in_quotes(meant);
    }
  }
  // A fraction too fine: cut digits until it is whole.
  for (std::size_t length = number.size(); length > 0; --length) {
    const auto ns = parse_duration(number.substr(0, length) + std::string(unit));
    if (ns) {
      return *ns > 0 ? in_quotes(format_duration(*ns)) : "\"1ns\"";
    }
  }
  return fallback;
}

std::optional<std::int64_t> read_duration(const Value& value, std::string_view example) {
  if (!value) {
    return std::nullopt;
  }
  const auto ns = value.is(Node::Kind::string) ? parse_duration(value.node().text) : std::nullopt;
  if (!ns || *ns <= 0) {
    value.refuse(kDurationRule, duration_remedy(value.node(), example));
    return std::nullopt;
  }
  return ns;
}

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
  constexpr std::array<std::string_view, 2> kPaces{"clock", "free"};
  if (value.is(Node::Kind::string) && value.node().text == "lockstep") {
    value.refuse("one of clock, free (lockstep is not available yet)", "\"free\"");
    return Pace::clock;
  }
  return read_choice(value, kPaces).value_or(0) == 1 ? Pace::free : Pace::clock;
}

void read_rate(const Value& value, Simulation& simulation) {
  constexpr double kSlowest = 1e-6, kFastest = 1e6;
  const Want want{"a number from 1e-06 to 1e+06, simulated seconds per second", "1.0"};
  const bool positive = value && value.node().is_number() && value.node().real > 0.0;
  const auto rate = positive ? read_number(value, NumberRange{kSlowest, kFastest}, want)
                             : read_positive(value, want);
  if (rate && simulation.pace == Pace::free) {
    value.refuse("no rate beside pace = \"free\"", "removing it, or pace = \"clock\"");
  }
  simulation.rate = rate.value_or(simulation.rate);
}

void read_epochs(Keys& keys, Simulation& simulation) {
  const Value utc = keys.optional("epoch_utc");
  const Value tai = keys.optional("epoch_tai");
  simulation.epoch = read_epoch(utc, TimeScale::utc);
  const auto epoch_tai = read_epoch(tai, TimeScale::tai);
  if (epoch_tai) {
    simulation.epoch = epoch_tai;
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
  read_rate(keys.optional("rate"), simulation);
  read_epochs(keys, simulation);
  simulation.accuracy_rad =
      read_positive(keys.optional("accuracy_rad"), {"an angle above 0 rad", "1e-6"});
  read_limits(keys, simulation.limits);
  keys.refuse_unknown();
  return section;
}

}  // namespace adstar::scene
