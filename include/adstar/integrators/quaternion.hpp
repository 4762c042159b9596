#pragma once
// Runge-Kutta on attitude quaternion and body momentum: what is run most, and its projection onto
// exact momentum.
//
//   q'    = ½ q (0, omega_B)                        (Hamilton 1844; Wie, Space Vehicle Dynamics, 5.3)
//   Pi_B' = Pi_B × omega_B + tau_B + R_IBᵀ tau_I     (Euler 1758),   omega_B = J_B⁻¹ Pi_B
//   G'    = R_IB tau_B + tau_I                      impulse, in I
//   W'    = omega_B · (tau_B + R_IBᵀ tau_I)         work
// as one system in R⁴ × R³ × R³ × R over any explicit tableau; then q is divided by its length.
// Stages leave the unit sphere by O(h²), and R is read from q as it is: the extension of the
// equations off the sphere is smooth and the exact flow stays on it, so the order is the tableau's.
//
// classical: H_{n+1} = R_{n+1} Pi_{n+1}. A free body's inertial momentum drifts, an error O(h^p).
// projected: H_{n+1} = H_n + G, and Pi_B is read from it when the next step begins: H_I of a free
// body is constant to the last bit and obeys the impulse balance to round-off always.
//
// The length that a step gives q before it is divided out is a free sign of trouble (RK4 turning by x
// at a steady rate: |q|² - 1 = -x⁶/4608 + ...). Off by more than a twentieth, or no number, the step
// has not followed: q_IB is left no number, H_I changed by the impulse alone.
// Energy: not conserved, O(h^p). Cost: one evaluation of the torque a stage, none on a free body,
// whose G and W cost nothing.

#include <limits>
#include <utility>

#include "adstar/bodies/rigid_body.hpp"
#include "adstar/integrators/dop853.hpp"
#include "adstar/integrators/scheme.hpp"
#include "adstar/integrators/stage_torque.hpp"
#include "adstar/integrators/tableaus.hpp"
#include "adstar/state.hpp"

namespace adstar {
namespace detail {

/// A quaternion near the unit sphere, or far from it: 1/|q| and 2/|q|². By series in |q|² - 1 where
/// steps of moderate length leave it, by a root past that.
template <class T>
struct Length {
  T inverse, twice_inverse_squared;
  bool followed = true;  ///< off by less than a twentieth

  [[gnu::always_inline]] explicit Length(const Quat<T>& q) {
    const T squared = squared_norm(q);
    const T d = squared - T(1);
    inverse = T(1) - d * (T(0.5) - T(0.375) * d);
    twice_inverse_squared = T(2) - T(2) * d * (T(1) - d);
    // The next terms, 5/16 d³ and 2 d³, are far below round-off here. Wider scalars get the root.
    constexpr int kDigits = std::numeric_limits<T>::digits;
    constexpr double kNear = kDigits <= 24 ? 1e-3 : kDigits <= 53 ? 1e-6 : 0;
    if (!(d <= T(kNear) && d >= T(-kNear))) [[unlikely]] {
      inverse = one_over_root(squared);
      twice_inverse_squared = T(2) * inverse * inverse;
      followed = d < T(0.05) && d > T(-0.05);
      if (!followed) {
        inverse = std::numeric_limits<T>::quiet_NaN();
      }
    }
  }

 private:
  /// Out of line: the rarer length leaves the registers to the common one.
  [[gnu::noinline]] static T one_over_root(T squared) {
    using std::sqrt;
    return T(1) / sqrt(squared);
  }
};

/// R v of a q of any length: q v q*/|q|² = v + 2/|q|² (w u×v + u×(u×v)). The length is needed last,
/// so v does not wait for it.
template <class T>
[[gnu::always_inline]] inline Vec3<T> rotate_by_any(const Quat<T>& q, const Length<T>& length,
                                                    const Vec3<T>& v) {
  const Vec3<T> u{q.x, q.y, q.z};
  const Vec3<T> t = cross(u, v);
  return v + length.twice_inverse_squared * (q.w * t + cross(u, t));
}

/// Pi × J⁻¹ Pi, on principal axes as products of two components; each is made a rate first, as no square
/// of 1e-200 or 1e200 N m s can be written.
template <class T>
[[gnu::always_inline]] inline Vec3<T> gyroscopic(const RigidBody<T>& body, const Vec3<T>& Pi,
                                                 const Vec3<T>& omega_B) {
  if (body.on_principal_axes()) {
    const Vec3<T> a = body.inverse_diagonal();
    return {((a.z - a.y) * Pi.y) * Pi.z, ((a.x - a.z) * Pi.z) * Pi.x, ((a.y - a.x) * Pi.x) * Pi.y};
  }
  return cross(Pi, omega_B);
}
template <class AnyBody, class T>
[[gnu::always_inline]] inline Vec3<T> gyroscopic(const AnyBody&, const Vec3<T>& Pi,
                                                 const Vec3<T>& omega_B) {
  return cross(Pi, omega_B);
}

}  // namespace detail

template <class Tableau, bool Projected>
struct QuaternionRk {
  using Nodes = Tableau;  ///< where torques of time alone are asked, known before the step
  static constexpr int kOrder = Tableau::kOrder;
  static constexpr double kStageReach = 1;
  static constexpr double kSubstepAngleRad = kOrder >= 8 ? 1.5 : kOrder >= 5 ? 0.75 : 0.5;
  static constexpr int kLeakPower = Projected ? kOrder : 0;  ///< Pi_B is read through q once a step
  static constexpr Claims kClaims{.exact_momentum = Projected};
  static constexpr bool kTakesAnyBody = true;  ///< that has angular_velocity()
  template <class T>
  using Body = RigidBody<T>;

  /// Advances `state` by h [s]. Never throws, never allocates.
  template <class AnyBody, class T, class Torque>
  static void step(const AnyBody& body, State<T>& state, const T& h, const Torque& torque) {
    step(body, state, h, torque, std::make_integer_sequence<int, Tableau::kStages>{});
  }

 private:
  /// Slopes at the stages; those of q doubled.
  template <class T>
  struct Slopes {
    Quat<T> q[Tableau::kStages];
    Vec3<T> Pi[Tableau::kStages];
    Vec3<T> impulse[Tableau::kStages];
    T work[Tableau::kStages];
  };

  template <class AnyBody, class T, class Torque, int... I>
  [[gnu::always_inline]] static void step(const AnyBody& body, State<T>& state, const T& h,
                                          const Torque& torque, std::integer_sequence<int, I...>) {
    const Quat<T> q_n{state.q_IB.w, state.q_IB.x, state.q_IB.y, state.q_IB.z};
    const Vec3<T> Pi_n = rotate_inverse(q_n, state.H_I.value());
    Slopes<T> k;
    (stage<I>(body, q_n, Pi_n, h, torque, k), ...);

    const T half_h = T(0.5) * h;
    // The increments first, so that what they are added to is rounded once.
    Quat<T> dq{T(0), T(0), T(0), T(0)};
    (add<!Tableau::b[I].is_zero()>(dq, half_h, Tableau::b[I], k.q[I]), ...);
    const Quat<T> q{q_n.w + dq.w, q_n.x + dq.x, q_n.y + dq.y, q_n.z + dq.z};
    const detail::Length<T> length(q);
    if constexpr (!Torque::kFree) {
      Vec3<T> impulse_I{};
      T work = T(0);
      (add<!Tableau::b[I].is_zero()>(impulse_I, h, Tableau::b[I], k.impulse[I]), ...);
      ((work = work + (h * Tableau::b[I].template as<T>()) * k.work[I]), ...);
      if (Projected || !length.followed) {
        state.H_I.add(impulse_I);
      }
      state.impulse_I.add(impulse_I);
      state.work.add(work);
    }
    if constexpr (!Projected) {
      Vec3<T> dPi{};
      (add<!Tableau::b[I].is_zero()>(dPi, h, Tableau::b[I], k.Pi[I]), ...);
      if (length.followed) {
        const Vec3<T> H_I = detail::rotate_by_any(q, length, Pi_n + dPi);
        state.H_I = {{H_I.x, T(0)}, {H_I.y, T(0)}, {H_I.z, T(0)}};
      }
    }
    const T n = length.inverse;
    state.q_IB = {n * q.w, n * q.x, n * q.y, n * q.z};
  }

  template <int I, class AnyBody, class T, class Torque>
  [[gnu::always_inline]] static void stage(const AnyBody& body, const Quat<T>& q_n,
                                           const Vec3<T>& Pi_n, const T& h, const Torque& torque,
                                           Slopes<T>& k) {
    Quat<T> q{q_n.w, q_n.x, q_n.y, q_n.z};
    Vec3<T> Pi{Pi_n.x, Pi_n.y, Pi_n.z};
    combine<I>(q, Pi, h, k, std::make_integer_sequence<int, I>{});
    const Vec3<T> omega_B = body.angular_velocity(Pi);
    // 2 q' = q (0, omega_B)
    k.q[I] = {-(q.x * omega_B.x) - (q.y * omega_B.y + q.z * omega_B.z),
              q.w * omega_B.x + (q.y * omega_B.z - q.z * omega_B.y),
              q.w * omega_B.y + (q.z * omega_B.x - q.x * omega_B.z),
              q.w * omega_B.z + (q.x * omega_B.y - q.y * omega_B.x)};
    k.Pi[I] = detail::gyroscopic(body, Pi, omega_B);
    if constexpr (!Torque::kFree) {
      const T since = h * Tableau::c[I].template as<T>();
      const Rotation<T> none;
      const TorqueSample<T> tau = torque.function(Stage<T>{since, omega_B, q, none, I});
      Vec3<T> total_B = tau.body;
      k.impulse[I] = rotate(q, tau.body);
      if constexpr (Torque::kInertial) {
        total_B = total_B + rotate_inverse(q, tau.inertial);
        k.impulse[I] = k.impulse[I] + tau.inertial;
      }
      k.Pi[I] = k.Pi[I] + total_B;
      k.work[I] = dot(omega_B, total_B);
    }
  }

  /// q_n + h Σ_{j<I} a_Ij q'_j and the same of Pi, zero entries left out at compile time.
  template <int I, class T, int... J>
  [[gnu::always_inline]] static void combine(Quat<T>& q, Vec3<T>& Pi, const T& h,
                                             const Slopes<T>& k, std::integer_sequence<int, J...>) {
    [[maybe_unused]] const T half_h = T(0.5) * h;
    (add<!Tableau::a[I][J].is_zero()>(q, half_h, Tableau::a[I][J], k.q[J]), ...);
    (add<!Tableau::a[I][J].is_zero()>(Pi, h, Tableau::a[I][J], k.Pi[J]), ...);
  }

  template <bool Present, class T, class Weight>
  [[gnu::always_inline]] static void add(Vec3<T>& sum, const T& h, const Weight& weight,
                                         const Vec3<T>& k) {
    if constexpr (Present) {
      sum = sum + (h * weight.template as<T>()) * k;
    }
  }
  template <bool Present, class T, class Weight>
  [[gnu::always_inline]] static void add(Quat<T>& sum, const T& h, const Weight& weight,
                                         const Quat<T>& k) {
    if constexpr (Present) {
      const T w = h * weight.template as<T>();
      sum = {sum.w + w * k.w, sum.x + w * k.x, sum.y + w * k.y, sum.z + w * k.z};
    }
  }
};

struct QuaternionRk4 : QuaternionRk<Rk4, false> {
  static constexpr const char* kName = "quaternion_rk4";
};
struct ProjectedRk4 : QuaternionRk<Rk4, true> {
  static constexpr const char* kName = "projected_rk4";
};
struct ProjectedDopri5 : QuaternionRk<Dopri5, true> {
  static constexpr const char* kName = "projected_dopri5";
};
struct ProjectedVerner6 : QuaternionRk<Verner6, true> {
  static constexpr const char* kName = "projected_verner6";
};
struct ProjectedFehlberg8 : QuaternionRk<Fehlberg8, true> {
  static constexpr const char* kName = "projected_fehlberg8";
};
struct ProjectedDop853 : QuaternionRk<Dop853, true> {
  static constexpr const char* kName = "projected_dop853";
};

}  // namespace adstar
