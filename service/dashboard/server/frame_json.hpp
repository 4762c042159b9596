#pragma once
// What the board holds, as the JSON that the page reads. Numbers have the digits of a double;
// what is not known is null. Keys carry frame and unit.

#include <cstdint>
#include <string>
#include <string_view>

#include "service/dashboard/server/board.hpp"

namespace adstar::dashboard {

/// One moment: every service with its timing, the spacecraft that is watched (null: not heard), the
/// verdicts after number `after_verdict`.
///   {"watched": "sat1", "spacecraft": {...}, "actuators": [...], "services": [...], "verdicts": [...]}
std::string frame_json(const Board& board, std::string_view watched, std::uint64_t after_verdict,
                       Clock::time_point now);

/// Every spacecraft, as columns of equal length; at most `kMostListed`, "spacecraft" says of how
/// many.
///   {"spacecraft": 10000, "name": [...], "service": [...], "time_s": [...], ...}
std::string fleet_json(const Board& board);
inline constexpr std::size_t kMostListed = 20'000;

/// "applied", ...; "unknown" for what this program does not know.
const char* verdict_word(adstar_Verdict verdict);

}  // namespace adstar::dashboard
