#pragma once
// Judges by the bridge's count of rounds whether it still goes round, or only exists: stopped,
// wedged, spinning in a lock.
//
// Silence is summed over looks, each counted for a tenth of a second at most: a watcher that stood
// still itself has not seen the bridge be silent.

#include <algorithm>
#include <cstdint>

namespace adstar::adstard {

class BridgePulse {
 public:
  static constexpr std::int64_t kPatience_ns = 3'000'000'000;
  static constexpr std::int64_t kStartPatience_ns = 10'000'000'000;  ///< until its first round
  static constexpr std::int64_t kLongestLook_ns = 100'000'000;

  /// A bridge has been started.
  void begin(std::uint32_t rounds, std::int64_t now_ns) noexcept {
    rounds_ = rounds;
    looked_ns_ = now_ns;
    silent_ns_ = 0;
    beaten_ = false;
  }

  /// True when it has made no round for too long.
  bool silent(std::uint32_t rounds, std::int64_t now_ns) noexcept {
    const std::int64_t passed_ns = std::min(now_ns - looked_ns_, kLongestLook_ns);
    looked_ns_ = now_ns;
    if (rounds != rounds_) {
      rounds_ = rounds;
      silent_ns_ = 0;
      beaten_ = true;
      return false;
    }
    silent_ns_ += passed_ns;
    return silent_ns_ > (beaten_ ? kPatience_ns : kStartPatience_ns);
  }

  std::int64_t silent_ns() const noexcept { return silent_ns_; }

 private:
  std::uint32_t rounds_ = 0;
  std::int64_t looked_ns_ = 0;
  std::int64_t silent_ns_ = 0;
  bool beaten_ = false;
};

}  // namespace adstar::adstard
