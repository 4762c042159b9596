#pragma once
// Coefficients of schemes, so that every scalar gets its own rounding of them.

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

/// high + low: the double nearest to the constant and the double nearest to what is left, 106 bits.
struct LongConstant {
  double high = 0, low = 0;

  template <class T>
  constexpr T as() const {
    return T(high) + T(low);
  }
  constexpr bool is_zero() const { return high == 0; }
};

}  // namespace adstar
