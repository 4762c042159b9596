#pragma once
// A long series for a plot, thinned while it comes: of each stretch of x the least and the greatest y stay, so that no
// peak is lost, and memory does not grow with the points.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "service/plot/plot.hpp"

namespace adstar::cli {

class Thinned {
 public:
  /// For x from `first` to `last`.
  Thinned(double first, double last, std::size_t stretches)
      : first_(first), per_x_(last > first ? static_cast<double>(stretches) / (last - first) : 0) {}

  /// In rising x.
  void add(const plot::Point& point) {
    const double number = std::floor((point.x - first_) * per_x_);
    if (!newest_) {
      keep(points_, point);
    }
    if (number != stretch_.number) {
      keep(points_, stretch_);
      stretch_ = {.number = number, .least = {}, .most = {}, .gap = {}};
    }
    if (!std::isfinite(point.y)) {
      stretch_.gap = point;
    } else {
      if (!stretch_.least || point.y < stretch_.least->y) {
        stretch_.least = point;
      }
      if (!stretch_.most || point.y > stretch_.most->y) {
        stretch_.most = point;
      }
    }
    newest_ = point;
  }

  /// Of each stretch the least, the greatest and one that is not finite, if there is any; and the first and the last of all.
  std::vector<plot::Point> points() const {
    std::vector<plot::Point> points = points_;
    keep(points, stretch_);
    if (newest_) {
      keep(points, *newest_);
    }
    return points;
  }

 private:
  struct Stretch {
    double number = 0;
    std::optional<plot::Point> least, most, gap;
  };

  /// Once.
  static void keep(std::vector<plot::Point>& points, const plot::Point& point) {
    if (points.empty() || point.x > points.back().x) {
      points.push_back(point);
    }
  }
  static void keep(std::vector<plot::Point>& points, const Stretch& stretch) {
    std::array all{stretch.least, stretch.most, stretch.gap};
    std::sort(all.begin(), all.end(),
              [](const auto& a, const auto& b) { return a && b ? a->x < b->x : !a && b; });
    for (const auto& point : all) {
      if (point) {
        keep(points, *point);
      }
    }
  }

  double first_, per_x_;
  std::vector<plot::Point> points_;
  Stretch stretch_;
  std::optional<plot::Point> newest_;
};

}  // namespace adstar::cli
