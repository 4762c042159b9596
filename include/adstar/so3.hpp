#pragma once
// exp, dexp and dexp⁻¹ of so(3), one rotation vector sharing its coefficients.
//
// With θ = |psi|, s = θ², and the half angle so that nothing cancels at small θ:
//   P = (1 - S)/s,  D = (S - C)/s,  S = sin(θ/2)/(θ/2) = 1 - s P,  C = cos(θ/2) = S - s D
//   exp(psi) v      = v + A psi×v + B psi×(psi×v)    A = sin θ/θ = S C,  B = (1 - cos θ)/θ² = S²/2
//   dexp(psi) v     = v + B psi×v + E psi×(psi×v)    E = (1 - A)/θ² = P (1 + S) + S D
//   dexpinv(psi, v) = v - ½ psi×v + g psi×(psi×v)    g = (1 - (θ/2) cot(θ/2))/θ² = D/S
// (Iserles, Munthe-Kaas, Nørsett, Zanna 2000; the half-angle forms are ours.) dexpinv is singular
// at θ = 2π. Coefficients hold to a few units in the last place for 0 ≤ θ ≤ π
// (tests/unit/so3_test.cpp).

#include <limits>
#include <type_traits>

#include <Eigen/Core>

#include "adstar/attitude.hpp"
#include "adstar/trig.hpp"
#include "adstar/vec3.hpp"

namespace adstar {
namespace detail {

template <class T>
struct HalfAngleSeries {
  T P, D;
};

/// P and D of u = (θ/2)²: ¼ Σ (-u)^k/(2k+3)! and ¼ Σ (-u)^k (2k+2)/(2k+3)!, cut for u ≤ 1/16 (θ ≤
/// ½).
inline HalfAngleSeries<double> half_angle_series_small(double u) {
  constexpr double p0 = 0.25 / 6, p1 = -0.25 / 120, p2 = 0.25 / 5040, p3 = -0.25 / 362880;
  constexpr double p4 = 0.25 / 39916800.0, p5 = -0.25 / 6227020800.0;
  const double P = p0 + u * (p1 + u * (p2 + u * (p3 + u * (p4 + u * p5))));
  const double D =
      2 * p0 + u * (4 * p1 + u * (6 * p2 + u * (8 * p3 + u * (10 * p4 + u * (12 * p5)))));
  return {P, D};
}

/// The same, summed until u^k/(2k+3)! vanishes: for any scalar, u ≤ (π/2)².
template <class T>
HalfAngleSeries<T> half_angle_series(const T& u) {
  T term = T(1) / T(24);  // ¼ (-u)^k/(2k+3)!
  T P = term;
  T D = T(2) * term;
  for (int k = 1; k < 40; ++k) {
    term = term * (-u / T((2 * k + 2) * (2 * k + 3)));
    P = P + term;
    D = D + T(2 * k + 2) * term;
    if (!(T(2 * k + 2) * (term < T(0) ? -term : term) >
          std::numeric_limits<T>::epsilon() / T(1000))) {
      break;
    }
  }
  return {P, D};
}

/// Twelve terms with constant coefficients: u ≤ (π/2)² in double.
inline HalfAngleSeries<double> half_angle_series(double u) {
  constexpr double kInverse[] = {0,         1.0 / 20,  1.0 / 42,  1.0 / 72,  1.0 / 110, 1.0 / 156,
                                 1.0 / 210, 1.0 / 272, 1.0 / 342, 1.0 / 420, 1.0 / 506, 1.0 / 600};
  double P = 1, D = 24;
  for (int k = 11; k >= 1; --k) {
    P = 1.0 - u * kInverse[k] * P;
    D = 2.0 * k - u * kInverse[k] * D;
  }
  return {P * (1.0 / 24), D * (1.0 / 24)};
}

}  // namespace detail

/// θ up to which the shorter series hold [rad].
inline constexpr double kTinyAngleRad = 0.03125;
inline constexpr double kSmallAngleRad = 0.5;

/// Coefficients of one rotation vector psi [rad]; see the head of this file.
template <class T>
class Rotation {
 public:
  /// psi = 0.
  Rotation() : A_(1), B_(T(0.5)), E_(T(1) / T(6)), g_(T(1) / T(12)), C_(1), half_S_(T(0.5)) {}

  /// Inline where it is used: a step of a single body waits for it.
  [[gnu::always_inline]] explicit Rotation(const Vec3<T>& psi)
      : psi_{psi.x, psi.y, psi.z}, s_(squared_norm(psi)) {
    if constexpr (std::is_same_v<T, double>) {
      if (s_ <= kTinyAngleRad * kTinyAngleRad) {
        set_tiny();
        return;
      }
    }
    const HalfAngle half = half_angle_of(s_);
    set(half.P, half.D);
  }

  /// exp(psi) v
  [[gnu::always_inline]] Vec3<T> exp(const Vec3<T>& v) const { return about(v, A_, B_); }
  /// exp(-psi) v
  [[gnu::always_inline]] Vec3<T> exp_inverse(const Vec3<T>& v) const { return about(v, -A_, B_); }
  /// dexp(psi) v: d/dt exp(psi(t)) = hat(dexp(psi) psi') exp(psi)
  Vec3<T> dexp(const Vec3<T>& v) const { return about(v, B_, E_); }
  /// dexp⁻¹(psi) v
  Vec3<T> dexpinv(const Vec3<T>& v) const { return about(v, T(-0.5), g_); }
  /// dexp⁻¹(-psi) v: the psi' of the body-frame (left-trivialised) kinematics R' = R hat(v), R =
  /// R_n exp(psi). As a matrix, (1 - g s) 1 + ½ hat(psi) + g psi psiᵀ: its entries are ready before
  /// v is, and v waits for them in a step.
  [[gnu::always_inline]] Vec3<T> dexpinv_minus(const Vec3<T>& v) const {
    const Vec3<T> gp = g_ * psi_;
    const Vec3<T> half = T(0.5) * psi_;
    const T d = T(1) - g_ * s_;
    const T xy = gp.x * psi_.y, xz = gp.x * psi_.z, yz = gp.y * psi_.z;
    return {(d + gp.x * psi_.x) * v.x + (xy - half.z) * v.y + (xz + half.y) * v.z,
            (xy + half.z) * v.x + (d + gp.y * psi_.y) * v.y + (yz - half.x) * v.z,
            (xz - half.y) * v.x + (yz + half.x) * v.y + (d + gp.z * psi_.z) * v.z};
  }
  /// |psi|² [rad²]
  const T& squared_angle() const { return s_; }
  /// The unit quaternion of exp(psi).
  [[gnu::always_inline]] Quat<T> quaternion() const {
    return {C_, half_S_ * psi_.x, half_S_ * psi_.y, half_S_ * psi_.z};
  }

 private:
  using HalfAngle = detail::HalfAngleSeries<T>;

  [[gnu::always_inline]] void set(const T& P, const T& D) {
    const T S = T(1) - s_ * P;
    C_ = S - s_ * D;
    half_S_ = T(0.5) * S;
    A_ = S * C_;
    B_ = half_S_ * S;
    E_ = P * (T(1) + S) + S * D;
    g_ = D / S;
  }

  /// Out of line: the rarer angles leave the registers to the common ones.
  [[gnu::noinline]] static HalfAngle half_angle_of(T s) {
    const T u = T(0.25) * s;
    if constexpr (std::is_same_v<T, double>) {
      if (u <= 0.25 * kSmallAngleRad * kSmallAngleRad) {
        return detail::half_angle_series_small(u);
      }
    }
    return u <= T(2.5) ? detail::half_angle_series(u) : beyond_pi(u);
  }

  static detail::HalfAngleSeries<T> beyond_pi(const T& u) {
    using std::sqrt;
    const T half = sqrt(u);
    const SinCos<T> a = sincos(half);
    const T S = a.sin / half;
    return {(T(1) - S) / (T(4) * u), (S - a.cos) / (T(4) * u)};
  }

  /// Taylor series in s for θ ≤ 1/32, cut where the next term, times the power of θ that it meets,
  /// is below 3e-17 (C and S/2, whose error would be a drift: below 2e-19); in pairs (Estrin 1960),
  /// since the step of a single body waits for them.
  [[gnu::always_inline]] void set_tiny() {
    const T s = s_, s2 = s_ * s_;
    A_ = (1 - s * (1. / 6)) + s2 * (1. / 120 - s * (1. / 5040));
    B_ = (0.5 - s * (1. / 24)) + s2 * (1. / 720);
    E_ = (1. / 6 - s * (1. / 120)) + s2 * (1. / 5040);
    g_ = (1. / 12 + s * (1. / 720)) + s2 * (1. / 30240);
    C_ = (1 - s * (1. / 8)) + s2 * (1. / 384 - s * (1. / 46080));
    half_S_ = (0.5 - s * (1. / 48)) + s2 * (1. / 3840 - s * (1. / 645120));
  }

  /// v + a psi×v + b psi×(psi×v)
  [[gnu::always_inline]] Vec3<T> about(const Vec3<T>& v, const T& a, const T& b) const {
    const Vec3<T> c = cross(psi_, v);
    return v + (a * c + b * cross(psi_, c));
  }

  Vec3<T> psi_;
  T s_{}, A_, B_, E_, g_, C_, half_S_;
};

/// hat(v) w = v × w
template <class T>
Eigen::Matrix<T, 3, 3> hat(const Eigen::Matrix<T, 3, 1>& v) {
  Eigen::Matrix<T, 3, 3> m;
  m << T(0), -v.z(), v.y(), v.z(), T(0), -v.x(), -v.y(), v.x(), T(0);
  return m;
}

/// Rotation matrix R_IB of a unit quaternion: its columns are the body axes in I.
template <class T>
Eigen::Matrix<T, 3, 3> rotation_matrix(const Quat<T>& q) {
  Eigen::Matrix<T, 3, 3> R_IB;
  R_IB.col(0) = to_eigen(rotate(q, Vec3<T>{T(1), T(0), T(0)}));
  R_IB.col(1) = to_eigen(rotate(q, Vec3<T>{T(0), T(1), T(0)}));
  R_IB.col(2) = to_eigen(rotate(q, Vec3<T>{T(0), T(0), T(1)}));
  return R_IB;
}

}  // namespace adstar
