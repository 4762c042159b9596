#pragma once
// Beside the tick: once in a while look at what it counted, tell the bridge, and log what changed.

#include <array>
#include <cstdint>
#include <optional>

#include "service/adstard/recorder.hpp"
#include "service/runtime/real_time.hpp"
#include "service/runtime/shared_segment.hpp"
#include "service/runtime/tick.hpp"
#include "service/scene/scene.hpp"

namespace adstar::adstard {

class Housekeeping {
 public:
  Housekeeping(const scene::Scene& scene, const runtime::Tick& tick,
               runtime::MappedSegment& segment);

  /// The tick's thread, once it has started: faults and switches count from here.
  void watch_thread(int thread) {
    thread_ = thread;
    at_start_ = runtime::account_of(thread);
  }

  /// While it is still there, after its last beat.
  void thread_is_done() { at_end_ = runtime::account_of(thread_); }

  /// Writes status and timing for the bridge and logs changes since the last call. Once a second
  /// will do.
  void look(std::uint64_t bridge_restarts, const StateHash& hash, bool stopped);

  /// The run in a few lines.
  void summarise() const;

 private:
  runtime::StatusRecord status(std::uint64_t bridge_restarts, const StateHash& hash,
                               bool stopped) const;
  runtime::TimingRecord timing(bool stopped) const;
  runtime::RunState state(bool stopped) const;
  void log_changes(const runtime::TimingRecord& now);
  void log_silence();
  void log_budget(const runtime::TimingRecord& now);

  const scene::Scene& scene_;
  const runtime::Tick& tick_;
  runtime::MappedSegment& segment_;
  int thread_ = 0;
  runtime::ThreadAccount at_start_;
  std::optional<runtime::ThreadAccount> at_end_;
  bool halt_said_ = false;
  bool silence_said_ = false;
  std::int64_t silence_since_ns_ = 0;
  std::array<std::uint64_t, runtime::kPhases> over_budget_seen_{};
  std::uint64_t unresolved_seen_ = 0;
  std::uint64_t missed_seen_ = 0;
  std::uint64_t overruns_seen_ = 0;
  std::uint64_t commands_lost_seen_ = 0;
  std::uint64_t verdicts_lost_seen_ = 0;
  std::uint64_t telemetry_lost_seen_ = 0;
};

}  // namespace adstar::adstard
