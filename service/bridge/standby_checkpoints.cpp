#include "service/bridge/standby_checkpoints.hpp"

#include <algorithm>

#include "service/run/files.hpp"

namespace adstar::bridge {
namespace {

/// Of 32 kB each: a checkpoint of 512 MB. Whoever can write to the topic could otherwise fill the memory.
constexpr std::uint32_t kMostParts = 16'384;

}  // namespace

std::optional<NumberedBytes> CheckpointWatch::newer() {
  try {
    if (!directory_) {
      directory_ = run::RunDirectory::open(run_, run::RunDirectory::Use::look);
    }
    const auto files = directory_->checkpoints();
    if (files.empty() || files.front().number == seen_) {
      return std::nullopt;
    }
    NumberedBytes newest{files.front().number, run::read_bytes(files.front().path)};
    seen_ = newest.number;
    return newest;
  } catch (const run::RunError&) {
    return std::nullopt;  // removed as it was looked at: there is a newer one next time
  }
}

std::optional<run::Bytes> CheckpointParts::add(std::uint64_t checkpoint, std::uint32_t part,
                                               std::uint32_t parts,
                                               std::span<const std::uint8_t> bytes) {
  if (checkpoint < checkpoint_ || parts > kMostParts || part >= parts) {
    return std::nullopt;
  }
  if (checkpoint > checkpoint_ || parts_.size() != parts) {
    checkpoint_ = checkpoint;
    parts_.assign(parts, std::nullopt);
  }
  const auto raw = std::as_bytes(bytes);
  parts_[part].emplace(raw.begin(), raw.end());
  run::Bytes whole;
  for (const auto& each : parts_) {
    if (!each) {
      return std::nullopt;
    }
    whole.insert(whole.end(), each->begin(), each->end());
  }
  return whole;
}

}  // namespace adstar::bridge
