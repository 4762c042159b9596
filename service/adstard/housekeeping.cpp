#include "service/adstard/housekeeping.hpp"

#include <algorithm>
#include <time.h>
#include <utility>

#include <spdlog/spdlog.h>

namespace adstar::adstard {
namespace {

std::uint64_t read(const std::atomic<std::uint64_t>& counter) {
  return counter.load(std::memory_order_relaxed);
}

/// The growth of a counter since it was last looked at.
std::uint64_t growth(std::uint64_t now, std::uint64_t& seen) {
  return now - std::exchange(seen, now);
}

double microseconds(std::int64_t ns) { return static_cast<double>(ns) * 1e-3; }

constexpr const char* kPhaseNames[runtime::kPhases] = {"wake-up lateness", "commands", "the step",
                                                       "the hand-over"};

void log_quantiles(const char* name, const runtime::QuantilesRecord& q) {
  if (q.count > 0) {
    spdlog::info("{} p50 {:.1f} us, p99.9 {:.1f} us, max {:.1f} us", name, microseconds(q.p50_ns),
                 microseconds(q.p99_9_ns), microseconds(q.max_ns));
  }
}

}  // namespace

Housekeeping::Housekeeping(const scene::Scene& scene, const runtime::Tick& tick,
                           runtime::MappedSegment& segment)
    : scene_(scene), tick_(tick), segment_(segment) {}

void Housekeeping::look(std::uint64_t bridge_restarts, const StateHash& hash, bool stopped) {
  segment_->status.write(status(bridge_restarts, hash, stopped));
  const runtime::TimingRecord now = timing(stopped);
  segment_->timing.write(now);
  runtime::wake_bridge(*segment_);
  log_changes(now);
}

runtime::RunState Housekeeping::state(bool stopped) const {
  const runtime::TickReport& report = tick_.report();
  return stopped                        ? runtime::RunState::stopped
         : report.following.load() != 0 ? runtime::RunState::standby
         : report.halted.load() != 0    ? runtime::RunState::halted
         : report.paused.load() != 0    ? runtime::RunState::paused
         : report.waiting.load() != 0   ? runtime::RunState::waiting
                                        : runtime::RunState::running;
}

runtime::StatusRecord Housekeeping::status(std::uint64_t bridge_restarts, const StateHash& hash,
                                           bool stopped) const {
  const runtime::TickReport& report = tick_.report();
  runtime::StatusRecord status;
  status.step = read(report.step);
  status.time_ns = static_cast<std::int64_t>(status.step) * scene_.simulation.step_ns;
  status.state = static_cast<std::uint64_t>(state(stopped));
  status.unresolved_spacecraft = read(report.unresolved_spacecraft);
  status.worst_momentum_residual_relative =
      report.worst_momentum_residual_relative.load(std::memory_order_relaxed);
  const std::uint64_t not_of_the_scene = read(segment_->commands_refused);
  status.commands_received = read(report.commands_received) + not_of_the_scene;
  status.commands_refused = read(report.commands_refused) + not_of_the_scene;
  status.commands_lost = read(segment_->commands_lost);
  status.verdicts_lost = read(report.verdicts_lost);
  status.telemetry_lost = read(report.telemetry_lost);
  status.bridge_restarts = bridge_restarts;
  status.state_hash = hash.hash;
  status.state_hash_step = hash.step;
  status.run = read(report.run);
  return status;
}

runtime::TimingRecord Housekeeping::timing(bool stopped) const {
  const runtime::TickReport& report = tick_.report();
  runtime::TimingRecord timing;
  timing.state = static_cast<std::uint64_t>(state(stopped));
  timing.step = read(report.step);
  timing.time_ns = static_cast<std::int64_t>(timing.step) * scene_.simulation.step_ns;
  const scene::Budget& budget = scene_.budget;
  const std::int64_t budgets[runtime::kPhases] = {budget.wake_up_ns, budget.commands_ns,
                                                  budget.step_ns, budget.hand_over_ns};
  for (std::size_t i = 0; i < runtime::kPhases; ++i) {
    const runtime::Histogram& took = report.phases[i];
    timing.phases[i] = {took.quantiles(), took.sum_ns(), took.quarter_octaves(), budgets[i],
                        read(report.over_budget[i])};
  }
  timing.tick_body = report.tick_body.quantiles();
  timing.late_beats = read(report.late_beats);
  timing.late_after_work = read(report.late_after_work);
  timing.late_after_loss = read(report.late_after_loss);
  timing.late_after_sleep = read(report.late_after_sleep);
  timing.overruns = read(report.overruns);
  timing.missed_beats = read(report.missed_beats);
  timing.caught_up_beats = read(report.caught_up_beats);
  timing.behind_ns = report.behind_ns.load(std::memory_order_relaxed);
  timing.phase_disciplined =
      scene_.simulation.phase_reference == scene::PhaseReference::none ? 0 : 1;
  timing.phase_error_ns = report.phase_error_ns.load(std::memory_order_relaxed);
  const runtime::ThreadAccount now = at_end_ ? *at_end_ : runtime::account_of(thread_);
  timing.account = {now.minor_faults - at_start_.minor_faults,
                    now.major_faults - at_start_.major_faults,
                    now.involuntary_switches - at_start_.involuntary_switches,
                    read(report.most_commands),
                    read(report.most_verdicts),
                    read(report.most_telemetry)};
  timing.fifo_scheduling = now.fifo_scheduling ? 1 : 0;
  timing.memory_locked = now.memory_locked ? 1 : 0;
  timing.cpu_pinned = now.cpu_pinned ? 1 : 0;
  return timing;
}

void Housekeeping::log_changes(const runtime::TimingRecord& now) {
  const runtime::TickReport& report = tick_.report();
  const std::uint64_t unresolved = read(report.unresolved_spacecraft);
  if (unresolved != unresolved_seen_) {
    if (unresolved == 0) {
      spdlog::info("every spacecraft is resolved again");
    } else {
      const auto first =
          std::min<std::uint64_t>(read(report.first_unresolved), scene_.spacecraft.size() - 1);
      spdlog::warn(
          "{} spacecraft not resolved, '{}' first: it turns too far in a step, or has too many "
          "torque edges in "
          "one; take a shorter step, or raise substep_limit or edge_limit in [simulation]",
          unresolved, scene_.spacecraft[first].name);
    }
    unresolved_seen_ = unresolved;
  }
  log_budget(now);
  log_silence();
  if (const auto n = growth(read(report.missed_beats), missed_seen_); n > 0) {
    spdlog::warn("{} beats missed: simulation time has fallen {} behind the wall", n,
                 scene::format_duration(report.behind_ns.load(std::memory_order_relaxed)));
  }
  if (const auto n = growth(read(report.overruns), overruns_seen_); n > 0) {
    spdlog::warn("{} beats took longer than their period; take a longer step or fewer spacecraft",
                 n);
  }
  if (const auto n = growth(read(segment_->commands_lost), commands_lost_seen_); n > 0) {
    spdlog::warn("{} commands lost: more came than the tick can take", n);
  }
  if (const auto n = growth(read(report.verdicts_lost), verdicts_lost_seen_); n > 0) {
    spdlog::warn(
        "{} verdicts lost while the bridge was away or slow; commanders repeat and get them", n);
  }
  if (const auto n = growth(read(report.telemetry_lost), telemetry_lost_seen_); n > 0) {
    spdlog::warn("{} telemetry samples lost while the bridge was away or slow", n);
  }
}

void Housekeeping::log_budget(const runtime::TimingRecord& now) {
  const runtime::TickReport& report = tick_.report();
  for (std::size_t i = 0; i < runtime::kPhases; ++i) {
    if (const auto n = growth(read(report.over_budget[i]), over_budget_seen_[i]); n > 0) {
      spdlog::warn("{} beats over the budget of {}: {} allowed, {:.1f} us at most so far", n,
                   kPhaseNames[i], scene::format_duration(now.phases[i].budget_ns),
                   microseconds(now.phases[i].took.max_ns));
    }
  }
  if (const std::uint32_t halted = report.halted.load(std::memory_order_acquire);
      halted != 0 && !halt_said_) {
    halt_said_ = true;
    spdlog::error(
        "halted before step {}: {} took {:.1f} us; telemetry is still served, commands are "
        "refused; Ctrl-C ends the run",
        read(report.step), kPhaseNames[halted - 1],
        microseconds(report.halted_ns.load(std::memory_order_relaxed)));
  }
}

/// Once, until somebody asks for a step again.
void Housekeeping::log_silence() {
  const runtime::TickReport& report = tick_.report();
  const auto patience_ns = scene_.simulation.lockstep_timeout_ns;
  const std::int64_t asked_ns = report.asked_ns.load(std::memory_order_relaxed);
  if (asked_ns != silence_since_ns_) {
    silence_since_ns_ = asked_ns;
    silence_said_ = false;
  }
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  const std::int64_t silence_ns = now.tv_sec * 1'000'000'000 + now.tv_nsec - asked_ns;
  if (report.waiting.load() == 0 || silence_said_ || !patience_ns || silence_ns < *patience_ns) {
    return;
  }
  silence_said_ = true;
  spdlog::warn(
      "in lock-step at step {}: nobody has asked for a step for {:.1f} s; the clock stands until "
      "somebody does (adstar step)",
      read(report.step), static_cast<double>(silence_ns) * 1e-9);
}

void Housekeeping::summarise() const {
  const runtime::TickReport& report = tick_.report();
  const auto& vehicles = tick_.fleet().vehicles();
  double worst = 0;
  for (const auto& vehicle : vehicles) {
    worst = std::max(worst, runtime::momentum_residual_relative(vehicle));
  }
  const runtime::TimingRecord now = timing(true);
  spdlog::info("{} steps of {}, {} spacecraft, momentum residual at most {:.1e} of |H|",
               read(report.step), scene::format_duration(scene_.simulation.step_ns),
               vehicles.size(), worst);
  for (std::size_t i = 0; i < runtime::kPhases; ++i) {
    log_quantiles(kPhaseNames[i], now.phases[i].took);
  }
  log_quantiles("tick body", now.tick_body);
  if (scene_.simulation.pace == scene::Pace::clock) {
    spdlog::info(
        "{} beats late ({} after our own work, {} after the processor was taken away, {} after the "
        "sleep), {} missed, {} caught up",
        now.late_beats, now.late_after_work, now.late_after_loss, now.late_after_sleep,
        now.missed_beats, now.caught_up_beats);
    spdlog::info("{} page faults, taken off the processor {} times; FIFO {}, memory {}, {}",
                 now.account.minor_faults + now.account.major_faults,
                 now.account.involuntary_switches,
                 now.fifo_scheduling != 0 ? "in force" : "not in force",
                 now.memory_locked != 0 ? "locked" : "not locked",
                 now.cpu_pinned != 0 ? "pinned to a processor" : "on any processor");
  }
  const std::uint64_t not_of_the_scene = read(segment_->commands_refused);
  spdlog::info("{} commands, repeats too, {} of them refused",
               read(report.commands_received) + not_of_the_scene,
               read(report.commands_refused) + not_of_the_scene);
}

}  // namespace adstar::adstard
