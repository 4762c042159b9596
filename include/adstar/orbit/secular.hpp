#pragma once
// A Kepler ellipse that the Earth's flattening turns: the secular drift by J2 of node, periapsis and mean anomaly.
//
//   p = a(1 - e²),  n = √(μ/a³),  k = ¾ J2 (R/p)² n
//   Ω' = -2k cos i,   ω' = k (4 - 5 sin² i),   M' = n + k √(1 - e²) (2 - 3 sin² i)
// (Kaula, Theory of Satellite Geodesy, 1966, eq. 3.74; Vallado, Fundamentals of Astrodynamics and Applications, 4th ed.,
// section 9.6). The elements are mean elements and I's z axis is the axis of the flattening. Left out: what J2 does
// within a revolution (some km in a low orbit), all other harmonics, the air, the Sun and the Moon.

#include <cmath>

#include "adstar/orbit/kepler.hpp"

namespace adstar {

/// J2 and equatorial radius of the Earth that it is scaled by (EGM96; Vallado, 4th ed., table D-1 and section 9.6).
inline constexpr double kEarthJ2 = 1.08262668e-3;
inline constexpr double kEarthEquator_m = 6378136.3;

/// Classical elements at t = 0, and how fast three of them drift.
template <class T>
struct SecularOrbit {
  OrbitElements<T> at_start;
  T node_rate_rad_s{};       ///< Ω'
  T periapsis_rate_rad_s{};  ///< ω'
  T anomaly_rate_rad_s{};    ///< M'
  SinCos<T> tilt;            ///< of the inclination
  friend bool operator==(const SecularOrbit&, const SecularOrbit&) = default;
};

/// Without J2 the ellipse stands still: make_orbit()'s.
template <class T>
SecularOrbit<T> make_secular_orbit(const OrbitElements<T>& e, const T& J2 = T(kEarthJ2),
                                   const T& equator_m = T(kEarthEquator_m)) {
  using std::sqrt;
  SecularOrbit<T> orbit;
  orbit.at_start = e;
  orbit.tilt = sincos(e.inclination_rad);
  const T rest = T(1) - e.eccentricity * e.eccentricity;
  const T ratio = equator_m / (e.semi_major_axis_m * rest);
  const T n = sqrt(e.gravity_m3_s2 / e.semi_major_axis_m) / e.semi_major_axis_m;
  const T k = T(0.75) * J2 * ratio * ratio * n;
  const T sine2 = orbit.tilt.sin * orbit.tilt.sin;
  orbit.node_rate_rad_s = -(T(2) * k * orbit.tilt.cos);
  orbit.periapsis_rate_rad_s = k * (T(4) - T(5) * sine2);
  orbit.anomaly_rate_rad_s = n + k * sqrt(rest) * (T(2) - T(3) * sine2);
  return orbit;
}

namespace detail {

/// The ellipse that the orbit runs on at t, with M and n of that moment as its M_0 and n: ask it for t = 0.
template <class T>
KeplerOrbit<T> ellipse_at(const SecularOrbit<T>& orbit, const T& t_s) {
  const OrbitElements<T>& e = orbit.at_start;
  const SinCos<T> node = sincos(e.right_ascension_rad + orbit.node_rate_rad_s * t_s);
  const SinCos<T> turn = sincos(e.argument_of_periapsis_rad + orbit.periapsis_rate_rad_s * t_s);
  const SinCos<T>& tilt = orbit.tilt;
  return {e.semi_major_axis_m,
          e.eccentricity,
          orbit.anomaly_rate_rad_s,
          e.mean_anomaly_rad + orbit.anomaly_rate_rad_s * t_s,
          e.gravity_m3_s2,
          {node.cos * turn.cos - node.sin * tilt.cos * turn.sin,
           node.sin * turn.cos + node.cos * tilt.cos * turn.sin, tilt.sin * turn.sin},
          {-(node.cos * turn.sin) - node.sin * tilt.cos * turn.cos,
           node.cos * tilt.cos * turn.cos - node.sin * turn.sin, tilt.sin * turn.cos}};
}

}  // namespace detail

template <class T>
OrbitPosition<T> position_at(const SecularOrbit<T>& orbit, const T& t_s) {
  return position_at(detail::ellipse_at(orbit, t_s), T(0));
}

/// The velocity is the derivative of the position, the drift in it:
///   v_I = M' ∂r/∂M + (Ω' z + ω' W) × r,   W = P × Q
template <class T>
OrbitMotion<T> motion_at(const SecularOrbit<T>& orbit, const T& t_s) {
  const KeplerOrbit<T> now = detail::ellipse_at(orbit, t_s);
  OrbitMotion<T> motion = motion_at(now, T(0));
  const Vec3<T> drift =
      Vec3<T>{T(0), T(0), orbit.node_rate_rad_s} + orbit.periapsis_rate_rad_s * cross(now.P, now.Q);
  motion.v_I = motion.v_I + cross(drift, motion.r_I);
  return motion;
}

}  // namespace adstar
