#pragma once
// One sine without branches or libm, for torques that are asked at every stage: half the time of
// trig.hpp's pair, and the same bits everywhere.
//
// x = nπ + r, |r| ≤ π/2, by Cody and Waite (1980) with π in four parts (26 bits each, so that n·part
// is exact for n < 2^27); sin x = (-1)^n sin r, Taylor series in pairs (Estrin 1960). Absolute error
// below 4e-16 (tests/unit/trig_test.cpp). Beyond |x| = 1e8 as trig.hpp.

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "adstar/scalar.hpp"

namespace adstar {

namespace detail {

inline constexpr double kOverPi = 0x1.45f306dc9c883p-2;
/// What is added to it is rounded to a whole number; |x| < 2^51.
inline constexpr double kWholes = 0x1.8p52;

/// sin(x - nπ)
template <Binary64 T>
[[gnu::always_inline]] inline T sine_less_half_turns(const T& x, const T& n) {
  constexpr double kPart1 = 0x1.921fb5p+1, kPart2 = 0x1.110b46p-25;
  constexpr double kPart3 = 0x1.1a6263p-53, kPart4 = 0x1.8a2e03707344ap-80;
  const T r = ((x - n * kPart1) - n * kPart2) - n * kPart3 - n * kPart4;
  constexpr double k3 = -1.0 / 6, k5 = 1.0 / 120, k7 = -1.0 / 5040, k9 = 1.0 / 362880;
  constexpr double k11 = -1.0 / 39916800, k13 = 1.0 / 6227020800.0, k15 = -1.0 / 1307674368000.0;
  constexpr double k17 = 1.0 / 355687428096000.0, k19 = -1.0 / 121645100408832000.0;
  constexpr double k21 = 1.0 / 51090942171709440000.0;
  const T s = r * r, s2 = s * s, s4 = s2 * s2;
  const T low = (k3 + s * k5) + s2 * (k7 + s * k9);
  const T high = ((k11 + s * k13) + s2 * (k15 + s * k17)) + s4 * (k19 + s * k21);
  return r + r * (s * (low + s4 * high));
}

inline constexpr double kLargestReduced = 1e8;

/// |x| ≤ kLargestReduced
[[gnu::always_inline]] inline double reduced_sine(double x) {
  const double shifted = x * kOverPi + kWholes;
  const double y = sine_less_half_turns(x, shifted - kWholes);
  const std::uint64_t odd = std::bit_cast<std::uint64_t>(shifted) << 63U;
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(y) ^ odd);
}

}  // namespace detail

inline double sine(double x) {
  if (!(std::fabs(x) <= detail::kLargestReduced)) {
    constexpr double kTwoPi = 0x1.921fb54442d18p+2;
    x = std::fmod(x, kTwoPi);  // NaN for infinities and NaN
  }
  return detail::reduced_sine(x);
}

template <class T>
requires(!std::is_same_v<T, double>) T sine(const T& x) {
  using std::sin;
  return sin(x);
}

/// x[i] := sine(x[i]), the same bits, in a loop that the compiler makes lanes of.
template <std::size_t N>
[[gnu::always_inline]] inline void replace_by_sines(double (&x)[N]) {
  bool reducible = true;
  for (const double angle : x) {
    reducible = reducible & (std::fabs(angle) <= detail::kLargestReduced);
  }
  if (!reducible) [[unlikely]] {
    for (double& angle : x) {
      angle = sine(angle);
    }
    return;
  }
  for (double& angle : x) {
    angle = detail::reduced_sine(angle);
  }
}

template <class T, std::size_t N>
requires(!std::is_same_v<T, double>) void replace_by_sines(T (&x)[N]) {
  for (T& angle : x) {
    angle = sine(angle);
  }
}

}  // namespace adstar
