#include "service/runtime/tick.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <limits>
#include <time.h>

namespace adstar::runtime {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kMostAge_ns = 2 * kSecond;

std::int64_t monotonic_ns() noexcept {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * kSecond + now.tv_nsec;
}

void sleep_until(std::int64_t due) noexcept {
  const timespec deadline{due / kSecond, due % kSecond};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &deadline, nullptr) == EINTR) {}
}

/// One writer: a load and a store, no locked instruction.
void add(std::atomic<std::uint64_t>& counter, std::uint64_t amount) noexcept {
  counter.store(counter.load(std::memory_order_relaxed) + amount, std::memory_order_relaxed);
}

/// A high-water mark.
void raise(std::atomic<std::uint64_t>& mark, std::uint64_t level) noexcept {
  if (level > mark.load(std::memory_order_relaxed)) {
    mark.store(level, std::memory_order_relaxed);
  }
}

bool due_at(std::uint64_t step, std::uint64_t every, bool everything) noexcept {
  return every != 0 && (everything || step % every == 0);
}

/// Whole steps in a second of simulation time, at least one.
std::uint64_t snapshot_every(std::int64_t step_ns) {
  return static_cast<std::uint64_t>(std::max<std::int64_t>(1, kSecond / step_ns));
}

/// The larger; what is no number is the worst of all.
double worse(double a, double b) noexcept { return a >= b || std::isnan(a) ? a : b; }

}  // namespace

Tick::Tick(const scene::Scene& scene, MappedSegment& segment)
    : segment_(segment),
      step_ns_(scene.simulation.step_ns),
      last_step_(static_cast<std::uint64_t>(
          scene.simulation.duration_ns.value_or(std::numeric_limits<std::int64_t>::max()) /
          step_ns_)),
      pace_(scene.simulation.pace),
      rate_(scene.simulation.rate),
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
      snapshot_every_(snapshot_every(step_ns_)),
      snapshot_(scene.spacecraft.size()),
      fleet_words_(fleet_words(segment.fleet_size())) {}

void Tick::run(const std::atomic<bool>& stop) noexcept {
  report_.step.store(first_step_, std::memory_order_relaxed);
  publish(first_step_, true);
  BeatClock clock = make_beat_clock(monotonic_ns(), step_ns_, rate_);
  clock.base_ns -= beats_to_ns(clock, first_step_);
  const std::int64_t period_ns = pace_ == scene::Pace::clock ? beats_to_ns(clock, 1) : 0;
  std::int64_t ended = due_ns(clock, first_step_);
  for (std::uint64_t n = first_step_; !stop.load(std::memory_order_relaxed) && n < last_step_;
       ++n) {
    const std::int64_t begun = pace_ == scene::Pace::clock ? await_beat(clock, n, ended) : ended;
    if (halted()) {
      break;
    }
    const BeatTimes times = beat(n, begun);
    account(times, period_ns);
    ended = times.handed_over;
  }
  if (halted()) {
    stand_still(stop);
  }
}

/// Sleeps until beat n is due, unless it is already; returns when it began.
std::int64_t Tick::await_beat(BeatClock& clock, std::uint64_t n, std::int64_t ended_ns) noexcept {
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
    late_by_work_ = false;
  }
  catch_up_or_skip(clock, n, begun);
  return begun;
}

void Tick::catch_up_or_skip(BeatClock& clock, std::uint64_t n, std::int64_t begun_ns) noexcept {
  const std::uint64_t behind = beats_behind(clock, n, begun_ns);
  if (behind > 0) {
    add(report_.late_beats, 1);
    add(late_by_work_ ? report_.late_after_work : report_.late_after_sleep, 1);
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
  report_.step.store(n + 1, std::memory_order_relaxed);
  if (journal_ != nullptr) {
    journal_->reached(n + 1);
  }
  if ((n + 1) % snapshot_every_ == 0) {
    snapshot_.offer(fleet_.vehicles(), n + 1);
  }
  publish_counters();

  const bool everything = segment_->snapshot_requested.exchange(0, std::memory_order_relaxed) != 0;
  publish(n + 1, everything);
  times.handed_over = monotonic_ns();
  return times;
}

void Tick::take_commands(const Beat& now, std::int64_t begun_ns) noexcept {
  raise(report_.most_commands, segment_->commands.size());
  for (int taken = 0; taken < kCommandsPerBeat; ++taken) {
    const std::optional<CommandRecord> command = segment_->commands.pop();
    if (!command) {
      break;
    }
    // What lay in the ring while this process stood still is nobody's wish any more; who means it
    // repeats it.
    if (command->received_ns != 0 && begun_ns - command->received_ns > kMostAge_ns) {
      continue;
    }
    if (halted()) {
      gate_.refuse(*command, now, Reason::halted);
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
  if (period_ns != 0 && body_ns > period_ns) {
    add(report_.overruns, 1);
    late_by_work_ = true;
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

/// The clock stands: commands are refused, snapshots are served.
void Tick::stand_still(const std::atomic<bool>& stop) noexcept {
  constexpr std::int64_t kLook_ns = kSecond / 100;
  const std::uint64_t step = report_.step.load(std::memory_order_relaxed);
  const Beat now{step, static_cast<std::int64_t>(step) * step_ns_, step_ns_};
  publish(step, true);
  while (!stop.load(std::memory_order_relaxed)) {
    const std::int64_t begun = monotonic_ns();
    take_commands(now, begun);
    publish_counters();
    if (segment_->snapshot_requested.exchange(0, std::memory_order_relaxed) != 0) {
      publish(step, true);
    } else if (segment_->verdicts.size() > 0) {
      wake_bridge(*segment_);
    }
    sleep_until(begun + kLook_ns);
  }
}

std::uint32_t Tick::topics_at(std::uint64_t step, bool everything) const noexcept {
  return (due_at(step, telemetry_.attitude_every, everything) ? kTopicAttitude : 0U) |
         (due_at(step, telemetry_.momentum_every, everything) ? kTopicMomentum : 0U);
}

void Tick::publish(std::uint64_t step, bool everything) noexcept {
  const std::uint32_t topics = topics_at(step, everything);
  const bool fleet = due_at(step, telemetry_.fleet_every, everything);
  if (topics != 0) {
    double worst = 0;
    for (const std::uint32_t spacecraft : telemetry_.watched) {
      if (!push_sample(spacecraft, topics, 0, step)) {
        add(report_.telemetry_lost, 1);
      }
      worst = worse(worst, momentum_residual_relative(fleet_.vehicles()[spacecraft]));
    }
    if (telemetry_.fleet_every == 0) {
      report_.worst_momentum_residual_relative.store(worst, std::memory_order_relaxed);
    }
  }
  if (fleet) {
    write_fleet(step, 0);
  }
  const std::size_t verdicts = segment_->verdicts.size();
  raise(report_.most_verdicts, verdicts);
  raise(report_.most_telemetry, segment_->telemetry.size());
  if (topics != 0 || fleet || verdicts > 0) {
    wake_bridge(*segment_);
  }
}

bool Tick::push_sample(std::uint32_t spacecraft, std::uint32_t topics, std::uint32_t flags,
                       std::uint64_t step) noexcept {
  const Vehicle& vehicle = fleet_.vehicles()[spacecraft];
  TelemetryRecord record = sample(vehicle);
  record.spacecraft = spacecraft;
  record.topics = topics;
  record.flags |= flags;
  record.step = step;
  record.time_ns = static_cast<std::int64_t>(step) * step_ns_;
  return segment_->telemetry.push(record);
}

void Tick::write_fleet(std::uint64_t step, std::uint32_t flags) noexcept {
  const FleetHeader header{step, static_cast<std::int64_t>(step) * step_ns_,
                           fleet_.vehicles().size()};
  std::uint64_t* word = fleet_words_.data();
  std::memcpy(word, &header, sizeof header);
  word += sizeof header / sizeof *word;
  double worst = 0;
  for (const Vehicle& vehicle : fleet_.vehicles()) {
    const TelemetryRecord full = sample(vehicle);
    const FleetRecord member{full.q_IB,
                             full.omega_B_rad_s,
                             full.H_I_n_m_s,
                             full.rotational_energy_j,
                             full.energy_residual_j,
                             full.flags | flags};
    std::memcpy(word, &member, sizeof member);
    word += sizeof member / sizeof *word;
    worst = worse(worst, momentum_residual_relative(vehicle));
  }
  report_.worst_momentum_residual_relative.store(worst, std::memory_order_relaxed);
  segment_->fleet.write(segment_.fleet_storage(), fleet_words_);
}

void Tick::publish_final(int patience_ms) {
  const std::uint64_t step = report_.step.load(std::memory_order_relaxed);
  const std::int64_t patience_ends = monotonic_ns() + patience_ms * (kSecond / 1000);
  const std::uint32_t topics = topics_at(step, true);
  for (const std::uint32_t spacecraft : telemetry_.watched) {
    while (topics != 0 && !push_sample(spacecraft, topics, kFlagFinal, step)) {
      if (monotonic_ns() > patience_ends) {
        add(report_.telemetry_lost, 1);
        break;
      }
      wake_bridge(*segment_);
      sleep_until(monotonic_ns() + kSecond / 1000);
    }
  }
  if (telemetry_.fleet_every != 0) {
    write_fleet(step, kFlagFinal);
  }
  wake_bridge(*segment_);
}

}  // namespace adstar::runtime
