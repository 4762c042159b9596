#include "service/runtime/tick.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "service/runtime/tick_parts.hpp"

namespace adstar::runtime {
namespace {

/// Whole steps in a second of simulation time, at least one.
std::uint64_t snapshot_every(std::int64_t step_ns) {
  return static_cast<std::uint64_t>(std::max<std::int64_t>(1, kSecond / step_ns));
}

/// In how many beats, at most in `most`, so many words are handed over to another thread. In one, where no beat is due at
/// a time. (decisions/0024-hand-over-in-parts.md)
std::size_t parts_of(const scene::Scene& scene, std::size_t words, std::uint64_t most) {
  constexpr double kWordsPerSecond = 2'000'000;  // 16 kB in a beat of 1 ms
  if (scene.simulation.pace != scene::Pace::clock) {
    return 1;
  }
  const double beat_s = seconds<double>(scene.simulation.step_ns) / scene.simulation.rate;
  const double beats = std::ceil(static_cast<double>(words) / (kWordsPerSecond * beat_s));
  return static_cast<std::size_t>(std::clamp(beats, 1.0, std::max(static_cast<double>(most), 1.0)));
}

}  // namespace

Tick::Tick(const scene::Scene& scene, MappedSegment& segment)
    : segment_(segment),
      step_ns_(scene.simulation.step_ns),
      last_step_(static_cast<std::uint64_t>(
          scene.simulation.duration_ns.value_or(std::numeric_limits<std::int64_t>::max()) /
          step_ns_)),
      pace_(scene.simulation.pace),
      rate_(scene.simulation.rate),
      phase_reference_(scene.simulation.phase_reference),
      telemetry_(scene.telemetry),
      on_overrun_(scene.budget.on_overrun),
      catch_up_beats_(on_overrun_ == scene::Overrun::catch_up
                          ? static_cast<std::uint64_t>(scene.budget.catch_up_beats)
                          : 0),
      budget_ns_(pace_ == scene::Pace::clock
                     ? std::array{scene.budget.wake_up_ns, scene.budget.commands_ns,
                                  scene.budget.step_ns, scene.budget.hand_over_ns}
                     : std::array<std::int64_t, kPhases>{}),
      fleet_(scene.spacecraft, scene.simulation.scheme, scene.simulation.limits),
      gate_(scene.spacecraft, segment->verdicts),
      step_requests_(segment->step_replies),
      controls_(segment->control_answers),
      obeys_run_control_(scene.service.run_control),
      lead_(scene.standby ? scene.standby->lead_steps : 0),
      held_(scene.standby ? 2 * kMostHeld : 0),
      snapshot_every_(snapshot_every(step_ns_)),
      snapshot_(fleet_),
      snapshot_parts_(parts_of(scene, snapshot_.words(), snapshot_every_ / 2)),
      digests_every_step_(scene.run.hashes_every_step),
      fleet_words_(fleet_words(segment.fleet_size())),
      fleet_parts_(parts_of(scene, fleet_words_.size(), telemetry_.fleet_every)),
      fleet_part_(fleet_parts_) {
  if (obeys_run_control_) {
    fleet_.keep_start();
  }
}

void Tick::run(const std::atomic<bool>& stop) noexcept {
  BeatClock clock = make_beat_clock(monotonic_ns(), step_ns_, rate_);
  std::int64_t first_due = clock.base_ns;
  const bool followed = following();
  if (followed) {
    const std::optional<std::int64_t> due = follow(stop);
    if (!due) {
      digests_.flush();
      return;
    }
    first_due = *due;
  }
  publish(step(), true, true);
  told_ = true;
  restart(clock, step(), first_due);
  const std::int64_t period_ns = pace_ == scene::Pace::clock ? beats_to_ns(clock, 1) : 0;
  used_ns_ = used_by_this_thread_ns();
  std::int64_t ended = followed ? make_up(clock, stop) : due_ns(clock, step());
  report_.asked_ns.store(ended, std::memory_order_relaxed);
  while (!stop.load(std::memory_order_relaxed) && (halted() || step() < last_step_)) {
    add(report_.turns, 1);
    if (stands()) {
      stand(stop);
      ended = monotonic_ns();
      used_ns_ = used_by_this_thread_ns();
      continue;
    }
    const std::uint64_t n = step();
    if (restart_clock_) {
      restart_clock_ = false;
      restart(clock, n, ended);
    }
    const bool by_clock = pace_ == scene::Pace::clock && !paused();
    const std::int64_t begun = by_clock ? await_beat(clock, n, ended) : await_room(ended);
    serve_requests(begun);
    if (stands() || restart_clock_) {
      ended = begun;
      continue;
    }
    const BeatTimes times = beat(n, begun);
    account(times, by_clock ? period_ns : 0);
    ended = times.handed_over;
  }
  hand_over_rest();
  digests_.flush();
  step_requests_.interrupt(face());
}

/// Sleeps until beat n is due, unless it is already; returns when it began.
std::int64_t Tick::await_beat(BeatClock& clock, std::uint64_t n, std::int64_t ended_ns) noexcept {
  keep_phase(clock, n);
  const std::int64_t due = due_ns(clock, n);
  const bool slept = ended_ns < due;
  std::int64_t begun = ended_ns;
  if (slept) {
    sleep_until(due);
    begun = monotonic_ns();
  }
  report_.phases[static_cast<std::size_t>(Phase::wake_up)].record(begun - due);
  judge(Phase::wake_up, begun - due);
  if (slept) {
    late_by_ = Cause::sleep;
  }
  catch_up_or_skip(clock, n, begun);
  return begun;
}

void Tick::keep_phase(BeatClock& clock, std::uint64_t n) noexcept {
  if (phase_reference_ == scene::PhaseReference::none) {
    return;
  }
  const clockid_t reference =
      phase_reference_ == scene::PhaseReference::tai ? CLOCK_TAI : CLOCK_REALTIME;
  const std::int64_t error = phase_error_ns(clock, n, offset_of(reference));
  report_.phase_error_ns.store(error, std::memory_order_relaxed);
  steer(clock, error);
}

void Tick::catch_up_or_skip(BeatClock& clock, std::uint64_t n, std::int64_t begun_ns) noexcept {
  const std::uint64_t behind = beats_behind(clock, n, begun_ns);
  if (behind > 0) {
    add(report_.late_beats, 1);
    add(late_by_ == Cause::work   ? report_.late_after_work
        : late_by_ == Cause::loss ? report_.late_after_loss
                                  : report_.late_after_sleep,
        1);
    const std::int64_t late_ns = begun_ns - due_ns(clock, n);
    const std::uint64_t missed = realign(clock, n, begun_ns, catch_up_beats_);
    add(report_.missed_beats, missed);
    if (catch_up_beats_ > 0) {
      add(report_.caught_up_beats, 1);  // this one is taken though the next is due
    }
    if (on_overrun_ == scene::Overrun::halt) {
      halt(Phase::wake_up, late_ns);
    }
  }
  report_.behind_ns.store(
      beats_to_ns(clock, clock.missed + std::min<std::uint64_t>(behind, catch_up_beats_)),
      std::memory_order_relaxed);
}

Tick::BeatTimes Tick::beat(std::uint64_t n, std::int64_t begun_ns) noexcept {
  const Beat now{n, static_cast<std::int64_t>(n) * step_ns_, step_ns_};
  BeatTimes times{begun_ns, 0, 0, 0};
  take_commands(now, begun_ns);
  hear_held(now);
  gate_.begin_step(now, fleet_);
  times.commanded = monotonic_ns();

  const std::size_t unresolved = fleet_.step(now.t_ns, now.h_ns);
  times.stepped = monotonic_ns();

  if (unresolved > 0) {
    const auto& vehicles = fleet_.vehicles();
    const auto first = std::find_if(vehicles.begin(), vehicles.end(),
                                    [](const Vehicle& vehicle) { return vehicle.flags != 0; });
    report_.first_unresolved.store(static_cast<std::uint64_t>(first - vehicles.begin()),
                                   std::memory_order_relaxed);
  }
  report_.unresolved_spacecraft.store(unresolved, std::memory_order_relaxed);
  reached(n + 1);
  publish_counters();

  const bool ended = n + 1 == last_step_;
  const std::uint64_t allowed = step_requests_.allowed();
  const bool last_asked_for = allowed == 1 || (allowed > 1 && ended);
  told_ =
      segment_->snapshot_requested.exchange(0, std::memory_order_relaxed) != 0 || last_asked_for;
  publish(n + 1, told_, last_asked_for);
  tell_standby(false);
  step_requests_.stepped(face(), ended);
  if (last_asked_for) {
    wake_bridge(*segment_);
  }
  times.handed_over = monotonic_ns();
  return times;
}

void Tick::reached(std::uint64_t step) noexcept {
  report_.step.store(step, std::memory_order_relaxed);
  if (journal_ != nullptr) {
    journal_->reached(step);
  }
  const Instant at{report_.run.load(std::memory_order_relaxed), step};
  digests_.add(fleet_.vehicles(), at);
  snapshot_.hand_over(1);
  if (step % snapshot_every_ == 0) {
    snapshot_.take(fleet_.vehicles(), at, snapshot_parts_);
    if (snapshot_parts_ == 1) {
      snapshot_.hand_over(1);
    }
  } else if (const std::uint64_t left = beats_left(step, snapshot_every_);
             left <= snapshot_parts_) {
    snapshot_.prepare(snapshot_parts_ - left, snapshot_parts_);
  }
}

void Tick::take_commands(const Beat& now, std::int64_t begun_ns) noexcept {
  raise(report_.most_commands, segment_->commands.size());
  for (int taken = 0; taken < kCommandsPerBeat; ++taken) {
    const std::optional<CommandRecord> command = segment_->commands.pop();
    if (!command) {
      break;
    }
    if (is_stale(command->received_ns, begun_ns)) {
      continue;
    }
    if (halted()) {
      gate_.refuse(*command, now, Reason::halted);
    } else if (lead_ > 0) {
      hold(*command, now);
    } else {
      gate_.receive(*command, now);
    }
  }
}

void Tick::publish_counters() noexcept {
  const GateCounters& counters = gate_.counters();
  report_.commands_received.store(counters.received, std::memory_order_relaxed);
  report_.commands_refused.store(counters.refused, std::memory_order_relaxed);
  report_.verdicts_lost.store(counters.verdicts_lost, std::memory_order_relaxed);
}

void Tick::account(const BeatTimes& times, std::int64_t period_ns) noexcept {
  const auto record = [&](Phase phase, std::int64_t took_ns) {
    report_.phases[static_cast<std::size_t>(phase)].record(took_ns);
    judge(phase, took_ns);
  };
  record(Phase::commands, times.commanded - times.begun);
  record(Phase::step, times.stepped - times.commanded);
  record(Phase::hand_over, times.handed_over - times.stepped);
  const std::int64_t body_ns = times.handed_over - times.begun;
  report_.tick_body.record(body_ns);
  if (pace_ != scene::Pace::clock) {
    return;
  }
  // With the end of its sleep, for a reading a beat is enough.
  const std::int64_t used_before_ns = std::exchange(used_ns_, used_by_this_thread_ns());
  if (period_ns != 0 && body_ns > period_ns) {
    add(report_.overruns, 1);
    late_by_ = used_ns_ - used_before_ns > period_ns ? Cause::work : Cause::loss;
  }
}

/// Against the budget, where there is one.
void Tick::judge(Phase phase, std::int64_t took_ns) noexcept {
  const auto which = static_cast<std::size_t>(phase);
  if (budget_ns_[which] == 0 || took_ns <= budget_ns_[which]) {
    return;
  }
  add(report_.over_budget[which], 1);
  if (on_overrun_ == scene::Overrun::halt) {
    halt(phase, took_ns);
  }
}

/// The first cause stands.
void Tick::halt(Phase phase, std::int64_t took_ns) noexcept {
  if (!halted()) {
    report_.halted_ns.store(took_ns, std::memory_order_relaxed);
    report_.halted.store(static_cast<std::uint32_t>(phase) + 1, std::memory_order_release);
  }
}

}  // namespace adstar::runtime
