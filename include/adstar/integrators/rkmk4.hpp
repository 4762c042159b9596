#pragma once
// Runge-Kutta-Munthe-Kaas of order four with the momentum equation in vector space: what the paper
// compares its scheme with (Terze, Müller, Zlatar, Fig. 3).
//
// Within a step R_IB(t) = R_n exp(psi), psi(t_n) = 0 (Munthe-Kaas 1998), and the classical
// Runge-Kutta step is taken on
//   psi'  = dexpinv(-psi, omega_B)
//   Pi_B' = Pi_B × omega_B + tau_B + R_IBᵀ tau_I,   omega_B = J_B⁻¹ Pi_B      (Euler 1758)
//   G'    = R_n exp(psi) tau_B + tau_I              impulse, in I
//   W'    = omega_B · (tau_B + R_IBᵀ tau_I)         work
// Then R_{n+1} = R_n exp(psi), H_{n+1} = R_{n+1} Pi_{n+1}: the rotation is one to round-off, but
// attitude and momentum each carry their own error, so a free body's H_I drifts, O(h⁴).
// A turn past π has not been followed: q_IB is left no number, H_I changed by the impulse alone.
// Order 4. Energy: not conserved. Cost: four evaluations of the torque, none on a free body.

#include <limits>

#include "adstar/bodies/rigid_body.hpp"
#include "adstar/integrators/scheme.hpp"
#include "adstar/integrators/stage_torque.hpp"
#include "adstar/so3.hpp"
#include "adstar/state.hpp"

namespace adstar {

struct Rkmk4 {
  static constexpr const char* kName = "rkmk4";
  static constexpr int kOrder = 4;
  static constexpr double kStageReach = 1;
  static constexpr double kSubstepAngleRad = 0.5;
  static constexpr int kLeakPower = 0;
  static constexpr Claims kClaims{};
  template <class T>
  using Body = RigidBody<T>;

  /// Advances `state` by h [s]. Never throws, never allocates.
  template <class T, class Torque>
  static void step(const RigidBody<T>& body, State<T>& state, const T& h, const Torque& torque) {
    const Quat<T> q_n{state.q_IB.w, state.q_IB.x, state.q_IB.y, state.q_IB.z};
    const Vec3<T> Pi_n = rotate_inverse(q_n, state.H_I.value());
    const T half = T(0.5) * h;
    const Slope<T> k1 = slope(body, q_n, T(0), Rotation<T>(), Pi_n, torque);
    const Rotation<T> turn2(half * k1.psi);
    const Slope<T> k2 = slope(body, q_n, half, turn2, Pi_n + half * k1.Pi, torque);
    const Rotation<T> turn3(half * k2.psi);
    const Slope<T> k3 = slope(body, q_n, half, turn3, Pi_n + half * k2.Pi, torque);
    const Rotation<T> turn4(h * k3.psi);
    const Slope<T> k4 = slope(body, q_n, h, turn4, Pi_n + h * k3.Pi, torque);
    const Rotation<T> turn(simpson(h, k1.psi, k2.psi, k3.psi, k4.psi));

    Quat<T> q = renormalised(q_n) * turn.quaternion();
    const bool followed = near(turn2) && near(turn3) && near(turn4) && near(turn);
    if constexpr (!Torque::kFree) {
      Vec3<T> impulse_I = rotate(q_n, simpson(h, k1.impulse, k2.impulse, k3.impulse, k4.impulse));
      if constexpr (Torque::kInertial) {
        impulse_I = impulse_I + simpson(h, k1.impulse_I, k2.impulse_I, k3.impulse_I, k4.impulse_I);
      }
      state.impulse_I.add(impulse_I);
      state.work.add((h * (T(1) / T(6))) * ((k1.work + k4.work) + T(2) * (k2.work + k3.work)));
      if (!followed) {
        state.H_I.add(impulse_I);
      }
    }
    if (followed) {
      const Vec3<T> H_I = rotate(q, Pi_n + simpson(h, k1.Pi, k2.Pi, k3.Pi, k4.Pi));
      state.H_I = {{H_I.x, T(0)}, {H_I.y, T(0)}, {H_I.z, T(0)}};
    } else {
      q.w = std::numeric_limits<T>::quiet_NaN();
    }
    state.q_IB = q;
  }

 private:
  /// Not past π; false for what is no number.
  template <class T>
  static bool near(const Rotation<T>& turn) {
    constexpr double kPiSquared = 9.8696;
    return turn.squared_angle() <= T(kPiSquared);
  }

  template <class T>
  struct Slope {
    Vec3<T> psi, Pi;
    Vec3<T> impulse;    ///< of body torques, in the frame of R_n
    Vec3<T> impulse_I;  ///< of inertial torques, in I
    T work;
  };

  template <class T, class Torque>
  [[gnu::always_inline]] static Slope<T> slope(const RigidBody<T>& body, const Quat<T>& q_n,
                                               const T& since, const Rotation<T>& turn,
                                               const Vec3<T>& Pi, const Torque& torque) {
    const Vec3<T> omega_B = body.angular_velocity(Pi);
    Slope<T> k{turn.dexpinv_minus(omega_B), cross(Pi, omega_B), {}, {}, T(0)};
    if constexpr (!Torque::kFree) {
      const TorqueSample<T> tau = torque.function(Stage<T>{since, omega_B, q_n, turn});
      Vec3<T> total_B = tau.body;
      k.impulse = turn.exp(tau.body);
      if constexpr (Torque::kInertial) {
        total_B = total_B + turn.exp_inverse(rotate_inverse(q_n, tau.inertial));
        k.impulse_I = tau.inertial;
      }
      k.Pi = k.Pi + total_B;
      k.work = dot(omega_B, total_B);
    }
    return k;
  }

  /// h/6 (a + 2b + 2c + d)
  template <class T>
  [[gnu::always_inline]] static Vec3<T> simpson(const T& h, const Vec3<T>& a, const Vec3<T>& b,
                                                const Vec3<T>& c, const Vec3<T>& d) {
    return (h * (T(1) / T(6))) * ((a + d) + T(2) * (b + c));
  }
};

}  // namespace adstar
