// What the tick says of each step.

#include <cmath>
#include <cstring>

#include "service/runtime/tick.hpp"
#include "service/runtime/tick_parts.hpp"

namespace adstar::runtime {
namespace {

bool due_at(std::uint64_t step, std::uint64_t every, bool everything) noexcept {
  return every != 0 && (everything || step % every == 0);
}

/// The larger; what is no number is the worst of all.
double worse(double a, double b) noexcept { return a >= b || std::isnan(a) ? a : b; }

}  // namespace

std::uint32_t Tick::topics_at(std::uint64_t step, bool everything) const noexcept {
  return (due_at(step, telemetry_.attitude_every, everything) ? kTopicAttitude : 0U) |
         (due_at(step, telemetry_.momentum_every, everything) ? kTopicMomentum : 0U);
}

void Tick::publish(std::uint64_t step, bool everything, bool fleet_at_once) noexcept {
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
  const bool wheels = due_at(step, telemetry_.wheel_every, everything);
  const bool pointing = due_at(step, telemetry_.pointing_every, everything);
  const bool linked = due_at(step, telemetry_.linked_every, everything);
  for (const std::uint32_t spacecraft : telemetry_.watched) {
    if (wheels && !push_wheels(spacecraft, 0, step)) {
      add(report_.telemetry_lost, 1);
    }
    if (pointing && !push_pointing(spacecraft, 0, step)) {
      add(report_.telemetry_lost, 1);
    }
    if (linked && !push_linked(spacecraft, 0, step)) {
      add(report_.telemetry_lost, 1);
    }
  }
  bool fleet_is_there = hand_over_fleet(1);
  if (fleet) {
    fleet_is_there = sample_fleet(step, 0) || fleet_is_there;
    if (fleet_at_once || fleet_parts_ == 1) {
      fleet_is_there = hand_over_fleet(kAll);
    }
  } else if (fleet_parts_ > 1 && beats_left(step, telemetry_.fleet_every) <= fleet_parts_) {
    bring_near(fleet_words_, fleet_parts_ - beats_left(step, telemetry_.fleet_every), fleet_parts_);
  }
  const std::size_t verdicts = segment_->verdicts.size();
  raise(report_.most_verdicts, verdicts);
  raise(report_.most_telemetry, segment_->telemetry.size());
  if (topics != 0 || fleet_is_there || wheels || pointing || linked || verdicts > 0 ||
      answers_wait()) {
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

/// All of that spacecraft, or none.
bool Tick::push_wheels(std::uint32_t spacecraft, std::uint32_t flags, std::uint64_t step) noexcept {
  const Vehicle& vehicle = fleet_.vehicles()[spacecraft];
  if (vehicle.wheels == nullptr) {
    return true;
  }
  const std::vector<SpinningWheel<double>>& spinning = vehicle.wheels->spinning;
  if (segment_->wheels.room() < spinning.size()) {
    return false;
  }
  const Vec3<double> omega_B = angular_velocity_of(vehicle);
  for (std::uint32_t i = 0; i < spinning.size(); ++i) {
    WheelRecord record = sample(spinning[i], omega_B);
    record.spacecraft = spacecraft;
    record.wheel = i;
    record.flags |= flags;
    record.step = step;
    record.time_ns = static_cast<std::int64_t>(step) * step_ns_;
    segment_->wheels.push(record);
  }
  return true;
}

/// Its bodies and joints, all of them or none.
bool Tick::push_linked(std::uint32_t spacecraft, std::uint32_t flags, std::uint64_t step) noexcept {
  Vehicle& vehicle = fleet_.vehicles()[spacecraft];
  if (vehicle.linked == nullptr) {
    return true;
  }
  const std::size_t bodies = vehicle.linked->assembly.bodies().size();
  const std::size_t joints = vehicle.linked->assembly.joints().size();
  if (segment_->bodies.room() < bodies || segment_->joints.room() < joints) {
    return false;
  }
  const std::int64_t time_ns = static_cast<std::int64_t>(step) * step_ns_;
  observe(vehicle, time_ns);
  const auto push = [&](auto record, auto& ring) {
    record.spacecraft = spacecraft;
    record.flags |= flags;
    record.step = step;
    record.time_ns = time_ns;
    ring.push(record);
  };
  for (std::size_t i = 0; i < bodies; ++i) {
    push(sample_body(vehicle, i), segment_->bodies);
  }
  for (std::size_t i = 0; i < joints; ++i) {
    push(sample_joint(vehicle, i), segment_->joints);
  }
  return true;
}

bool Tick::push_pointing(std::uint32_t spacecraft, std::uint32_t flags,
                         std::uint64_t step) noexcept {
  const Vehicle& vehicle = fleet_.vehicles()[spacecraft];
  if (vehicle.reference == nullptr) {
    return true;
  }
  const std::int64_t time_ns = static_cast<std::int64_t>(step) * step_ns_;
  PointingRecord record = pointing(vehicle, seconds<double>(time_ns));
  record.spacecraft = spacecraft;
  record.flags |= flags;
  record.step = step;
  record.time_ns = time_ns;
  return segment_->pointing.push(record);
}

/// True when some of the one before was left, which is there now.
bool Tick::sample_fleet(std::uint64_t step, std::uint32_t flags) noexcept {
  const bool ended_one = hand_over_fleet(kAll);
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
  fleet_count_ = segment_->fleet.begin();
  fleet_part_ = 0;
  return ended_one;
}

/// At most so many parts of what was sampled. True with the last one.
bool Tick::hand_over_fleet(std::size_t parts) noexcept {
  const std::size_t before = fleet_part_;
  for (; fleet_part_ < fleet_parts_ && parts > 0; --parts, ++fleet_part_) {
    segment_->fleet.put(fleet_count_, segment_.fleet_storage(), fleet_words_,
                        fleet_words_.size() * fleet_part_ / fleet_parts_,
                        fleet_words_.size() * (fleet_part_ + 1) / fleet_parts_);
  }
  const bool ended = before < fleet_parts_ && fleet_part_ == fleet_parts_;
  if (ended) {
    segment_->fleet.end(fleet_count_);
  }
  return ended;
}

/// The clock is not to go on.
void Tick::hand_over_rest() noexcept {
  snapshot_.hand_over(kAll);
  if (hand_over_fleet(kAll)) {
    wake_bridge(*segment_);
  }
}

void Tick::publish_final(int patience_ms) {
  if (following()) {
    return;
  }
  const std::uint64_t step = report_.step.load(std::memory_order_relaxed);
  const std::int64_t patience_ends = monotonic_ns() + patience_ms * (kSecond / 1000);
  const std::uint32_t topics = topics_at(step, true);
  const auto patiently = [&](const auto& push) {
    while (!push()) {
      if (monotonic_ns() > patience_ends) {
        add(report_.telemetry_lost, 1);
        return;
      }
      wake_bridge(*segment_);
      sleep_until(monotonic_ns() + kSecond / 1000);
    }
  };
  for (const std::uint32_t spacecraft : telemetry_.watched) {
    if (topics != 0) {
      patiently([&] { return push_sample(spacecraft, topics, kFlagFinal, step); });
    }
    if (telemetry_.wheel_every != 0) {
      patiently([&] { return push_wheels(spacecraft, kFlagFinal, step); });
    }
    if (telemetry_.linked_every != 0) {
      patiently([&] { return push_linked(spacecraft, kFlagFinal, step); });
    }
    if (telemetry_.pointing_every != 0) {
      patiently([&] { return push_pointing(spacecraft, kFlagFinal, step); });
    }
  }
  if (telemetry_.fleet_every != 0) {
    sample_fleet(step, kFlagFinal);
    hand_over_fleet(kAll);
  }
  tell_standby(true);
  wake_bridge(*segment_);
}

}  // namespace adstar::runtime
