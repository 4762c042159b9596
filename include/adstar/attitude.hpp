#pragma once
// Unit quaternions q_IB (Hamilton), mapping body vectors to inertial: v_I = q_IB v_B q_IB*.

#include <cmath>

#include <Eigen/Geometry>

#include "adstar/vec3.hpp"

namespace adstar {

template <class T>
struct Quat {
  T w{1}, x{}, y{}, z{};
  friend bool operator==(const Quat&, const Quat&) = default;
};

/// Hamilton product: rotate(p * q, v) = rotate(p, rotate(q, v)).
template <class T>
constexpr Quat<T> operator*(const Quat<T>& p, const Quat<T>& q) {
  return {(p.w * q.w - p.x * q.x) - (p.y * q.y + p.z * q.z),  //
          (p.w * q.x + p.x * q.w) + (p.y * q.z - p.z * q.y),  //
          (p.w * q.y - p.x * q.z) + (p.y * q.w + p.z * q.x),  //
          (p.w * q.z + p.x * q.y) - (p.y * q.x - p.z * q.w)};
}

template <class T>
constexpr T squared_norm(const Quat<T>& q) {
  return (q.w * q.w + q.x * q.x) + (q.y * q.y + q.z * q.z);
}

/// v_I = R_IB v_B:  v + w t + u×t with t = u×2v.
template <class T>
[[gnu::always_inline]] constexpr Vec3<T> rotate(const Quat<T>& q, const Vec3<T>& v) {
  const Vec3<T> u{q.x, q.y, q.z};
  const Vec3<T> t = cross(u, T(2) * v);
  return v + (q.w * t + cross(u, t));
}

/// v_B = R_IBᵀ v_I.
template <class T>
[[gnu::always_inline]] constexpr Vec3<T> rotate_inverse(const Quat<T>& q, const Vec3<T>& v) {
  const Vec3<T> u{q.x, q.y, q.z};
  const Vec3<T> t = cross(u, T(2) * v);
  return v + (cross(u, t) - q.w * t);
}

/// One Newton step of 1/√|q|²: exact to round-off for the |q|² = 1 + O(1e-8) that a product of unit
/// quaternions has.
template <class T>
constexpr Quat<T> renormalised(const Quat<T>& q) {
  const T scale = T(1.5) - T(0.5) * squared_norm(q);
  return {scale * q.w, scale * q.x, scale * q.y, scale * q.z};
}

/// rotate_inverse(renormalised(q), v), the length put in last, so that nothing waits for it. Without,
/// a |q|² off by a rounding bends the result, not only stretches it.
template <class T>
[[gnu::always_inline]] constexpr Vec3<T> rotate_inverse_exactly(const Quat<T>& q,
                                                                const Vec3<T>& v) {
  const Vec3<T> u{q.x, q.y, q.z};
  const Vec3<T> t = cross(u, v);
  const T two_over_squared_norm = T(4) - T(2) * squared_norm(q);
  return v + two_over_squared_norm * (cross(u, t) - q.w * t);
}

/// A rotation by its unit quaternion (1 + u, v): u is small where the angle is, and keeps its digits.
template <class T>
struct Turn {
  T u{};
  Vec3<T> v;
};

/// renormalised(q) * (1 + u, v), written as q plus what is small: one rounding of q. That of the
/// product has a bias, a drift of 1e-19 to 1e-18 a step in the energy of a free body (measured over
/// 1e7 steps); this one walks at random.
template <class T>
[[gnu::always_inline]] constexpr Quat<T> turned(const Quat<T>& q, const Turn<T>& turn) {
  const T e = turn.u + T(0.5) * (T(1) - squared_norm(q));
  const Vec3<T>& v = turn.v;
  return {q.w + ((q.w * e - q.x * v.x) - (q.y * v.y + q.z * v.z)),
          q.x + ((q.x * e + q.w * v.x) + (q.y * v.z - q.z * v.y)),
          q.y + ((q.y * e + q.w * v.y) + (q.z * v.x - q.x * v.z)),
          q.z + ((q.z * e + q.w * v.z) + (q.x * v.y - q.y * v.x))};
}

/// For input of any length but zero, without overflow or underflow.
template <class T>
Quat<T> normalised(const Quat<T>& q) {
  using std::abs;
  using std::max;
  using std::sqrt;
  const T largest = max(max(abs(q.w), abs(q.x)), max(abs(q.y), abs(q.z)));
  const Quat<T> p{q.w / largest, q.x / largest, q.y / largest, q.z / largest};
  const T n = sqrt(squared_norm(p));
  return {p.w / n, p.x / n, p.y / n, p.z / n};
}

/// Angle of the rotation that takes `a` to `b` [rad], 0 to π; q and -q are the same attitude.
template <class T>
T angle_between(const Quat<T>& a, const Quat<T>& b) {
  using std::abs;
  using std::atan2;
  const Quat<T> d = Quat<T>{a.w, -a.x, -a.y, -a.z} * b;
  return T(2) * atan2(norm(Vec3<T>{d.x, d.y, d.z}), abs(d.w));
}

template <class T>
Eigen::Quaternion<T> to_eigen(const Quat<T>& q) {
  return {q.w, q.x, q.y, q.z};
}
template <class T>
Quat<T> from_eigen(const Eigen::Quaternion<T>& q) {
  return {q.w(), q.x(), q.y(), q.z()};
}

}  // namespace adstar
