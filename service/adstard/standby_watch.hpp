#pragma once
// What the main thread says of primary and standby, and when one of them is to end.

#include <cstdint>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "service/runtime/shared_segment.hpp"

namespace adstar::adstard {

class StandbyWatch {
 public:
  explicit StandbyWatch(const runtime::SharedSegment& segment) : link_(segment.standby) {}

  /// Says once that this daemon has taken over. Nothing as long as it may go on.
  std::optional<std::string> why_to_end() {
    if (link_.lost_track.load() != 0) {
      return "this standby has lost track of its primary; start it again";
    }
    if (!said_ && link_.take_over.load() != 0) {
      said_ = true;
      spdlog::warn("the primary is gone: this daemon flies in its place, in term {}",
                   link_.term.load());
    }
    if (const std::uint64_t term = link_.outranked_by.load(); term != 0) {
      return fmt::format(
          "another daemon took over in term {}, while this one, of term {}, was not heard; it "
          "flies "
          "on, start this one as its --standby",
          term, link_.term.load());
    }
    return std::nullopt;
  }

 private:
  const runtime::StandbyLink& link_;
  bool said_ = false;
};

}  // namespace adstar::adstard
