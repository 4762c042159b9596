#pragma once
// A rigid body: Pi_B = J_B omega_B with a full symmetric inertia tensor about the centre of mass.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include <Eigen/Core>

#include "adstar/attitude.hpp"
#include "adstar/vec3.hpp"

namespace adstar {

/// J = R diag(moments) Rᵀ, R = R_BP of the unit quaternion `axes`: principal axes P to B.
template <class T>
struct PrincipalFrame {
  std::array<T, 3> moments;  ///< ascending
  Quat<T> axes;              ///< q_BP, a proper rotation
};

/// Eigenvalues and axes of a symmetric matrix: cyclic Jacobi rotations (Golub and Van Loan, Matrix
/// Computations, 8.5), written out so that the bits do not depend on a library's choice of
/// instructions. The rotations, all within π/4, are gathered as a quaternion by their half angles.
template <class T>
PrincipalFrame<T> principal_frame(const Sym3<T>& J) {
  using std::abs;
  using std::sqrt;
  T m[3][3] = {{J.xx, J.xy, J.xz}, {J.xy, J.yy, J.yz}, {J.xz, J.yz, J.zz}};
  Quat<T> axes{T(1), T(0), T(0), T(0)};
  // Turns the frame about its own axis r by the angle of sine s and cosine c.
  const auto turn = [&axes](int r, const T& c, const T& s) {
    const T w = sqrt(T(0.5) * (T(1) + c));
    const T v = s / (T(2) * w);
    axes = axes * Quat<T>{w, r == 0 ? v : T(0), r == 1 ? v : T(0), r == 2 ? v : T(0)};
  };
  for (int sweep = 0; sweep < 30; ++sweep) {
    if (m[0][1] == T(0) && m[0][2] == T(0) && m[1][2] == T(0)) {
      break;
    }
    for (int p = 0; p < 2; ++p) {
      for (int q = p + 1; q < 3; ++q) {
        if (m[p][q] == T(0)) {
          continue;
        }
        const T zeta = (m[q][q] - m[p][p]) / (T(2) * m[p][q]);
        const T root = abs(zeta) + sqrt(T(1) + zeta * zeta);
        const T t = (zeta < T(0) ? T(-1) : T(1)) / root;
        const T c = T(1) / sqrt(T(1) + t * t);
        const T s = t * c;
        const int r = 3 - p - q;
        const T m_pq = m[p][q], m_rp = m[r][p], m_rq = m[r][q];
        m[p][p] = m[p][p] - t * m_pq;
        m[q][q] = m[q][q] + t * m_pq;
        m[p][q] = m[q][p] = T(0);
        m[r][p] = m[p][r] = c * m_rp - s * m_rq;
        m[r][q] = m[q][r] = s * m_rp + c * m_rq;
        turn(r, c, r == 1 ? s : -s);  // e_p' = c e_p - s e_q
      }
    }
  }
  std::array<T, 3> moments{m[0][0], m[1][1], m[2][2]};
  for (const int p : {0, 1, 0}) {  // quarter turns put them in order
    const auto i = static_cast<std::size_t>(p);
    if (moments[i + 1] < moments[i]) {
      std::swap(moments[i], moments[i + 1]);
      turn(p == 0 ? 2 : 0, T(0), T(1));
    }
  }
  return {moments, normalised(axes)};
}

/// Eigenvalues alone, ascending.
template <class T>
std::array<T, 3> principal_moments(const Sym3<T>& J) {
  return principal_frame(J).moments;
}

template <class T>
class RigidBody {
 public:
  /// `inertia_B`: 3x3 about the centre of mass [kg m²], symmetric positive definite (the lower
  /// triangle is read).
  explicit RigidBody(const Eigen::Matrix<T, 3, 3>& inertia_B)
      : J_{inertia_B(0, 0), inertia_B(1, 1), inertia_B(2, 2),
           inertia_B(1, 0), inertia_B(2, 0), inertia_B(2, 1)},
        J_inverse_(inverse(J_)),
        frame_(principal_frame(J_)),
        inverse_moments_{T(1) / frame_.moments[0], T(1) / frame_.moments[1],
                         T(1) / frame_.moments[2]},
        diagonal_(J_.xy == T(0) && J_.xz == T(0) && J_.yz == T(0)) {}

  /// omega_B = J_B⁻¹ Pi_B [rad/s]
  [[gnu::always_inline]] Vec3<T> angular_velocity(const Vec3<T>& Pi_B) const {
    if (diagonal_) {
      return {J_inverse_.xx * Pi_B.x, J_inverse_.yy * Pi_B.y, J_inverse_.zz * Pi_B.z};
    }
    return J_inverse_ * Pi_B;
  }
  /// Pi_B = J_B omega_B [N m s]
  Vec3<T> momentum(const Vec3<T>& omega_B) const { return J_ * omega_B; }
  /// E = ½ omega_B · Pi_B [J]
  T energy(const Vec3<T>& Pi_B) const { return T(0.5) * dot(angular_velocity(Pi_B), Pi_B); }
  /// B is a frame of principal axes: J_B is diagonal.
  bool on_principal_axes() const { return diagonal_; }
  /// Diagonal of J_B⁻¹ [1/(kg m²)].
  Vec3<T> inverse_diagonal() const { return {J_inverse_.xx, J_inverse_.yy, J_inverse_.zz}; }
  /// Ascending [kg m²].
  const std::array<T, 3>& moments() const { return frame_.moments; }
  /// q_BP: principal axes, in the order of moments(), to body axes. Any of them where moments are equal.
  const Quat<T>& principal_axes() const { return frame_.axes; }
  /// About the centre of mass, in B [kg m²].
  const Sym3<T>& inertia() const { return J_; }
  /// One over moments(): descending.
  const std::array<T, 3>& inverse_moments() const { return inverse_moments_; }

 private:
  static Sym3<T> inverse(const Sym3<T>& m) {
    if (m.xy == T(0) && m.xz == T(0) && m.yz == T(0)) {
      return {T(1) / m.xx, T(1) / m.yy, T(1) / m.zz, T(0), T(0), T(0)};
    }
    // Scaled first: the products of three moments of 1e-120 or 1e120 kg m² must not leave the
    // range.
    using std::max;
    const T k = max(max(m.xx, m.yy), m.zz);
    const Sym3<T> a{m.xx / k, m.yy / k, m.zz / k, m.xy / k, m.xz / k, m.yz / k};
    const T c_xx = a.yy * a.zz - a.yz * a.yz;
    const T c_xy = a.xz * a.yz - a.xy * a.zz;
    const T c_xz = a.xy * a.yz - a.xz * a.yy;
    const T d = (a.xx * c_xx + a.xy * c_xy + a.xz * c_xz) * k;
    return {c_xx / d, (a.xx * a.zz - a.xz * a.xz) / d, (a.xx * a.yy - a.xy * a.xy) / d, c_xy / d,
            c_xz / d, (a.xy * a.xz - a.xx * a.yz) / d};
  }

  Sym3<T> J_;
  Sym3<T> J_inverse_;
  PrincipalFrame<T> frame_;
  std::array<T, 3> inverse_moments_;
  bool diagonal_;
};

}  // namespace adstar
