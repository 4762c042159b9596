#include "service/bridge/ros2_torques.hpp"

#include <functional>
#include <map>
#include <mutex>
#include <random>
#include <string>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "service/dds/rate_limit.hpp"
#include "service/dds/verdict_text.hpp"
#include "service/scene/complaints.hpp"

namespace adstar::bridge {
namespace {

std::string name_or_none(const scene::Actuator* actuator) {
  return actuator == nullptr ? std::string() : actuator->name;
}

adstar_CommanderId new_commander() {
  std::random_device random;
  return {kRos2Commander, std::uint64_t{random()} << 32U | random()};
}

void tell(std::string_view spacecraft, std::string_view what) {
  // A node that is wrong all the time does not hide what another hears once. Two threads log.
  static std::mutex mutex;
  static std::map<std::string, dds::RateLimit, std::less<>> limits;
  std::unique_lock lock(mutex);
  const auto known = limits.find(spacecraft);
  dds::RateLimit& limit = known != limits.end()
                              ? known->second
                              : limits.try_emplace(std::string(spacecraft), 1).first->second;
  lock.unlock();
  if (const auto dropped = limit.admit()) {
    spdlog::warn("ROS 2: a torque for '{}' is {}{}", spacecraft, what,
                 *dropped > 0 ? fmt::format(" ({} more since the last one told)", *dropped) : "");
  }
}

}  // namespace

Ros2Target ros2_target(const scene::Spacecraft& spacecraft) {
  return {spacecraft.name, ros2::body_frame(spacecraft.name),
          name_or_none(scene::first_commanded_torque(spacecraft, Frame::body)),
          name_or_none(scene::first_commanded_torque(spacecraft, Frame::inertial))};
}

Ros2Wish wish_of(const ros2::WrenchStamped& wrench, const Ros2Target& target) {
  const auto& force = wrench.wrench.force;
  if (!(force.x == 0 && force.y == 0 && force.z == 0)) {
    return {nullptr, "it has a force, and nothing here moves by one; send force 0, 0, 0"};
  }
  const std::string_view frame = wrench.header.frame_id == nullptr ? "" : wrench.header.frame_id;
  const bool body = frame == target.body_frame;
  if (!body && frame != ros2::kInertialFrame) {
    return {nullptr, fmt::format("its frame_id is {}; send \"{}\" or \"{}\"",
                                 scene::in_quotes(frame), target.body_frame, ros2::kInertialFrame)};
  }
  const std::string& actuator = body ? target.body_actuator : target.inertial_actuator;
  if (actuator.empty()) {
    return {nullptr, fmt::format("the spacecraft has no commanded torque in the frame \"{}\"; see "
                                 "`adstar check`, or add one to the scene",
                                 frame)};
  }
  return {&actuator, {}};
}

Ros2Torques::Ros2Torques(const dds::Participant& participant, const scene::Scene& scene)
    : validity_ns_(scene.ros2->torque_validity_ns.value()), commander_(new_commander()) {
  for (const std::uint32_t index : scene.telemetry.watched) {
    Ros2Target target = ros2_target(scene.spacecraft[index]);
    if (!target.body_actuator.empty() || !target.inertial_actuator.empty()) {
      const std::string name = ros2::name_of(target.spacecraft, ros2::kTorque);
      topics_.push_back(
          {std::move(target),
           {participant, *ros2::kTorque.descriptor, name.c_str(), ros2::kTorque.reader}});
    }
  }
}

void Ros2Torques::attach_to(dds::WaitSet& wait_set) const {
  for (const Topic& topic : topics_) {
    wait_set.attach(topic.reader);
  }
}

adstar_TorqueCommand Ros2Torques::command(const ros2::WrenchStamped& wrench,
                                          const Ros2Target& target, const std::string& actuator) {
  const auto& torque = wrench.wrench.torque;
  adstar_TorqueCommand command{};
  dds::set_text(command.spacecraft, target.spacecraft);
  dds::set_text(command.actuator, actuator);
  command.commander = commander_;
  command.sequence_number = ++sequence_;
  command.start_time_ns = adstar_START_AT_NEXT_BEAT;
  command.duration_ns = validity_ns_;
  command.torque_n_m = {torque.x, torque.y, torque.z};
  return command;
}

void log_refused_ros2(std::string_view spacecraft, std::string_view why) {
  tell(spacecraft, fmt::format("not obeyed: {}", why));
}

void log_if_of_ros2(const runtime::VerdictRecord& record, std::string_view spacecraft) {
  using runtime::Verdict;
  if (record.commander.high != kRos2Commander) {
    return;
  }
  if (record.verdict == Verdict::refused) {
    log_refused_ros2(spacecraft, dds::reason_text(record.reason));
  } else if (record.verdict == Verdict::outranked) {
    log_refused_ros2(spacecraft, "a commander of a higher priority has the actuator");
  } else if (record.verdict == Verdict::clamped) {
    tell(spacecraft,
         fmt::format("scaled to the actuator's limit: {} N m", fmt::join(record.value, ", ")));
  }
}

}  // namespace adstar::bridge
