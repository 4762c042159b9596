#pragma once
// Every scheme at the extremes: one step from many starts, judged by the truth.
//
// A cell is a scheme and a turn |omega| h; in it stand bodies from needle to disc and chipsat to
// station, spinning about each axis, on the separatrix, beside it and at random, free, under constant
// torques weak and strong, and under an impulse shorter than the step. (The thinnest needle, and turns
// beyond 5 rad, free only: their forced truth takes minutes.)

#include <array>
#include <string>
#include <vector>

#include "service/trade/truth.hpp"

namespace adstar::trade {

/// From best to worst.
enum class Standing { exact, accurate, bounded, reported, wrong };
inline constexpr std::array<const char*, 5> kStandings = {"exact", "accurate", "bounded",
                                                          "reported", "wrong"};

/// Attitude error of one step that turns by up to `turn_rad`:
///   reported  a step said that it could not follow the motion, whatever it did
///   exact     at most 1e-14 (1 + turn) rad: round-off
///   accurate  at most 1e-3 of the turn
///   bounded   at most 0.1 rad: coarse, and what --accuracy would refuse
///   wrong     more, and nobody said so
Standing judge(double error_rad, double turn_rad, bool reported);

struct MapCell {
  std::string scheme;
  double turn_rad = 0;
  std::array<int, kStandings.size()> counts{};  ///< starts, by standing
  double worst_rad = 0;                         ///< of those that were not reported
  std::string worst_case;                       ///< body, start and load of that
  /// Of the starts that were not reported; reported when all were.
  Standing worst() const;
  int starts() const;
  int reported() const { return counts[static_cast<std::size_t>(Standing::reported)]; }
};

struct StabilityMap {
  std::vector<double> turns_rad;
  std::vector<std::string> schemes;
  std::vector<MapCell> cells;  ///< by scheme, then by turn
};

/// Throws Interrupted when `progress` returns false.
StabilityMap map_stability(const std::vector<std::string>& schemes,
                           const std::vector<double>& turns_rad, const Progress& progress);

/// 1e-12 to 20 rad.
std::vector<double> default_turns();

std::string table(const StabilityMap& map);
std::string json(const StabilityMap& map);
std::string picture(const StabilityMap& map);

}  // namespace adstar::trade
