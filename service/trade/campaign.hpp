#pragma once
// A scene's spacecraft over schemes and steps: truth once, then every point.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "service/scene/scene.hpp"
#include "service/trade/measure.hpp"
#include "service/trade/truth.hpp"

namespace adstar::trade {

struct Campaign {
  std::int64_t horizon_ns = 0;
  std::vector<std::string> schemes;    ///< by name
  std::vector<std::int64_t> steps_ns;  ///< descending; each divides the distance of the instants
  /// A scheme is not refined further once it is this close; nothing: down to round-off.
  std::optional<double> accuracy_rad;
  Effort effort;
};

struct Trade {
  std::int64_t horizon_ns = 0;
  std::string truth;             ///< how the reference was had
  double uncertainty_rad = 0;    ///< of the reference
  std::vector<Measured> points;  ///< by scheme, then by falling step
};

/// Schemes that the scene can be run with: no free-only scheme when a spacecraft names a torque.
std::vector<std::string> usable_schemes(const scene::Scene& scene);

/// Throws Interrupted when `progress` returns false.
Trade run(const scene::Scene& scene, const Campaign& campaign, const Progress& progress);

}  // namespace adstar::trade
