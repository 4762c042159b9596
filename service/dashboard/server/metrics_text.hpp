#pragma once
// What the board holds, as Prometheus reads it (text exposition format 0.0.4).

#include <string>

#include "service/dashboard/server/board.hpp"

namespace adstar::dashboard {

/// Counters are the daemon's own since the start of its run; verdicts are those heard since the
/// dashboard began. Spacecraft in metrics of their own are those with topics of their own, at most
/// `kMostMeasured`: a fleet of 10,000 does not belong into labels.
std::string metrics_text(const Board& board, Clock::time_point now);
inline constexpr std::size_t kMostMeasured = 64;

}  // namespace adstar::dashboard
