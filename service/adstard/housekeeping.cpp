#include "service/adstard/housekeeping.hpp"

#include <algorithm>
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

}  // namespace

Housekeeping::Housekeeping(const scene::Scene& scene, const runtime::Tick& tick,
                           runtime::MappedSegment& segment)
    : scene_(scene), tick_(tick), segment_(segment) {}

void Housekeeping::look(std::uint64_t bridge_restarts, bool stopped) {
  const runtime::TickReport& report = tick_.report();
  runtime::StatusRecord status;
  status.step = read(report.step);
  status.time_ns = static_cast<std::int64_t>(status.step) * scene_.simulation.step_ns;
  status.stopped = stopped ? 1 : 0;
  status.unresolved_spacecraft = read(report.unresolved_spacecraft);
  status.worst_momentum_residual_relative =
      report.worst_momentum_residual_relative.load(std::memory_order_relaxed);
  status.commands_received = read(report.commands_received);
  status.commands_refused = read(report.commands_refused);
  status.commands_lost = read(segment_->commands_lost);
  status.verdicts_lost = read(report.verdicts_lost);
  status.telemetry_lost = read(report.telemetry_lost);
  status.bridge_restarts = bridge_restarts;
  segment_->status.write(status);

  runtime::TimingRecord timing;
  timing.step = status.step;
  timing.time_ns = status.time_ns;
  timing.wake_up_lateness = report.wake_up_lateness.quantiles();
  timing.tick_body = report.tick_body.quantiles();
  timing.late_beats = read(report.late_beats);
  timing.overruns = read(report.overruns);
  timing.missed_beats = read(report.missed_beats);
  timing.fifo_scheduling = real_time_.fifo_scheduling ? 1 : 0;
  timing.memory_locked = real_time_.memory_locked ? 1 : 0;
  timing.cpu_pinned = real_time_.cpu_pinned ? 1 : 0;
  segment_->timing.write(timing);
  runtime::wake_bridge(*segment_);
  log_changes();
}

void Housekeeping::log_changes() {
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
  if (const auto n = growth(read(report.missed_beats), missed_seen_); n > 0) {
    spdlog::warn("{} beats missed: simulation time has fallen behind the wall by as much", n);
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

void Housekeeping::summarise() const {
  const runtime::TickReport& report = tick_.report();
  const auto& vehicles = tick_.fleet().vehicles();
  double worst = 0;
  for (const auto& vehicle : vehicles) {
    worst = std::max(worst, runtime::momentum_residual_relative(vehicle));
  }
  const auto body = report.tick_body.quantiles();
  const auto late = report.wake_up_lateness.quantiles();
  spdlog::info("{} steps of {}, {} spacecraft, momentum residual at most {:.1e} of |H|",
               read(report.step), scene::format_duration(scene_.simulation.step_ns),
               vehicles.size(), worst);
  spdlog::info("tick body p50 {:.1f} us, p99.9 {:.1f} us, max {:.1f} us", microseconds(body.p50_ns),
               microseconds(body.p99_9_ns), microseconds(body.max_ns));
  if (late.count > 0) {
    spdlog::info("wake-up lateness p50 {:.1f} us, p99.9 {:.1f} us, max {:.1f} us; {} beats missed",
                 microseconds(late.p50_ns), microseconds(late.p99_9_ns), microseconds(late.max_ns),
                 read(report.missed_beats));
  }
  spdlog::info("{} commands, {} of them refused", read(report.commands_received),
               read(report.commands_refused));
}

}  // namespace adstar::adstard
