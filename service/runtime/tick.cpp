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

bool due_at(std::uint64_t step, std::uint64_t every, bool everything) noexcept {
  return every != 0 && (everything || step % every == 0);
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
      fleet_(scene.spacecraft, scene.simulation.scheme, scene.simulation.limits),
      gate_(scene.spacecraft, segment->verdicts),
      fleet_words_(fleet_words(segment.fleet_size())) {}

void Tick::run(const std::atomic<bool>& stop) noexcept {
  publish(0, true);
  BeatClock clock = make_beat_clock(monotonic_ns(), step_ns_, rate_);
  std::int64_t begun = clock.base_ns;
  for (std::uint64_t n = 0; !stop.load(std::memory_order_relaxed) && n < last_step_; ++n) {
    if (pace_ == scene::Pace::clock) {
      const std::int64_t due = due_ns(clock, n);
      sleep_until(due);
      begun = monotonic_ns();
      report_.wake_up_lateness.record(begun - due);
      const std::uint64_t missed = realign(clock, n, begun);
      if (missed > 0) {
        add(report_.late_beats, 1);
        add(report_.missed_beats, missed);
      }
    }
    beat(n, begun);
    const std::int64_t ended = monotonic_ns();
    report_.tick_body.record(ended - begun);
    if (pace_ == scene::Pace::clock && ended - begun > beats_to_ns(clock, 1)) {
      add(report_.overruns, 1);
    }
    begun = ended;
  }
}

void Tick::beat(std::uint64_t n, std::int64_t begun_ns) noexcept {
  const Beat now{n, static_cast<std::int64_t>(n) * step_ns_, step_ns_};
  for (int taken = 0; taken < kCommandsPerBeat; ++taken) {
    const std::optional<CommandRecord> command = segment_->commands.pop();
    if (!command) {
      break;
    }
    // What lay in the ring while this process stood still is nobody's wish any more; who means it
    // repeats it.
    if (command->received_ns == 0 || begun_ns - command->received_ns <= kMostAge_ns) {
      gate_.receive(*command, now);
    }
  }
  gate_.begin_step(now, fleet_);

  const std::size_t unresolved = fleet_.step(now.t_ns, now.h_ns);
  if (unresolved > 0) {
    const auto& vehicles = fleet_.vehicles();
    const auto first = std::find_if(vehicles.begin(), vehicles.end(),
                                    [](const Vehicle& vehicle) { return vehicle.flags != 0; });
    report_.first_unresolved.store(static_cast<std::uint64_t>(first - vehicles.begin()),
                                   std::memory_order_relaxed);
  }
  report_.unresolved_spacecraft.store(unresolved, std::memory_order_relaxed);
  const GateCounters& counters = gate_.counters();
  report_.commands_received.store(counters.received, std::memory_order_relaxed);
  report_.commands_refused.store(counters.refused, std::memory_order_relaxed);
  report_.verdicts_lost.store(counters.verdicts_lost, std::memory_order_relaxed);
  report_.step.store(n + 1, std::memory_order_relaxed);

  const bool everything = segment_->snapshot_requested.exchange(0, std::memory_order_relaxed) != 0;
  publish(n + 1, everything);
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
  if (topics != 0 || fleet || segment_->verdicts.size() > 0) {
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
