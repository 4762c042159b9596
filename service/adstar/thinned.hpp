#pragma once
// Long series for a plot: of each stretch of points the least and the greatest stay, so that no peak is lost.

#include <algorithm>
#include <cstddef>
#include <vector>

#include "service/plot/plot.hpp"

namespace adstar::cli {

/// At most 2·`stretches` + 1 points, in their order; the first and the last among them.
inline std::vector<plot::Point> thinned(const std::vector<plot::Point>& points,
                                        std::size_t stretches) {
  if (points.size() <= 2 * stretches) {
    return points;
  }
  const auto by_y = [](const plot::Point& a, const plot::Point& b) { return a.y < b.y; };
  std::vector<plot::Point> kept{points.front()};
  for (std::size_t i = 0; i < stretches; ++i) {
    const auto at = [&](std::size_t n) {
      return points.begin() + static_cast<std::ptrdiff_t>(1 + n * (points.size() - 2) / stretches);
    };
    const auto [least, most] = std::minmax_element(at(i), at(i + 1), by_y);
    kept.push_back(*std::min(least, most));
    if (least != most) {
      kept.push_back(*std::max(least, most));
    }
  }
  if (kept.size() > 2 * stretches) {
    kept.pop_back();
  }
  kept.push_back(points.back());
  return kept;
}

}  // namespace adstar::cli
