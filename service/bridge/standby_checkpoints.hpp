#pragma once
// Checkpoints on their way from a primary's run directory to a standby's.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "service/run/bytes.hpp"
#include "service/run/run_directory.hpp"

namespace adstar::bridge {

struct NumberedBytes {
  std::uint64_t number = 0;
  run::Bytes bytes;
};

/// The newest checkpoint in a run directory, once each.
class CheckpointWatch {
 public:
  explicit CheckpointWatch(std::string run) : run_(std::move(run)) {}

  /// Nothing when there is none, or it was given before.
  std::optional<NumberedBytes> newer();

 private:
  std::string run_;
  std::optional<run::RunDirectory> directory_;
  std::uint64_t seen_ = 0;
};

/// The parts of one checkpoint, in any order; those of an older one are dropped.
class CheckpointParts {
 public:
  /// The whole, with the part that completes it.
  std::optional<run::Bytes> add(std::uint64_t checkpoint, std::uint32_t part, std::uint32_t parts,
                                std::span<const std::uint8_t> bytes);

 private:
  std::uint64_t checkpoint_ = 0;
  std::vector<std::optional<run::Bytes>> parts_;
};

}  // namespace adstar::bridge
