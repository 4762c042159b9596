#pragma once
// Carrying a fleet and its gate on from what the journal holds, beat by beat as the tick does.

#include <cstdint>
#include <span>

#include "service/runtime/fleet.hpp"
#include "service/runtime/gate.hpp"
#include "service/runtime/journal.hpp"

namespace adstar::run {

struct Flight {
  runtime::CommandGate& gate;
  runtime::Fleet* fleet = nullptr;  ///< null: the gate alone, which does not look at the fleet
  std::int64_t step_ns = 0;
  std::uint64_t step = 0;  ///< the next beat
};

/// Hands the records of beat flight.step at the front of `records` to the gate; returns how many.
std::size_t hear(Flight& flight, std::span<const runtime::JournalRecord> records);

/// Computes the beats before `until` with their records; returns how many of `records` they took.
std::size_t carry_on(Flight& flight, std::span<const runtime::JournalRecord> records,
                     std::uint64_t until);

}  // namespace adstar::run
