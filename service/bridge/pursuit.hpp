#pragma once
// What a standby makes of what it hears: whom it follows, what it hands to the tick, and whether it is to
// take over. No DDS in here: whoever calls says what came, and what time it is.
//
// A standby is bound to one primary, by the state that it took from it: records of another mean another
// state. What it cannot follow with the same bits it does not follow: it has lost track, and ends.

#include <cstdint>
#include <deque>
#include <optional>

#include "service/bridge/claim.hpp"
#include "service/run/bytes.hpp"
#include "service/runtime/shared_segment.hpp"
#include "service/scene/scene.hpp"

namespace adstar::bridge {

class Pursuit {
 public:
  /// All times are of the monotonic clock [ns]. One that is begun anew, over the same link, goes on where the
  /// last one was.
  Pursuit(runtime::StandbyLink& link, const scene::Standby& standby, std::int64_t now_ns);

  /// True when this is the first that is heard of the one it follows.
  bool hear_beat(const Claim& claim, const runtime::StandbyBeatRecord& beat);
  /// Nobody asserts its liveliness any more.
  void hear_end(const runtime::CommanderId& instance);
  void hear_record(const runtime::CommanderId& instance, const runtime::JournalRecord& record);
  /// A checkpoint of it, and the number of the first record that is not in there.
  void hear_state(const runtime::CommanderId& instance, run::Bytes bytes,
                  std::uint64_t next_number);

  bool follows(const runtime::CommanderId& instance) const noexcept;
  bool follows_somebody() const noexcept { return primary_.has_value(); }

  /// The state that adstard is to have, once the records since are here without a gap; null before, and
  /// after state_is_handed_over().
  const run::Bytes* state_to_hand_over();
  void state_is_handed_over();

  enum class Verdict { follow, take_over, lost_track };
  /// Hands over what can be handed over. lost_track: why_lost() says why.
  Verdict go_on(std::int64_t now_ns);
  const char* why_lost() const noexcept { return why_lost_; }

 private:
  bool bound() const noexcept { return link_.state_received.load() != 0; }
  Verdict lose_track(const char* why) noexcept;
  bool hand_over_records();
  bool waits_too_long(std::int64_t now_ns) noexcept;
  bool may_have_heard_what_is_missing() const noexcept;

  runtime::StandbyLink& link_;
  std::uint64_t lead_steps_;
  std::int64_t patience_ns_;
  std::int64_t begun_ns_;
  std::optional<Claim> primary_;
  std::optional<runtime::StandbyBeatRecord> beat_;
  bool gone_ = false;     ///< its liveliness is lost
  bool usurped_ = false;  ///< another one goes before it
  std::optional<run::Bytes> state_;
  std::uint64_t next_number_ = 0;               ///< of the first record that is not in state_
  std::deque<runtime::JournalRecord> waiting_;  ///< ascending
  std::uint64_t complete_step_ = 0;             ///< of the last beat whose records were all here
  std::uint64_t last_record_step_ = 0;
  std::int64_t missing_since_ns_ = 0;                       ///< 0: nothing is missing
  const char* why_lost_ = "its own journal takes no more";  ///< what the tick alone knows
};

}  // namespace adstar::bridge
