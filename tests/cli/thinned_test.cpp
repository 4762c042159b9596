#include "service/adstar/thinned.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace adstar::cli {
namespace {

constexpr std::size_t kStretches = 100;

bool has(const std::vector<plot::Point>& points, double x) {
  return std::any_of(points.begin(), points.end(),
                     [&](const plot::Point& point) { return point.x == x; });
}

TEST(Thinned, keeps_every_peak_and_both_ends_of_a_long_series_in_order) {
  constexpr int kLast = 100'000;
  Thinned series(0, kLast, kStretches);
  for (int x = 0; x <= kLast; ++x) {
    series.add({static_cast<double>(x), x == 54'321 ? 9 : x == 54'322 ? -9 : std::sin(x)});
  }
  const std::vector<plot::Point> points = series.points();
  EXPECT_LE(points.size(), 2 * kStretches + 2);
  for (const double x : {0.0, 54'321.0, 54'322.0, double{kLast}}) {
    EXPECT_TRUE(has(points, x)) << x;
  }
  for (std::size_t i = 1; i < points.size(); ++i) {
    EXPECT_LT(points[i - 1].x, points[i].x);
  }
}

TEST(Thinned, keeps_all_of_a_short_series) {
  Thinned series(10, 60, kStretches);
  for (int x = 10; x <= 60; ++x) {
    series.add({static_cast<double>(x), 1});
  }
  EXPECT_EQ(series.points().size(), 51U);
  Thinned one(3, 3, kStretches);
  EXPECT_TRUE(one.points().empty());
  one.add({3, 1});
  EXPECT_EQ(one.points().size(), 1U);
}

TEST(Thinned, shows_a_gap_where_a_value_is_not_finite_and_no_more_of_them_than_stretches) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Thinned series(0, 10'000, kStretches);
  for (int x = 0; x <= 10'000; ++x) {
    series.add({static_cast<double>(x), x > 5'000 && x % 2 == 1 ? nan : x});
  }
  const std::vector<plot::Point> points = series.points();
  EXPECT_LE(points.size(), 3 * kStretches + 2);
  const auto gaps = std::count_if(points.begin(), points.end(),
                                  [](const plot::Point& point) { return std::isnan(point.y); });
  EXPECT_EQ(gaps, 50);
  EXPECT_TRUE(has(points, 10'000));
}

}  // namespace
}  // namespace adstar::cli
