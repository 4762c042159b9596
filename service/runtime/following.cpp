// A primary and its standby (decisions/0016). The primary hears each command some beats after it came, and
// says at once at which; the standby hears the same at the same beats, computes no further than the
// primary has, and goes on alone when that one is gone.

#include <algorithm>

#include "service/runtime/tick.hpp"
#include "service/runtime/tick_parts.hpp"

namespace adstar::runtime {

/// It is heard `lead_` beats from now, here and there.
void Tick::hold(const CommandRecord& command, const Beat& now) noexcept {
  const bool has_room = held_.size() < kMostHeld && segment_->standby.relayed.has_room() &&
                        (journal_ == nullptr || journal_->has_room());
  if (!has_room) {
    gate_.refuse(command, now, Reason::not_recorded);
    return;
  }
  const JournalRecord record =
      make_journal_record(JournalKind::command, next_number_, now.step + lead_, 0, command);
  keep(record);
  segment_->standby.relayed.push(record);
}

void Tick::keep(const JournalRecord& record) noexcept {
  if (journal_ != nullptr) {
    journal_->write(record.kind, record.step, record.note, payload_of<CommandRecord>(record));
  }
  held_.push(record);
  ++next_number_;
}

void Tick::hear_held(const Beat& now) noexcept {
  while (!held_.empty() && held_.front().step <= now.step) {
    gate_.receive(payload_of<CommandRecord>(held_.front()), now);
    held_.pop();
  }
}

void Tick::tell_standby(bool ended) noexcept {
  if (lead_ > 0) {
    segment_->standby.beat.write({step(), next_number_, 0, ended ? 1U : 0U});
    wake_bridge(*segment_);
  }
}

/// Returns when the next beat is due, once the primary is gone; nothing when this ends before.
std::optional<std::int64_t> Tick::follow(const std::atomic<bool>& stop) noexcept {
  StandbyLink& link = segment_->standby;
  StandbyBeatRecord primary;
  while (!stop.load(std::memory_order_relaxed) && step() < last_step_) {
    add(report_.turns, 1);
    const std::uint32_t seen = segment_->push_count.load(std::memory_order_seq_cst);
    // Read before the rings: the bridge asks for it only after its last push.
    const bool gone = link.take_over.load(std::memory_order_acquire) != 0;
    link.primary_beat.read(primary);
    follow_to(primary, stop);
    if (gone && link.followed.size() > 0) {
      link.lost_track.store(1, std::memory_order_relaxed);  // the journal takes no more
    }
    if (gone && step() < last_step_ && link.lost_track.load(std::memory_order_relaxed) == 0) {
      report_.following.store(0, std::memory_order_relaxed);
      return due_after(primary);
    }
    sleep_until_pushed(*segment_, seen, 10);
  }
  return std::nullopt;
}

/// The beats that the primary has computed, as far as their commands are here.
void Tick::follow_to(const StandbyBeatRecord& primary, const std::atomic<bool>& stop) noexcept {
  take_followed();
  // All commands of a beat are here when all are that the primary knew of, or one of a later beat is.
  const auto complete = [&] {
    return next_number_ >= primary.next_number || (!held_.empty() && held_.back().step > step());
  };
  while (step() < std::min(primary.step, last_step_) && complete() &&
         !stop.load(std::memory_order_relaxed)) {
    add(report_.turns, 1);
    follow_beat();
    take_followed();
  }
}

/// Its phase goes on, as far as it was heard.
std::int64_t Tick::due_after(const StandbyBeatRecord& primary) const noexcept {
  if (primary.received_ns == 0) {
    return monotonic_ns();
  }
  const BeatClock clock = make_beat_clock(0, step_ns_, rate_);
  const std::uint64_t short_of = primary.step > step() ? primary.step - step() : 0;
  return primary.received_ns + beats_to_ns(clock, 1) - beats_to_ns(clock, short_of);
}

/// What comes out of order is not kept: the bridge looks after that, and says so.
void Tick::take_followed() noexcept {
  while (held_.has_room() && (journal_ == nullptr || journal_->has_room())) {
    const std::optional<JournalRecord> record = segment_->standby.followed.pop();
    if (!record) {
      return;
    }
    if (record->kind == JournalKind::command && record->number == next_number_) {
      keep(*record);
    }
  }
}

/// A beat that says nothing. Its verdicts are the bridge's to keep.
void Tick::follow_beat() noexcept {
  const std::uint64_t n = step();
  const Beat now{n, static_cast<std::int64_t>(n) * step_ns_, step_ns_};
  hear_held(now);
  gate_.begin_step(now, fleet_);
  report_.unresolved_spacecraft.store(fleet_.step(now.t_ns, now.h_ns), std::memory_order_relaxed);
  reached(n + 1);
  publish_counters();
  if (segment_->verdicts.size() > 0) {
    wake_bridge(*segment_);
  }
}

/// The beats of the silence, one after the other: subscribers get every step. Returns when it was done. What a
/// machine cannot make up in twice their number is left to the policy of the budget.
std::int64_t Tick::make_up(const BeatClock& clock, const std::atomic<bool>& stop) noexcept {
  std::int64_t now_ns = monotonic_ns();
  std::uint64_t left = 2 * beats_behind(clock, step(), now_ns);
  while (left > 0 && step() < last_step_ && beats_behind(clock, step(), now_ns) > 0 && !halted() &&
         !stop.load(std::memory_order_relaxed)) {
    account(beat(step(), now_ns), 0);
    add(report_.turns, 1);
    add(report_.caught_up_beats, 1);
    now_ns = monotonic_ns();
    --left;
  }
  return now_ns;
}

}  // namespace adstar::runtime
