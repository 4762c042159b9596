#pragma once
// Angles from their sines and cosines, for any scalar: over the arc tangent of trig.hpp for double, whose bits are our
// own.

#include <cmath>
#include <type_traits>

#include "adstar/trig.hpp"

namespace adstar {

template <class T>
T arc_tangent(const T& x) {
  if constexpr (std::is_same_v<T, double>) {
    return adstar::atan(x);
  } else {
    using std::atan;
    return atan(x);
  }
}

template <class T>
constexpr T half_turn() {
  if constexpr (std::is_same_v<T, double>) {
    return 0x1.921fb54442d18p+1;
  } else {
    return T(4) * arc_tangent(T(1));
  }
}

/// Of a cosine and a sine of one circle about 0, neither of them NaN: -π to π. (0, 0) gives 0.
template <class T>
T arc_of(const T& cosine, const T& sine) {
  using std::abs;
  if (abs(sine) <= abs(cosine)) {
    if (cosine == T(0)) {
      return T(0);
    }
    const T a = arc_tangent(sine / cosine);
    if (cosine > T(0)) {
      return a;
    }
    return sine < T(0) ? a - half_turn<T>() : a + half_turn<T>();
  }
  const T b = arc_tangent(cosine / sine);
  return sine > T(0) ? T(0.5) * half_turn<T>() - b : -(T(0.5) * half_turn<T>()) - b;
}

/// arcsin x of 0 ≤ x ≤ 1; a little beyond 1 counts as 1.
template <class T>
T arc_sine(const T& x) {
  using std::sqrt;
  const T rest = (T(1) - x) * (T(1) + x);
  return arc_of(rest > T(0) ? T(sqrt(rest)) : T(0), x);
}

/// arccos x of -1 ≤ x ≤ 1; a little beyond counts as the end.
template <class T>
T arc_cosine(const T& x) {
  using std::sqrt;
  const T rest = (T(1) - x) * (T(1) + x);
  return arc_of(x, rest > T(0) ? T(sqrt(rest)) : T(0));
}

}  // namespace adstar
