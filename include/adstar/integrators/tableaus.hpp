#pragma once
// Explicit Butcher tableaus in exact fractions; dop853.hpp has the one that is not rational.

#include "adstar/integrators/constants.hpp"

namespace adstar {

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

/// Fifth order on six stages (Dormand and Prince 1980, RK5(4)7M); the seventh, of the error estimate
/// alone, is left out.
struct Dopri5 {
  static constexpr int kStages = 6;
  static constexpr int kOrder = 5;
  static constexpr Fraction a[kStages][kStages] = {
      {},
      {{1, 5}},
      {{3, 40}, {9, 40}},
      {{44, 45}, {-56, 15}, {32, 9}},
      {{19372, 6561}, {-25360, 2187}, {64448, 6561}, {-212, 729}},
      {{9017, 3168}, {-355, 33}, {46732, 5247}, {49, 176}, {-5103, 18656}}};
  static constexpr Fraction b[kStages] = {{35, 384},  {0, 1},        {500, 1113},
                                          {125, 192}, {-2187, 6784}, {11, 84}};
  static constexpr Fraction c[kStages] = {{0, 1}, {1, 5}, {3, 10}, {4, 5}, {8, 9}, {1, 1}};
};

/// Sixth order (Verner 1978, the eight stages of DVERK); its sixth stage serves the error estimate
/// alone and is left out: seven remain, the fewest that sixth order can have (Butcher 1964).
struct Verner6 {
  static constexpr int kStages = 7;
  static constexpr int kOrder = 6;
  static constexpr Fraction a[kStages][kStages] = {
      {},
      {{1, 6}},
      {{4, 75}, {16, 75}},
      {{5, 6}, {-8, 3}, {5, 2}},
      {{-165, 64}, {55, 6}, {-425, 64}, {85, 96}},
      {{-8263, 15000}, {124, 75}, {-643, 680}, {-81, 250}, {2484, 10625}},
      {{3501, 1720}, {-300, 43}, {297275, 52632}, {-319, 2322}, {24068, 84065}, {3850, 26703}}};
  static constexpr Fraction b[kStages] = {{3, 40},     {0, 1},       {875, 2244}, {23, 72},
                                          {264, 1955}, {125, 11592}, {43, 616}};
  static constexpr Fraction c[kStages] = {{0, 1}, {1, 6}, {4, 15}, {2, 3}, {5, 6}, {1, 15}, {1, 1}};
};

/// Eighth order (Fehlberg 1968, NASA TR R-287, RK7(8), the higher of its two formulas); the
/// eleventh of its thirteen stages serves the lower one alone and is left out.
struct Fehlberg8 {
  static constexpr int kStages = 12;
  static constexpr int kOrder = 8;
  static constexpr Fraction a[kStages][kStages] = {
      {},
      {{2, 27}},
      {{1, 36}, {1, 12}},
      {{1, 24}, {0, 1}, {1, 8}},
      {{5, 12}, {0, 1}, {-25, 16}, {25, 16}},
      {{1, 20}, {0, 1}, {0, 1}, {1, 4}, {1, 5}},
      {{-25, 108}, {0, 1}, {0, 1}, {125, 108}, {-65, 27}, {125, 54}},
      {{31, 300}, {0, 1}, {0, 1}, {0, 1}, {61, 225}, {-2, 9}, {13, 900}},
      {{2, 1}, {0, 1}, {0, 1}, {-53, 6}, {704, 45}, {-107, 9}, {67, 90}, {3, 1}},
      {{-91, 108}, {0, 1}, {0, 1}, {23, 108}, {-976, 135}, {311, 54}, {-19, 60}, {17, 6}, {-1, 12}},
      {{3, 205}, {0, 1}, {0, 1}, {0, 1}, {0, 1}, {-6, 41}, {-3, 205}, {-3, 41}, {3, 41}, {6, 41}},
      {{-1777, 4100},
       {0, 1},
       {0, 1},
       {-341, 164},
       {4496, 1025},
       {-289, 82},
       {2193, 4100},
       {51, 82},
       {33, 164},
       {12, 41},
       {1, 1}}};
  static constexpr Fraction b[kStages] = {{0, 1},   {0, 1},    {0, 1},    {0, 1},
                                          {0, 1},   {34, 105}, {9, 35},   {9, 35},
                                          {9, 280}, {9, 280},  {41, 840}, {41, 840}};
  static constexpr Fraction c[kStages] = {{0, 1}, {2, 27}, {1, 9}, {1, 6}, {5, 12}, {1, 2},
                                          {5, 6}, {1, 6},  {2, 3}, {1, 3}, {0, 1},  {1, 1}};
};

/// The largest Σ_j |a_ij|. Up to 1 no stage can turn further than the step at its fastest; past it a
/// stage may overshoot, since its weights cancel only as far as its slopes agree.
template <class Tableau>
constexpr double stage_overshoot() {
  double reach = 0;
  for (const auto& row : Tableau::a) {
    double sum = 0;
    for (const auto& entry : row) {
      const double value = entry.template as<double>();
      sum += value < 0 ? -value : value;
    }
    reach = sum > reach ? sum : reach;
  }
  return reach;
}

}  // namespace adstar
