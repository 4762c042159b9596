#pragma once
// Joints between body a and body b (or the ground): what they hold, and which way.
//
// A joint has a point and a frame in each body: F fixed in a at the point c_a, G fixed in b at c_b. It holds
//   translation, along axes e of F:   e·(c_b - c_a) = 0
//   rotation, f of G against g of F:  f·g = 0
// With the *point of action c = c_b for both bodies*, s = c - x_a, r = c - x_b and w the velocity of c on b
// relative to the material point of a that is there,
//   d/dt e·(c_b - c_a) = e·(v_b + omega_b×r - v_a - omega_a×s) = e·w,   d/dt f·g = (omega_b - omega_a)·(f×g)
// exactly, gap or no gap: so the force e λ, or the couple (f×g) λ, of a row acts on b, and its opposite on a
// at the same point, and both are one spatial wrench about any origin (the paper's C and Cᵀ λ, eq. 1a).
// A second derivative gives the right-hand side gamma of C v' = gamma (index 1).
//
//   kind        holds                          free coordinates
//   fixed       x, y, z; all rotation          none
//   revolute    x, y, z; z_G against x_F, y_F  angle about z_F
//   universal   x, y, z; y_G against x_F       angle about x_F, then angle about y_G
//   spherical   x, y, z                        rotation vector of G from F, in F
//   prismatic   x, y; all rotation             displacement along z_F
// F and G coincide where every coordinate is zero.

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "adstar/attitude.hpp"
#include "adstar/multibody/joint_force.hpp"
#include "adstar/vec3.hpp"

namespace adstar::multibody {

enum class JointKind { fixed, revolute, universal, spherical, prismatic };

inline constexpr int kGround = -1;  ///< in place of a body: the inertial frame

/// A frame fixed in a body.
template <class T>
struct JointFrame {
  Vec3<T> point_B;  ///< from the centre of mass; of the ground, from the origin of I [m]
  Quat<T> q_BF;     ///< joint axes to body axes, unit
};

template <class T>
struct Joint {
  std::string name;
  JointKind kind = JointKind::fixed;
  int body_a = kGround, body_b = kGround;  ///< places in the assembly, or kGround
  JointFrame<T> a, b;
  std::array<CoordinateLaw<T>, 3> laws{};  ///< of the free coordinates, in their order
};

/// How many rows hold translation and rotation, and how many coordinates are free.
struct JointShape {
  int translations, rotations, coordinates;
  int rows() const { return translations + rotations; }
};

constexpr JointShape shape_of(JointKind kind) {
  switch (kind) {
    case JointKind::fixed:
      return {3, 3, 0};
    case JointKind::revolute:
      return {3, 2, 1};
    case JointKind::universal:
      return {3, 1, 2};
    case JointKind::spherical:
      return {3, 0, 3};
    default:
      return {2, 3, 1};
  }
}

/// What a row holds, for people.
constexpr std::string_view row_name(JointKind kind, int row) {
  constexpr std::string_view kAlong[] = {"translation along x", "translation along y",
                                         "translation along z"};
  constexpr std::string_view kAbout[] = {"rotation about x", "rotation about y",
                                         "rotation about z"};
  const int translations = shape_of(kind).translations;
  if (row < translations) {
    return kAlong[row];
  }
  return kind == JointKind::universal ? kAbout[2] : kAbout[row - translations];
}

constexpr std::string_view kind_name(JointKind kind) {
  constexpr std::string_view kNames[] = {"fixed", "revolute", "universal", "spherical",
                                         "prismatic"};
  return kNames[static_cast<std::size_t>(kind)];
}

/// A coordinate that is an angle is counted on through whole turns.
constexpr bool is_angle(JointKind kind) {
  return kind == JointKind::revolute || kind == JointKind::universal;
}

/// Where a body is and how it moves.
template <class T>
struct BodyMotion {
  Vec3<T> x_I;      ///< centre of mass [m]
  Quat<T> q_IB;     ///< unit
  Vec3<T> v_I;      ///< [m/s]
  Vec3<T> omega_I;  ///< [rad/s]
};

/// A joint at one instant.
template <class T>
struct JointMotion {
  JointShape shape{};
  Vec3<T> c;                      ///< point of action, in I
  Vec3<T> s, r;                   ///< c from x_a, c from x_b
  Vec3<T> d;                      ///< c_b - c_a
  Vec3<T> w;                      ///< velocity of c on b relative to a
  Vec3<T> omega;                  ///< omega_b - omega_a
  Vec3<T> x_F, y_F, z_F;          ///< axes of F
  Vec3<T> x_G, y_G, z_G;          ///< axes of G
  Quat<T> q_FG;                   ///< of G from F
  std::array<Vec3<T>, 6> axis{};  ///< e of a translation, f×g of a rotation
  std::array<T, 6> gap{};         ///< Φ [m], [rad]
  std::array<T, 6> rate{};        ///< Φ' = C v
  std::array<T, 6> gamma{};       ///< C v' = gamma
};

namespace detail {

template <class T>
void add_rotation_row(JointMotion<T>& m, int row, const Vec3<T>& f, const Vec3<T>& g,
                      const Vec3<T>& omega_a, const Vec3<T>& omega_b) {
  const auto i = static_cast<std::size_t>(row);
  const Vec3<T> u = cross(f, g);
  const Vec3<T> u_rate = cross(cross(omega_b, f), g) + cross(f, cross(omega_a, g));
  m.axis[i] = u;
  m.gap[i] = dot(f, g);
  m.rate[i] = dot(m.omega, u);
  m.gamma[i] = -dot(m.omega, u_rate);
}

}  // namespace detail

/// The geometry of a joint, its violation, rate and right-hand side.
template <class T>
void evaluate(const Joint<T>& joint, const BodyMotion<T>& a, const BodyMotion<T>& b,
              JointMotion<T>& m) {
  m.shape = shape_of(joint.kind);
  m.r = rotate(b.q_IB, joint.b.point_B);
  m.c = b.x_I + m.r;
  m.s = m.c - a.x_I;
  m.d = m.s - rotate(a.q_IB, joint.a.point_B);
  const Quat<T> q_F = a.q_IB * joint.a.q_BF, q_G = b.q_IB * joint.b.q_BF;
  m.q_FG = Quat<T>{q_F.w, -q_F.x, -q_F.y, -q_F.z} * q_G;
  const Vec3<T> x{T(1), T(0), T(0)}, y{T(0), T(1), T(0)}, z{T(0), T(0), T(1)};
  m.x_F = rotate(q_F, x), m.y_F = rotate(q_F, y), m.z_F = rotate(q_F, z);
  m.x_G = rotate(q_G, x), m.y_G = rotate(q_G, y), m.z_G = rotate(q_G, z);

  m.omega = b.omega_I - a.omega_I;
  const Vec3<T> spin_b = cross(b.omega_I, m.r);
  const Vec3<T> c_rate = (b.v_I - a.v_I) + spin_b;  // of s
  m.w = c_rate - cross(a.omega_I, m.s);
  // e·[v_b' + omega_b'×r - v_a' - omega_a'×s] = -e·[omega_b×(omega_b×r) - omega_a×(s' + w)]
  const Vec3<T> left = cross(b.omega_I, spin_b) - cross(a.omega_I, c_rate + m.w);
  const Vec3<T>* const along[] = {&m.x_F, &m.y_F, &m.z_F};
  for (int k = 0; k < m.shape.translations; ++k) {
    const auto i = static_cast<std::size_t>(k);
    m.axis[i] = *along[k];
    m.gap[i] = dot(m.axis[i], m.d);
    m.rate[i] = dot(m.axis[i], m.w);
    m.gamma[i] = -dot(m.axis[i], left);
  }
  const auto rotation = [&](int row, const Vec3<T>& f, const Vec3<T>& g) {
    detail::add_rotation_row(m, row, f, g, a.omega_I, b.omega_I);
  };
  switch (joint.kind) {
    case JointKind::fixed:
    case JointKind::prismatic:
      rotation(m.shape.translations, m.y_G, m.z_F);
      rotation(m.shape.translations + 1, m.z_G, m.x_F);
      rotation(m.shape.translations + 2, m.x_G, m.y_F);
      break;
    case JointKind::revolute:
      rotation(3, m.z_G, m.y_F);  // about x
      rotation(4, m.z_G, m.x_F);  // about y
      break;
    case JointKind::universal:
      rotation(3, m.y_G, m.x_F);
      break;
    default:
      break;
  }
}

/// Rows of C on one body, against (omega_I', v_I'): (lever×e, e) or (u, 0), with the sign of the side.
template <class T>
struct JacobianBlock {
  T row[6][6];
};

/// `lever`: s on a, r on b; `sign`: -1 on a, 1 on b.
template <class T>
void jacobian_block(const JointMotion<T>& m, const Vec3<T>& lever, const T& sign,
                    JacobianBlock<T>& block) {
  for (int i = 0; i < m.shape.rows(); ++i) {
    const Vec3<T> e = sign * m.axis[static_cast<std::size_t>(i)];
    const bool translation = i < m.shape.translations;
    const Vec3<T> moment = translation ? cross(lever, e) : e;
    T* const row = block.row[i];
    row[0] = moment.x, row[1] = moment.y, row[2] = moment.z;
    row[3] = translation ? e.x : T(0);
    row[4] = translation ? e.y : T(0);
    row[5] = translation ? e.z : T(0);
  }
}

/// A force through the point of action, and a couple [N, N m], or their impulses: on b; a has the opposite.
template <class T>
struct PointWrench {
  Vec3<T> force, couple;
  friend bool operator==(const PointWrench&, const PointWrench&) = default;
};

/// Cᵀ λ
template <class T>
PointWrench<T> constraint_wrench(const JointMotion<T>& m, const std::array<T, 6>& lambda) {
  PointWrench<T> wrench{};
  for (int k = 0; k < m.shape.rows(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    Vec3<T>& part = k < m.shape.translations ? wrench.force : wrench.couple;
    part = part + lambda[i] * m.axis[i];
  }
  return wrench;
}

}  // namespace adstar::multibody
