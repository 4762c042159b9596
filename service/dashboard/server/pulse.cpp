#include "service/dashboard/server/pulse.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "service/adstar/stop_signal.hpp"
#include "service/adstar/verdict_sentence.hpp"
#include "service/dds/verdict_text.hpp"

namespace adstar::dashboard {
namespace {

using namespace std::chrono_literals;
using Json = nlohmann::json;

constexpr auto kTimeout = 5s;
constexpr std::size_t kLongestName = 63;
constexpr double kLongest_s = 1e6;
constexpr std::array<std::string_view, 4> kKeys{"spacecraft", "actuator", "torque_n_m",
                                                "duration_s"};

[[noreturn]] void wrong(const std::string& what) { throw std::invalid_argument(what); }

std::string name_at(const Json& json, const char* key) {
  const auto found = json.find(key);
  if (found == json.end() || !found->is_string()) {
    wrong(fmt::format("{}: expected a name in quotes", key));
  }
  auto name = found->get<std::string>();
  if (name.empty() || name.size() > kLongestName) {
    wrong(fmt::format("{}: got {} bytes, expected 1 to {}", key, name.size(), kLongestName));
  }
  return name;
}

double number(const Json& json, const char* key, const char* unit) {
  if (!json.is_number() || !std::isfinite(json.get<double>())) {
    wrong(fmt::format("{}: expected a finite number [{}]", key, unit));
  }
  return json.get<double>();
}

PulseAnswer plain(int status, const char* verdict, const std::string& sentence) {
  return {status, Json{{"verdict", verdict}, {"sentence", sentence}}.dump(
                      -1, ' ', false, Json::error_handler_t::replace)};
}

}  // namespace

Pulse pulse_of(std::string_view text) {
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) {
    wrong(R"(expected an object such as {"spacecraft": "sat1", "actuator": "body", )"
          R"("torque_n_m": [0, 0, 0.05], "duration_s": 5})");
  }
  for (const auto& [key, value] : json.items()) {
    if (std::find(kKeys.begin(), kKeys.end(), key) == kKeys.end()) {
      wrong(fmt::format("{}: unknown key; expected spacecraft, actuator, torque_n_m, duration_s",
                        key.substr(0, kLongestName)));
    }
  }
  Pulse pulse;
  pulse.target = {name_at(json, "spacecraft"), name_at(json, "actuator"), {}};
  const Json torque = json.value("torque_n_m", Json());
  if (!torque.is_array() || torque.size() != 3) {
    wrong("torque_n_m: expected three numbers [N m], such as [0, 0, 0.05]");
  }
  for (std::size_t i = 0; i < 3; ++i) {
    pulse.order.torque_n_m[i] = number(torque[i], "torque_n_m", "N m");
  }
  const double duration_s = number(json.value("duration_s", Json()), "duration_s", "s");
  if (duration_s < 1e-9 || duration_s > kLongest_s) {
    wrong(fmt::format("duration_s: got {}, expected 1e-9 to {:g}", duration_s, kLongest_s));
  }
  pulse.order.duration_ns = std::llround(duration_s * 1e9);
  return pulse;
}

PulseAnswer PulseDesk::send(const Pulse& pulse) {
  const std::unique_lock turn(busy_, kTimeout);
  if (!turn) {
    return plain(503, "busy", "another command is under way; try again");
  }
  using cli::Commander;
  Commander commander(participant_, pulse.target);
  const std::uint64_t sequence = commander.give(pulse.order);
  while (!cli::stop_requested()) {
    commander.work(50ms);
    const auto& dispatch = commander.at(sequence);
    if (dispatch.ended() || commander.waits(sequence)) {
      return plain(200, dds::verdict_text(dispatch.answer->verdict),
                   cli::verdict_sentence(*dispatch.answer, pulse.order));
    }
    if (commander.silent(sequence, kTimeout)) {
      const std::int64_t timeout_ns = std::chrono::nanoseconds(kTimeout).count();
      return plain(504, "no_answer",
                   cli::no_answer_sentence(commander.heard_by_anyone(), timeout_ns,
                                           participant_.options(), {}));
    }
  }
  return plain(503, "no_answer", "the dashboard ends; a command that was accepted still runs");
}

}  // namespace adstar::dashboard
