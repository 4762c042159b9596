#pragma once
// What exp and dexp⁻¹ of so(3) add to the identity: small where the turn is, and keeps its digits.
//
//   exp(±psi) v - v      = ±A psi×v + B psi×(psi×v)
//   dexpinv(-psi, v) - v = ½ psi×v + g psi×(psi×v)
// with the coefficients of so3.hpp. In float: for θ = |psi| ≤ ½ by Taylor series in s = θ², beyond by the
// half angle, past π by double's sine and cosine (one number), or no number (a lane: it is for
// the caller to step it on its own). Coefficients hold to 4 units in float's last place for θ ≤ π
// (tests/unit/added_turn_test.cpp). The same bits one by one and in every lane.

#include <cmath>
#include <concepts>
#include <limits>

#include "adstar/scalar.hpp"
#include "adstar/so3.hpp"
#include "adstar/trig.hpp"
#include "adstar/vec3.hpp"

namespace adstar {

/// float, or lanes of float.
template <class T>
concept Binary32 = std::same_as < typename NumberIn<T>::type,
float > ;

/// For a scalar of any width, by difference.
template <class N>
class AddedTurn {
 public:
  explicit AddedTurn(const Vec3<N>& psi) : whole_(psi) {}

  /// exp(psi) v - v
  Vec3<N> exp(const Vec3<N>& v) const { return whole_.exp(v) - v; }
  /// exp(-psi) v - v
  Vec3<N> exp_inverse(const Vec3<N>& v) const { return whole_.exp_inverse(v) - v; }
  /// dexp⁻¹(-psi) v - v
  Vec3<N> dexpinv_minus(const Vec3<N>& v) const { return whole_.dexpinv_minus(v) - v; }

 private:
  Rotation<N> whole_;
};

template <Binary32 N>
class AddedTurn<N> {
 public:
  [[gnu::always_inline]] explicit AddedTurn(const Vec3<N>& psi) : psi_{psi.x, psi.y, psi.z} {
    const N s = squared_norm(psi_);
    const auto tiny = s <= N(kTinyAngleRad * kTinyAngleRad);
    if constexpr (ManyLanes<N>) {
      c_ = of_tiny_angle(s);
      if (!all(tiny)) {
        c_ = select_each(tiny, c_, of_larger_angle(s));
      }
    } else {
      c_ = tiny ? of_tiny_angle(s) : of_larger_angle(s);
    }
  }

  /// exp(psi) v - v
  [[gnu::always_inline]] Vec3<N> exp(const Vec3<N>& v) const { return about(v, c_.A, c_.B); }
  /// exp(-psi) v - v
  [[gnu::always_inline]] Vec3<N> exp_inverse(const Vec3<N>& v) const {
    return about(v, -c_.A, c_.B);
  }
  /// dexp⁻¹(-psi) v - v
  [[gnu::always_inline]] Vec3<N> dexpinv_minus(const Vec3<N>& v) const {
    return about(v, N(0.5), c_.g);
  }

 private:
  struct Coefficients {
    N A, B, g;
  };

  /// Taylor, cut where the next term is below 1e-8 of the first.
  [[gnu::always_inline]] static Coefficients of_tiny_angle(const N& s) {
    return {N(1) - s * N(1. / 6), N(0.5) - s * N(1. / 24), N(1. / 12) + s * N(1. / 720)};
  }

  /// Taylor for θ ≤ ½, beyond by the half angle. Out of line: the rarer angles leave the registers to
  /// the common ones.
  [[gnu::noinline]] static Coefficients of_larger_angle(N s) {
    const N s2 = s * s;
    const Coefficients small{
        (N(1) - s * N(1. / 6)) + s2 * (N(1. / 120) - s * N(1. / 5040)),
        (N(0.5) - s * N(1. / 24)) + s2 * (N(1. / 720) - s * N(1. / 40320)),
        (N(1. / 12) + s * N(1. / 720)) + s2 * (N(1. / 30240) + s * N(1. / 1209600))};
    const auto is_small = s <= N(kSmallAngleRad * kSmallAngleRad);
    if constexpr (ManyLanes<N>) {
      return all(is_small) ? small : select_each(is_small, small, by_half_angle(s));
    } else {
      return is_small ? small : by_half_angle(s);
    }
  }

  template <class Mask>
  [[gnu::always_inline]] static Coefficients select_each(const Mask& mask, const Coefficients& yes,
                                                         const Coefficients& no) {
    return {select(mask, yes.A, no.A), select(mask, yes.B, no.B), select(mask, yes.g, no.g)};
  }

  /// From P and D of u = (θ/2)² (so3.hpp), seven terms.
  static Coefficients by_half_angle(const N& s) {
    const N u = N(0.25) * s;
    constexpr double kTerm[] = {0.25 / 6,           -0.25 / 120,       0.25 / 5040,
                                -0.25 / 362880,     0.25 / 39916800.0, -0.25 / 6227020800.0,
                                0.25 / 1307674368e3};  // ¼ (-1)^k/(2k+3)!
    N P = N(kTerm[6]), D = N(14 * kTerm[6]);
    for (int k = 5; k >= 0; --k) {
      P = N(kTerm[k]) + u * P;
      D = N((2 * k + 2) * kTerm[k]) + u * D;
    }
    const auto within_pi = u <= N(2.5);
    if constexpr (ManyLanes<N>) {
      P = select(within_pi, P, N(std::numeric_limits<float>::quiet_NaN()));
    } else if (!within_pi) {
      return beyond_pi(s);
    }
    const N S = N(1) - s * P;
    return {S * (S - s * D), N(0.5) * (S * S), D / S};
  }

  static Coefficients beyond_pi(float s) {
    const double squared = s, half = std::sqrt(0.25 * squared);
    const SinCos<double> a = sincos(half);
    const double S = a.sin / half;
    return {static_cast<float>(S * a.cos), static_cast<float>(0.5 * S * S),
            static_cast<float>((S - a.cos) / (squared * S))};
  }

  /// a psi×v + b psi×(psi×v)
  [[gnu::always_inline]] Vec3<N> about(const Vec3<N>& v, const N& a, const N& b) const {
    const Vec3<N> c = cross(psi_, v);
    return a * c + b * cross(psi_, c);
  }

  Vec3<N> psi_;
  Coefficients c_;
};

}  // namespace adstar
