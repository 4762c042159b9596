#include "service/bridge/ros2_publisher.hpp"

#include <algorithm>

namespace adstar::bridge {
namespace {

template <class T>
void make(std::optional<dds::Writer<T>>& writer, const dds::Participant& participant,
          const dds::Topic<T>& topic, const std::string& name) {
  writer.emplace(participant, *topic.descriptor, name.c_str(), topic.writer);
}

template <class T>
unsigned write(std::optional<dds::Writer<T>>& writer, const T& sample) {
  return writer && !writer->write(sample) ? 1 : 0;
}

}  // namespace

Ros2Publisher::Ros2Publisher(const dds::Participant& participant, const scene::Scene& scene) {
  for (const std::uint32_t index : scene.telemetry.watched) {
    const std::string& name = scene.spacecraft[index].name;
    Craft& craft = spacecraft_[index];
    craft.body_frame = ros2::body_frame(name);
    if (scene.telemetry.attitude_every > 0) {
      make(craft.attitude, participant, ros2::kAttitude, ros2::name_of(name, ros2::kAttitude));
    }
    if (scene.telemetry.momentum_every > 0) {
      make(craft.angular_momentum, participant, ros2::kAngularMomentum,
           ros2::name_of(name, ros2::kAngularMomentum));
    }
  }
  if (scene.ros2->tf && scene.telemetry.attitude_every > 0) {
    make(tf_, participant, ros2::kTf, ros2::kTf.name);
  }
  if (scene.ros2->clock) {
    make(clock_, participant, ros2::kClock, ros2::kClock.name);
  }
}

unsigned Ros2Publisher::publish(const runtime::TelemetryRecord& record) {
  const auto found = spacecraft_.find(record.spacecraft);
  if (found == spacecraft_.end()) {
    return 0;
  }
  Craft& craft = found->second;
  unsigned unsent = 0;
  if (told_ns_ != record.time_ns) {
    told_ns_ = record.time_ns;
    unsent += write(clock_, {ros2::to_time(record.time_ns)});
  }
  if ((record.topics & runtime::kTopicAttitude) != 0) {
    unsent += write(craft.attitude, ros2::to_attitude(record));
    ros2::TransformStamped transform = ros2::to_transform(record, craft.body_frame);
    unsent += write(tf_, {{1, 1, &transform, false}});
  }
  if ((record.topics & runtime::kTopicMomentum) != 0) {
    unsent += write(craft.angular_momentum, ros2::to_angular_momentum(record));
  }
  return unsent;
}

/// The status is read by another thread than the one that steps: its time would jump against the records'.
unsigned Ros2Publisher::repeat_time(std::int64_t status_time_ns) {
  return write(clock_, {ros2::to_time(told_ns_.value_or(status_time_ns))});
}

bool Ros2Publisher::wait_for_readers(std::chrono::steady_clock::time_point deadline) {
  bool all = true;
  const auto wait = [&](auto& writer) {
    if (writer) {
      const auto left = deadline - std::chrono::steady_clock::now();
      all =
          writer->wait_for_acks(std::max(left, std::chrono::steady_clock::duration::zero())) && all;
    }
  };
  for (auto& [index, craft] : spacecraft_) {
    wait(craft.attitude);
    wait(craft.angular_momentum);
  }
  wait(tf_);
  wait(clock_);
  return all;
}

}  // namespace adstar::bridge
