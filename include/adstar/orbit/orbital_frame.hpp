#pragma once
// The orbital frame O that an attitude near the Earth is told against, and how far one attitude is from another.
//
//   z_O = -r/|r| to the nadir,   y_O = -(r × v)/|r × v| against the orbit's normal,   x_O = y_O × z_O, roughly forward
// (Hughes, Spacecraft Attitude Dynamics, 1986, chapter 9; Wertz, Spacecraft Attitude Determination and Control, 1978,
// section 2.2: roll, pitch and yaw turn about x, y and z of it).

#include <algorithm>
#include <cmath>
#include <variant>

#include "adstar/arc.hpp"
#include "adstar/attitude.hpp"
#include "adstar/orbit/orbit.hpp"
#include "adstar/vec3.hpp"

namespace adstar {

template <class T>
struct OrbitalFrame {
  Quat<T> q_IO;     ///< O to I, unit
  Vec3<T> omega_O;  ///< of O relative to I, in O [rad/s]
};

/// The unit quaternion of a rotation by its columns, of its four components the largest by a root
/// (Shepperd 1978, Journal of Guidance and Control 1, p. 223).
template <class T>
Quat<T> quaternion_from_columns(const Vec3<T>& x, const Vec3<T>& y, const Vec3<T>& z) {
  const T trace = x.x + y.y + z.z;
  Quat<T> q;
  if (trace >= x.x && trace >= y.y && trace >= z.z) {
    q = {T(1) + trace, y.z - z.y, z.x - x.z, x.y - y.x};
  } else if (x.x >= y.y && x.x >= z.z) {
    q = {y.z - z.y, T(1) + x.x - y.y - z.z, x.y + y.x, x.z + z.x};
  } else if (y.y >= z.z) {
    q = {z.x - x.z, x.y + y.x, T(1) + y.y - x.x - z.z, y.z + z.y};
  } else {
    q = {x.y - y.x, x.z + z.x, y.z + z.y, T(1) + z.z - x.x - y.y};
  }
  return normalised(q);
}

/// omega_O = (0, -|r × v|/r², 0), which is all of it where the force points to the centre (fixed and Kepler orbits);
/// orbital_frame_at() has the rest. At rest or straight up there is no forward: O's y axis is then square to r and I's z, or I's x.
template <class T>
OrbitalFrame<T> orbital_frame(const OrbitMotion<T>& motion) {
  const T distance = norm(motion.r_I);
  const Vec3<T> up = (T(1) / distance) * motion.r_I;
  const Vec3<T> area = cross(motion.r_I, motion.v_I);
  const T twice_area = norm(area);
  Vec3<T> normal;
  if (twice_area > T(0)) {
    normal = (T(1) / twice_area) * area;
  } else {
    const bool polar = up.z * up.z > T(0.99);
    const Vec3<T> across = cross(up, polar ? Vec3<T>{T(1), T(0), T(0)} : Vec3<T>{T(0), T(0), T(1)});
    normal = (T(-1) / norm(across)) * across;
  }
  const Vec3<T> y = -normal, z = -up;
  return {quaternion_from_columns(cross(y, z), y, z),
          {T(0), -(twice_area / distance / distance), T(0)}};
}

namespace detail {

/// v' [m/s²] by a difference over 2 s, or over what the span leaves of it.
template <class T>
Vec3<T> acceleration_at(const Orbit<T>& orbit, const T& t_s) {
  using std::max;
  using std::min;
  const auto [first_s, last_s] = span_s(orbit);
  const T begin = max(first_s, T(t_s - T(1))), end = min(last_s, T(t_s + T(1)));
  return end > begin
             ? (T(1) / (end - begin)) * (motion_at(orbit, end).v_I - motion_at(orbit, begin).v_I)
             : Vec3<T>{};
}

}  // namespace detail

/// O of an orbit at t. A force that does not point to the centre turns the orbit's plane, and O about r:
///   omega_O = (0, -|h|/r², -(r/|h|) (v'·h/|h|)),   h = r × v
/// (of v' = f r the last component is 0; J2: up to 2 |Ω'| sin i, some 1e-6 rad/s in a low orbit).
template <class T>
OrbitalFrame<T> orbital_frame_at(const Orbit<T>& orbit, const T& t_s) {
  const OrbitMotion<T> motion = motion_at(orbit, t_s);
  OrbitalFrame<T> frame = orbital_frame(motion);
  const Vec3<T> h = cross(motion.r_I, motion.v_I);
  const T h2 = squared_norm(h);
  const bool central = std::holds_alternative<KeplerOrbit<T>>(orbit) ||
                       std::holds_alternative<FixedPosition<T>>(orbit);
  if (!central && h2 > T(0)) {
    frame.omega_O.z = -(norm(motion.r_I) * dot(detail::acceleration_at(orbit, t_s), h) / h2);
  }
  return frame;
}

/// phi with R_to = R_from exp(phi), |phi| ≤ π [rad]: in the frame of `from` and in that of `to` alike. Quaternions of
/// any length but zero. Its length is the pointing error; digits of a small one are those of the quaternions.
template <class T>
Vec3<T> rotation_vector(const Quat<T>& from, const Quat<T>& to) {
  const Quat<T> d = Quat<T>{from.w, -from.x, -from.y, -from.z} * to;
  const Vec3<T> v = d.w < T(0) ? Vec3<T>{-d.x, -d.y, -d.z} : Vec3<T>{d.x, d.y, d.z};
  const T sine = norm(v), cosine = d.w < T(0) ? -d.w : d.w;
  if (sine == T(0)) {
    return {};
  }
  return (T(2) * arc_of(cosine, sine) / sine) * v;
}

}  // namespace adstar
