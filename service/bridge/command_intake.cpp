#include "service/bridge/command_intake.hpp"

#include <spdlog/spdlog.h>

#include "service/bridge/staleness.hpp"
#include "service/dds/convert.hpp"
#include "service/dds/rate_limit.hpp"
#include "service/dds/verdict_text.hpp"

namespace adstar::bridge {
namespace {

std::string_view actuator_of(const adstar_TorqueCommand& command) {
  return dds::text_of(command.actuator);
}
std::string_view actuator_of(const adstar_DipoleCommand& command) {
  return dds::text_of(command.magnetorquer);
}
std::string_view actuator_of(const adstar_ThrusterCommand& command) {
  return dds::text_of(command.thruster);
}
std::string_view actuator_of(const adstar_JointTorqueCommand& command) {
  return dds::text_of(command.joint);
}
std::string_view actuator_of(const auto& command) { return dds::text_of(command.wheel); }

template <class Command>
constexpr scene::ActuatorKind kKind = scene::ActuatorKind::wheel;
template <>
constexpr scene::ActuatorKind kKind<adstar_TorqueCommand> = scene::ActuatorKind::torque;
template <>
constexpr scene::ActuatorKind kKind<adstar_DipoleCommand> = scene::ActuatorKind::magnetorquer;
template <>
constexpr scene::ActuatorKind kKind<adstar_JointTorqueCommand> = scene::ActuatorKind::joint;
template <>
constexpr scene::ActuatorKind kKind<adstar_ThrusterCommand> = scene::ActuatorKind::thruster;

}  // namespace

CommandIntake::CommandIntake(const dds::Participant& participant, runtime::SharedSegment& segment,
                             const scene::Scene& scene, const Directory& directory,
                             const OtherServices& others, StatusWriter& statuses,
                             std::string service)
    : segment_(segment),
      directory_(directory),
      others_(others),
      statuses_(statuses),
      service_(std::move(service)),
      torques_(participant),
      wheel_torques_(participant),
      wheel_speeds_(participant),
      dipoles_(participant),
      thrusters_(participant),
      joints_(participant),
      requests_(participant, segment, directory, service_),
      wait_set_(participant) {
  wait_set_.attach(torques_);
  wait_set_.attach(wheel_torques_);
  wait_set_.attach(wheel_speeds_);
  wait_set_.attach(dipoles_);
  wait_set_.attach(thrusters_);
  wait_set_.attach(joints_);
  requests_.attach_to(wait_set_);
  if (scene.ros2 && scene.ros2->torque_validity_ns) {
    ros2_.emplace(participant, scene);
    ros2_->attach_to(wait_set_);
  }
  thread_ = std::thread([this] { listen(); });
}

CommandIntake::~CommandIntake() {
  ending_.store(true);
  try {
    wait_set_.wake();
  } catch (const std::exception& error) {
    spdlog::warn("{}", error.what());  // the thread ends with its next time-out
  }
  thread_.join();
}

void CommandIntake::check() const {
  if (failed_.load()) {
    std::rethrow_exception(failure_);
  }
}

void CommandIntake::listen() noexcept {
  try {
    while (!ending_.load()) {
      wait_set_.wait(std::chrono::seconds(1));
      bool more = true;
      while (more && !ending_.load()) {
        const bool commands = take_commands();
        more = requests_.take_some() || commands;
      }
    }
  } catch (...) {
    failure_ = std::current_exception();
    failed_.store(true);
  }
}

/// False when there was none.
bool CommandIntake::take_commands() {
  std::size_t taken = take_from(torques_);
  taken += take_from(wheel_torques_);
  taken += take_from(wheel_speeds_);
  taken += take_from(dipoles_);
  taken += take_from(thrusters_);
  taken += take_from(joints_);
  taken += ros2_ ? take_from_ros2() : 0;
  return taken > 0;
}

std::size_t CommandIntake::take_from_ros2() {
  return ros2_->take([this](const ros2::WrenchStamped& wrench, const dds_sample_info_t& info,
                            const Ros2Target& target) {
    if (is_stale(info,
                 [&] { return fmt::format("a torque of ROS 2 for '{}'", target.spacecraft); })) {
      stale_.fetch_add(1);
      return;
    }
    const Ros2Wish wish = wish_of(wrench, target);
    if (wish.actuator != nullptr) {
      take(ros2_->command(wrench, target, *wish.actuator));
      return;
    }
    segment_.commands_refused.fetch_add(1);
    log_refused_ros2(target.spacecraft, wish.objection);
  });
}

template <class Command>
std::size_t CommandIntake::take_from(dds::Reader<Command>& reader) {
  return reader.take([this](const Command& command, const dds_sample_info_t& info) {
    if (is_stale(info, [&] {
          return fmt::format("a command for '{}'", dds::text_of(command.spacecraft));
        })) {
      stale_.fetch_add(1);
    } else {
      take(command);
    }
  });
}

template <class Command>
void CommandIntake::take(const Command& command) {
  const auto spacecraft = directory_.spacecraft(dds::text_of(command.spacecraft));
  if (!spacecraft) {
    // Another daemon answers for its own spacecraft.
    if (!others_.flies(dds::text_of(command.spacecraft))) {
      refuse(command, runtime::Reason::unknown_spacecraft);
    }
    return;
  }
  const auto actuator = directory_.actuator(*spacecraft, kKind<Command>, actuator_of(command));
  if (!actuator) {
    refuse(command, runtime::Reason::unknown_actuator);
    return;
  }
  runtime::CommandRecord record = dds::to_record(command, *spacecraft, *actuator);
  record.received_ns = clock_ns(CLOCK_MONOTONIC);
  if (segment_.commands.push(record)) {
    handed_over_.fetch_add(1);
    runtime::wake_tick(segment_);
    return;
  }
  segment_.commands_lost.fetch_add(1);
  static dds::RateLimit limit(1);
  if (limit.admit()) {
    spdlog::warn(
        "the command ring is full, commands are lost; send fewer of them, or find out why adstard "
        "does not take them");
  }
}

template <class Command>
void CommandIntake::refuse(const Command& command, runtime::Reason reason) {
  segment_.commands_refused.fetch_add(1);
  runtime::VerdictRecord verdict;
  verdict.commander = {command.commander.high, command.commander.low};
  verdict.sequence = command.sequence_number;
  verdict.priority = command.priority;
  verdict.verdict = runtime::Verdict::refused;
  verdict.reason = reason;
  runtime::StatusRecord newest;
  if (segment_.status.read(newest) > 0) {
    verdict.step = newest.step;
    verdict.time_ns = newest.time_ns;
  }
  statuses_.write(
      dds::to_sample(verdict, dds::text_of(command.spacecraft), actuator_of(command), service_));
  static dds::RateLimit limit(5);
  if (const auto dropped = limit.admit()) {
    spdlog::warn("refused a command for '{}' actuator '{}': {}", dds::text_of(command.spacecraft),
                 actuator_of(command), dds::reason_text(reason));
    if (*dropped > 0) {
      spdlog::warn("{} more refusals since the last one told", *dropped);
    }
  }
}

}  // namespace adstar::bridge
