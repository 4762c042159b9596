#pragma once
// The free coordinates of a joint, their rates, and the wrench of what acts along them.
//
// revolute:  q = angle of x_G about z_F from x_F, q' = z_F·omega; the couple f z_F
// universal: G from F by Rot_x(q_1) Rot_y(q_2), q_1' = x_F·omega, q_2' = y_G·omega; the couple f_1 x_F + f_2 y_G
// prismatic: q = z_F·(c_b - c_a), q' = z_F·w; the force f z_F at c
// spherical: q the rotation vector of G from F (|q| ≤ π), in F. Its rates are omega in F, and along those act
//   motor and damper; spring and stops have a potential in q, so f becomes the couple dexpinv(q)ᵀ f, and a stop
//   sees q' = dexpinv(q, omega). At |q| = π q jumps to the other side: keep its springs away from there.

#include <array>
#include <cmath>
#include <limits>

#include "adstar/multibody/joint.hpp"
#include "adstar/so3.hpp"
#include "adstar/trig.hpp"

namespace adstar::multibody {
namespace detail {

inline double arc_tangent(double x) { return adstar::atan(x); }
template <class T>
T arc_tangent(const T& x) {
  using std::atan;
  return atan(x);
}

/// Twice the double nearest to π, in the scalar at hand.
template <class T>
T two_pi() {
  return T(8) * arc_tangent(T(1));
}

/// The angle of (cos, sin) [rad], -π to π.
template <class T>
T angle_of(const T& sine, const T& cosine) {
  using std::abs;
  if (abs(sine) <= abs(cosine)) {
    const T angle = arc_tangent(T(sine / cosine));
    const T half_turn = T(0.5) * two_pi<T>();
    return cosine > T(0) ? angle : sine < T(0) ? angle - half_turn : angle + half_turn;
  }
  const T quarter = T(0.25) * two_pi<T>();
  return (sine > T(0) ? quarter : -quarter) - arc_tangent(T(cosine / sine));
}

/// The rotation vector of a unit quaternion, |.| ≤ π [rad].
template <class T>
Vec3<T> rotation_vector(const Quat<T>& q) {
  using std::sqrt;
  const T sign = q.w < T(0) ? T(-1) : T(1);
  const Vec3<T> v = sign * Vec3<T>{q.x, q.y, q.z};
  const T n = sqrt(squared_norm(v));
  return (n > T(1e-150) ? T(2) * angle_of(n, sign * q.w) / n : T(2)) * v;
}

}  // namespace detail

/// In the order of the laws; of an angle, -π to π.
template <class T>
std::array<T, 3> joint_coordinates(JointKind kind, const JointMotion<T>& m) {
  switch (kind) {
    case JointKind::revolute:
      return {detail::angle_of(dot(m.x_G, m.y_F), dot(m.x_G, m.x_F)), T(0), T(0)};
    case JointKind::universal:
      return {detail::angle_of(dot(m.y_G, m.z_F), dot(m.y_G, m.y_F)),
              detail::angle_of(dot(m.z_G, m.x_F), dot(m.x_G, m.x_F)), T(0)};
    case JointKind::spherical: {
      const Vec3<T> q = detail::rotation_vector(m.q_FG);
      return {q.x, q.y, q.z};
    }
    case JointKind::prismatic:
      return {dot(m.z_F, m.d), T(0), T(0)};
    default:
      return {};
  }
}

/// The angle that is `angle` but for whole turns, nearest to `last` [rad].
template <class T>
T continued(const T& angle, const T& last) {
  using std::floor;
  const T turn = detail::two_pi<T>();
  return angle + turn * floor((last - angle) / turn + T(0.5));
}

/// Coordinates with their angles continued from `last`.
template <class T>
std::array<T, 3> counted_on(JointKind kind, std::array<T, 3> q, const std::array<T, 3>& last) {
  if (is_angle(kind)) {
    q[0] = continued(q[0], last[0]);
    q[1] = kind == JointKind::universal ? continued(q[1], last[1]) : T(0);
  }
  return q;
}

template <class T>
std::array<T, 3> joint_rates(JointKind kind, const JointMotion<T>& m) {
  switch (kind) {
    case JointKind::revolute:
      return {dot(m.z_F, m.omega), T(0), T(0)};
    case JointKind::universal:
      return {dot(m.x_F, m.omega), dot(m.y_G, m.omega), T(0)};
    case JointKind::spherical:
      return {dot(m.x_F, m.omega), dot(m.y_F, m.omega), dot(m.z_F, m.omega)};
    case JointKind::prismatic:
      return {dot(m.z_F, m.w), T(0), T(0)};
    default:
      return {};
  }
}

/// What acts along the coordinates of a joint, on b, and the power of what has no potential [W].
template <class T>
struct ActiveWrench {
  PointWrench<T> wrench;
  T power{};
};

/// `q`, `rate`: of joint_coordinates (continued) and joint_rates; `motor`: per coordinate [N m] or [N], or null.
template <class T>
ActiveWrench<T> active_wrench(const Joint<T>& joint, const JointMotion<T>& m,
                              const std::array<T, 3>& q, const std::array<T, 3>& rate,
                              const T* motor) {
  const auto told = [&](std::size_t i) { return motor == nullptr ? T(0) : motor[i]; };
  ActiveWrench<T> active{};
  if (joint.kind == JointKind::spherical) {
    const Rotation<T> turn(Vec3<T>{q[0], q[1], q[2]});
    const Vec3<T> q_rate = turn.dexpinv(Vec3<T>{rate[0], rate[1], rate[2]});
    const T rates[] = {q_rate.x, q_rate.y, q_rate.z};
    T conservative[3], dissipative[3], direct[3];
    for (std::size_t i = 0; i < 3; ++i) {
      const CoordinateForce<T> f = elastic_force(joint.laws[i], q[i], rates[i]);
      conservative[i] = f.conservative + f.dissipative;
      dissipative[i] = f.dissipative * rates[i];
      direct[i] = told(i) - joint.laws[i].damping * rate[i];
    }
    const Vec3<T> couple_F =
        turn.dexpinv_minus(Vec3<T>{conservative[0], conservative[1], conservative[2]}) +
        Vec3<T>{direct[0], direct[1], direct[2]};
    active.wrench.couple = couple_F.x * m.x_F + couple_F.y * m.y_F + couple_F.z * m.z_F;
    active.power = ((dissipative[0] + dissipative[1]) + dissipative[2]) +
                   ((direct[0] * rate[0] + direct[1] * rate[1]) + direct[2] * rate[2]);
    return active;
  }
  const Vec3<T>* const axes[] = {joint.kind == JointKind::universal ? &m.x_F : &m.z_F, &m.y_G};
  for (int k = 0; k < m.shape.coordinates; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const CoordinateForce<T> f = elastic_force(joint.laws[i], q[i], rate[i]);
    const T work = f.dissipative + (told(i) - joint.laws[i].damping * rate[i]);
    Vec3<T>& part = joint.kind == JointKind::prismatic ? active.wrench.force : active.wrench.couple;
    part = part + (f.conservative + work) * *axes[k];
    active.power = active.power + work * rate[i];
  }
  return active;
}

}  // namespace adstar::multibody
