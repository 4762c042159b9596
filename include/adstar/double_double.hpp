#pragma once
// Twice the digits of double from pairs of doubles: hi + lo, |lo| at most half an ulp of hi. For the
// few quantities of a closed form that a long time multiplies.
//
// Sum: Knuth (1969). Product: Dekker (1971) with Veltkamp's splitting, since a fused multiply-add
// is not on every machine and its bits are. Relative errors below 2⁻¹⁰⁰ (Joldes, Muller, Popescu
// 2017 prove 3·2⁻¹⁰⁶ to 15·2⁻¹⁰⁶ for these sequences). Products must stay within 1e-250 and 1e290:
// scale first.

#include <cmath>
#include <limits>

#include "adstar/trig.hpp"

namespace adstar {

struct DoubleDouble {
  double hi = 0, lo = 0;

  constexpr DoubleDouble() = default;
  constexpr explicit DoubleDouble(double x) : hi(x) {}
  constexpr DoubleDouble(double h, double l) : hi(h), lo(l) {}
  constexpr explicit operator double() const { return hi + lo; }
  friend constexpr bool operator==(const DoubleDouble&, const DoubleDouble&) = default;
};

namespace detail {

/// a + b exactly, |a| ≥ |b|.
constexpr DoubleDouble quick_two_sum(double a, double b) {
  const double s = a + b;
  return {s, b - (s - a)};
}

/// a + b exactly.
constexpr DoubleDouble two_sum(double a, double b) {
  const double s = a + b;
  const double seen = s - a;
  return {s, (a - (s - seen)) + (b - seen)};
}

/// a b exactly.
constexpr DoubleDouble two_product(double a, double b) {
  constexpr double kSplit = 134217729.0;  // 2²⁷ + 1
  const double p = a * b;
  const double ta = kSplit * a, tb = kSplit * b;
  const double a1 = ta - (ta - a), b1 = tb - (tb - b);
  const double a2 = a - a1, b2 = b - b1;
  return {p, ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2};
}

}  // namespace detail

constexpr DoubleDouble operator-(const DoubleDouble& a) { return {-a.hi, -a.lo}; }

constexpr DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble s = detail::two_sum(a.hi, b.hi), t = detail::two_sum(a.lo, b.lo);
  const DoubleDouble v = detail::quick_two_sum(s.hi, s.lo + t.hi);
  return detail::quick_two_sum(v.hi, t.lo + v.lo);
}
constexpr DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + (-b); }

constexpr DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble p = detail::two_product(a.hi, b.hi);
  return detail::quick_two_sum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}
constexpr DoubleDouble operator*(const DoubleDouble& a, double b) {
  const DoubleDouble p = detail::two_product(a.hi, b);
  return detail::quick_two_sum(p.hi, p.lo + a.lo * b);
}
constexpr DoubleDouble operator*(double a, const DoubleDouble& b) { return b * a; }

constexpr DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
  const double q = a.hi / b.hi;
  const DoubleDouble r = a - b * q;
  return detail::quick_two_sum(q, (r.hi + r.lo) / b.hi);
}

/// One Newton step from the double root.
inline DoubleDouble sqrt(const DoubleDouble& a) {
  if (!(a.hi > 0)) {
    return DoubleDouble(a.hi == 0 ? 0 : std::numeric_limits<double>::quiet_NaN());
  }
  const double s = std::sqrt(a.hi);
  const DoubleDouble r = a - detail::two_product(s, s);
  return detail::quick_two_sum(s, (r.hi + r.lo) / (2 * s));
}

constexpr DoubleDouble abs(const DoubleDouble& a) { return a.hi < 0 ? -a : a; }
constexpr bool operator<(const DoubleDouble& a, const DoubleDouble& b) {
  return a.hi < b.hi || (a.hi == b.hi && a.lo < b.lo);
}
constexpr bool operator>(const DoubleDouble& a, const DoubleDouble& b) { return b < a; }
constexpr bool operator<=(const DoubleDouble& a, const DoubleDouble& b) { return a < b || a == b; }

/// Sine and cosine of hi + lo, rounded to double: x less the nearest multiple of π/2, with π/2 in
/// 106 bits, so that |x| up to 1e15 still has its phase to 1e-16.
inline SinCos<double> sincos(const DoubleDouble& x) {
  constexpr DoubleDouble kHalfPi{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};
  constexpr double kTwoOverPi = 0x1.45f306dc9c883p-1;
  DoubleDouble r = x;
  double quarters = 0;
  if (!(std::fabs(x.hi) <= 0.75)) {
    if (!(std::fabs(x.hi) <= 1e15)) {
      const double none = std::numeric_limits<double>::quiet_NaN();
      return {none, none};
    }
    quarters = std::floor(x.hi * kTwoOverPi + 0.5);
    r = x - kHalfPi * quarters;
  }
  const SinCos<double> a = detail::sincos_reduced(r.hi);
  const double sine = a.sin + r.lo * a.cos, cosine = a.cos - r.lo * a.sin;
  switch (static_cast<long long>(quarters) & 3) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

}  // namespace adstar
