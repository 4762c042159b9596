#pragma once
// Beside the tick: once in a while look at what it counted, tell the bridge, and log what changed.

#include <cstdint>

#include "service/runtime/real_time.hpp"
#include "service/runtime/shared_segment.hpp"
#include "service/runtime/tick.hpp"
#include "service/scene/scene.hpp"

namespace adstar::adstard {

class Housekeeping {
 public:
  Housekeeping(const scene::Scene& scene, const runtime::Tick& tick,
               runtime::MappedSegment& segment);

  /// What the tick's thread got of the system; known once it has started.
  void set_real_time(const runtime::RealTime& real_time) { real_time_ = real_time; }

  /// Writes status and timing for the bridge and logs changes since the last call. Once a second
  /// will do.
  void look(std::uint64_t bridge_restarts, bool stopped);

  /// The run in a few lines.
  void summarise() const;

 private:
  void log_changes();

  const scene::Scene& scene_;
  const runtime::Tick& tick_;
  runtime::MappedSegment& segment_;
  runtime::RealTime real_time_;
  std::uint64_t unresolved_seen_ = 0;
  std::uint64_t missed_seen_ = 0;
  std::uint64_t overruns_seen_ = 0;
  std::uint64_t commands_lost_seen_ = 0;
  std::uint64_t verdicts_lost_seen_ = 0;
  std::uint64_t telemetry_lost_seen_ = 0;
};

}  // namespace adstar::adstard
