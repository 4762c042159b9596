#pragma once
// At most so many lines a second, and the number of those left out: log throttles that drain by
// themselves.

#include <chrono>
#include <cstdint>
#include <mutex>
#include <optional>

namespace adstar::dds {

class RateLimit {
 public:
  using Clock = std::chrono::steady_clock;
  explicit RateLimit(std::uint32_t lines_per_second) : lines_(lines_per_second) {}

  /// Nothing: leave the line out. Else the number of lines left out before this one.
  std::optional<std::uint64_t> admit(Clock::time_point now = Clock::now()) {
    const std::lock_guard lock(mutex_);
    if (now - begin_ >= std::chrono::seconds(1)) {
      begin_ = now;
      used_ = 0;
    }
    if (used_ >= lines_) {
      ++dropped_;
      return std::nullopt;
    }
    ++used_;
    const std::uint64_t dropped = dropped_;
    dropped_ = 0;
    return dropped;
  }

 private:
  std::mutex mutex_;
  std::uint32_t lines_;
  std::uint32_t used_ = 0;
  std::uint64_t dropped_ = 0;
  Clock::time_point begin_{};
};

}  // namespace adstar::dds
