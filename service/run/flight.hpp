#pragma once
// Carrying a fleet and its gate on from what the journal holds, beat by beat as the tick does.

#include <cstdint>
#include <span>

#include "service/runtime/fleet.hpp"
#include "service/runtime/fleet_snapshot.hpp"
#include "service/runtime/gate.hpp"
#include "service/runtime/journal.hpp"
#include "service/runtime/run_control.hpp"

namespace adstar::run {

using runtime::Instant;

struct Flight {
  runtime::CommandGate& gate;
  runtime::ControlMemory& controls;
  runtime::Fleet* fleet = nullptr;  ///< null: the gate alone, which does not look at the fleet
  std::int64_t step_ns = 0;
  Instant at;  ///< before beat at.step
};

/// Hears the records of the present beat at the front of `records`, up to a reset; returns how many.
std::size_t hear(Flight& flight, std::span<const runtime::JournalRecord> records);

/// Computes the beats before `until` with their records, as far as those reach over resets; returns how many
/// of `records` that took.
std::size_t carry_on(Flight& flight, std::span<const runtime::JournalRecord> records,
                     const Instant& until);

}  // namespace adstar::run
