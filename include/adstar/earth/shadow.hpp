#pragma once
// How much of the Sun a spacecraft sees past the Earth: 1 in the light, 0 in the umbra.
//
// cylinder: the Sun infinitely far; dark where r·s < 0 and |r - (r·s) s| < R. A jump at the edge: a step that holds it loses its order.
// cone: the Sun a disc of half-angle a, the Earth one of b, c between their centres; between b - a and b + a the part that
// is covered is A/(πa²),
//   A = a² arccos(x/a) + b² arccos((c - x)/b) - c y,   x = (c² + a² - b²)/(2c),   y = √(a² - x²)
// (Montenbruck and Gill, Satellite Orbits, 2000, section 3.4.2). Continuous, with kinks where the penumbra begins and ends.
// The Earth is a sphere of its equatorial radius, without air: it lengthens the shadow by some seconds near the poles.

#include <cmath>
#include <cstdint>

#include "adstar/arc.hpp"
#include "adstar/earth/rotation.hpp"
#include "adstar/earth/sun.hpp"
#include "adstar/orbit/kepler.hpp"

namespace adstar {

enum class Shadow : std::uint8_t { none, cylinder, cone };

/// [m] (IAU 2015 resolution B3).
inline constexpr double kSunRadius_m = 6.957e8;

template <class T>
T light_behind_cylinder(const OrbitPosition<T>& at, const Vec3<T>& sun_I) {
  const T along = dot(at.direction_I, sun_I);
  if (!(along < T(0))) {
    return T(1);
  }
  const T ratio = T(kEarthRadius_m) / at.distance_m;
  const Vec3<T> across = cross(at.direction_I, sun_I);
  return squared_norm(across) < ratio * ratio ? T(0) : T(1);
}

/// The covered part of a disc of radius a by one of b, c between their centres: of angles as of lengths in a plane.
template <class T>
T covered_part(const T& a, const T& b, const T& c) {
  using std::sqrt;
  if (c >= a + b) {
    return T(0);
  }
  if (c <= b - a) {
    return T(1);
  }
  if (c <= a - b) {
    return b * b / (a * a);
  }
  const T x = (c * c + a * a - b * b) / (T(2) * c);
  const T rest = (a - x) * (a + x);
  const T y = rest > T(0) ? T(sqrt(rest)) : T(0);
  const T area = a * a * arc_cosine(T(x / a)) + b * b * arc_cosine(T((c - x) / b)) - c * y;
  return area / (half_turn<T>() * a * a);
}

template <class T>
T light_behind_cone(const OrbitPosition<T>& at, const SunPosition<T>& sun) {
  const Vec3<T> r = at.distance_m * at.direction_I;
  const Vec3<T> to_sun = (sun.distance_au * T(kAstronomicalUnit_m)) * sun.direction_I - r;
  const T distance = norm(to_sun);
  const Vec3<T> s = (T(1) / distance) * to_sun;
  const T along = -dot(at.direction_I, s);  // cos c
  const T sine_b = T(kEarthRadius_m) / at.distance_m;
  if (along <= T(0) && sine_b < T(0.9999)) {
    return T(1);  // above the dayside
  }
  const T a = arc_sine(T(T(kSunRadius_m) / distance)), b = arc_sine(sine_b);
  return T(1) - covered_part(a, b, arc_of(along, T(norm(cross(at.direction_I, s)))));
}

/// 0 to 1.
template <class T>
T light_at(Shadow shadow, const OrbitPosition<T>& at, const SunPosition<T>& sun) {
  switch (shadow) {
    case Shadow::cylinder:
      return light_behind_cylinder(at, sun.direction_I);
    case Shadow::cone:
      return light_behind_cone(at, sun);
    default:
      return T(1);
  }
}

}  // namespace adstar
