#pragma once
// Lie-Newmark: the member beta = 0, gamma = ½ of Newmark's family on SO(3) in convected form (Simo
// and Vu-Quoc 1988), explicit in attitude and torque, implicit in the angular velocity. Of the explicit
// Newmark forms that Krysl and Endres (2005, Int. J. Numer. Meth. Engng 62:2154) treat, which one this
// is and why: service/decisions/0009.
//
//   alpha_n     = J⁻¹ (tau_n - omega_n × J omega_n)
//   R_{n+1}     = R_n exp(h omega_n + ½ h² alpha_n)
//   omega_{n+1} = omega_n + ½ h (alpha_n + alpha_{n+1})
// the last with y = omega_{n+1}, tau_{n+1} at the new attitude:
//   F(y) = J (y - omega_n) - ½ h (J alpha_n + tau_{n+1} - y × J y) = 0,
//   F'(y) = J + ½ h (hat(y) J - hat(J y)),      solved by Newton from omega_n + h alpha_n.
// A torque that depends on the angular velocity sees that predictor, its error O(h²) times h.
//
// Order 2. A free body's H_I drifts, O(h²), and its energy does too: the scheme is not symplectic.
// impulse and work by the trapezium. Cost: two evaluations of the torque, some six small solves.

#include <limits>

#include "adstar/bodies/rigid_body.hpp"
#include "adstar/integrators/scheme.hpp"
#include "adstar/integrators/stage_torque.hpp"
#include "adstar/so3.hpp"
#include "adstar/state.hpp"

namespace adstar {

struct LieNewmark {
  static constexpr const char* kName = "lie_newmark";
  static constexpr int kOrder = 2;
  static constexpr double kStageReach = 1;
  static constexpr double kSubstepAngleRad = 0.075;
  static constexpr int kLeakPower = 0;
  static constexpr Claims kClaims{};
  static constexpr int kIterations = 20;
  template <class T>
  using Body = RigidBody<T>;

  /// Advances `state` by h [s]. Never throws, never allocates. A turn past π, or a
  /// Newton that does not settle, leaves q_IB no number and H_I changed by the impulse alone.
  template <class T, class Torque>
  static void step(const RigidBody<T>& body, State<T>& state, const T& h, const Torque& torque) {
    const Quat<T> q_n{state.q_IB.w, state.q_IB.x, state.q_IB.y, state.q_IB.z};
    const Vec3<T> Pi_n = rotate_inverse(q_n, state.H_I.value());
    const Vec3<T> omega_n = body.angular_velocity(Pi_n);
    const T half = T(0.5) * h;

    const Rotation<T> none;
    const Load<T> begin = load(q_n, T(0), omega_n, none, torque);
    const Vec3<T> Pi_rate = begin.body + cross(Pi_n, omega_n);  // J alpha_n
    const Vec3<T> alpha_n = body.angular_velocity(Pi_rate);
    const Vec3<T> predicted = omega_n + h * alpha_n;
    const Rotation<T> turn(h * (omega_n + half * alpha_n));
    Quat<T> q = renormalised(q_n) * turn.quaternion();
    const Load<T> end = load(q_n, h, predicted, turn, torque);

    // J y + ½ h y × J y = Pi_n + ½ h (J alpha_n + tau_{n+1})
    const Vec3<T> target = Pi_n + half * (Pi_rate + end.body);
    Vec3<T> y{predicted.x, predicted.y, predicted.z};
    constexpr double kPiSquared = 9.8696;
    const bool settled = turn.squared_angle() <= T(kPiSquared) && solve(body, half, target, y);

    if constexpr (!Torque::kFree) {
      const Vec3<T> impulse_I = half * (begin.impulse_I + end.impulse_I);
      state.impulse_I.add(impulse_I);
      state.work.add(half * (dot(omega_n, begin.body) + dot(y, end.body)));
      if (!settled) {
        state.H_I.add(impulse_I);
      }
    }
    if (settled) {
      const Vec3<T> H_I = rotate(q, body.momentum(y));
      state.H_I = {{H_I.x, T(0)}, {H_I.y, T(0)}, {H_I.z, T(0)}};
    } else {
      q.w = std::numeric_limits<T>::quiet_NaN();
    }
    state.q_IB = q;
  }

 private:
  /// All torques at one end of the step, as a body torque and as the impulse per time that they are.
  template <class T>
  struct Load {
    Vec3<T> body, impulse_I;
  };

  template <class T, class Torque>
  static Load<T> load(const Quat<T>& q_n, const T& since, const Vec3<T>& omega_B,
                      const Rotation<T>& turn, const Torque& torque) {
    Load<T> load{};
    if constexpr (!Torque::kFree) {
      const TorqueSample<T> tau = torque.function(Stage<T>{since, omega_B, q_n, turn});
      load.body = tau.body;
      load.impulse_I = rotate(q_n, turn.exp(tau.body));
      if constexpr (Torque::kInertial) {
        load.body = load.body + turn.exp_inverse(rotate_inverse(q_n, tau.inertial));
        load.impulse_I = load.impulse_I + tau.inertial;
      }
    }
    return load;
  }

  /// Newton on J y + c y × J y = target; false when it has not come to rest within kIterations.
  template <class T>
  static bool solve(const RigidBody<T>& body, const T& c, const Vec3<T>& target, Vec3<T>& y) {
    const Vec3<T> J_x = body.momentum({T(1), T(0), T(0)});
    const Vec3<T> J_y = body.momentum({T(0), T(1), T(0)});
    const Vec3<T> J_z = body.momentum({T(0), T(0), T(1)});
    T before = std::numeric_limits<T>::max();
    for (int i = 0; i < kIterations; ++i) {
      const Vec3<T> Pi = body.momentum(y);
      const Vec3<T> F = (Pi - target) + c * cross(y, Pi);
      // Columns of F': J e + c (y × J e + e × J y).
      const Vec3<T> a = J_x + c * (cross(y, J_x) + Vec3<T>{T(0), -Pi.z, Pi.y});
      const Vec3<T> b = J_y + c * (cross(y, J_y) + Vec3<T>{Pi.z, T(0), -Pi.x});
      const Vec3<T> d = J_z + c * (cross(y, J_z) + Vec3<T>{-Pi.y, Pi.x, T(0)});
      // Cramer's rule
      const Vec3<T> bd = cross(b, d);
      const T scale = T(1) / dot(a, bd);
      const Vec3<T> step{scale * dot(F, bd), scale * dot(F, cross(d, a)),
                         scale * dot(F, cross(a, b))};
      y = y - step;
      // At rest: below round-off of y, or no longer shrinking while within some units of it.
      const T size = squared_norm(step), unit = std::numeric_limits<T>::epsilon();
      const T small = unit * unit * squared_norm(y);
      if (size <= small || (size <= T(1024) * small && size >= before)) {
        return true;
      }
      before = size;
    }
    return false;
  }
};

}  // namespace adstar
