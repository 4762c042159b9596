#pragma once
// The exponential of our own: the same bits on every machine and instruction set, which no libm promises.
//
// x = n ln 2 + r, |r| ≤ ½ ln 2, with ln 2 in two parts (Cody and Waite 1980: the first of 32 bits, so that n·part is
// exact), Taylor series of e^r, and 2^n put into the exponent. double: error below 1.5 ulp, of subnormal results too
// (tests/unit/exponential_test.cpp). Beyond the range: 0 or infinity. Other scalars use their own library.

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace adstar {

namespace detail {

/// 2^n for n from -1022 to 1023.
constexpr double power_of_two(std::int64_t n) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(n + 1023) << 52U);
}

/// e^r for |r| ≤ ½ ln 2.
inline double exponential_reduced(double r) {
  constexpr double k2 = 1.0 / 2, k3 = 1.0 / 6, k4 = 1.0 / 24, k5 = 1.0 / 120, k6 = 1.0 / 720;
  constexpr double k7 = 1.0 / 5040, k8 = 1.0 / 40320, k9 = 1.0 / 362880, k10 = 1.0 / 3628800;
  constexpr double k11 = 1.0 / 39916800, k12 = 1.0 / 479001600, k13 = 1.0 / 6227020800.0;
  // In pairs (Estrin 1960); what is largest comes last, so that it rounds once.
  const double s = r * r, s2 = s * s;
  const double low = (k2 + r * k3) + s * (k4 + r * k5);
  const double high = (k6 + r * k7) + s * (k8 + r * k9);
  const double top = (k10 + r * k11) + s * (k12 + r * k13);
  return 1.0 + (r + s * (low + s2 * (high + s2 * top)));
}

}  // namespace detail

inline double exponential(double x) {
  constexpr double kOverflow = 0x1.62e42fefa39efp+9;    // the largest whose power is finite
  constexpr double kUnderflow = -0x1.74910d52d3051p+9;  // below it the power is nearer 0
  if (!(x <= kOverflow)) {
    return x > kOverflow ? std::numeric_limits<double>::infinity() : x;  // NaN stays
  }
  if (x < kUnderflow) {
    return 0.0;
  }
  constexpr double kOverLn2 = 0x1.71547652b82fep+0;
  constexpr double kPart1 = 0x1.62e42feep-1, kPart2 = 0x1.a39ef35793c76p-33;
  const double n = std::floor(x * kOverLn2 + 0.5);
  const double r = (x - n * kPart1) - n * kPart2;
  const double y = detail::exponential_reduced(r);
  const auto whole = static_cast<std::int64_t>(n);
  if (whole >= -1022 && whole <= 1023) {
    return y * detail::power_of_two(whole);
  }
  // The first factor is exact; the second rounds once, into the subnormals or up to the largest number.
  const std::int64_t first = whole / 2;
  return (y * detail::power_of_two(first)) * detail::power_of_two(whole - first);
}

template <class T>
requires(!std::is_same_v<T, double>) T exponential(const T& x) {
  using std::exp;
  return exp(x);
}

}  // namespace adstar
