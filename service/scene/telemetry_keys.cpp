// [telemetry]: rates become whole steps, names become indices.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <unordered_map>

#include "service/scene/nearest.hpp"
#include "service/scene/sections.hpp"

namespace adstar::scene {
namespace {

constexpr double kWholeTolerance = 1e-9;
constexpr std::size_t kWatchedByDefault = 64;
/// Steps between two samples; more is a rate that only a slip of the pen asks for.
constexpr double kSlowest = 1e15;

std::string rate_text(double every, double step_s) {
  char text[40];
  std::snprintf(text, sizeof text, "%.12g", 1.0 / (every * step_s));
  return text;
}

std::uint64_t nearest_every(double hz, double step_s) {
  return hz == 0.0 ? 0 : static_cast<std::uint64_t>(std::max(1.0, std::round(1.0 / (hz * step_s))));
}

std::uint64_t read_every(const Value& value, double standard_hz, std::int64_t step_ns) {
  const Want want{"a rate in Hz, 0 for none", "10"};
  const auto hz = read_number(value, NumberRange{.least = 0.0}, want);
  if (step_ns == 0) {
    return 0;
  }
  const double step_s = seconds<double>(step_ns);
  if (!value) {
    return nearest_every(standard_hz, step_s);
  }
  if (!hz || *hz == 0.0) {
    return 0;
  }
  const double every = 1.0 / (*hz * step_s);
  const double whole = std::round(every);
  const std::string fastest = rate_text(1.0, step_s);
  if (whole < 1.0 || every < 1.0 - kWholeTolerance) {
    value.refuse("at most " + fastest + " Hz, every step", fastest);
    return 0;
  }
  if (every > kSlowest) {
    value.refuse("at least a sample in 1e+15 steps, 0 for none", "0");
    return 0;
  }
  if (std::fabs(every - whole) > kWholeTolerance * every) {
    value.refuse(
        "a rate that whole steps of " + format_duration(step_ns) + " give",
        rate_text(std::floor(every), step_s) + " or " + rate_text(std::ceil(every), step_s));
    return 0;
  }
  return static_cast<std::uint64_t>(whole);
}

std::vector<std::uint32_t> read_watched(const Value& value, const Spacecrafts& fleet) {
  std::vector<std::uint32_t> watched;
  if (!value) {
    for (std::size_t i = 0; i < std::min(kWatchedByDefault, fleet.names.size()); ++i) {
      watched.push_back(static_cast<std::uint32_t>(i));
    }
    return watched;
  }
  if (!value.is(Node::Kind::array)) {
    value.refuse("an array of spacecraft names", "[\"sat1\"]");
    return watched;
  }
  const std::vector<std::string_view> names(fleet.names.begin(), fleet.names.end());
  std::unordered_map<std::string_view, std::uint32_t> index;
  for (std::size_t i = 0; i < names.size(); ++i) {
    index.emplace(names[i], static_cast<std::uint32_t>(i));
  }
  std::vector<bool> seen(names.size());
  for (std::size_t i = 0; i < value.node().items.size(); ++i) {
    const Value item = value.item(i);
    const auto name = read_text(item, {"the name of a spacecraft", "\"sat1\""});
    if (!name) {
      continue;
    }
    const auto found = index.find(*name);
    if (found == index.end()) {
      const auto near = nearest(*name, names);
      if (near && fleet.every_name_known) {
        item.refuse("a spacecraft of this scene", in_quotes(*near));
      }
    } else if (seen[found->second]) {
      item.refuse("each spacecraft once", "removing it");
    } else {
      seen[found->second] = true;
      watched.push_back(found->second);
    }
  }
  return watched;
}

}  // namespace

Telemetry read_telemetry(Keys& root, std::int64_t step_ns, const Spacecrafts& fleet) {
  constexpr double kAttitudeHz = 10.0, kMomentumHz = 10.0, kFleetHz = 1.0;
  Keys keys = root.section("telemetry", "[telemetry] on a line of its own");
  Telemetry telemetry;
  telemetry.attitude_every = read_every(keys.optional("attitude_hz"), kAttitudeHz, step_ns);
  telemetry.momentum_every = read_every(keys.optional("momentum_hz"), kMomentumHz, step_ns);
  telemetry.fleet_every =
      read_every(keys.optional("fleet_hz"), fleet.names.size() > 1 ? kFleetHz : 0.0, step_ns);
  constexpr double kWheelHz = 10.0;
  const bool wheels = first_with_wheels(fleet.spacecraft) != nullptr;
  telemetry.wheel_every = read_every(keys.optional("wheel_hz"), wheels ? kWheelHz : 0.0, step_ns);
  constexpr double kPointingHz = 1.0;
  const bool linked = first_linked(fleet.spacecraft) != nullptr;
  telemetry.linked_every = read_every(keys.optional("linked_hz"), linked ? kWheelHz : 0.0, step_ns);
  const bool reference = first_with_reference(fleet.spacecraft) != nullptr;
  telemetry.pointing_every =
      read_every(keys.optional("pointing_hz"), reference ? kPointingHz : 0.0, step_ns);
  telemetry.watched = read_watched(keys.optional("spacecraft"), fleet);
  keys.refuse_unknown();
  return telemetry;
}

}  // namespace adstar::scene
