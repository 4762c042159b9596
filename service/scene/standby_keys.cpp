// [standby]: a second daemon that goes on when the first is gone.

#include <algorithm>

#include "service/scene/duration_key.hpp"
#include "service/scene/sections.hpp"

namespace adstar::scene {
namespace {

constexpr std::int64_t kMillisecond = 1'000'000;
constexpr std::int64_t kDay = 86'400'000 * kMillisecond;
constexpr std::int64_t kMostSteps = 2000;

std::uint64_t read_lead(const Value& value, std::int64_t step_ns) {
  const std::int64_t lead_ns = read_duration(value, "20ms").value_or(0);
  if (!value) {
    const std::int64_t standard = (20 * kMillisecond + step_ns - 1) / step_ns;
    return static_cast<std::uint64_t>(std::clamp<std::int64_t>(standard, 2, kMostSteps));
  }
  if (lead_ns > 0 && (lead_ns % step_ns != 0 || lead_ns / step_ns > kMostSteps)) {
    const std::int64_t near =
        std::clamp<std::int64_t>((lead_ns + step_ns - 1) / step_ns, 1, kMostSteps);
    value.refuse("whole steps of " + format_duration(step_ns) + ", " + std::to_string(kMostSteps) +
                     " at most",
                 in_quotes(format_duration(near * step_ns)));
  }
  return static_cast<std::uint64_t>(std::max<std::int64_t>(1, lead_ns / step_ns));
}

}  // namespace

std::optional<Standby> read_standby(Keys& root, const Simulation& simulation,
                                    const Service& service) {
  const Value section = root.optional("standby");
  if (!section) {
    return std::nullopt;
  }
  Keys keys(section, "[standby] on a line of its own");
  Standby standby;
  standby.lead_steps =
      read_lead(keys.optional("lead"), std::max<std::int64_t>(1, simulation.step_ns));
  const Value lease = keys.optional("lease");
  const std::int64_t beat = std::clamp<std::int64_t>(beat_ns(simulation), 1, kDay);
  const std::int64_t standard = std::max(100 * kMillisecond, 5 * beat);
  const std::int64_t least = std::max(20 * kMillisecond, 3 * beat);
  standby.lease_ns = read_duration(lease, "100ms").value_or(standard);
  if (standby.lease_ns < least) {
    lease.refuse(
        format_duration(least) +
            " at least: three beats, or a busy machine, are silent so long without being gone",
        in_quotes(format_duration(standard)));
  }
  keys.refuse_unknown();
  if (simulation.pace != Pace::clock) {
    section.refuse_as("beside pace = \"" + std::string(name_of(simulation.pace)) + "\"",
                      "pace = \"clock\": only then a silence means something",
                      "pace = \"clock\" in [simulation]");
  }
  if (service.run_control) {
    section.refuse_as("beside run_control = true",
                      "commands alone to change a run that a standby follows",
                      "run_control = false in [service]");
  }
  return standby;
}

}  // namespace adstar::scene
