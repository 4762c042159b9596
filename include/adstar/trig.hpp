#pragma once
// Sine, cosine and arc tangent of our own: the same bits on every machine and instruction set, which no libm
// promises.
//
// double: |x| reduced to |r| ≤ π/4 by Cody and Waite (1980) with π/2 in four parts (26 bits each,
// so that n·part is exact for n < 2^27), then Taylor series. Error below 1.5 ulp of the larger of
// sine and cosine (tests/unit/trig_test.cpp). Beyond |x| = 1e8 the argument first goes through fmod
// (exact in IEEE 754) with the double nearest 2π: relative error of the argument 4e-17, less than
// half its own last place. Other scalars use their own library (by argument-dependent lookup).

#include <cmath>
#include <type_traits>

namespace adstar {

template <class T>
struct SinCos {
  T sin, cos;
  friend bool operator==(const SinCos&, const SinCos&) = default;
};

namespace detail {

/// sin and cos for |r| ≤ π/4.
inline SinCos<double> sincos_reduced(double r) {
  const double s = r * r;
  // r - r³/3! + r⁵/5! ...;  1 - s/2 + s²/4! ...: the leading terms last, so that they round once.
  constexpr double k3 = -1.0 / 6, k5 = 1.0 / 120, k7 = -1.0 / 5040, k9 = 1.0 / 362880;
  constexpr double k11 = -1.0 / 39916800, k13 = 1.0 / 6227020800.0, k15 = -1.0 / 1307674368000.0;
  constexpr double k17 = 1.0 / 355687428096000.0;
  constexpr double c4 = 1.0 / 24, c6 = -1.0 / 720, c8 = 1.0 / 40320, c10 = -1.0 / 3628800;
  constexpr double c12 = 1.0 / 479001600, c14 = -1.0 / 87178291200.0, c16 = 1.0 / 20922789888000.0;
  const double sine_tail =
      k3 + s * (k5 + s * (k7 + s * (k9 + s * (k11 + s * (k13 + s * (k15 + s * k17))))));
  const double cosine_tail = c4 + s * (c6 + s * (c8 + s * (c10 + s * (c12 + s * (c14 + s * c16)))));
  return {r + r * (s * sine_tail), 1.0 - (0.5 * s - (s * s) * cosine_tail)};
}

}  // namespace detail

inline SinCos<double> sincos(double x) {
  constexpr double kTwoPi = 0x1.921fb54442d18p+2;
  if (!(std::fabs(x) <= 1e8)) {
    x = std::fmod(x, kTwoPi);  // NaN for infinities and NaN, as the callers' checks expect
    if (!(std::fabs(x) <= kTwoPi)) {
      return {x, x};
    }
  }
  constexpr double kTwoOverPi = 0x1.45f306dc9c883p-1;
  constexpr double kPart1 = 0x1.921fb5p+0, kPart2 = 0x1.110b46p-26;
  constexpr double kPart3 = 0x1.1a6263p-54, kPart4 = 0x1.8a2e03707344ap-81;
  const double n = std::floor(x * kTwoOverPi + 0.5);
  const double r = ((x - n * kPart1) - n * kPart2) - n * kPart3 - n * kPart4;
  const SinCos<double> a = detail::sincos_reduced(r);
  switch (static_cast<long long>(n) & 3) {
    case 0:
      return {a.sin, a.cos};
    case 1:
      return {a.cos, -a.sin};
    case 2:
      return {-a.sin, -a.cos};
    default:
      return {-a.cos, a.sin};
  }
}

/// Arc tangent, error below 1.5 ulp (tests/unit/double_double_test.cpp): x beyond 1 by atan x = π/2 - atan 1/x,
/// then atan x = atan c + atan((x - c)/(1 + x c)) with c the nearest eighth, and Taylor for |t| ≤ 1/16.
inline double atan(double x) {
  constexpr double kAtan[] = {0x0.0p+0,
                              0x1.fd5ba9aac2f6ep-4,
                              0x1.f5b75f92c80ddp-3,
                              0x1.6f61941e4def1p-2,
                              0x1.dac670561bb4fp-2,
                              0x1.1e00babdefeb4p-1,
                              0x1.4978fa3269ee1p-1,
                              0x1.700a7c5784634p-1,
                              0x1.921fb54442d18p-1};
  constexpr double kHalfPi = 0x1.921fb54442d18p+0, kHalfPiRest = 0x1.1a62633145c07p-54;
  if (std::isnan(x)) {
    return x;
  }
  const double magnitude = std::fabs(x);
  const bool beyond = magnitude > 1;
  const double y = beyond ? 1 / magnitude : magnitude;
  const int eighths = static_cast<int>(8 * y + 0.5);
  const double c = 0.125 * eighths;
  const double t = eighths == 0 ? y : (y - c) / (1 + y * c);
  const double s = t * t;
  constexpr double k3 = -1.0 / 3, k5 = 1.0 / 5, k7 = -1.0 / 7, k9 = 1.0 / 9, k11 = -1.0 / 11;
  constexpr double k13 = 1.0 / 13;
  const double tail = k3 + s * (k5 + s * (k7 + s * (k9 + s * (k11 + s * k13))));
  double angle = kAtan[eighths] + (t + t * (s * tail));
  if (beyond) {
    angle = kHalfPi - (angle - kHalfPiRest);
  }
  return x < 0 ? -angle : angle;
}

template <class T>
requires(!std::is_same_v<T, double>) SinCos<T> sincos(const T& x) {
  using std::cos;
  using std::sin;
  return {sin(x), cos(x)};
}

}  // namespace adstar
