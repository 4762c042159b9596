#include "service/trade/stability_map.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

#include "adstar/integrators/all.hpp"
#include "service/runtime/fleet.hpp"
#include "service/trade/step_truth.hpp"

namespace adstar::trade {
namespace {

constexpr double kRoundOff = 1e-14, kAccurate = 1e-3, kBounded = 0.1;

/// Adds a start's flags to the detectors that spoke.
void add_detectors(MapCell& cell, std::uint32_t flags) {
  using namespace runtime;
  const auto spoke = [&](Detector detector) {
    ++cell.detectors[static_cast<std::size_t>(detector)];
  };
  constexpr std::uint32_t kWhy = kFlagLightAxis | kFlagSeparatrix | kFlagAttitudeLost;
  if ((flags & kFlagUnresolvedAngle) != 0 && (flags & kWhy) == 0) {
    spoke(Detector::turn);
  }
  if ((flags & kFlagLightAxis) != 0) {
    spoke(Detector::light_axis);
  }
  if ((flags & kFlagSeparatrix) != 0) {
    spoke(Detector::separatrix);
  }
  if ((flags & kFlagUnresolvedDamping) != 0) {
    spoke(Detector::damping);
  }
  if ((flags & kFlagAttitudeLost) != 0) {
    spoke(Detector::attitude);
  }
  if ((flags & kFlagUnresolvedEdges) != 0) {
    spoke(Detector::edges);
  }
}

/// One start under every scheme, in its column of the chart.
class Trial {
 public:
  Trial(const Extreme& extreme, double& uncertainty_rad)
      : extreme_(extreme), uncertainty_rad_(uncertainty_rad) {}

  void run(MapCell& cell) {
    runtime::Fleet fleet({extreme_.craft}, cell.scheme, StepLimits{});
    const bool reported = fleet.step(0, kExtremeStepNs) > 0;
    const runtime::Vehicle& vehicle = fleet.vehicles().front();
    if (reported) {
      ++cell.counts[static_cast<std::size_t>(Standing::reported)];
      add_detectors(cell, vehicle.flags);
      return;
    }
    const Quat<double>& q = vehicle.state.q_IB;
    const auto error =
        static_cast<double>(angle_between(truth(), normalised(Quat<Wide>{q.w, q.x, q.y, q.z})));
    ++cell.counts[static_cast<std::size_t>(judge(error, extreme_.turn_rad, false))];
    if (!(error <= cell.worst_rad)) {
      cell.worst_rad = error;
      cell.worst_case = extreme_.name;
    }
  }

 private:
  const Quat<Wide>& truth() {
    if (!truth_) {
      const double goal = 0.1 * kRoundOff * (1 + extreme_.turn_rad);
      const StepTruth found = find_step_truth(extreme_.craft, kExtremeStepNs, goal);
      truth_ = found.q_IB;
      if (!(found.uncertainty_rad <= uncertainty_rad_)) {
        uncertainty_rad_ = found.uncertainty_rad;
      }
    }
    return *truth_;
  }

  const Extreme& extreme_;
  double& uncertainty_rad_;
  std::optional<Quat<Wide>> truth_;
};

}  // namespace

Standing judge(double error_rad, double turn_rad, bool reported) {
  if (reported) {
    return Standing::reported;
  }
  if (error_rad <= kRoundOff * (1 + turn_rad)) {
    return Standing::exact;
  }
  if (error_rad <= std::min(kAccurate * turn_rad, kBounded)) {
    return Standing::accurate;
  }
  return error_rad <= kBounded ? Standing::bounded : Standing::wrong;  // NaN is wrong
}

Standing MapCell::worst() const {
  for (const Standing standing : {Standing::wrong, Standing::bounded, Standing::accurate}) {
    if (counts[static_cast<std::size_t>(standing)] > 0) {
      return standing;
    }
  }
  return reported() > 0 && reported() == starts() ? Standing::reported : Standing::exact;
}

int MapCell::starts() const { return std::accumulate(counts.begin(), counts.end(), 0); }

StabilityMap map_stability(const std::vector<std::string>& schemes,
                           const std::vector<Extremity>& extremes, const Progress& progress) {
  StabilityMap map{schemes, {}, 0};
  double all = 0, done = 0;
  for (const Extremity& extremity : extremes) {
    for (const Extremes& column : extremity.columns) {
      all += static_cast<double>(column.starts.size());
    }
  }
  for (const Extremity& extremity : extremes) {
    Chart chart{extremity.title, extremity.x_label, {}, {}};
    for (const Extremes& column : extremity.columns) {
      chart.columns.push_back(column.name);
    }
    for (const std::string& scheme : schemes) {
      for (const std::string& column : chart.columns) {
        chart.cells.push_back({scheme, column, {}, {}, 0, {}});
      }
    }
    for (std::size_t column = 0; column < chart.columns.size(); ++column) {
      for (const Extreme& extreme : extremity.columns[column].starts) {
        if (!progress(done++ / all)) {
          throw Interrupted{};
        }
        Trial trial(extreme, map.uncertainty_rad);
        for (std::size_t row = 0; row < schemes.size(); ++row) {
          if (extreme.craft.torques.empty() || !claims_of(schemes[row]).free_only) {
            trial.run(chart.cells[row * chart.columns.size() + column]);
          }
        }
      }
    }
    map.charts.push_back(std::move(chart));
  }
  return map;
}

}  // namespace adstar::trade
