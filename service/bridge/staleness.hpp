#pragma once
// What waited in a socket while this process, or the one that wrote it, stood still is nobody's wish
// any more. It is not answered: who still means it repeats it with a stamp of now.

#include <cstdint>
#include <string_view>
#include <time.h>

#include <dds/dds.h>
#include <spdlog/spdlog.h>

#include "service/dds/rate_limit.hpp"

namespace adstar::bridge {

inline std::int64_t clock_ns(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return now.tv_sec * 1'000'000'000 + now.tv_nsec;
}

/// Says so in the log, now and then. `what`: "a command for 'sat1'".
template <class What>
bool is_stale(const dds_sample_info_t& info, What&& what) {
  constexpr std::int64_t kMostAge_ns = 2'000'000'000;
  const std::int64_t age_ns = clock_ns(CLOCK_REALTIME) - info.source_timestamp;
  if (age_ns <= kMostAge_ns) {
    return false;
  }
  static dds::RateLimit limit(1);
  if (limit.admit()) {
    spdlog::warn(
        "ignored {} that was written {:.1f} s ago by its stamp; if it was sent just now, set the "
        "clocks of the two machines",
        what(), static_cast<double>(age_ns) * 1e-9);
  }
  return true;
}

}  // namespace adstar::bridge
