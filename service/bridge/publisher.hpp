#pragma once
// What adstard left in the shared memory becomes samples on the network. One round is bounded, so
// that no ring keeps the others waiting.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "service/bridge/directory.hpp"
#include "service/bridge/options.hpp"
#include "service/bridge/ros2_publisher.hpp"
#include "service/bridge/status_writer.hpp"
#include "service/dds/convert.hpp"
#include "service/dds/writer.hpp"
#include "service/runtime/shared_segment.hpp"
#include "service/scene/scene.hpp"

namespace adstar::bridge {

struct PublishedCounts {
  std::uint64_t verdicts = 0;
  std::uint64_t telemetry = 0;  ///< records; each is a sample on one topic or more
  std::uint64_t fleet_chunks = 0;
  std::uint64_t unsent = 0;  ///< samples that Cyclone had no room for
};

class Publisher {
 public:
  enum class Left { nothing, fleet, more };

  /// Registers the instances of the watched spacecraft.
  Publisher(const dds::Participant& participant, runtime::MappedSegment& segment,
            const scene::Scene& scene, const Directory& directory, const Options& options,
            AnswerWriters& answers);

  /// Publishes at most one batch of everything; says what waits.
  Left publish_some();

  /// Of what publish_some() publishes, ServiceStatus and StepTiming alone.
  void publish_health();

  /// What the daemon calls itself from now on.
  void rename(std::string_view service);

  /// An answer that was given while this daemon was mute.
  void say(const runtime::VerdictRecord& record);

  /// Gives reliable readers a moment to have it all. False when some did not in time.
  bool wait_for_readers(std::chrono::milliseconds timeout);

  const PublishedCounts& counts() const noexcept { return counts_; }

 private:
  bool publish_verdicts();
  bool publish_telemetry();
  bool publish_wheels();
  bool publish_pointing();
  bool publish_bodies();
  bool publish_joints();
  bool publish_fleet();
  void publish_step_replies(std::size_t count);
  void publish_control_answers();
  void publish_time();
  void count_unsent(bool sent) { counts_.unsent += sent ? 0 : 1; }

  runtime::MappedSegment& segment_;
  const Directory& directory_;
  AnswerWriters& answers_;
  std::string service_;
  dds::ServiceFacts facts_;
  dds::Writer<adstar_AttitudeState> attitude_;
  dds::Writer<adstar_MomentumState> momentum_;
  dds::Writer<adstar_WheelState> wheels_;
  dds::Writer<adstar_PointingState> pointing_;
  dds::Writer<adstar_BodyState> bodies_;
  dds::Writer<adstar_JointState> joints_;
  dds::Writer<adstar_FleetState> fleet_;
  dds::Writer<adstar_ServiceStatus> status_;
  dds::Writer<adstar_StepTiming> timing_;
  std::optional<Ros2Publisher> ros2_;
  PublishedCounts counts_;
  std::uint64_t fleet_seen_ = 0;
  std::uint64_t status_seen_ = 0;
  std::uint64_t time_seen_ = 0;
  std::int64_t status_time_ns_ = 0;
  std::uint64_t timing_seen_ = 0;
  std::vector<std::uint64_t> snapshot_;      ///< our copy of the fleet slot
  std::size_t next_chunk_ = 0;               ///< of the snapshot, to be sent
  std::vector<adstar_FleetMember> members_;  ///< of one chunk
};

}  // namespace adstar::bridge
