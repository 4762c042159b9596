#pragma once
// The tick: at beat n take the commands, step [t_n, t_n+1], publish t_n+1 at once, account for the
// time.
//
// Nothing in here calls DDS, the logger or the allocator, or waits on a lock; the only system calls
// are the sleep to the next beat and, when the bridge sleeps, one futex wake.

#include <atomic>
#include <cstdint>
#include <vector>

#include "service/runtime/beat_clock.hpp"
#include "service/runtime/fleet.hpp"
#include "service/runtime/gate.hpp"
#include "service/runtime/histogram.hpp"
#include "service/runtime/shared_segment.hpp"
#include "service/scene/scene.hpp"

namespace adstar::runtime {

/// What the tick lets the housekeeping thread see: counters with one writer.
struct TickReport {
  std::atomic<std::uint64_t> step{0};
  std::atomic<std::uint64_t> unresolved_spacecraft{0};
  std::atomic<std::uint64_t> first_unresolved{0};  ///< its index, when there is one
  std::atomic<std::uint64_t> commands_received{0};
  std::atomic<std::uint64_t> commands_refused{0};
  std::atomic<std::uint64_t> verdicts_lost{0};
  std::atomic<std::uint64_t> telemetry_lost{0};
  std::atomic<std::uint64_t> late_beats{0};
  std::atomic<std::uint64_t> overruns{0};
  std::atomic<std::uint64_t> missed_beats{0};
  std::atomic<double> worst_momentum_residual_relative{0};
  Histogram wake_up_lateness;
  Histogram tick_body;
};

class Tick {
 public:
  Tick(const scene::Scene& scene, MappedSegment& segment);

  /// Runs until `stop` is set or the scene's duration is over. Call from the thread that is to be
  /// real-time.
  void run(const std::atomic<bool>& stop) noexcept;

  /// Publishes every spacecraft's state now, marked final; after run(), off real time: waits up to
  /// `patience_ms` for room in the ring.
  void publish_final(int patience_ms);

  const TickReport& report() const noexcept { return report_; }
  const Fleet& fleet() const noexcept { return fleet_; }
  std::int64_t time_ns() const noexcept {
    return static_cast<std::int64_t>(report_.step.load(std::memory_order_relaxed)) * step_ns_;
  }

 private:
  /// Commands judged in one beat, at most; more wait in the ring for the next.
  static constexpr int kCommandsPerBeat = 256;

  void beat(std::uint64_t n, std::int64_t begun_ns) noexcept;
  void publish(std::uint64_t step, bool everything) noexcept;
  std::uint32_t topics_at(std::uint64_t step, bool everything) const noexcept;
  bool push_sample(std::uint32_t spacecraft, std::uint32_t topics, std::uint32_t flags,
                   std::uint64_t step) noexcept;
  void write_fleet(std::uint64_t step, std::uint32_t flags) noexcept;

  MappedSegment& segment_;
  std::int64_t step_ns_;
  std::uint64_t last_step_;  ///< of the scene's duration, or of what 63 bits of nanoseconds hold
  scene::Pace pace_;
  double rate_;
  scene::Telemetry telemetry_;
  Fleet fleet_;
  CommandGate gate_;
  std::vector<std::uint64_t> fleet_words_;
  TickReport report_;
};

}  // namespace adstar::runtime
