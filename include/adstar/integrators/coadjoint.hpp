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
//
// How far a stage turns. It reaches psi_i = h Σ_j a_ij psi'_j. With Σ_j |a_ij| ≤ 1 that is at most
// h·max|psi'|, which the guard bounds before the step. High-order tableaus have entries that are
// large and cancel (Fehlberg8: Σ_j |a_ij| up to 43, Σ_j a_ij = c_i ≤ 1); the bound by magnitudes
// would split a step of 1 rad into 43 parts, where in truth
//   psi_i = c_i h psi'_0 + h Σ_j a_ij (psi'_j - psi'_0)
// and slopes that agree leave c_i h|omega|. How well they agree is known only inside the step, so it
// is there that stages are watched. A stage past π (dexpinv has its pole at 2π), or at a rate that
// would turn it by more than 2 rad in the step, which no true motion within the guard's 1 rad has,
// makes q_IB no number, and advance() says so. The rate is the sharper sign: Pi_B is carried over by
// the attitude of the stage, so an error of angle e leaks e|Pi| into the lightest axis, and a needle
// spins there at e|Pi|/J_min. The guard counts with c_i ≤ 1 (tests/conformance/overshoot_test.cpp)
// and with the leak (guard.hpp).

#include <limits>
#include <utility>

#include "adstar/bodies/rigid_body.hpp"
#include "adstar/integrators/dop853.hpp"
#include "adstar/integrators/scheme.hpp"
#include "adstar/integrators/stage_torque.hpp"
#include "adstar/integrators/tableaus.hpp"
#include "adstar/so3.hpp"
#include "adstar/state.hpp"

namespace adstar {

template <class Tableau>
struct Coadjoint {
  using Nodes = Tableau;  ///< where torques of time alone are asked, known before the step
  static constexpr int kOrder = Tableau::kOrder;
  static constexpr double kStageReach = 1;
  static constexpr double kSubstepAngleRad = kOrder >= 8   ? 1.5
                                             : kOrder >= 6 ? 1.1
                                             : kOrder >= 5 ? 1.25
                                             : kOrder == 4 ? 0.7
                                                           : 0.075;
  static constexpr int kLeakPower = 1;  ///< stages read Pi_B through their own attitudes
  static constexpr Claims kClaims{.exact_momentum = true};
  /// step() also takes several bodies side by side.
  static constexpr bool kTakesLanes = !(stage_overshoot<Tableau>() > 1);
  static constexpr bool kTakesAnyBody = true;  ///< that has angular_velocity()
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
  static constexpr bool kOvershoots = stage_overshoot<Tableau>() > 1;
  static constexpr double kFarthestSquared = 9.8696;  ///< π² [rad²]
  static constexpr double kFastestSquared = 4;        ///< of h·omega_B [rad²]

  /// Slopes at the stages; room only for what this torque has.
  template <class T, class Torque>
  struct Slopes {
    static constexpr int kForced = Torque::kFree ? 1 : Tableau::kStages;
    Vec3<T> psi[Tableau::kStages];
    Vec3<T> body_impulse[kForced];
    Vec3<T> inertial_impulse[Torque::kInertial ? Tableau::kStages : 1];
    T work[kForced];
    bool too_far = false;  ///< some stage turned past π, or too fast
  };

  template <class AnyBody, class T, class Torque, int... I>
  [[gnu::always_inline]] static void step(const AnyBody& body, State<T>& state, const T& h,
                                          const Torque& torque,
                                          std::integer_sequence<int, I...> stages) {
    const Quat<T> q_n{state.q_IB.w, state.q_IB.x, state.q_IB.y, state.q_IB.z};
    const Vec3<T> Pi_n = rotate_inverse(q_n, state.H_I.value());
    Slopes<T, Torque> k;
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
    const Rotation<T> turn(psi);
    state.q_IB = renormalised(q_n) * turn.quaternion();
    if constexpr (kOvershoots) {
      const Vec3<T> Pi_end =
          turn.exp_inverse(Torque::kFree ? Pi_n : rotate_inverse(q_n, state.H_I.value()));
      if (k.too_far || !followed(turn, h, body.angular_velocity(Pi_end))) {
        state.q_IB.w = std::numeric_limits<T>::quiet_NaN();
      }
    }
  }

  /// Within π, and at no more than 2 rad a step; false for what is no number.
  template <class T>
  [[gnu::always_inline]] static bool followed(const Rotation<T>& turn, const T& h,
                                              const Vec3<T>& omega_B) {
    return turn.squared_angle() <= T(kFarthestSquared) &&
           h * h * squared_norm(omega_B) <= T(kFastestSquared);
  }

  template <int I, class AnyBody, class T, class Torque>
  [[gnu::always_inline]] static void stage(const AnyBody& body, const Quat<T>& q_n,
                                           const Vec3<T>& Pi_n, const T& h, const Torque& torque,
                                           Slopes<T, Torque>& k) {
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
      Vec3<T> Pi_stage{Pi_n.x, Pi_n.y, Pi_n.z};
      if constexpr (!Torque::kFree) {
        Pi_stage = Pi_stage + combined<I>(h, k.body_impulse, earlier);
      }
      if constexpr (Torque::kInertial) {
        Pi_stage = Pi_stage + rotate_inverse(q_n, combined<I>(h, k.inertial_impulse, earlier));
      }
      const Vec3<T> omega_B = body.angular_velocity(turn.exp_inverse(Pi_stage));
      k.psi[I] = turn.dexpinv_minus(omega_B);
      if constexpr (kOvershoots) {
        k.too_far = k.too_far || !followed(turn, h, omega_B);
      }
      if constexpr (!Torque::kFree) {
        const T since = h * Tableau::c[I].template as<T>();
        const TorqueSample<T> tau = torque.function(Stage<T>{since, omega_B, q_n, turn, I});
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

  template <bool Present, class T, class Weight>
  [[gnu::always_inline]] static void accumulate(Vec3<T>& sum, const T& h, const Weight& weight,
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

struct CoadjointDopri5 : Coadjoint<Dopri5> {
  static constexpr const char* kName = "coadjoint_dopri5";
};

struct CoadjointVerner6 : Coadjoint<Verner6> {
  static constexpr const char* kName = "coadjoint_verner6";
};

struct CoadjointFehlberg8 : Coadjoint<Fehlberg8> {
  static constexpr const char* kName = "coadjoint_fehlberg8";
};

struct CoadjointDop853 : Coadjoint<Dop853> {
  static constexpr const char* kName = "coadjoint_dop853";
};

}  // namespace adstar
