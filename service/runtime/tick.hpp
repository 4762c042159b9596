#pragma once
// The tick: at beat n take the commands, step [t_n, t_n+1], publish t_n+1 at once (the state of a large fleet in parts,
// over the beats after it), account for the time.
//
// Nothing in here calls DDS, the logger or the allocator, or waits on a lock; the only system calls
// are the sleep to the next beat and, when the bridge sleeps, one futex wake.

#include <array>
#include <atomic>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "service/runtime/beat_clock.hpp"
#include "service/runtime/fleet.hpp"
#include "service/runtime/fleet_snapshot.hpp"
#include "service/runtime/gate.hpp"
#include "service/runtime/held_commands.hpp"
#include "service/runtime/histogram.hpp"
#include "service/runtime/run_control.hpp"
#include "service/runtime/shared_segment.hpp"
#include "service/runtime/step_digests.hpp"
#include "service/runtime/step_requests.hpp"
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
  std::atomic<std::uint64_t> late_after_work{0};
  std::atomic<std::uint64_t> late_after_loss{0};
  std::atomic<std::uint64_t> late_after_sleep{0};
  std::atomic<std::uint64_t> overruns{0};
  std::atomic<std::uint64_t> missed_beats{0};
  std::atomic<std::uint64_t> caught_up_beats{0};
  std::atomic<std::int64_t> behind_ns{0};
  std::atomic<std::int64_t> phase_error_ns{0};  ///< of the beats on the reference clock
  std::atomic<std::uint64_t> most_commands{0};
  std::atomic<std::uint64_t> most_verdicts{0};
  std::atomic<std::uint64_t> most_telemetry{0};
  std::atomic<double> worst_momentum_residual_relative{0};
  std::array<Histogram, kPhases> phases;  ///< by Phase
  std::array<std::atomic<std::uint64_t>, kPhases> over_budget{};
  Histogram tick_body;
  std::atomic<std::uint32_t> halted{0};     ///< 1 + the Phase that was over its budget; 0: it runs
  std::atomic<std::int64_t> halted_ns{0};   ///< what that phase took
  std::atomic<std::uint32_t> following{0};  ///< 1 while it computes what a primary has computed
  std::atomic<std::uint32_t> paused{0};     ///< 1 while RunControl holds the clock
  std::atomic<std::uint32_t> waiting{0};    ///< 1 while the clock stands for want of a StepRequest
  std::atomic<std::int64_t> asked_ns{
      0};                               ///< monotonic time of the last StepRequest, or of the start
  std::atomic<std::uint64_t> run{0};    ///< rises with each reset
  std::atomic<std::uint64_t> turns{0};  ///< of the tick's loop: while it rises the tick is alive

  const Histogram& phase(Phase which) const noexcept {
    return phases[static_cast<std::size_t>(which)];
  }
};

class Tick {
 public:
  Tick(const scene::Scene& scene, MappedSegment& segment);

  /// Before run(): what is to be written down, every command and how far the run is.
  void record_in(JournalWriter* journal) noexcept {
    journal_ = journal;
    next_number_ = journal == nullptr ? 1 : journal->next_number();
    gate_.record_in(lead_ == 0 ? journal : nullptr);  // what is held is written when it comes
    digests_.write_to(digests_every_step_ ? journal : nullptr);
  }

  /// Before run(): compute what a primary has computed, and say nothing, until it is gone.
  void stand_by() noexcept { report_.following.store(1, std::memory_order_relaxed); }

  /// Before run(): a run that goes on at a later step; fleet() and gate() are set to it by the caller.
  void go_on_from(const Instant& at) noexcept {
    report_.step.store(at.step, std::memory_order_relaxed);
    report_.run.store(at.resets, std::memory_order_relaxed);
  }

  /// Runs until `stop` is set or the scene's duration is over. Call from the thread that is to be
  /// real-time. Halted, it goes on serving snapshots and refusing commands until `stop` is set;
  /// paused, or in lock-step, until it may step again.
  void run(const std::atomic<bool>& stop) noexcept;

  /// Publishes every spacecraft's state now, marked final; after run(), off real time: waits up to
  /// `patience_ms` for room in the ring.
  void publish_final(int patience_ms);

  const TickReport& report() const noexcept { return report_; }
  const Fleet& fleet() const noexcept { return fleet_; }
  Fleet& fleet() noexcept { return fleet_; }                ///< not while it runs
  CommandGate& gate() noexcept { return gate_; }            ///< not while it runs
  ControlMemory& controls() noexcept { return controls_; }  ///< not while it runs
  FleetSnapshot& snapshot() noexcept { return snapshot_; }  ///< the reader's end
  std::int64_t time_ns() const noexcept {
    return static_cast<std::int64_t>(report_.step.load(std::memory_order_relaxed)) * step_ns_;
  }

 private:
  /// Commands judged in one beat, at most; more wait in the ring for the next.
  static constexpr int kCommandsPerBeat = 256;
  /// The same of run control and of step requests.
  static constexpr int kRequestsPerBeat = 16;

  /// Of a hand-over in parts.
  static constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();

  /// Commands that wait for their lead to pass, at most. A standby has room for more: it may be behind.
  static constexpr std::size_t kMostHeld = decltype(StandbyLink::relayed)::kCapacity;

  /// When the parts of a beat ended, monotonic time [ns].
  struct BeatTimes {
    std::int64_t begun = 0, commanded = 0, stepped = 0, handed_over = 0;
  };

  std::uint64_t step() const noexcept { return report_.step.load(std::memory_order_relaxed); }
  bool halted() const noexcept { return report_.halted.load(std::memory_order_relaxed) != 0; }
  bool paused() const noexcept { return report_.paused.load(std::memory_order_relaxed) != 0; }
  bool stands() const noexcept;
  Beat now() const noexcept;
  ClockFace face() const noexcept;

  // tick.cpp: beats
  std::int64_t await_beat(BeatClock& clock, std::uint64_t n, std::int64_t ended_ns) noexcept;
  void keep_phase(BeatClock& clock, std::uint64_t n) noexcept;
  void catch_up_or_skip(BeatClock& clock, std::uint64_t n, std::int64_t begun_ns) noexcept;
  BeatTimes beat(std::uint64_t n, std::int64_t begun_ns) noexcept;
  void reached(std::uint64_t step) noexcept;
  void take_commands(const Beat& now, std::int64_t begun_ns) noexcept;
  void account(const BeatTimes& times, std::int64_t period_ns) noexcept;
  void judge(Phase phase, std::int64_t took_ns) noexcept;
  void halt(Phase phase, std::int64_t took_ns) noexcept;
  void publish_counters() noexcept;

  // standing.cpp: those who hold the clock
  void stand(const std::atomic<bool>& stop) noexcept;
  void serve_requests(std::int64_t now_ns) noexcept;
  void control(const ControlRecord& record) noexcept;
  ControlRefusal objection(ControlAction action) const noexcept;
  void follow(ControlAction action) noexcept;
  bool answers_wait() const noexcept;
  std::int64_t await_room(std::int64_t ended_ns) noexcept;

  // following.cpp: a primary and its standby
  bool following() const noexcept { return report_.following.load(std::memory_order_relaxed) != 0; }
  void hold(const CommandRecord& command, const Beat& now) noexcept;
  void keep(const JournalRecord& record) noexcept;
  void hear_held(const Beat& now) noexcept;
  void tell_standby(bool ended) noexcept;
  std::optional<std::int64_t> follow(const std::atomic<bool>& stop) noexcept;
  void take_followed() noexcept;
  void follow_to(const StandbyBeatRecord& primary, const std::atomic<bool>& stop) noexcept;
  std::int64_t due_after(const StandbyBeatRecord& primary) const noexcept;
  void follow_beat() noexcept;
  std::int64_t make_up(const BeatClock& clock, const std::atomic<bool>& stop) noexcept;

  // publishing.cpp
  void publish(std::uint64_t step, bool everything, bool fleet_at_once) noexcept;
  std::uint32_t topics_at(std::uint64_t step, bool everything) const noexcept;
  bool push_sample(std::uint32_t spacecraft, std::uint32_t topics, std::uint32_t flags,
                   std::uint64_t step) noexcept;
  bool push_wheels(std::uint32_t spacecraft, std::uint32_t flags, std::uint64_t step) noexcept;
  bool push_linked(std::uint32_t spacecraft, std::uint32_t flags, std::uint64_t step) noexcept;
  bool push_pointing(std::uint32_t spacecraft, std::uint32_t flags, std::uint64_t step) noexcept;
  bool sample_fleet(std::uint64_t step, std::uint32_t flags) noexcept;
  bool hand_over_fleet(std::size_t parts) noexcept;
  void hand_over_rest() noexcept;

  MappedSegment& segment_;
  std::int64_t step_ns_;
  std::uint64_t last_step_;  ///< of the scene's duration, or of what 63 bits of nanoseconds hold
  scene::Pace pace_;
  double rate_;
  scene::PhaseReference phase_reference_;
  scene::Telemetry telemetry_;
  scene::Overrun on_overrun_;
  std::uint64_t catch_up_beats_;                 ///< 0 unless they are to be caught up
  std::array<std::int64_t, kPhases> budget_ns_;  ///< by Phase; 0: none
  Fleet fleet_;
  CommandGate gate_;
  StepRequests step_requests_;
  ControlMemory controls_;
  bool obeys_run_control_;
  bool restart_clock_ = false;  ///< the next beat is due when it comes
  bool told_ = false;           ///< everything was published of what the fleet is now
  JournalWriter* journal_ = nullptr;
  std::uint64_t lead_;             ///< beats from a command's coming to its hearing; 0: no standby
  HeldCommands held_;              ///< those that wait for it
  std::uint64_t next_number_ = 1;  ///< of the journal record that comes next, where there is a lead
  std::uint64_t snapshot_every_;   ///< steps: about a second of simulation time
  FleetSnapshot snapshot_;
  std::size_t snapshot_parts_;
  bool digests_every_step_;
  StepDigests digests_;
  std::vector<std::uint64_t> fleet_words_;  ///< the fleet's state, as sampled at one step
  std::size_t fleet_parts_;                 ///< in which it is handed over, one a beat
  std::uint64_t fleet_count_ = 0;           ///< of fleet states, with it
  std::size_t fleet_part_;                  ///< the next one; all: nothing is left of it
  enum class Cause { sleep, work, loss };
  Cause late_by_ = Cause::sleep;  ///< what made the beats since the last sleep late
  std::int64_t used_ns_ = 0;      ///< of the processor by this thread, at the end of the last beat
  TickReport report_;
};

}  // namespace adstar::runtime
