#pragma once
// A bar on stderr for runs that last: nothing in the first two seconds, nothing when nobody
// watches.

#include <chrono>
#include <cstdint>

namespace adstar::cli {

class ProgressBar {
 public:
  explicit ProgressBar(std::uint64_t total);
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  /// Leaves an empty line behind.
  ~ProgressBar();

  /// Cheap enough to be called some thousand times a second.
  void show(std::uint64_t done);

 private:
  using Clock = std::chrono::steady_clock;

  std::uint64_t total_;
  bool watched_;
  bool drawn_ = false;
  Clock::time_point begun_ = Clock::now();
  Clock::time_point next_;
};

}  // namespace adstar::cli
