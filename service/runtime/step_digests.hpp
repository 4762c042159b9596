#pragma once
// A digest of the fleet's state after every step, for `adstar replay` to find the first one that differs.
// Opt-in ([run] hashes = "step"): the tick works it out and hands it over in blocks, beside the journal.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "service/runtime/fleet_snapshot.hpp"
#include "service/runtime/journal.hpp"

namespace adstar::runtime {

/// One word more. For a given `digest` no two words give the same, and the other way round: states that
/// differ in one word have different digests.
inline std::uint64_t digest_with(std::uint64_t digest, std::uint64_t word) noexcept {
  digest = (digest ^ word) * 0x9e37'79b9'7f4a'7c15ULL;
  return digest ^ (digest >> 32);
}

template <class Record>
std::uint64_t digest_with_all(std::uint64_t digest, const Record& record) noexcept {
  static_assert(sizeof(Record) % 8 == 0);
  for (const std::uint64_t word :
       std::bit_cast<std::array<std::uint64_t, sizeof(Record) / 8>>(record)) {
    digest = digest_with(digest, word);
  }
  return digest;
}

/// Of all that changes in a fleet.
inline std::uint64_t digest_of(const std::vector<Vehicle>& vehicles) noexcept {
  std::uint64_t digest = 0;
  for (const Vehicle& vehicle : vehicles) {
    digest = digest_with_all(digest, state_of(vehicle));
    if (vehicle.wheels != nullptr) {
      for (const SpinningWheel<double>& spinning : vehicle.wheels->spinning) {
        digest = digest_with_all(digest, spinning.h);
      }
    }
    for_each_memory(vehicle, [&](const auto& record) { digest = digest_with_all(digest, record); });
  }
  return digest;
}

/// Digests of consecutive steps, as one journal record carries them.
struct DigestBlock {
  static constexpr std::size_t kMost = JournalRecord::kPayloadWords - 1;
  std::uint64_t count = 0;
  std::array<std::uint64_t, kMost> digests{};
};

/// What a record of the journal carries; its count is never more than there are.
inline DigestBlock digests_of(const JournalRecord& record) {
  auto block = payload_of<DigestBlock>(record);
  block.count = std::min<std::uint64_t>(block.count, DigestBlock::kMost);
  return block;
}

/// The tick's: fills one block after the other. Without a journal it does nothing.
class StepDigests {
 public:
  void write_to(JournalWriter* journal) noexcept { journal_ = journal; }

  /// After the step that led to `at`. Never waits, never allocates.
  void add(const std::vector<Vehicle>& vehicles, const Instant& at) noexcept {
    if (journal_ == nullptr) {
      return;
    }
    if (block_.count == DigestBlock::kMost ||
        at != Instant{first_.resets, first_.step + block_.count}) {
      flush();
      first_ = at;
    }
    block_.digests[block_.count++] = digest_of(vehicles);
  }

  void flush() noexcept {
    if (journal_ != nullptr && block_.count > 0) {
      journal_->write_beside(JournalKind::step_digests, first_.step,
                             static_cast<std::uint32_t>(first_.resets), block_);
    }
    block_ = {};
  }

 private:
  JournalWriter* journal_ = nullptr;
  Instant first_;
  DigestBlock block_;
};

}  // namespace adstar::runtime
