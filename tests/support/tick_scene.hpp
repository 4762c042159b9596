#pragma once
// A scene for the tick without a scene file: free pace, two spacecraft with an actuator each.

#include <cstring>
#include <vector>

#include "service/runtime/shared_segment.hpp"
#include "service/scene/scene.hpp"
#include "tests/support/gate_harness.hpp"

namespace adstar::test {

inline scene::Scene tick_scene(std::int64_t steps) {
  scene::Scene scene;
  scene.simulation.step_ns = 10 * kMs;
  scene.simulation.pace = scene::Pace::free;
  if (steps > 0) {
    scene.simulation.duration_ns = steps * scene.simulation.step_ns;
  }
  scene.spacecraft = {make_craft(1, Frame::inertial), make_craft(1, Frame::body)};
  scene.telemetry = {10, 4, 25, {1}};
  return scene;
}

inline std::vector<runtime::TelemetryRecord> telemetry_of(runtime::MappedSegment& segment) {
  std::vector<runtime::TelemetryRecord> all;
  while (const auto record = segment->telemetry.pop()) {
    all.push_back(*record);
  }
  return all;
}

inline std::vector<runtime::VerdictRecord> verdicts_of(runtime::MappedSegment& segment) {
  std::vector<runtime::VerdictRecord> all;
  while (const auto record = segment->verdicts.pop()) {
    all.push_back(*record);
  }
  return all;
}

/// The fleet slot, as a reader of the shared memory sees it.
struct FleetSnapshot {
  std::uint64_t count = 0;
  runtime::FleetHeader header;
  std::vector<runtime::FleetRecord> members;
};

inline FleetSnapshot fleet_of(runtime::MappedSegment& segment) {
  std::vector<std::uint64_t> words(runtime::fleet_words(segment.fleet_size()));
  FleetSnapshot snapshot;
  snapshot.count = segment->fleet.read(segment.fleet_storage(), words);
  snapshot.members.resize(segment.fleet_size());
  std::memcpy(static_cast<void*>(&snapshot.header), words.data(), sizeof snapshot.header);
  std::memcpy(static_cast<void*>(snapshot.members.data()),
              words.data() + sizeof snapshot.header / sizeof(std::uint64_t),
              snapshot.members.size() * sizeof(runtime::FleetRecord));
  return snapshot;
}

}  // namespace adstar::test
