#pragma once
// Keeps a bridge going: one that fell is started again when its back-off is over, one that does nothing is
// killed first.

#include <cstdint>

#include <spdlog/spdlog.h>

#include "service/adstard/bridge_process.hpp"
#include "service/adstard/bridge_pulse.hpp"
#include "service/runtime/shared_segment.hpp"
#include "service/scene/scene.hpp"

namespace adstar::adstard {

class BridgeCare {
 public:
  /// `bridge` runs. `now_ns` is monotonic, here and below.
  BridgeCare(BridgeProcess& bridge, const runtime::MappedSegment& segment, std::int64_t now_ns)
      : bridge_(bridge), segment_(segment) {
    pulse_.begin(segment_->bridge_rounds.load(), now_ns);
  }

  /// Every few milliseconds.
  void look(std::int64_t now_ns) {
    const bool alive = bridge_.alive();
    if (!alive && was_alive_) {
      spdlog::warn("the bridge {}; the tick goes on, the bridge is started again", bridge_.how());
    }
    was_alive_ = alive;
    if (!alive) {
      segment_.restore_header();
      was_alive_ = bridge_.restart_when_due(now_ns);
      pulse_.begin(segment_->bridge_rounds.load(), now_ns);
    } else if (pulse_.silent(segment_->bridge_rounds.load(), now_ns)) {
      constexpr std::int64_t kSecond = 1'000'000'000;
      spdlog::warn("the bridge has done nothing for {} and is killed",
                   scene::format_duration(pulse_.silent_ns() / kSecond * kSecond));
      bridge_.kill_now();
      pulse_.begin(segment_->bridge_rounds.load(), now_ns);
    }
  }

 private:
  BridgeProcess& bridge_;
  const runtime::MappedSegment& segment_;
  BridgePulse pulse_;
  bool was_alive_ = true;
};

}  // namespace adstar::adstard
