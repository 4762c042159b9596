#pragma once
// Where a spacecraft is on a Kepler ellipse about a point mass, in I: the orbit that torques of the
// surroundings ask for, propagated apart from the attitude.
//
//   M = M_0 + n t,  n = √(μ/a³),   E - e sin E = M            (Kepler 1609)
//   r_I = a (cos E - e) P + a √(1 - e²) sin E Q
// P points to the periapsis and Q is 90° ahead of it in the plane of the orbit (Vallado, Fundamentals of
// Astrodynamics and Applications, 4th ed., sections 2.2 and 2.6).

#include <cmath>

#include "adstar/torques/frame.hpp"
#include "adstar/trig.hpp"
#include "adstar/vec3.hpp"

namespace adstar {

/// μ of the Earth [m³/s²] (IERS Conventions 2010, table 1.1; TCG-compatible).
inline constexpr double kEarthGravity_m3_s2 = 3.986004418e14;

/// Classical elements at t = 0; angles in rad.
template <class T>
struct OrbitElements {
  T semi_major_axis_m{};
  T eccentricity{};  ///< 0 to below 1
  T inclination_rad{};
  T right_ascension_rad{};  ///< of the ascending node
  T argument_of_periapsis_rad{};
  T mean_anomaly_rad{};
  T gravity_m3_s2 = T(kEarthGravity_m3_s2);
  friend bool operator==(const OrbitElements&, const OrbitElements&) = default;
};

template <class T>
struct KeplerOrbit {
  T semi_major_axis_m{};
  T eccentricity{};
  T mean_motion_rad_s{};
  T mean_anomaly_rad{};  ///< at t = 0
  T gravity_m3_s2{};
  Vec3<T> P, Q;  ///< unit, in I
  friend bool operator==(const KeplerOrbit&, const KeplerOrbit&) = default;
};

template <class T>
KeplerOrbit<T> make_orbit(const OrbitElements<T>& e) {
  using std::sqrt;
  const SinCos<T> node = sincos(e.right_ascension_rad), tilt = sincos(e.inclination_rad),
                  turn = sincos(e.argument_of_periapsis_rad);
  KeplerOrbit<T> orbit;
  orbit.semi_major_axis_m = e.semi_major_axis_m;
  orbit.eccentricity = e.eccentricity;
  orbit.gravity_m3_s2 = e.gravity_m3_s2;
  orbit.mean_anomaly_rad = e.mean_anomaly_rad;
  orbit.mean_motion_rad_s = sqrt(e.gravity_m3_s2 / e.semi_major_axis_m) / e.semi_major_axis_m;
  orbit.P = {node.cos * turn.cos - node.sin * tilt.cos * turn.sin,
             node.sin * turn.cos + node.cos * tilt.cos * turn.sin, tilt.sin * turn.sin};
  orbit.Q = {-(node.cos * turn.sin) - node.sin * tilt.cos * turn.cos,
             node.cos * tilt.cos * turn.cos - node.sin * turn.sin, tilt.sin * turn.cos};
  return orbit;
}

/// E of M by Newton's method from M + e sin M (e above 0.8: from π with the sign of M), at most twelve steps;
/// it converges in three to five below e = 0.8.
template <class T>
T eccentric_anomaly(const T& M, const T& e) {
  using std::abs;
  const T pi = T(3.14159265358979323846L);
  // Within a turn, so that far out the digits are those of M.
  using std::floor;
  const T whole = (pi + pi) * floor((M + pi) / (pi + pi));
  const T m = M - whole;
  T E = e > T(0.8) ? (m < T(0) ? -pi : pi) : m + e * sincos(m).sin;
  for (int i = 0; i < 12; ++i) {
    const SinCos<T> s = sincos(E);
    const T step = (E - e * s.sin - m) / (T(1) - e * s.cos);
    E = E - step;
    if (abs(step) <= T(1e-9)) {  // the next step would be its square
      break;
    }
  }
  return E;
}

/// Unit vector to the spacecraft in I, and its distance [m].
template <class T>
struct OrbitPosition {
  Vec3<T> direction_I;
  T distance_m{};
  friend bool operator==(const OrbitPosition&, const OrbitPosition&) = default;
};

template <class T>
OrbitPosition<T> position_at(const KeplerOrbit<T>& orbit, const T& t_s) {
  using std::sqrt;
  const T M = orbit.mean_anomaly_rad + orbit.mean_motion_rad_s * t_s;
  const T& e = orbit.eccentricity;
  if (e == T(0)) {
    const SinCos<T> s = sincos(M);
    return {s.cos * orbit.P + s.sin * orbit.Q, orbit.semi_major_axis_m};
  }
  const SinCos<T> s = sincos(eccentric_anomaly(M, e));
  const T over = T(1) / (T(1) - e * s.cos);  // a/r
  return {(over * (s.cos - e)) * orbit.P + (over * sqrt(T(1) - e * e) * s.sin) * orbit.Q,
          orbit.semi_major_axis_m * (T(1) - e * s.cos)};
}

/// Position [m] and velocity [m/s] about the centre of attraction, in I.
template <class T>
struct OrbitMotion {
  Vec3<T> r_I, v_I;
};

/// v_I = n a/(1 - e cos E) (√(1 - e²) cos E Q - sin E P): the derivative of r_I (Vallado, 4th ed., section 2.2).
template <class T>
OrbitMotion<T> motion_at(const KeplerOrbit<T>& orbit, const T& t_s) {
  using std::sqrt;
  const T M = orbit.mean_anomaly_rad + orbit.mean_motion_rad_s * t_s;
  const T &e = orbit.eccentricity, &a = orbit.semi_major_axis_m;
  const SinCos<T> s = sincos(e == T(0) ? M : eccentric_anomaly(M, e));
  const T minor = sqrt(T(1) - e * e);
  const T speed = orbit.mean_motion_rad_s * a / (T(1) - e * s.cos);
  return {(a * (s.cos - e)) * orbit.P + (a * minor * s.sin) * orbit.Q,
          (speed * minor * s.cos) * orbit.Q - (speed * s.sin) * orbit.P};
}

}  // namespace adstar
