#pragma once
// How the Earth turns under a spacecraft: from I (celestial) to E (terrestrial, fixed to the ground).
//
//   v_E = R_EI(t) v_I,   R_EI(t) = R_3(theta_0 + omega t) Q
// Q is constant over a run: what precession, nutation and the frame bias make of the pole at the scene's epoch (the
// celestial-to-intermediate matrix of the IERS Conventions 2010, section 5.4), theta the Earth rotation angle, omega its
// rate, 2π · 1.00273781191135448 a day (eq. 5.15). Left out: polar motion (10 m on the ground), the drift of Q within a run
// (0.05″ a day) and of UT1 against the clock (ms a day).

#include "adstar/trig.hpp"
#include "adstar/vec3.hpp"

namespace adstar {

/// Earth rotation rate [rad/s] (IERS Conventions 2010, eq. 5.15).
inline constexpr double kEarthRotation_rad_s = 7.292115146706979e-5;

/// Of WGS 84: equatorial radius [m], flattening, and the radius at the poles [m].
inline constexpr double kEarthRadius_m = 6378137.0;
inline constexpr double kEarthFlattening = 1 / 298.257223563;
inline constexpr double kEarthPolarRadius_m = kEarthRadius_m * (1 - kEarthFlattening);

/// R_EI at one instant.
template <class T>
struct EarthFrame {
  Vec3<T> x, y, z;  ///< axes of E in I: rows of R_EI

  Vec3<T> to_terrestrial(const Vec3<T>& v_I) const {
    return {dot(x, v_I), dot(y, v_I), dot(z, v_I)};
  }
  Vec3<T> to_inertial(const Vec3<T>& v_E) const { return v_E.x * x + (v_E.y * y + v_E.z * z); }
};

/// As it stands, I's x axis is above the zero meridian at t = 0, and I's z axis is the pole.
template <class T>
struct EarthRotation {
  /// Rows of Q, of a rotation: the axes of the intermediate frame in I; the last is the pole.
  Vec3<T> Q_x{T(1), T(0), T(0)}, Q_y{T(0), T(1), T(0)}, Q_z{T(0), T(0), T(1)};
  T angle_rad{};  ///< theta_0, at t = 0
  T rate_rad_s = T(kEarthRotation_rad_s);

  const Vec3<T>& pole_I() const { return Q_z; }
  /// Of E relative to I [rad/s].
  Vec3<T> omega_I() const { return rate_rad_s * Q_z; }

  EarthFrame<T> at(const T& t_s) const {
    const SinCos<T> s = sincos(angle_rad + rate_rad_s * t_s);
    return {s.cos * Q_x + s.sin * Q_y, s.cos * Q_y - s.sin * Q_x, Q_z};
  }
  friend bool operator==(const EarthRotation&, const EarthRotation&) = default;
};

}  // namespace adstar
