#include "service/trade/campaign.hpp"

#include <algorithm>

#include "adstar/gyrostat.hpp"
#include "adstar/integrators/all.hpp"
#include "service/trade/front.hpp"
#include "service/trade/grid.hpp"

namespace adstar::trade {
namespace {

int order_of(const std::string& name) {
  int order = 0;
  with_scheme(name, [&](auto scheme) { order = decltype(scheme)::kOrder; });
  return order;
}

/// Round-off has taken over: two refinements in a row that did not help.
class Floor {
 public:
  bool reached(double error) {
    stalled_ = error > 0.5 * best_ ? stalled_ + 1 : 0;
    best_ = std::min(best_, error);
    return stalled_ >= 2 && best_ < kSmall;
  }

 private:
  static constexpr double kSmall = 1e-9;
  double best_ = 1e300;
  int stalled_ = 0;
};

}  // namespace

std::vector<std::string> usable_schemes(const scene::Scene& scene) {
  const bool forced = scene::first_forced(scene.spacecraft) != nullptr;
  const bool wheels = scene::first_with_wheels(scene.spacecraft) != nullptr;
  const bool linked = scene::first_linked(scene.spacecraft) != nullptr;
  std::vector<std::string> names;
  for (const std::string_view name : scheme_names()) {
    if ((!forced || !claims_of(name).free_only) && (!wheels || carries_wheels(name)) &&
        (!linked || multibody::links_bodies(name))) {
      names.emplace_back(name);
    }
  }
  return names;
}

Trade run(const scene::Scene& scene, const Campaign& campaign, const Progress& progress) {
  // The reference takes about a tenth of the time, the schemes share the rest.
  constexpr double kTruthShare = 0.1;
  constexpr double kGoalRad = 1e-14;
  const Truth truth = find_truth(scene.spacecraft, instants_of(campaign.horizon_ns), kGoalRad,
                                 [&](double done) { return progress(kTruthShare * done); });
  Trade trade{campaign.horizon_ns, truth.how, truth.uncertainty_rad, {}};
  const auto all = static_cast<double>(campaign.schemes.size());
  for (std::size_t i = 0; i < campaign.schemes.size(); ++i) {
    const std::string& scheme = campaign.schemes[i];
    const double done = kTruthShare + (1 - kTruthShare) * static_cast<double>(i) / all;
    const auto here = [&](double) { return progress(done); };
    Floor floor;
    for (const std::int64_t step_ns : campaign.steps_ns) {
      Measured point{scheme, order_of(scheme), step_ns, {}, {}, false};
      const StepLimits& limits = scene.simulation.limits;
      point.errors = find_errors(scene.spacecraft, scheme, limits, step_ns, truth, here);
      point.cost = find_cost(scene.spacecraft, scheme, limits, step_ns, campaign.horizon_ns,
                             campaign.effort);
      trade.points.push_back(point);
      const bool enough = campaign.accuracy_rad && point.errors.resolved &&
                          point.errors.attitude_rad <= *campaign.accuracy_rad;
      if (enough || floor.reached(point.errors.attitude_rad)) {
        break;
      }
    }
  }
  mark_front(trade.points);
  return trade;
}

}  // namespace adstar::trade
