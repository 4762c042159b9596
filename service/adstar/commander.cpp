#include "service/adstar/commander.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "service/adstar/failure.hpp"
#include "service/adstar/random_id.hpp"
#include "service/dds/convert.hpp"
#include "service/dds/verdict_text.hpp"

namespace adstar::cli {
namespace {

using namespace std::chrono_literals;

constexpr auto kRepeat = 50ms;
constexpr auto kUntilSomebodyListens = 10ms;
constexpr auto kAskAfter = 1s;
constexpr auto kABeat = 500ms;
/// Time for the service that does fly the spacecraft to speak up.
constexpr auto kProvisional = 300ms;

Answer answer_of(const adstar_CommandStatus& status) {
  const auto verdict = dds::verdict_of(status);
  const auto reason = dds::reason_of(status);
  if (!verdict || !reason) {
    throw Failure(kFailed,
                  fmt::format("service '{}' gave a verdict that this program does not "
                              "know ({}/{}); use the adstar of the service's version",
                              dds::text_of(status.service), static_cast<unsigned>(status.verdict),
                              static_cast<unsigned>(status.reason)));
  }
  const adstar_Vector3& torque = status.torque_applied_n_m;
  const adstar_Vector3& dipole = status.dipole_applied_a_m2;
  return {*verdict,
          *reason,
          std::string(dds::text_of(status.service)),
          status.step,
          status.time_ns,
          status.effective_start_time_ns,
          status.effective_end_time_ns,
          {torque.x, torque.y, torque.z},
          status.speed_applied_rad_s,
          {dipole.x, dipole.y, dipole.z}};
}

}  // namespace

bool Answer::is_final() const { return forgotten || dds::is_final(verdict); }

Commander::Commander(const dds::Participant& participant, Target target)
    : target_(std::move(target)),
      id_(random_id()),
      participant_(participant),
      reader_(participant),
      wait_set_(participant) {
  wait_set_.attach(reader_);
}

std::uint64_t Commander::give(const Order& order) {
  const std::uint64_t sequence = ++last_sequence_;
  Dispatch dispatch;
  dispatch.order = order;
  const auto make = [this](auto& writer) {
    if (!writer) {
      writer.emplace(participant_);
    }
  };
  switch (order.what) {
    case Ordered::torque:
      make(torques_);
      break;
    case Ordered::wheel_torque:
      make(wheel_torques_);
      break;
    case Ordered::wheel_speed:
      make(wheel_speeds_);
      break;
    case Ordered::dipole:
      make(dipoles_);
      break;
    case Ordered::thrust:
      make(thrusters_);
      break;
    case Ordered::joint_torque:
      make(joints_);
      break;
  }
  dispatch.heard = dispatch.next_send = Clock::now();
  dispatches_.emplace(sequence, std::move(dispatch));
  return sequence;
}

template <class Command>
Command Commander::header_of(std::uint64_t sequence, const Order& order) const {
  Command command{};
  dds::set_text(command.spacecraft, target_.spacecraft);
  if constexpr (requires { command.wheel; }) {
    dds::set_text(command.wheel, target_.actuator);
  } else if constexpr (requires { command.magnetorquer; }) {
    dds::set_text(command.magnetorquer, target_.actuator);
  } else if constexpr (requires { command.thruster; }) {
    dds::set_text(command.thruster, target_.actuator);
  } else if constexpr (requires { command.joint; }) {
    dds::set_text(command.joint, target_.actuator);
  } else {
    dds::set_text(command.actuator, target_.actuator);
  }
  command.commander = {id_.high, id_.low};
  command.sequence_number = sequence;
  command.priority = order.priority;
  command.start_time_ns = order.start_ns;
  command.end_time_ns = order.end_ns;
  command.duration_ns = order.duration_ns;
  return command;
}

// A full send window is what the next repetition is for.
void Commander::send(std::uint64_t sequence, const Order& order) {
  switch (order.what) {
    case Ordered::torque: {
      auto command = header_of<adstar_TorqueCommand>(sequence, order);
      command.torque_n_m = {order.torque_n_m[0], order.torque_n_m[1], order.torque_n_m[2]};
      torques_->write(command);
      break;
    }
    case Ordered::wheel_torque: {
      auto command = header_of<adstar_WheelTorqueCommand>(sequence, order);
      command.motor_torque_n_m = order.torque_n_m[0];
      wheel_torques_->write(command);
      break;
    }
    case Ordered::wheel_speed: {
      auto command = header_of<adstar_WheelSpeedCommand>(sequence, order);
      command.speed_rad_s = order.speed_rad_s;
      wheel_speeds_->write(command);
      break;
    }
    case Ordered::dipole: {
      auto command = header_of<adstar_DipoleCommand>(sequence, order);
      command.dipole_body_a_m2 = {order.dipole_a_m2[0], order.dipole_a_m2[1], order.dipole_a_m2[2]};
      dipoles_->write(command);
      break;
    }
    case Ordered::thrust:
      thrusters_->write(header_of<adstar_ThrusterCommand>(sequence, order));
      break;
    case Ordered::joint_torque: {
      auto command = header_of<adstar_JointTorqueCommand>(sequence, order);
      command.motor_torque_n_m = order.torque_n_m[0];
      joints_->write(command);
      break;
    }
  }
}

bool Commander::heard_by_anyone() const {
  const auto heard = [](const auto& writer) { return writer && writer->matched() > 0; };
  return heard(torques_) || heard(wheel_torques_) || heard(wheel_speeds_) || heard(dipoles_) ||
         heard(thrusters_) || heard(joints_);
}

void Commander::work(std::chrono::milliseconds patience) {
  const auto until = Clock::now() + patience;
  for (auto now = Clock::now(); now < until; now = Clock::now()) {
    send_due(now);
    if (take_answers(now) || confirm_provisional(now)) {
      return;
    }
    wait_set_.wait(std::max<Clock::duration>(next_event(until) - Clock::now(), 0ns));
  }
}

bool Commander::silent(std::uint64_t sequence, std::chrono::nanoseconds timeout) const {
  const Dispatch& dispatch = at(sequence);
  const std::chrono::nanoseconds patience =
      dispatch.answer ? std::max<std::chrono::nanoseconds>(timeout, 3 * kAskAfter) : timeout;
  return Clock::now() - dispatch.heard > patience;
}

bool Commander::waits(std::uint64_t sequence) const {
  const Dispatch& dispatch = at(sequence);
  return dispatch.answer && !dispatch.ended() && Clock::now() - dispatch.answered > kABeat;
}

void Commander::send_due(Clock::time_point now) {
  const bool listened_to = heard_by_anyone();
  for (auto& [sequence, dispatch] : dispatches_) {
    if (dispatch.ended() || now < dispatch.next_send) {
      continue;
    }
    if (listened_to) {
      send(sequence, dispatch.order);
    }
    dispatch.next_send = now + (dispatch.answer ? kAskAfter
                                : listened_to   ? kRepeat
                                                : kUntilSomebodyListens);
  }
}

bool Commander::take_answers(Clock::time_point now) {
  bool any = false;
  while (reader_.take([&](const adstar_CommandStatus& status, const dds_sample_info_t&) {
    any = receive(status, now) || any;
  }) > 0) {}
  return any;
}

bool Commander::receive(const adstar_CommandStatus& status, Clock::time_point now) {
  const runtime::CommanderId commander{status.commander.high, status.commander.low};
  const auto found = dispatches_.find(status.sequence_number);
  const bool ours = commander == id_ && found != dispatches_.end() &&
                    dds::text_of(status.spacecraft) == target_.spacecraft &&
                    dds::text_of(status.actuator) == target_.actuator;
  const bool from_target =
      target_.service.empty() || dds::text_of(status.service) == target_.service;
  if (!ours || !from_target || found->second.ended()) {
    return false;
  }
  Dispatch& dispatch = found->second;
  Answer answer = answer_of(status);
  dispatch.heard = now;
  if (answer.reason == runtime::Reason::unknown_spacecraft) {
    if (!dispatch.answer && !dispatch.provisional) {
      dispatch.provisional = std::move(answer);
      dispatch.provisional_until = now + kProvisional;
    }
    return false;
  }
  if (dispatch.answer && answer.reason == runtime::Reason::old_sequence) {
    dispatch.answer->forgotten = true;
    return true;
  }
  if (!dispatch.answer) {
    dispatch.answered = now;
  }
  const bool news = !dispatch.answer || answer.is_final();
  dispatch.next_send = now + kAskAfter;
  dispatch.answer = std::move(answer);
  return news;
}

bool Commander::confirm_provisional(Clock::time_point now) {
  bool any = false;
  for (auto& [sequence, dispatch] : dispatches_) {
    if (!dispatch.answer && dispatch.provisional && now >= dispatch.provisional_until) {
      dispatch.answer = dispatch.provisional;
      any = true;
    }
  }
  return any;
}

Commander::Clock::time_point Commander::next_event(Clock::time_point limit) const {
  for (const auto& [sequence, dispatch] : dispatches_) {
    if (!dispatch.ended()) {
      limit = std::min(limit, dispatch.next_send);
      if (!dispatch.answer && dispatch.provisional) {
        limit = std::min(limit, dispatch.provisional_until);
      }
    }
  }
  return limit;
}

}  // namespace adstar::cli
