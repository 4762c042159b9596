#pragma once
// A rigid body: Pi_B = J_B omega_B with a full symmetric inertia tensor about the centre of mass.

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Core>

#include "adstar/vec3.hpp"

namespace adstar {

/// Eigenvalues of a symmetric matrix, ascending: cyclic Jacobi rotations (Golub and Van Loan,
/// Matrix Computations, 8.5), written out so that the bits do not depend on a library's choice of
/// instructions.
template <class T>
std::array<T, 3> principal_moments(const Sym3<T>& J) {
  using std::abs;
  using std::sqrt;
  T m[3][3] = {{J.xx, J.xy, J.xz}, {J.xy, J.yy, J.yz}, {J.xz, J.yz, J.zz}};
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
      }
    }
  }
  std::array<T, 3> moments{m[0][0], m[1][1], m[2][2]};
  std::sort(moments.begin(), moments.end());
  return moments;
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
        moments_(principal_moments(J_)),
        inverse_moments_{T(1) / moments_[0], T(1) / moments_[1], T(1) / moments_[2]},
        diagonal_(J_.xy == T(0) && J_.xz == T(0) && J_.yz == T(0)) {}

  /// omega_B = J_B⁻¹ Pi_B [rad/s]
  Vec3<T> angular_velocity(const Vec3<T>& Pi_B) const {
    if (diagonal_) {
      return {J_inverse_.xx * Pi_B.x, J_inverse_.yy * Pi_B.y, J_inverse_.zz * Pi_B.z};
    }
    return J_inverse_ * Pi_B;
  }
  /// Pi_B = J_B omega_B [N m s]
  Vec3<T> momentum(const Vec3<T>& omega_B) const { return J_ * omega_B; }
  /// E = ½ omega_B · Pi_B [J]
  T energy(const Vec3<T>& Pi_B) const { return T(0.5) * dot(angular_velocity(Pi_B), Pi_B); }
  /// Ascending [kg m²].
  const std::array<T, 3>& moments() const { return moments_; }
  /// One over moments(): descending.
  const std::array<T, 3>& inverse_moments() const { return inverse_moments_; }
  const Sym3<T>& inverse_inertia() const { return J_inverse_; }
  /// Whether the axes are principal ones: angular_velocity() then multiplies by three numbers.
  bool is_diagonal() const { return diagonal_; }

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
  std::array<T, 3> moments_;
  std::array<T, 3> inverse_moments_;
  bool diagonal_;
};

}  // namespace adstar
