#pragma once
// exp and dexp⁻¹ of se(3), for poses g = (R, x) that move as g' = g (omega_B, v_B).
//
// Within a step g = g_n exp(xi), xi = (psi, rho), and
//   exp(xi) = (exp psi, dexp(psi) rho)
//   xi'     = dexpinv(-xi, V) = (1 + ½ ad + a ad² + b ad⁴) V,   ad (w, v) = (psi×w, psi×v + rho×w)
// ad⁵ = -2θ² ad³ - θ⁴ ad, θ = |psi|, folds the series Σ B_2n/(2n)! ad^2n into a and b (Selig, Geometric
// Fundamentals of Robotics, 2005, section 7; Bullo and Murray 1995). With B_2n the Bernoulli numbers, s = θ²:
//   a = Σ B_2n/(2n)! (2 - n) (-s)^(n-1) = 3g/2 - P(1 + S)/(2S²)  → 1/12
//   b = Σ B_2n/(2n)! (n - 1) (-s)^(n-2) = (g - P(1 + S)/S²)/(2s) → -1/720
// S = sin(θ/2)/(θ/2), P = (1 - S)/s, g = (1 - (θ/2) cot(θ/2))/s of so3.hpp; ours, and free of cancellation
// but for the difference in b. Equal to a = 2/θ² + (θ + 3 sin θ)/(4θ(cos θ - 1)), b = 1/θ⁴ + (θ + sin θ)/(4θ³(cos θ
// - 1)). Singular at θ = 2π. Error below 1e-14 of a, and of b θ⁴ beside 1 (tests/multibody/se3_test.cpp).

#include <array>

#include "adstar/scalar.hpp"
#include "adstar/so3.hpp"
#include "adstar/trig.hpp"
#include "adstar/vec3.hpp"

namespace adstar::multibody {

/// Of a body, in B: (omega_B [rad/s], v_B [m/s]); or xi = (psi [rad], rho [m]).
template <class T>
struct Twist {
  Vec3<T> angular, linear;
};

/// a and b of the head of this file.
template <class T>
struct DexpinvCoefficients {
  T a, b;
};

/// θ up to which the series hold [rad]: what twelve terms of them reach.
inline constexpr double kSeriesAngleRad = 1.0;      // double: s^12/(4π²)^12 = 6e-20
inline constexpr double kWideSeriesAngleRad = 0.1;  // other scalars: 6e-44

namespace detail {

inline constexpr int kSeriesTerms = 12;

/// B_2n/(2n)!, n = 1 to 14.
template <class T>
std::array<T, kSeriesTerms + 2> bernoulli_terms() {
  constexpr double kNumerator[] = {
      1, -1, 1, -1, 5, -691, 7, -3617, 43867, -174611, 854513, -236364091, 8553103, -23749461029.0};
  constexpr double kDenominator[] = {6, 30, 42, 30, 66, 2730, 6, 510, 798, 330, 138, 2730, 6, 870};
  std::array<T, kSeriesTerms + 2> terms{};
  T factorial = T(1);
  for (std::size_t n = 0; n < terms.size(); ++n) {
    factorial = factorial * T(static_cast<int>((2 * n + 1) * (2 * n + 2)));
    terms[n] = T(kNumerator[n]) / (T(kDenominator[n]) * factorial);
  }
  return terms;
}
template <class T>
inline const std::array<T, kSeriesTerms + 2> kBernoulliTerms = bernoulli_terms<T>();

}  // namespace detail

/// Of s = θ² [rad²], by series: below the thresholds above.
template <class T>
DexpinvCoefficients<T> dexpinv_series(const T& s) {
  const auto& beta = detail::kBernoulliTerms<T>;
  T a{}, b{};
  for (int n = detail::kSeriesTerms; n >= 1; --n) {
    const auto i = static_cast<std::size_t>(n - 1);
    a = T(2 - n) * beta[i] - s * a;  // term n of a
    b = T(n) * beta[i + 1] - s * b;  // term n + 1 of b
  }
  return {a, b};
}

/// The same in closed form.
template <class T>
DexpinvCoefficients<T> dexpinv_closed(const T& s) {
  using std::sqrt;
  const T half = T(0.5) * sqrt(s);
  const SinCos<T> angle = sincos(half);
  const T S = angle.sin / half;
  const T q = (T(1) - S * S) / (s * (S * S));
  const T g = (T(1) - angle.cos / S) / s;
  return {T(1.5) * g - T(0.5) * q, (g - q) / (T(2) * s)};
}

template <class T>
DexpinvCoefficients<T> dexpinv_coefficients(const T& s) {
  constexpr double kLimit = Binary64<T> ? kSeriesAngleRad : kWideSeriesAngleRad;
  return s <= T(kLimit * kLimit) ? dexpinv_series(s) : dexpinv_closed(s);
}

/// ad_xi V
template <class T>
Twist<T> ad(const Twist<T>& xi, const Twist<T>& V) {
  return {cross(xi.angular, V.angular), cross(xi.angular, V.linear) + cross(xi.linear, V.angular)};
}

/// xi' of the body twist V.
template <class T>
Twist<T> dexpinv_minus(const Twist<T>& xi, const Twist<T>& V) {
  const DexpinvCoefficients<T> k = dexpinv_coefficients(squared_norm(xi.angular));
  const Twist<T> ad1 = ad(xi, V);
  const Twist<T> ad2 = ad(xi, ad1);
  const Twist<T> ad4 = ad(xi, ad(xi, ad2));
  return {V.angular + (T(0.5) * ad1.angular + (k.a * ad2.angular + k.b * ad4.angular)),
          V.linear + (T(0.5) * ad1.linear + (k.a * ad2.linear + k.b * ad4.linear))};
}

/// The translation of exp(xi), in the frame of g_n [m]; its rotation is `turn`, of psi.
template <class T>
Vec3<T> exp_translation(const Rotation<T>& turn, const Vec3<T>& rho) {
  return turn.dexp(rho);
}

}  // namespace adstar::multibody
