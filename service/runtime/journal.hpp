#pragma once
// What the tick writes down before it counts: every command that changes the gate and every run control
// that changes the fleet, with the beat that took it. Scene, checkpoint and journal give the same bits again.
//
// The tick pushes into a ring in a file of /dev/shm: a page there is never written back, so a store
// never faults nor waits for a disk, and it outlives the process. Another thread moves the ring's
// entries to a file (service/run/), and lets go of them only once they are there. decisions/0013.

#include <array>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "service/runtime/records.hpp"
#include "service/runtime/ring.hpp"

namespace adstar::runtime {

enum class JournalKind : std::uint32_t {
  command,     ///< payload: CommandRecord
  control,     ///< payload: ControlRecord that was tried; note: its ControlRefusal
  state_hash,  ///< payload: one word, the hash of the fleet's state at `step`; note: resets before
  step_digests,  ///< payload: DigestBlock, of the states from `step` on; note: resets before
};

/// What happened, which a run must hear to be flown again; the others only say how it was.
inline bool is_heard(JournalKind kind) noexcept {
  return kind == JournalKind::command || kind == JournalKind::control;
}

struct JournalRecord {
  static constexpr std::size_t kPayloadWords = 20;
  std::uint64_t number =
      0;  ///< rises by one from record to record; what is not heard repeats the last
  std::uint64_t step = 0;  ///< of the beat that took it
  JournalKind kind = JournalKind::command;
  std::uint32_t note = 0;
  std::array<std::uint64_t, kPayloadWords> payload{};
};

template <class Payload>
JournalRecord make_journal_record(JournalKind kind, std::uint64_t number, std::uint64_t step,
                                  std::uint32_t note, const Payload& payload) noexcept {
  static_assert(std::is_trivially_copyable_v<Payload>);
  static_assert(sizeof(Payload) <= sizeof(JournalRecord::payload));
  JournalRecord record{number, step, kind, note, {}};
  std::memcpy(record.payload.data(), &payload, sizeof payload);
  return record;
}

template <class Payload>
Payload payload_of(const JournalRecord& record) noexcept {
  static_assert(std::is_trivially_copyable_v<Payload>);
  static_assert(sizeof(Payload) <= sizeof(JournalRecord::payload));
  Payload payload;
  std::memcpy(static_cast<void*>(&payload), record.payload.data(), sizeof payload);
  return payload;
}

/// The part of the journal that is not in a file yet. Lives in shared memory.
struct HotJournal {
  using Ring = SpscRing<JournalRecord, 16384>;
  std::uint64_t layout = 0;            ///< kHotJournalLayout
  std::uint64_t run = 0;               ///< whose it is
  std::atomic<std::uint64_t> step{0};  ///< the next beat to be computed
  Ring ring;                           ///< tick → recorder
};

inline constexpr std::uint64_t kHotJournalLayout = 0x6164'6a6f'7572'0000ULL ^ sizeof(HotJournal);

/// The tick's end of it.
class JournalWriter {
 public:
  JournalWriter(HotJournal& hot, std::uint64_t next_number) noexcept
      : hot_(hot), next_number_(next_number) {}

  /// Of the record that comes next.
  std::uint64_t next_number() const noexcept { return next_number_; }

  /// Whether one more will be taken; what finds no place must not happen.
  bool has_room() const noexcept { return hot_.ring.has_room(); }

  template <class Payload>
  void write(JournalKind kind, std::uint64_t step, std::uint32_t note,
             const Payload& payload) noexcept {
    if (hot_.ring.push(make_journal_record(kind, next_number_, step, note, payload))) {
      ++next_number_;
    }
  }

  /// What a run can do without, into the half of the ring that commands can spare.
  template <class Payload>
  void write_beside(JournalKind kind, std::uint64_t step, std::uint32_t note,
                    const Payload& payload) noexcept {
    if (hot_.ring.size() < HotJournal::Ring::kCapacity / 2) {
      hot_.ring.push(make_journal_record(kind, next_number_ - 1, step, note, payload));
    }
  }

  /// All beats before `step` are computed. Before a reset is written: 0.
  void reached(std::uint64_t step) noexcept { hot_.step.store(step, std::memory_order_release); }

 private:
  HotJournal& hot_;
  std::uint64_t next_number_;
};

}  // namespace adstar::runtime
