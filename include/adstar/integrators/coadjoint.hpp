#pragma once
// The forced coadjoint scheme over any explicit Runge-Kutta tableau (Terze, Müller, Zlatar, eq. 3
// to 7).
//
// Within a step R_IB(t) = R_n exp(psi), psi(t_n) = 0, and the Runge-Kutta step is taken on
//   psi' = dexpinv(-psi, omega_B)                                                (eq. 4)
//   J'   = exp(psi) tau_B       impulse of body torques, in the frame of R_n     (the integral of eq. 7)
//   G'   = tau_I                impulse of inertial torques, in I
//   W'   = omega_B · tau        work
// with Pi_B = exp(-psi) (R_nᵀ (H_n + G) + J), the coadjoint action (eq. 3, 7), omega_B = J_B⁻¹ Pi_B. Then
//   R_{n+1} = R_n exp(psi),   H_{n+1} = H_n + R_n J + G                          (eq. 7, times R_{n+1}).
//
// Order: the tableau's. H_I: constant to the last bit on a free body; obeys the impulse balance to
// round-off always; its error under a body-frame torque is the quadrature's, O(h^p) of the impulse.
// Energy: not conserved, error O(h^p). Cost: one evaluation of the torque a stage, none on a free
// body.

#include <utility>

#include "adstar/bodies/rigid_body.hpp"
#include "adstar/integrators/scheme.hpp"
#include "adstar/integrators/stage_torque.hpp"
#include "adstar/integrators/tableaus.hpp"
#include "adstar/so3.hpp"
#include "adstar/state.hpp"

namespace adstar {

template <class Tableau>
struct Coadjoint {
  static constexpr int kOrder = Tableau::kOrder;
  static constexpr double kStageReach = stage_reach<Tableau>();
  static constexpr Claims kClaims{.exact_momentum = true};
  static constexpr bool kTakesLanes = true;  ///< step() also takes several bodies side by side
  template <class T>
  using Body = RigidBody<T>;

  /// Advances `state` by h [s]. Never throws, never allocates. `AnyBody`: RigidBody<T>, or the
  /// bodies of several lanes.
  template <class AnyBody, class T, class Torque>
  [[gnu::always_inline]] static void step(const AnyBody& body, State<T>& state, const T& h,
                                          const Torque& torque) {
    step(body, state, h, torque, std::make_integer_sequence<int, Tableau::kStages>{});
  }

 private:
  /// Slopes at the stages.
  template <class T>
  struct Slopes {
    Vec3<T> psi[Tableau::kStages];
    Vec3<T> body_impulse[Tableau::kStages];
    Vec3<T> inertial_impulse[Tableau::kStages];
    T work[Tableau::kStages];
  };

  template <class AnyBody, class T, class Torque, int... I>
  [[gnu::always_inline]] static void step(const AnyBody& body, State<T>& state, const T& h,
                                          const Torque& torque,
                                          std::integer_sequence<int, I...> stages) {
    const Quat<T> q_n = state.q_IB;
    const Vec3<T> Pi_n = rotate_inverse(q_n, state.H_I.value());
    Slopes<T> k;
    (stage<I>(body, q_n, Pi_n, h, torque, k), ...);

    const Vec3<T> psi = weighted(h, k.psi, stages);
    if constexpr (!Torque::kFree) {
      Vec3<T> impulse_I = rotate(q_n, weighted(h, k.body_impulse, stages));
      if constexpr (Torque::kInertial) {
        impulse_I = impulse_I + weighted(h, k.inertial_impulse, stages);
      }
      state.H_I.add(impulse_I);
      state.impulse_I.add(impulse_I);
      T work = T(0);
      ((work = work + (h * Tableau::b[I].template as<T>()) * k.work[I]), ...);
      state.work.add(work);
    }
    // Renormalised before the product, not after: the next step need not wait for it, and |q|²
    // stays 1 to round-off.
    state.q_IB = renormalised(q_n) * Rotation<T>(psi).quaternion();
  }

  template <int I, class AnyBody, class T, class Torque>
  [[gnu::always_inline]] static void stage(const AnyBody& body, const Quat<T>& q_n,
                                           const Vec3<T>& Pi_n, const T& h, const Torque& torque,
                                           Slopes<T>& k) {
    if constexpr (I == 0) {
      // psi = 0: exp and dexpinv are the identity.
      const Vec3<T> omega_B = body.angular_velocity(Pi_n);
      k.psi[0] = omega_B;
      if constexpr (!Torque::kFree) {
        const Rotation<T> none;
        const TorqueSample<T> tau = torque.function(Stage<T>{T(0), omega_B, q_n, none});
        k.body_impulse[0] = tau.body;
        k.work[0] = dot(omega_B, tau.body);
        if constexpr (Torque::kInertial) {
          k.inertial_impulse[0] = tau.inertial;
          k.work[0] = k.work[0] + dot(omega_B, rotate_inverse(q_n, tau.inertial));
        }
      }
    } else {
      constexpr auto earlier = std::make_integer_sequence<int, I>{};
      const Rotation<T> turn(combined<I>(h, k.psi, earlier));
      // Pi_B = exp(-psi) (R_nᵀ (H_n + G) + J)
      Vec3<T> Pi_stage = Pi_n;
      if constexpr (!Torque::kFree) {
        Pi_stage = Pi_stage + combined<I>(h, k.body_impulse, earlier);
      }
      if constexpr (Torque::kInertial) {
        Pi_stage = Pi_stage + rotate_inverse(q_n, combined<I>(h, k.inertial_impulse, earlier));
      }
      const Vec3<T> omega_B = body.angular_velocity(turn.exp_inverse(Pi_stage));
      k.psi[I] = turn.dexpinv_minus(omega_B);
      if constexpr (!Torque::kFree) {
        const T since = h * Tableau::c[I].template as<T>();
        const TorqueSample<T> tau = torque.function(Stage<T>{since, omega_B, q_n, turn});
        k.body_impulse[I] = turn.exp(tau.body);
        k.work[I] = dot(omega_B, tau.body);
        if constexpr (Torque::kInertial) {
          k.inertial_impulse[I] = tau.inertial;
          k.work[I] = k.work[I] + dot(turn.exp(omega_B), rotate_inverse(q_n, tau.inertial));
        }
      }
    }
  }

  /// h Σ_{j<I} a_Ij k_j, zero entries left out at compile time.
  template <int I, class T, int... J>
  [[gnu::always_inline]] static Vec3<T> combined(const T& h, const Vec3<T>* k,
                                                 std::integer_sequence<int, J...>) {
    Vec3<T> sum{};
    (accumulate<!Tableau::a[I][J].is_zero()>(sum, h, Tableau::a[I][J], k[J]), ...);
    return sum;
  }

  /// h Σ b_i k_i
  template <class T, int... I>
  [[gnu::always_inline]] static Vec3<T> weighted(const T& h, const Vec3<T>* k,
                                                 std::integer_sequence<int, I...>) {
    Vec3<T> sum{};
    (accumulate<!Tableau::b[I].is_zero()>(sum, h, Tableau::b[I], k[I]), ...);
    return sum;
  }

  template <bool Present, class T>
  [[gnu::always_inline]] static void accumulate(Vec3<T>& sum, const T& h, const Fraction& weight,
                                                const Vec3<T>& k) {
    if constexpr (Present) {
      sum = sum + (h * weight.template as<T>()) * k;
    }
  }
};

/// The paper's scheme.
struct CoadjointRk4 : Coadjoint<Rk4> {
  static constexpr const char* kName = "coadjoint_rk4";
};

struct CoadjointMidpoint2 : Coadjoint<Midpoint2> {
  static constexpr const char* kName = "coadjoint_midpoint2";
};

}  // namespace adstar
