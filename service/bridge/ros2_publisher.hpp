#pragma once
// Telemetry for ROS 2 nodes, beside our own topics: attitude and momentum of each watched spacecraft, its
// body as a frame of tf2, and simulation time.

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "service/dds/ros2.hpp"
#include "service/dds/writer.hpp"
#include "service/scene/scene.hpp"

namespace adstar::bridge {

class Ros2Publisher {
 public:
  Ros2Publisher(const dds::Participant& participant, const scene::Scene& scene);

  /// What the record is for; the time before it, where it is another than the last. Returns how many samples
  /// could not be sent.
  unsigned publish(const runtime::TelemetryRecord& record);

  /// For who joins a clock that stands, and where there is no other telemetry.
  unsigned repeat_time(std::int64_t status_time_ns);

  /// False when some reader has not acknowledged by then.
  bool wait_for_readers(std::chrono::steady_clock::time_point deadline);

 private:
  struct Craft {
    std::string body_frame;
    std::optional<dds::Writer<ros2::QuaternionStamped>> attitude;
    std::optional<dds::Writer<ros2::Vector3Stamped>> angular_momentum;
  };

  std::map<std::uint32_t, Craft> spacecraft_;  ///< by index
  std::optional<dds::Writer<ros2::TfMessage>> tf_;
  std::optional<dds::Writer<ros2::Clock>> clock_;
  std::optional<std::int64_t> told_ns_;  ///< of the newest record
};

}  // namespace adstar::bridge
