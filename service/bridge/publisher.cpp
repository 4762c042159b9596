#include "service/bridge/publisher.hpp"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "service/bridge/ros2_torques.hpp"
#include "service/bridge/roster.hpp"
#include "service/dds/rate_limit.hpp"
#include "service/dds/refusal_text.hpp"

namespace adstar::bridge {
namespace {

constexpr int kBatch = 512;
// Two chunks are 104 kB: what a default receive buffer takes at once.
constexpr int kFleetBatch = 2;

dds::ServiceFacts facts_of(const scene::Scene& scene, std::string_view service,
                           const Options& options) {
  dds::ServiceFacts facts;
  facts.service = service;
  facts.instance = options.instance;
  facts.started_utc_ns = options.started_utc_ns;
  facts.step_length_ns = scene.simulation.step_ns;
  facts.pace = scene::name_of(scene.simulation.pace);
  facts.scheme = scene.simulation.scheme;
  facts.spacecraft = static_cast<std::uint32_t>(scene.spacecraft.size());
  return facts;
}

void log_control(const runtime::ControlAnswerRecord& answer, std::string_view spacecraft) {
  static dds::RateLimit limit(5);
  if (!limit.admit()) {
    return;
  }
  const std::string what =
      runtime::is_of_one_spacecraft(answer.action)
          ? fmt::format("{} of '{}'", dds::action_name(answer.action), spacecraft)
          : std::string(dds::action_name(answer.action));
  if (answer.refusal == runtime::ControlRefusal::none) {
    spdlog::info("run control: {} done, at step {}", what, answer.step);
  } else {
    spdlog::warn("run control: {} refused: {}", what, dds::refusal_text(answer.refusal));
  }
}

}  // namespace

Publisher::Publisher(const dds::Participant& participant, runtime::MappedSegment& segment,
                     const scene::Scene& scene, const Directory& directory, const Options& options,
                     AnswerWriters& answers)
    : segment_(segment),
      directory_(directory),
      answers_(answers),
      service_(options.service),
      facts_(facts_of(scene, service_, options)),
      attitude_(participant),
      momentum_(participant),
      wheels_(participant),
      pointing_(participant),
      bodies_(participant),
      joints_(participant),
      fleet_(participant),
      status_(participant),
      timing_(participant),
      snapshot_(runtime::fleet_words(segment.fleet_size())),
      next_chunk_(chunks_of(segment.fleet_size())) {
  if (scene.ros2) {
    ros2_.emplace(participant, scene);
  }
  for (const std::uint32_t index : scene.telemetry.watched) {
    const std::string_view name = directory.spacecraft_name(index);
    if (scene.telemetry.attitude_every > 0) {
      attitude_.register_instance(dds::to_attitude({}, name, service_));
    }
    if (scene.telemetry.momentum_every > 0) {
      momentum_.register_instance(dds::to_momentum({}, name, service_));
    }
    const scene::Spacecraft& craft = scene.spacecraft[index];
    if (scene.telemetry.pointing_every > 0 && (craft.orbit || craft.target)) {
      pointing_.register_instance(dds::to_sample(runtime::PointingRecord{}, name, service_));
    }
    if (scene.telemetry.linked_every > 0 && craft.linked) {
      for (const auto& body : craft.linked->bodies) {
        bodies_.register_instance(dds::to_sample(runtime::BodyRecord{}, name, body.name, service_));
      }
      for (const auto& joint : craft.linked->joints) {
        joints_.register_instance(
            dds::to_sample(runtime::JointRecord{}, name, joint.name, service_));
      }
    }
    for (const scene::NamedWheel& wheel : craft.wheels) {
      if (scene.telemetry.wheel_every > 0) {
        wheels_.register_instance(
            dds::to_sample(runtime::WheelRecord{}, name, wheel.name, service_));
      }
    }
  }
}

Publisher::Left Publisher::publish_some() {
  // What was pushed before an answer to a step request is written before it.
  const std::size_t replies = segment_->step_replies.size();
  const bool verdicts = publish_verdicts();
  publish_control_answers();
  const bool wheels = publish_wheels();
  const bool pointing = publish_pointing();
  const bool bodies = publish_bodies();
  const bool joints = publish_joints();
  const bool telemetry = publish_telemetry() || wheels || pointing || bodies || joints;
  const bool fleet = publish_fleet();
  if (!verdicts && !telemetry) {
    publish_step_replies(replies);
  }
  publish_health();
  publish_time();
  return verdicts || telemetry ? Left::more : fleet ? Left::fleet : Left::nothing;
}

bool Publisher::publish_verdicts() {
  for (int i = 0; i < kBatch; ++i) {
    const auto record = segment_->verdicts.pop();
    if (!record) {
      return false;
    }
    say(*record);
  }
  return true;
}

void Publisher::say(const runtime::VerdictRecord& record) {
  const std::string_view spacecraft = directory_.spacecraft_name(record.spacecraft);
  const std::string_view actuator = directory_.actuator_name(record.spacecraft, record.actuator);
  count_unsent(answers_.commands.write(dds::to_sample(record, spacecraft, actuator, service_)));
  log_if_of_ros2(record, spacecraft);
  ++counts_.verdicts;
}

/// Keys that it never wrote are another's, and not its to unregister.
void Publisher::rename(std::string_view service) {
  if (status_seen_ > 0) {
    adstar_ServiceStatus status{};
    dds::set_text(status.service, service_);
    status_.unregister_instance(status);
  }
  if (timing_seen_ > 0) {
    adstar_StepTiming timing{};
    dds::set_text(timing.service, service_);
    timing_.unregister_instance(timing);
  }
  service_ = service;
  facts_.service = service_;
}

void Publisher::publish_step_replies(std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    if (const auto record = segment_->step_replies.pop()) {
      count_unsent(answers_.steps.write(dds::to_sample(*record, service_)));
    }
  }
}

void Publisher::publish_control_answers() {
  for (int i = 0; i < kBatch; ++i) {
    const auto record = segment_->control_answers.pop();
    if (!record) {
      return;
    }
    count_unsent(answers_.controls.write(dds::to_sample(*record, service_)));
    log_control(*record, directory_.spacecraft_name(record->spacecraft));
  }
}

bool Publisher::publish_telemetry() {
  for (int i = 0; i < kBatch; ++i) {
    const auto record = segment_->telemetry.pop();
    if (!record) {
      return false;
    }
    const std::string_view spacecraft = directory_.spacecraft_name(record->spacecraft);
    if ((record->topics & runtime::kTopicAttitude) != 0) {
      count_unsent(attitude_.write(dds::to_attitude(*record, spacecraft, service_)));
    }
    if ((record->topics & runtime::kTopicMomentum) != 0) {
      count_unsent(momentum_.write(dds::to_momentum(*record, spacecraft, service_)));
    }
    if (ros2_) {
      counts_.unsent += ros2_->publish(*record);
    }
    ++counts_.telemetry;
  }
  return true;
}

bool Publisher::publish_wheels() {
  for (int i = 0; i < kBatch; ++i) {
    const auto record = segment_->wheels.pop();
    if (!record) {
      return false;
    }
    count_unsent(wheels_.write(
        dds::to_sample(*record, directory_.spacecraft_name(record->spacecraft),
                       directory_.wheel_name(record->spacecraft, record->wheel), service_)));
    ++counts_.telemetry;
  }
  return true;
}

bool Publisher::publish_bodies() {
  for (int i = 0; i < kBatch; ++i) {
    const auto record = segment_->bodies.pop();
    if (!record) {
      return false;
    }
    count_unsent(bodies_.write(
        dds::to_sample(*record, directory_.spacecraft_name(record->spacecraft),
                       directory_.body_name(record->spacecraft, record->body), service_)));
    ++counts_.telemetry;
  }
  return true;
}

bool Publisher::publish_joints() {
  for (int i = 0; i < kBatch; ++i) {
    const auto record = segment_->joints.pop();
    if (!record) {
      return false;
    }
    count_unsent(joints_.write(
        dds::to_sample(*record, directory_.spacecraft_name(record->spacecraft),
                       directory_.joint_name(record->spacecraft, record->joint), service_)));
    ++counts_.telemetry;
  }
  return true;
}

bool Publisher::publish_pointing() {
  for (int i = 0; i < kBatch; ++i) {
    const auto record = segment_->pointing.pop();
    if (!record) {
      return false;
    }
    count_unsent(pointing_.write(
        dds::to_sample(*record, directory_.spacecraft_name(record->spacecraft), service_)));
    ++counts_.telemetry;
  }
  return true;
}

bool Publisher::publish_fleet() {
  const std::size_t chunks = chunks_of(segment_.fleet_size());
  if (next_chunk_ == chunks) {
    // A snapshot is sent whole before a newer one is looked at.
    const std::uint64_t count = segment_->fleet.read(segment_.fleet_storage(), snapshot_);
    if (count == 0 || count == fleet_seen_) {
      return false;
    }
    fleet_seen_ = count;
    next_chunk_ = 0;
  }
  runtime::FleetHeader header;
  std::memcpy(static_cast<void*>(&header), snapshot_.data(), sizeof header);
  for (int i = 0; i < kFleetBatch && next_chunk_ < chunks; ++i, ++next_chunk_) {
    const std::size_t first = next_chunk_ * kChunk;
    const std::size_t count = std::min(kChunk, segment_.fleet_size() - first);
    members_.resize(count);
    for (std::size_t k = 0; k < count; ++k) {
      runtime::FleetRecord record;
      std::memcpy(static_cast<void*>(&record), &snapshot_[runtime::fleet_words(first + k)],
                  sizeof record);
      members_[k] = dds::to_member(record);
    }
    adstar_FleetState sample{};
    dds::set_text(sample.service, service_);
    sample.chunk = static_cast<std::uint32_t>(next_chunk_);
    sample.step = header.step;
    sample.time_ns = header.time_ns;
    sample.first_spacecraft = static_cast<std::uint32_t>(first);
    sample.members._length = sample.members._maximum = static_cast<std::uint32_t>(count);
    sample.members._buffer = members_.data();
    count_unsent(fleet_.write(sample));
    ++counts_.fleet_chunks;
  }
  return next_chunk_ < chunks;
}

void Publisher::publish_health() {
  runtime::StatusRecord status;
  if (const std::uint64_t count = segment_->status.read(status);
      count > 0 && count != status_seen_) {
    status_seen_ = count;
    status_time_ns_ = status.time_ns;
    count_unsent(status_.write(dds::to_sample(status, facts_)));
  }
  runtime::TimingRecord timing;
  if (const std::uint64_t count = segment_->timing.read(timing);
      count > 0 && count != timing_seen_) {
    timing_seen_ = count;
    count_unsent(timing_.write(dds::to_sample(timing, service_)));
  }
}

/// With every status, which a standby publishes too: it keeps the time to itself.
void Publisher::publish_time() {
  if (ros2_ && time_seen_ != status_seen_) {
    time_seen_ = status_seen_;
    counts_.unsent += ros2_->repeat_time(status_time_ns_);
  }
}

bool Publisher::wait_for_readers(std::chrono::milliseconds timeout) {
  const auto deadline = std::chrono::steady_clock::now() + timeout;
  const auto left = [&] {
    return std::max(deadline - std::chrono::steady_clock::now(),
                    std::chrono::steady_clock::duration::zero());
  };
  bool all = attitude_.wait_for_acks(left());
  all = momentum_.wait_for_acks(left()) && all;
  all = wheels_.wait_for_acks(left()) && all;
  all = pointing_.wait_for_acks(left()) && all;
  all = bodies_.wait_for_acks(left()) && all;
  all = joints_.wait_for_acks(left()) && all;
  all = fleet_.wait_for_acks(left()) && all;
  all = status_.wait_for_acks(left()) && all;
  all = timing_.wait_for_acks(left()) && all;
  all = (!ros2_ || ros2_->wait_for_readers(deadline)) && all;
  all = answers_.steps.writer().wait_for_acks(left()) && all;
  all = answers_.controls.writer().wait_for_acks(left()) && all;
  return answers_.commands.writer().wait_for_acks(left()) && all;
}

}  // namespace adstar::bridge
