#pragma once
// The state of a run at one step, in a file: the fleet, the gate, and where the journal goes on.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "service/run/bytes.hpp"
#include "service/runtime/fleet_snapshot.hpp"

namespace adstar::run {

struct Checkpoint {
  std::uint64_t run = 0;          ///< of which run
  std::uint64_t fingerprint = 0;  ///< of its scene (scene_fingerprint)
  runtime::Instant at;
  std::uint64_t next_number = 1;    ///< of the first journal record that is not in here
  std::uint64_t first_journal = 1;  ///< count of the oldest journal file with such a record
  runtime::FleetState fleet;
  std::vector<std::uint64_t> gate;      ///< CommandGate::save
  std::vector<std::uint64_t> controls;  ///< ControlMemory::save
};

Bytes to_bytes(const Checkpoint& checkpoint);

/// Throws RunError that says what is wrong with the bytes: cut off, changed, of another format.
Checkpoint checkpoint_from(std::span<const std::byte> bytes);

/// Of the state alone: what two daemons that fly the same must have in common.
std::uint64_t state_hash(std::uint64_t step, const runtime::FleetState& fleet);

}  // namespace adstar::run
