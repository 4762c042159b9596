#pragma once
// The memory that adstard and adstar-bridge share: rings for what is a sequence, latest-value slots
// for what is a state. A sealed memfd (no shrink, no grow), inherited by the bridge.
//
// The bridge is not trusted: adstard masks every index it reads here and copies before it
// validates.

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "service/runtime/journal.hpp"
#include "service/runtime/latest_value.hpp"
#include "service/runtime/records.hpp"
#include "service/runtime/ring.hpp"

namespace adstar::runtime {

enum class BridgeState : std::uint32_t { starting, ready, refused };

/// Between a primary and its standby (decisions/0016). `following` and `term` are adstard's at the start.
struct StandbyLink {
  std::atomic<std::uint64_t> term{1};  ///< rises by one with each take-over
  std::atomic<std::uint32_t> state_received{
      0};                                       ///< by the bridge: the primary's state is in a file
  std::atomic<std::uint32_t> following{0};      ///< by adstard: the tick has it and follows
  std::atomic<std::uint32_t> take_over{0};      ///< by the bridge: the primary is gone
  std::atomic<std::uint32_t> lost_track{0};     ///< by either: it cannot follow with the same bits
  std::atomic<std::uint64_t> followed_high{0};  ///< by the bridge: whose state it has
  std::atomic<std::uint64_t> followed_low{0};
  std::atomic<std::uint64_t> outranked_by{0};   ///< by the bridge: a higher term is out there
  std::atomic<std::uint64_t> next_followed{0};  ///< by the bridge: of the record to be pushed next
  SpscRing<JournalRecord, 4096> relayed;        ///< tick → bridge, of a primary
  SpscRing<JournalRecord, 4096> followed;       ///< bridge → tick, of a standby
  LatestValue<StandbyBeatRecord> beat;          ///< tick → bridge, of a primary
  LatestValue<StandbyBeatRecord> primary_beat;  ///< bridge → tick, of a standby
};

struct SharedSegment {
  std::uint64_t layout = 0;  ///< kLayout; a bridge of another build refuses to attach
  std::uint64_t fleet_size = 0;

  std::atomic<std::uint32_t> bridge_state{0};    ///< BridgeState, written by the bridge
  char bridge_message[256] = {};                 ///< why it refused, written before the state
  std::atomic<std::uint32_t> stop_requested{0};  ///< by adstard: drain the rings, then exit
  std::atomic<std::uint32_t> snapshot_requested{
      0};  ///< by the bridge: publish everything at the next beat
  std::atomic<std::uint64_t> commands_lost{0};  ///< by the bridge: command ring was full
  std::atomic<std::uint64_t> commands_refused{
      0};  ///< by the bridge: for what the scene does not have
  std::atomic<std::uint32_t> wake_count{
      0};  ///< futex word: rises when there is something to publish
  std::atomic<std::uint32_t> bridge_sleeps{0};  ///< 1 while the bridge waits on wake_count
  std::atomic<std::uint32_t> bridge_rounds{0};  ///< by the bridge: rises with every round it makes
  std::atomic<std::uint32_t> push_count{
      0};  ///< futex word: rises when the bridge has pushed something for the tick
  std::atomic<std::uint32_t> tick_sleeps{0};  ///< 1 while the tick stands and waits on push_count

  SpscRing<CommandRecord, 4096> commands;              ///< bridge → tick
  SpscRing<VerdictRecord, 8192> verdicts;              ///< tick → bridge
  SpscRing<TelemetryRecord, 16384> telemetry;          ///< tick → bridge
  SpscRing<WheelRecord, 8192> wheels;                  ///< tick → bridge
  SpscRing<BodyRecord, 8192> bodies;                   ///< tick → bridge
  SpscRing<JointRecord, 8192> joints;                  ///< tick → bridge
  SpscRing<PointingRecord, 8192> pointing;             ///< tick → bridge
  SpscRing<StepRequestRecord, 64> step_requests;       ///< bridge → tick
  SpscRing<StepReplyRecord, 256> step_replies;         ///< tick → bridge
  SpscRing<ControlRecord, 64> controls;                ///< bridge → tick
  SpscRing<ControlAnswerRecord, 256> control_answers;  ///< tick → bridge
  LatestValue<StatusRecord> status;                    ///< housekeeping → bridge
  LatestValue<TimingRecord> timing;                    ///< housekeeping → bridge
  StandbyLink standby;
  LatestWords fleet;  ///< tick → bridge; its words follow this struct
};

inline constexpr std::uint64_t kLayout = 0x6164'7374'6172'0000ULL ^ sizeof(SharedSegment);

/// Words of one fleet snapshot: header, then members.
constexpr std::size_t fleet_words(std::size_t members) {
  return (sizeof(FleetHeader) + members * sizeof(FleetRecord)) / 8;
}

/// A mapped segment. Move-only; unmaps and closes at the end.
class MappedSegment {
 public:
  /// Makes a new one: memfd, sized, sealed, prefaulted. Throws std::system_error.
  static MappedSegment create(std::size_t fleet_size);
  /// Maps one that was inherited. Throws std::runtime_error when it is of another build.
  static MappedSegment attach(int fd);

  MappedSegment(MappedSegment&& other) noexcept;
  MappedSegment(const MappedSegment&) = delete;
  MappedSegment& operator=(const MappedSegment&) = delete;
  MappedSegment& operator=(MappedSegment&&) = delete;
  ~MappedSegment();

  /// Writes the header again: what a bridge scribbled there as it died must not keep the next one
  /// away.
  void restore_header() const noexcept;

  SharedSegment& operator*() const noexcept { return *segment_; }
  SharedSegment* operator->() const noexcept { return segment_; }
  int fd() const noexcept { return fd_; }
  std::size_t fleet_size() const noexcept { return fleet_size_; }  ///< this side's own copy
  std::span<std::uint64_t> fleet_storage() const noexcept;         ///< both halves

 private:
  MappedSegment(int fd, SharedSegment* segment, std::size_t bytes, std::size_t fleet_size)
      : fd_(fd), segment_(segment), bytes_(bytes), fleet_size_(fleet_size) {}
  int fd_ = -1;
  SharedSegment* segment_ = nullptr;
  std::size_t bytes_ = 0;
  std::size_t fleet_size_ = 0;
};

/// Producer side: there is something to publish. One system call when the bridge sleeps, none when
/// not.
void wake_bridge(SharedSegment& segment) noexcept;

/// Bridge side: sleeps until woken or timeout. Call with the wake_count read before the rings were
/// found empty.
void sleep_until_woken(SharedSegment& segment, std::uint32_t seen, int timeout_ms) noexcept;

/// Bridge side: something was pushed for the tick. A system call only while the clock stands.
void wake_tick(SharedSegment& segment) noexcept;

/// Tick side, while the clock stands: sleeps until something is pushed or timeout. Call with the
/// push_count read before the rings were found empty.
void sleep_until_pushed(SharedSegment& segment, std::uint32_t seen, int timeout_ms) noexcept;

}  // namespace adstar::runtime
