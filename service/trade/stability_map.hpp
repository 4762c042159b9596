#pragma once
// Every scheme at the extremes: one step from many starts (extremes.hpp), judged by the truth.
//
// The truth of a start is sought only where some scheme did not report it: what all report may turn by
// a million radians.

#include <array>
#include <string>
#include <vector>

#include "service/trade/extremes.hpp"
#include "service/trade/truth.hpp"

namespace adstar::trade {

/// From best to worst.
enum class Standing { exact, accurate, bounded, reported, wrong };
inline constexpr std::array<const char*, 5> kStandings = {"exact", "accurate", "bounded",
                                                          "reported", "wrong"};

/// Attitude error of one step that turns by up to `turn_rad`:
///   reported  a step said that it could not follow the motion, whatever it did
///   exact     at most 1e-14 (1 + turn) rad: round-off
///   accurate  at most 1e-3 of the turn, nor above 0.1 rad
///   bounded   at most 0.1 rad: coarse, and what --accuracy would refuse
///   wrong     more, and nobody said so
Standing judge(double error_rad, double turn_rad, bool reported);

/// What a step can be reported by.
enum class Detector { turn, light_axis, separatrix, damping, attitude, edges };
inline constexpr std::array<const char*, 6> kDetectors = {"turn",    "light_axis", "separatrix",
                                                          "damping", "attitude",   "edges"};

struct MapCell {
  std::string scheme;
  std::string column;
  std::array<int, kStandings.size()> counts{};     ///< starts, by standing
  std::array<int, kDetectors.size()> detectors{};  ///< of the reported; one start may have several
  double worst_rad = 0;                            ///< of those that were not reported
  std::string worst_case;                          ///< body, start and load of that

  int starts() const;  ///< none where all have a torque and the scheme knows none
  int reported() const { return counts[static_cast<std::size_t>(Standing::reported)]; }
  /// Of the starts that were not reported; reported when all were.
  Standing worst() const;
};

struct Chart {
  std::string title, x_label;
  std::vector<std::string> columns;
  std::vector<MapCell> cells;  ///< by scheme, then by column
};

struct StabilityMap {
  std::vector<std::string> schemes;
  std::vector<Chart> charts;
  double uncertainty_rad = 0;  ///< of the worst truth
};

/// Throws Interrupted when `progress` returns false.
StabilityMap map_stability(const std::vector<std::string>& schemes,
                           const std::vector<Extremity>& extremes, const Progress& progress);

std::string table(const StabilityMap& map);
std::string json(const StabilityMap& map);
std::string picture(const StabilityMap& map);

}  // namespace adstar::trade
