#pragma once
// What is known of a rigid body's motion before a step: how fast it can turn, how much an error can
// grow within it, how fast its damping acts.
//
// Speed. With a_i = 1/J_i, the free motion keeps P² = |Pi|² = Σ x_i and 2E = Σ a_i x_i (x_i = Pi_i²),
// and |omega|² = Σ a_i² x_i is linear in x ≥ 0, so its maximum lies where only two x_i differ from zero:
//   |omega|² = (a_i + a_j) 2E - a_i a_j P².
// Pair (smallest J, largest J) is always feasible; the other is (1,2) or (2,3) by the side of the
// separatrix. A torque with ∫|tau| dt ≤ I moves P by at most I and √(2E) by at most I/√J_min (dE/dt =
// omega·tau).
//
// Growth. About the middle axis a deviation grows like exp(λ t), λ = √(A B) P/J_2 with A = (J_2 -
// J_1)/J_1, B = (J_3 - J_2)/J_3 (Euler's equations, linearised there). In u, v = (√(A x_1) ± √(B x_3))/P
// one grows as the other shrinks, and their product stays,
//   u v = δ = 2E J_2/P² - 1,   |u|, |v| ≤ 2√m,   m = A B/(A + B),
// so that one passage stretches an error by at most 4m/|δ|. Errors that come in evenly over h have grown
// by its end, in the mean, by (exp(λ h) - 1)/(λ h). What grows is the error of the momentum: an attitude
// error e through which it is read turns Pi_B by e, u by √A e, √((A + B)/B) times as much in units of √m.
//
// All in units of the power of two next to the momentum, moments too: rates stay rates, and no square
// of 1e200 N m s is formed.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "adstar/bodies/rigid_body.hpp"
#include "adstar/vec3.hpp"

namespace adstar {

template <class T>
struct MotionBounds {
  std::array<T, 3> rate;  ///< unit/J_i, descending [rad/s]
  T P;                    ///< |Pi_B| [unit]
  T P_squared;
  T two_E;    ///< [unit rad/s]
  T impulse;  ///< what torques may add to the momentum over the span [unit]

  MotionBounds(const RigidBody<T>& body, const Vec3<T>& Pi_B, const T& impulse_n_m_s) {
    using std::sqrt;
    const T unit = power_of_two(Pi_B, impulse_n_m_s);
    const T over = T(1) / unit;
    const Vec3<T> Pi = over * Pi_B;
    for (std::size_t i = 0; i < 3; ++i) {
      rate[i] = unit * body.inverse_moments()[i];
    }
    P_squared = squared_norm(Pi);
    P = sqrt(P_squared);
    two_E = unit * (T(2) * body.energy(Pi));
    impulse = over * impulse_n_m_s;
  }

 private:
  static T power_of_two(const Vec3<T>& Pi, const T& impulse) {
    using std::abs;
    using std::frexp;
    using std::ldexp;
    T largest = impulse;
    for (const T& x : {Pi.x, Pi.y, Pi.z}) {
      const T size = abs(x);
      largest = size > largest ? size : largest;
    }
    if (!(largest > T(0)) || !(largest <= std::numeric_limits<T>::max())) {
      return T(1);  // what is no number stays none
    }
    int exponent = 0;
    frexp(largest, &exponent);
    // Its inverse must be a number too.
    constexpr int kMost = std::numeric_limits<T>::max_exponent - 2;
    return ldexp(T(1), std::clamp(exponent, -kMost, kMost));
  }
};

/// Upper bound of |omega_B|² [rad²/s²] over the span.
template <class T>
T angular_speed_bound_squared(const MotionBounds<T>& motion) {
  using std::isnan;
  using std::sqrt;
  // Not max(): what is no number must stay none, or a ruined momentum would count as a slow one.
  const auto not_negative = [](const T& x) { return x < T(0) ? T(0) : x; };
  const auto& [a1, a2, a3] = motion.rate;
  T P_squared = motion.P_squared;
  T two_E = motion.two_E;
  if (!(motion.impulse <= T(0))) {
    const T P = not_negative(motion.P - motion.impulse);
    const T root = sqrt(not_negative(two_E)) + motion.impulse * sqrt(a1);
    P_squared = P * P;
    two_E = root * root;
  }
  const T outer = (a1 + a3) * two_E - a1 * a3 * P_squared;
  const T inner = two_E >= a2 * P_squared ? (a1 + a2) * two_E - a1 * a2 * P_squared
                                          : (a2 + a3) * two_E - a2 * a3 * P_squared;
  return not_negative(inner > outer || isnan(inner) ? inner : outer);
}

/// The same of a span in which the torques' impulse is at most `impulse` [N m s].
template <class T>
T angular_speed_bound_squared(const RigidBody<T>& body, const Vec3<T>& Pi_B, const T& impulse) {
  return angular_speed_bound_squared(MotionBounds<T>(body, Pi_B, impulse));
}

/// exp(x), x ≥ 0, within a part in 1e5 up to 100: of nobody's library, as the count of parts follows it.
template <class T>
T growth_over(const T& x) {
  constexpr int kSquarings = 14;
  const T y = x / T(1 << kSquarings);
  T e = T(1) + y * (T(1) + y * (T(1) / T(2)) * (T(1) + y * (T(1) / T(3))));
  for (int i = 0; i < kSquarings; ++i) {
    e = e * e;
  }
  return e;
}

/// Whether a scheme reads the momentum through the attitude that it steps.
enum class Reading : std::uint8_t { none, once, at_stages };

/// By how much an error has grown by the end of a span of h [s] in which it comes in evenly; at least
/// 1. Twofold growth is in the limits of angle, which were measured over four parts; a scheme that steps the
/// momentum by itself errs in it less than a sixty-fourth of what its attitude does (measured).
template <class T>
T error_growth(const MotionBounds<T>& motion, const T& h, Reading reading) {
  using std::sqrt;
  const auto not_negative = [](const T& x) { return x < T(0) ? T(0) : x; };
  const auto& [a1, a2, a3] = motion.rate;
  const T A = not_negative(a1 / a2 - T(1)), B = not_negative(T(1) - a3 / a2);
  const T impulse = not_negative(motion.impulse);
  const T x = h * a2 * (motion.P + impulse) * sqrt(A * B);
  if (x <= T(1)) {  // less than twofold
    return T(1);
  }
  const T mean = (growth_over(x) - T(1)) / x;
  // δ nearest to zero that energy and momentum can reach.
  const T root = sqrt(not_negative(motion.two_E));
  const T more = root + impulse * sqrt(a1), less = not_negative(root - impulse * sqrt(a1));
  const T P_more = motion.P + impulse, P_less = not_negative(motion.P - impulse);
  const T lowest = less * less - a2 * (P_more * P_more);  // δ a_2 P²
  const T highest = more * more - a2 * (P_less * P_less);
  const T distance = lowest > T(0) ? lowest : highest < T(0) ? -highest : T(0);
  const T passage = T(4) * (A * B / (A + B)) * a2 * (P_more * P_more) / distance;
  const T growth = (passage < mean ? passage : mean) - T(2);
  const T share = reading == Reading::none   ? T(1) / T(64)
                  : reading == Reading::once ? T(1)
                                             : T(2) * sqrt((A + B) / B);
  return growth > T(0) ? T(1) + share * growth : T(1);
}

/// The fastest rate [1/s] at which a damping torque -c omega_B, c ≥ 0 per axis [N m s/rad], takes the
/// rate down, at most: an eigenvalue of J⁻¹ c, none of them above their sum.
template <class T>
T decay_rate(const RigidBody<T>& body, const Vec3<T>& c) {
  const Vec3<T> a = body.inverse_diagonal();
  const T x = c.x * a.x, y = c.y * a.y, z = c.z * a.z;
  if (body.on_principal_axes()) {
    return std::max(std::max(x, y), z);
  }
  return std::min(x + y + z, std::max(std::max(c.x, c.y), c.z) * body.inverse_moments()[0]);
}

}  // namespace adstar
