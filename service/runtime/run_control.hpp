#pragma once
// Run control: what somebody outside may do to a run, beside commanding torques. The rules:
// service/pages/commands.md, "Run control".

#include <cstdint>
#include <span>
#include <vector>

#include "service/runtime/fleet.hpp"
#include "service/runtime/records.hpp"
#include "service/runtime/request_memory.hpp"
#include "service/runtime/ring.hpp"

namespace adstar::runtime {

using ControlAnswerRing = SpscRing<ControlAnswerRecord, 256>;

/// Pause and resume are the clock's alone.
constexpr bool changes_the_fleet(ControlAction action) noexcept {
  return action != ControlAction::pause && action != ControlAction::resume;
}

/// Does to the fleet what the record says, or nothing, and says which. Trusts nothing in the record.
/// Pause and resume are the clock's alone: here they only pass. A function of record and fleet, so
/// that a recorded run can be taken again; the fleet must have kept its start (Fleet::keep_start).
/// Step and time of the answer are the caller's. Between steps; never allocates.
ControlAnswerRecord apply_control(const ControlRecord& record, Fleet& fleet) noexcept;

/// Answers a sequence number that was heard before as it was answered then, and remembers.
class ControlMemory {
 public:
  explicit ControlMemory(ControlAnswerRing& answers) : answers_(answers) {}

  /// True: it was heard before and is answered.
  bool repeated(const ControlRecord& record, const ControlAnswerRecord& blank) noexcept;
  /// Answers, and remembers.
  void conclude(const ControlAnswerRecord& answer) noexcept;

  /// Remembers what was answered before this process.
  void hear_again(const ControlAnswerRecord& answer) noexcept;
  std::vector<std::uint64_t> save() const { return memory_.save(); }
  bool load(std::span<const std::uint64_t> words) { return memory_.load(words); }

 private:
  ControlAnswerRing& answers_;
  RequestMemory<ControlAnswerRecord> memory_;
};

/// The answer without a verdict.
ControlAnswerRecord blank_answer(const ControlRecord& record) noexcept;

}  // namespace adstar::runtime
