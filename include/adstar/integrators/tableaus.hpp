#pragma once
// Explicit Butcher tableaus, as exact fractions so that every scalar gets its own rounding of them.

#include <cstdint>

namespace adstar {

struct Fraction {
  std::int64_t numerator = 0;
  std::int64_t denominator = 1;

  template <class T>
  constexpr T as() const {
    return T(numerator) / T(denominator);
  }
  constexpr bool is_zero() const { return numerator == 0; }
};

/// The explicit midpoint rule (Runge 1895).
struct Midpoint2 {
  static constexpr int kStages = 2;
  static constexpr int kOrder = 2;
  static constexpr Fraction a[kStages][kStages] = {{}, {{1, 2}}};
  static constexpr Fraction b[kStages] = {{0, 1}, {1, 1}};
  static constexpr Fraction c[kStages] = {{0, 1}, {1, 2}};
};

/// The classical fourth-order method (Kutta 1901).
struct Rk4 {
  static constexpr int kStages = 4;
  static constexpr int kOrder = 4;
  static constexpr Fraction a[kStages][kStages] = {
      {}, {{1, 2}}, {{0, 1}, {1, 2}}, {{0, 1}, {0, 1}, {1, 1}}};
  static constexpr Fraction b[kStages] = {{1, 6}, {1, 3}, {1, 3}, {1, 6}};
  static constexpr Fraction c[kStages] = {{0, 1}, {1, 2}, {1, 2}, {1, 1}};
};

/// The largest Σ_j |a_ij|, at least 1: how far, in steps, a stage may reach.
template <class Tableau>
constexpr double stage_reach() {
  double reach = 1;
  for (const auto& row : Tableau::a) {
    double sum = 0;
    for (const Fraction& entry : row) {
      const double value = entry.as<double>();
      sum += value < 0 ? -value : value;
    }
    reach = sum > reach ? sum : reach;
  }
  return reach;
}

}  // namespace adstar
