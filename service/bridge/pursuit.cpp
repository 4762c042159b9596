#include "service/bridge/pursuit.hpp"

#include <algorithm>

namespace adstar::bridge {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
// Some seconds of the most that a primary takes: what waits longer waits in vain.
constexpr std::size_t kMostWaiting = 65'536;

}  // namespace

Pursuit::Pursuit(runtime::StandbyLink& link, const scene::Standby& standby, std::int64_t now_ns)
    : link_(link),
      lead_steps_(standby.lead_steps),
      patience_ns_(std::max(kSecond, 3 * standby.lease_ns)),
      begun_ns_(now_ns) {
  if (bound()) {
    primary_ = Claim{link_.term.load(), {link_.followed_high.load(), link_.followed_low.load()}};
  }
}

bool Pursuit::follows(const runtime::CommanderId& instance) const noexcept {
  return primary_ && primary_->instance == instance;
}

bool Pursuit::hear_beat(const Claim& claim, const runtime::StandbyBeatRecord& beat) {
  if (!follows(claim.instance)) {
    if (primary_ && !goes_before(claim, *primary_)) {
      return false;
    }
    if (bound()) {
      usurped_ = true;
      return false;
    }
    state_.reset();
    waiting_.clear();
    beat_.reset();
    missing_since_ns_ = 0;
  }
  const bool is_first = !beat_;
  primary_ = claim;
  link_.term.store(claim.term);
  // The last words of one that ends come late: they are no later beat.
  const std::int64_t received_ns =
      beat_ && beat_->step == beat.step ? beat_->received_ns : beat.received_ns;
  gone_ = false;
  beat_ = beat;
  beat_->received_ns = received_ns;
  return is_first;
}

void Pursuit::hear_end(const runtime::CommanderId& instance) {
  if (!follows(instance)) {
    return;
  }
  gone_ = true;
  if (!bound()) {
    primary_.reset();  // whoever comes next is as good
    beat_.reset();
  }
}

void Pursuit::hear_record(const runtime::CommanderId& instance,
                          const runtime::JournalRecord& record) {
  if (!follows(instance)) {
    return;
  }
  waiting_.push_back(record);
  // Before there is a state they only wait for one: the oldest are in the next checkpoint.
  while (!bound() && waiting_.size() > kMostWaiting) {
    waiting_.pop_front();
  }
}

void Pursuit::hear_state(const runtime::CommanderId& instance, run::Bytes bytes,
                         std::uint64_t next_number) {
  if (follows(instance) && !bound()) {
    state_ = std::move(bytes);
    next_number_ = next_number;
  }
}

const run::Bytes* Pursuit::state_to_hand_over() {
  if (!state_ || bound() || !beat_) {
    return nullptr;
  }
  std::erase_if(waiting_, [&](const auto& record) { return record.number < next_number_; });
  const std::uint64_t first = waiting_.empty() ? beat_->next_number : waiting_.front().number;
  return first > next_number_ ? nullptr : &*state_;  // past a gap the next checkpoint will do
}

void Pursuit::state_is_handed_over() {
  link_.next_followed.store(next_number_);
  link_.followed_high.store(primary_->instance.high);
  link_.followed_low.store(primary_->instance.low);
  link_.state_received.store(1);
  state_.reset();
}

Pursuit::Verdict Pursuit::lose_track(const char* why) noexcept {
  why_lost_ = why;
  link_.lost_track.store(1);
  return Verdict::lost_track;
}

/// False when some are missing between.
bool Pursuit::hand_over_records() {
  std::uint64_t next = link_.next_followed.load();
  while (!waiting_.empty()) {
    const runtime::JournalRecord& record = waiting_.front();
    if (record.number > next) {
      return false;
    }
    if (record.number == next) {
      if (!link_.followed.push(record)) {
        return true;  // the tick has a backlog; next round
      }
      last_record_step_ = record.step;
      link_.next_followed.store(++next);
    }
    waiting_.pop_front();
  }
  return true;
}

/// For a record that a beat counts on, though nothing that comes is it.
bool Pursuit::waits_too_long(std::int64_t now_ns) noexcept {
  const bool missing = beat_ && waiting_.empty() && beat_->next_number > link_.next_followed.load();
  if (!missing) {
    missing_since_ns_ = 0;
    if (beat_ && waiting_.empty()) {
      complete_step_ = beat_->step;
    }
    return false;
  }
  if (missing_since_ns_ == 0) {
    missing_since_ns_ = now_ns;
  }
  return now_ns - missing_since_ns_ > patience_ns_;
}

/// A record that is missing came after complete_step_, is heard a lead later, and not before one with a
/// lower number.
bool Pursuit::may_have_heard_what_is_missing() const noexcept {
  return missing_since_ns_ != 0 &&
         beat_->step > std::max(complete_step_ + lead_steps_, last_record_step_);
}

Pursuit::Verdict Pursuit::go_on(std::int64_t now_ns) {
  if (!bound() || link_.following.load() == 0) {
    return Verdict::follow;
  }
  if (link_.lost_track.load() != 0) {
    return Verdict::lost_track;
  }
  if (usurped_) {
    return lose_track("another daemon has taken over from the primary whose state it has");
  }
  if (!hand_over_records()) {
    return lose_track("records of the primary are missing");
  }
  if (waiting_.size() > kMostWaiting) {
    return lose_track("the primary is too fast for it");
  }
  if (waits_too_long(now_ns)) {
    return lose_track("a record of the primary does not come");
  }
  if (beat_) {
    link_.primary_beat.write(*beat_);
  }
  // Begun anew, it may have missed the primary's end.
  const bool unheard = !beat_ && now_ns - begun_ns_ > patience_ns_;
  const bool ended = beat_ && beat_->ended != 0 && missing_since_ns_ == 0;
  if (!(gone_ || ended || unheard) || !waiting_.empty()) {
    return Verdict::follow;
  }
  if (may_have_heard_what_is_missing()) {
    return lose_track("the primary went with a command that it may have obeyed");
  }
  return Verdict::take_over;
}

}  // namespace adstar::bridge
