#pragma once
// Where the bodies are when the coordinates of their joints are what they should be: along the tree, from the
// ground or from body 0, which stays where it is.

#include <array>
#include <span>
#include <vector>

#include "adstar/multibody/assembly.hpp"
#include "adstar/multibody/joint.hpp"
#include "adstar/multibody/topology.hpp"
#include "adstar/so3.hpp"

namespace adstar::multibody {

/// Coordinates of a joint [rad] or [m], and their rates, as joint_coordinates.hpp has them.
template <class T>
struct JointStart {
  std::array<T, 3> q{}, rate{};
};

namespace detail {

/// G from F: rotation, displacement, angular velocity and velocity, all in F.
template <class T>
struct RelativeMotion {
  Quat<T> q_FG;
  Vec3<T> d, omega, w;
};

template <class T>
Quat<T> turn_about(const Vec3<T>& axis, const T& angle) {
  const SinCos<T> half = sincos(T(0.5) * angle);
  return {half.cos, half.sin * axis.x, half.sin * axis.y, half.sin * axis.z};
}

template <class T>
RelativeMotion<T> relative_motion(JointKind kind, const JointStart<T>& start) {
  const Vec3<T> x{T(1), T(0), T(0)}, y{T(0), T(1), T(0)}, z{T(0), T(0), T(1)};
  const auto& [q, rate] = start;
  RelativeMotion<T> m{};
  switch (kind) {
    case JointKind::revolute:
      m.q_FG = turn_about(z, q[0]);
      m.omega = rate[0] * z;
      break;
    case JointKind::universal: {
      const Quat<T> first = turn_about(x, q[0]);
      m.q_FG = first * turn_about(y, q[1]);
      m.omega = rate[0] * x + rate[1] * rotate(first, y);
      break;
    }
    case JointKind::spherical: {
      const Vec3<T> phi{q[0], q[1], q[2]};
      const T angle = norm(phi);
      m.q_FG = angle > T(0) ? turn_about((T(1) / angle) * phi, angle) : Quat<T>{};
      m.omega = {rate[0], rate[1], rate[2]};
      break;
    }
    case JointKind::prismatic:
      m.d = q[0] * z;
      m.w = rate[0] * z;
      break;
    default:
      break;
  }
  return m;
}

}  // namespace detail

/// Sets x_I, q_IB, v_I, omega_B of all bodies but the base from the joints of the tree; `joint_starts`: by joint,
/// those of loop joints are not read.
template <class T>
void place(std::vector<BodySpec<T>>& bodies, const std::vector<Joint<T>>& joints,
           std::span<const JointStart<T>> joint_starts) {
  for (const Joint<T>& joint : joints) {
    detail::check_joint(joint, bodies);
  }
  for (const TreeLink& link : find_topology(bodies.size(), joints).links) {
    if (link.joint < 0) {
      continue;
    }
    const Joint<T>& joint = joints[static_cast<std::size_t>(link.joint)];
    const BodyMotion<T> from = link.parent == kGround
                                   ? BodyMotion<T>{}
                                   : start_of(bodies[static_cast<std::size_t>(link.parent)]);
    const detail::RelativeMotion<T> rel =
        detail::relative_motion(joint.kind, joint_starts[static_cast<std::size_t>(link.joint)]);
    const JointFrame<T>& near = link.child_is_b ? joint.a : joint.b;
    const JointFrame<T>& far = link.child_is_b ? joint.b : joint.a;
    BodySpec<T>& child = bodies[static_cast<std::size_t>(link.body)];
    const Quat<T> far_inverse{far.q_BF.w, -far.q_BF.x, -far.q_BF.y, -far.q_BF.z};
    const Quat<T> q_near = from.q_IB * near.q_BF;
    const Quat<T> inverse{rel.q_FG.w, -rel.q_FG.x, -rel.q_FG.y, -rel.q_FG.z};
    const Quat<T> q_far = q_near * (link.child_is_b ? rel.q_FG : inverse);
    const Quat<T> q_F = link.child_is_b ? q_near : q_far;
    const T sign = link.child_is_b ? T(1) : T(-1);
    const Vec3<T> omega = rotate(q_F, rel.omega), w = rotate(q_F, rel.w), d = rotate(q_F, rel.d);
    child.q_IB = normalised(q_far * far_inverse);
    const Vec3<T> omega_I = from.omega_I + sign * omega;
    child.omega_B = rotate_inverse(child.q_IB, omega_I);
    const Vec3<T> point_near = from.x_I + rotate(from.q_IB, near.point_B);
    const Vec3<T> point_far = point_near + sign * d;
    const Vec3<T> lever = rotate(child.q_IB, far.point_B);
    child.x_I = point_far - lever;
    // w is the velocity of c = c_b on b relative to a.
    const Vec3<T> c = link.child_is_b ? point_far : point_near;
    const Vec3<T> of_near = from.v_I + cross(from.omega_I, c - from.x_I);
    child.v_I = (of_near + sign * w) - cross(omega_I, c - child.x_I);
  }
}

/// A joint frame with its z along `axis_B` (of any length but zero): revolute and prismatic joints move there. Its x
/// is square to it, nearest to the body axis that leans on it least.
template <class T>
JointFrame<T> frame_about(const Vec3<T>& point_B, const Vec3<T>& axis_B) {
  using std::abs;
  const T length = norm(axis_B);
  if (!(length > T(0)) || !(length - length == T(0))) {
    detail::refuse("the axis of a joint has no direction; give three numbers, not all zero");
  }
  const Vec3<T> z = (T(1) / length) * axis_B;
  const bool x_least = abs(z.x) <= abs(z.y) && abs(z.x) <= abs(z.z);
  const bool y_least = !x_least && abs(z.y) <= abs(z.z);
  const Vec3<T> e = x_least   ? Vec3<T>{T(1), T(0), T(0)}
                    : y_least ? Vec3<T>{T(0), T(1), T(0)}
                              : Vec3<T>{T(0), T(0), T(1)};
  const Vec3<T> across = e - dot(e, z) * z;
  const Vec3<T> x = (T(1) / norm(across)) * across;
  Eigen::Matrix<T, 3, 3> R;
  R.col(0) = to_eigen(x);
  R.col(1) = to_eigen(cross(z, x));
  R.col(2) = to_eigen(z);
  return {point_B, normalised(from_eigen(Eigen::Quaternion<T>(R)))};
}

/// A frame of one body, or the ground's, as another has it where both are: with it as b's frame every coordinate of
/// the joint is zero at the start.
template <class T>
JointFrame<T> seen_from(const BodyMotion<T>& other, const BodyMotion<T>& body,
                        const JointFrame<T>& frame) {
  const Vec3<T> point_I = body.x_I + rotate(body.q_IB, frame.point_B);
  const Quat<T> q = other.q_IB;
  return {rotate_inverse(q, point_I - other.x_I),
          normalised(Quat<T>{q.w, -q.x, -q.y, -q.z} * (body.q_IB * frame.q_BF))};
}

/// Moves the origin to the common centre of mass, at rest there.
template <class T>
void centre(std::vector<BodySpec<T>>& bodies) {
  T mass{};
  Vec3<T> x{}, v{};
  for (const BodySpec<T>& body : bodies) {
    mass = mass + body.mass_kg;
    x = x + body.mass_kg * body.x_I;
    v = v + body.mass_kg * body.v_I;
  }
  for (BodySpec<T>& body : bodies) {
    body.x_I = body.x_I - (T(1) / mass) * x;
    body.v_I = body.v_I - (T(1) / mass) * v;
  }
}

}  // namespace adstar::multibody
