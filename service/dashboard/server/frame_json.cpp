#include "service/dashboard/server/frame_json.hpp"

#include <cmath>
#include <iterator>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "service/adstar/service_state.hpp"
#include "service/adstar/services.hpp"
#include "service/adstar/timing_text.hpp"
#include "service/dds/convert.hpp"
#include "service/dds/verdict_text.hpp"

namespace adstar::dashboard {
namespace {

using Json = nlohmann::ordered_json;

double seconds(std::int64_t ns) { return static_cast<double>(ns) / 1e9; }

double seconds(Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

double length(const Vector& v) { return std::hypot(v[0], v[1], v[2]); }

template <std::size_t N>
std::string name_in(const char (&text)[N]) {
  return cli::printable(dds::text_of(text));
}

std::string dumped(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json motion_json(std::string_view name, const Motion& motion, Clock::time_point now) {
  return {{"name", name},
          {"service", motion.service},
          {"step", motion.step},
          {"time_s", seconds(motion.time_ns)},
          {"age_s", seconds(now - motion.heard)},
          {"q_IB", motion.q_IB},
          {"omega_B_rad_s", motion.omega_B},
          {"H_I_n_m_s", motion.H_I},
          {"Pi_B_n_m_s", motion.Pi_B},
          {"momentum_residual_I_n_m_s", motion.momentum_residual_I},
          {"energy_j", motion.energy_j},
          {"work_j", motion.work_j},
          {"energy_residual_j", motion.energy_residual_j},
          {"flags", motion.flags}};
}

Json service_json(const std::string& name, const ServiceRecord& service, Clock::time_point now) {
  Json json{{"name", name}, {"age_s", seconds(now - service.heard)}};
  if (service.status) {
    const adstar_ServiceStatus& s = *service.status;
    json["run"] = fmt::format("{:016x}{:016x}/{}", s.instance_high, s.instance_low, s.run);
    json["step"] = s.step;
    json["time_s"] = seconds(s.time_ns);
    json["step_length_ns"] = s.step_length_ns;
    json["pace"] = name_in(s.pace);
    json["scheme"] = name_in(s.scheme);
    json["spacecraft"] = s.spacecraft;
    json["unresolved_spacecraft"] = s.unresolved_spacecraft;
    json["worst_momentum_residual_relative"] = s.worst_momentum_residual_relative;
    json["commands_received"] = s.commands_received;
    json["commands_refused"] = s.commands_refused;
    json["commands_lost"] = s.commands_lost;
    json["verdicts_lost"] = s.verdicts_lost;
    json["telemetry_lost"] = s.telemetry_lost;
    json["bridge_restarts"] = s.bridge_restarts;
  }
  if (service.timing) {
    json["timing"] = Json::parse(cli::timing_json(*service.timing));
  }
  json["state"] = service.status   ? cli::state_word(service.status->state)
                  : service.timing ? cli::state_word(service.timing->state)
                                   : "unknown";
  return json;
}

Json verdict_json(const VerdictEntry& entry) {
  const adstar_CommandStatus& s = entry.status;
  const auto reason = dds::reason_of(s);
  return {{"number", entry.number},
          {"spacecraft", name_in(s.spacecraft)},
          {"actuator", name_in(s.actuator)},
          {"service", name_in(s.service)},
          {"commander", fmt::format("{:016x}{:016x}", s.commander.high, s.commander.low)},
          {"sequence", s.sequence_number},
          {"verdict", verdict_word(s.verdict)},
          {"reason", reason ? dds::reason_name(*reason) : "unknown"},
          {"time_s", seconds(s.time_ns)},
          {"start_s", seconds(s.effective_start_time_ns)},
          {"end_s", seconds(s.effective_end_time_ns)},
          {"torque_applied_n_m",
           {s.torque_applied_n_m.x, s.torque_applied_n_m.y, s.torque_applied_n_m.z}}};
}

/// A column of numbers; six digits are enough to sort and to look at.
class Column {
 public:
  void add(double value) {
    text_ += text_.empty() ? "" : ",";
    if (std::isfinite(value)) {
      fmt::format_to(std::back_inserter(text_), "{:.6g}", value);
    } else {
      text_ += "null";
    }
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace

const char* verdict_word(adstar_Verdict verdict) {
  adstar_CommandStatus status{};
  status.verdict = verdict;
  const auto known = dds::verdict_of(status);
  return known ? dds::verdict_text(*known) : "unknown";
}

std::string frame_json(const Board& board, std::string_view watched, std::uint64_t after_verdict,
                       Clock::time_point now) {
  const std::string name = watched.empty() ? board.first_spacecraft() : std::string(watched);
  const auto motion = board.motion(name);
  const Member* member = board.member(name);
  Json frame{{"watched", name}};
  frame["spacecraft"] = motion ? motion_json(name, *motion, now) : Json(nullptr);
  frame["actuators"] = member != nullptr ? Json(member->actuators) : Json::array();
  frame["services"] = Json::array();
  for (const auto& [service, record] : board.services()) {
    frame["services"].push_back(service_json(service, record, now));
  }
  frame["verdicts"] = Json::array();
  for (const VerdictEntry& entry : board.verdicts()) {
    if (entry.number > after_verdict) {
      frame["verdicts"].push_back(verdict_json(entry));
    }
  }
  return dumped(frame);
}

std::string fleet_json(const Board& board) {
  std::size_t count = 0;
  Json names = Json::array(), services = Json::array();
  Column time, rate, momentum, energy, energy_residual, flags;
  board.each_motion([&](const std::string& name, const Motion& motion) {
    if (++count > kMostListed) {
      return;
    }
    names.push_back(name);
    services.push_back(motion.service);
    time.add(seconds(motion.time_ns));
    rate.add(length(motion.omega_B));
    momentum.add(length(motion.H_I));
    energy.add(motion.energy_j);
    energy_residual.add(motion.energy_residual_j);
    flags.add(motion.flags);
  });
  return fmt::format(
      "{{\"spacecraft\":{},\"name\":{},\"service\":{},\"time_s\":[{}],\"rate_rad_s\":[{}],"
      "\"momentum_n_m_s\":[{}],\"energy_j\":[{}],\"energy_residual_j\":[{}],\"flags\":[{}]}}",
      count, dumped(names), dumped(services), time.text(), rate.text(), momentum.text(),
      energy.text(), energy_residual.text(), flags.text());
}

}  // namespace adstar::dashboard
