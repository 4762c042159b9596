#include "service/trade/front.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace adstar::trade {

void mark_front(std::vector<Measured>& points) {
  std::vector<std::size_t> by_cost(points.size());
  std::iota(by_cost.begin(), by_cost.end(), std::size_t{0});
  std::stable_sort(by_cost.begin(), by_cost.end(), [&](std::size_t a, std::size_t b) {
    return points[a].cost.median_us < points[b].cost.median_us;
  });
  double closest = std::numeric_limits<double>::infinity();
  for (const std::size_t i : by_cost) {
    points[i].on_front = points[i].errors.resolved && points[i].errors.attitude_rad < closest;
    if (points[i].on_front) {
      closest = points[i].errors.attitude_rad;
    }
  }
}

std::optional<std::size_t> cheapest(const std::vector<Measured>& points, double accuracy_rad,
                                    std::optional<double> budget_us) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Measured& point = points[i];
    const bool good = point.errors.resolved && point.errors.attitude_rad <= accuracy_rad &&
                      (!budget_us || point.step_cost_us() <= *budget_us);
    if (good && (!best || point.cost.median_us < points[*best].cost.median_us)) {
      best = i;
    }
  }
  return best;
}

}  // namespace adstar::trade
