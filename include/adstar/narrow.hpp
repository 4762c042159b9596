#pragma once
// Between the scalar of a state and that of stages which need not be so wide: float for double; for
// lanes of double, two registers of them, one of float (batch/narrow_lanes.hpp). Narrowing rounds to
// nearest (IEEE 754), widening is exact. Any other scalar stays what it is: 113 bits tell the order of
// the formulas.

#include "adstar/vec3.hpp"

namespace adstar {

/// How many T side by side make one narrow number, and how.
template <class T>
struct Narrower {
  using type = T;
  static constexpr int kParts = 1;
  static const T& narrow(const T& x) { return x; }
  template <int>
  static const T& widen(const T& x) {
    return x;
  }
};

template <>
struct Narrower<double> {
  using type = float;
  static constexpr int kParts = 1;
  [[gnu::always_inline]] static float narrow(double x) { return static_cast<float>(x); }
  template <int>
  [[gnu::always_inline]] static double widen(float x) {
    return static_cast<double>(x);
  }
};

template <class T>
using NarrowOf = typename Narrower<T>::type;

template <class T, class... More>
[[gnu::always_inline]] inline Vec3<NarrowOf<T>> narrow(const Vec3<T>& v,
                                                       const Vec3<More>&... more) {
  using To = Narrower<T>;
  return {To::narrow(v.x, more.x...), To::narrow(v.y, more.y...), To::narrow(v.z, more.z...)};
}

template <class T, int kPart>
[[gnu::always_inline]] inline Vec3<T> widen(const Vec3<NarrowOf<T>>& v) {
  using From = Narrower<T>;
  return {From::template widen<kPart>(v.x), From::template widen<kPart>(v.y),
          From::template widen<kPart>(v.z)};
}

}  // namespace adstar
