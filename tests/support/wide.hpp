#pragma once
// Arithmetic to judge by: 113 bits to run the library in, 100 digits to tell the truth in.

#include <limits>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>
#ifdef ADSTAR_HAS_FLOAT128
#include <boost/multiprecision/float128.hpp>
#endif

#include "adstar/attitude.hpp"
#include "adstar/vec3.hpp"

namespace adstar::test {

#ifdef ADSTAR_HAS_FLOAT128  // compiles in a sixth of the other's time
using Quad = boost::multiprecision::float128;
#else
using Quad = boost::multiprecision::cpp_bin_float_quad;
#endif
/// Digits enough that a closed form loses 60 of them at θ = 1e-12 and still judges 113 bits.
using Wide = boost::multiprecision::cpp_bin_float_100;

template <class T>
Wide wide(const T& x) {
  return Wide(x);
}
inline Wide wide(const Quad& x) { return x.convert_to<Wide>(); }
inline const Wide& wide(const Wide& x) { return x; }

template <class To, class From>
To narrow(const From& x) {
  return static_cast<To>(x);
}

template <class T>
double to_double(const T& x) {
  return static_cast<double>(x);
}

template <class To, class From>
Vec3<To> convert(const Vec3<From>& v) {
  return {static_cast<To>(v.x), static_cast<To>(v.y), static_cast<To>(v.z)};
}
template <class To, class From>
Quat<To> convert(const Quat<From>& q) {
  return {static_cast<To>(q.w), static_cast<To>(q.x), static_cast<To>(q.y), static_cast<To>(q.z)};
}

inline constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// Distance to the next double above |x|.
inline double ulp(double x) {
  const double a = std::fabs(x);
  return std::nextafter(a, std::numeric_limits<double>::infinity()) - a;
}

}  // namespace adstar::test
