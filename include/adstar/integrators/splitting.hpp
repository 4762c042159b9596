#pragma once
// Splitting for a body under torque: free motion and kicks in turn, over any composition and any
// scheme of the free body.
//
//   A:  q_IB moves freely at constant H_I, time runs        (the free scheme, with its own error)
//   B:  H_I' = R_IB tau_B + tau_I, W' = omega_B · tau; attitude and time stand still:
//       H_I += b h R_IB tau_B + b h tau_I                          exact for a torque of time and attitude
//       W   += ½ (omega_before + omega_after) · ΔPi_B              exact always: E is a square of Pi_B
// A torque that looks at omega_B changes within its own kick: B is then one step of the classical
// Runge-Kutta method (Kutta 1901), with an error of the fifth power of the torque, and W as before.
//
// Order: the composition's, and the free scheme's of small steps. The body moves by A alone, so under a
// weak torque the error is the torque's share of it (compositions.hpp: ε h^2n + ε² h^p). H_I: changes
// by the impulse alone, balance to round-off. E - E_0 - W: round-off, of the free scheme: it says nothing
// about the accuracy of the motion. Cost: one evaluation of the torque a kick (four if it looks at
// omega_B), one free step a drift; a free body is taken through the same drifts.

#include <algorithm>
#include <cstddef>
#include <limits>
#include <type_traits>

#include "adstar/attitude.hpp"
#include "adstar/integrators/compositions.hpp"
#include "adstar/integrators/moser_veselov.hpp"
#include "adstar/integrators/scheme.hpp"
#include "adstar/integrators/stage_torque.hpp"
#include "adstar/state.hpp"

namespace adstar {

template <class Composition, class FreeScheme>
struct Splitting {
  static constexpr int kOrder = Composition::kOrder;
  static constexpr int kFreeOrder = FreeScheme::kOrder;  ///< without torque
  static constexpr double kStageReach = FreeScheme::kStageReach;
  static constexpr double kWeakReach = FreeScheme::kStageReach * longest_drift<Composition>();
  static constexpr double kSubstepAngleRad = FreeScheme::kSubstepAngleRad;
  static constexpr int kLeakPower = FreeScheme::kLeakPower;
  static constexpr Claims kClaims{.exact_momentum = true,
                                  .exact_energy = FreeScheme::kClaims.exact_energy,
                                  .reversible = FreeScheme::kClaims.reversible};
  template <class T>
  using Body = BodyOf<FreeScheme, T>;

  /// Advances `state` by h [s]. Never throws, never allocates. A drift that the free scheme cannot
  /// follow leaves q_IB no number and H_I changed by the impulse alone, at the attitudes before it.
  template <class T, class Torque>
  static void step(const std::type_identity_t<Body<T>>& body, State<T>& state, const T& h,
                   const Torque& torque) {
    Motion<T> motion{{state.q_IB.w, state.q_IB.x, state.q_IB.y, state.q_IB.z},
                     state.H_I.value(),
                     {},
                     T(0),
                     T(0),
                     true};
    const Vec3<T> H_n = motion.H_I;
    for (int i = 0; i < Composition::kKicks; ++i) {
      drift(body, motion, h * Composition::a[i].template as<T>());
      if constexpr (!Torque::kFree) {
        kick(body, motion, h * Composition::b[i].template as<T>(), torque);
        motion.H_I = H_n + motion.impulse_I;
      }
    }
    drift(body, motion, h * Composition::a[Composition::kKicks].template as<T>());
    state.q_IB = motion.q_IB;
    if (!motion.followed) {
      state.q_IB.w = std::numeric_limits<T>::quiet_NaN();
    }
    if constexpr (!Torque::kFree) {
      state.H_I.add(motion.impulse_I);
      state.impulse_I.add(motion.impulse_I);
      state.work.add(motion.work);
    }
  }

 private:
  /// Where the step has come to.
  template <class T>
  struct Motion {
    Quat<T> q_IB;
    Vec3<T> H_I, impulse_I;
    T work, time_s;
    bool followed;
  };

  template <class T>
  [[gnu::always_inline]] static void drift(const Body<T>& body, Motion<T>& motion, const T& h) {
    const Quat<T> q = moved(body, motion.q_IB, motion.H_I, h);
    const T squared = squared_norm(q);
    if (squared > T(0.5) && squared < T(2)) [[likely]] {
      motion.q_IB = q;
    } else {
      motion.followed = false;
    }
    motion.time_s = motion.time_s + h;
  }

  template <class T>
  [[gnu::always_inline]] static Quat<T> moved(const Body<T>& body, const Quat<T>& q,
                                              const Vec3<T>& H_I, const T& h) {
    if constexpr (requires { FreeScheme::moved(body, q, H_I, h); }) {
      return FreeScheme::moved(body, q, H_I, h);
    } else {
      State<T> state;
      state.q_IB = q;
      state.H_I.add(H_I);
      FreeScheme::step(body, state, h, NoTorque{});
      return state.q_IB;
    }
  }

  template <class T, class Torque>
  [[gnu::always_inline]] static void kick(const Body<T>& body, Motion<T>& motion, const T& h,
                                          const Torque& torque) {
    const Quat<T>& q = motion.q_IB;
    const Rotation<T> none;
    const Vec3<T> Pi = rotate_inverse_exactly(q, motion.H_I);
    const Vec3<T> omega = body.angular_velocity(Pi);
    TorqueSample<T> tau = torque.function(Stage<T>{motion.time_s, omega, q, none});
    if constexpr (Torque::kOfRate) {
      const auto after = [&](const T& span) {
        const Vec3<T> omega_B = body.angular_velocity(Pi + span * in_body<Torque>(q, tau));
        return torque.function(Stage<T>{motion.time_s, omega_B, q, none});
      };
      const T half = T(0.5) * h;
      TorqueSample<T> mean = tau;
      tau = after(half);
      add(mean, T(2), tau);
      tau = after(half);
      add(mean, T(2), tau);
      tau = after(h);
      add(mean, T(1), tau);
      const T sixth = T(1) / T(6);
      tau = {sixth * mean.body, sixth * mean.inertial};
    }
    const Vec3<T> change = h * in_body<Torque>(q, tau);
    const Vec3<T> omega_after = body.angular_velocity(Pi + change);
    motion.work = motion.work + T(0.5) * dot(omega + omega_after, change);
    Vec3<T> impulse_I = rotate(q, h * tau.body);
    if constexpr (Torque::kInertial) {
      impulse_I = impulse_I + h * tau.inertial;
    }
    motion.impulse_I = motion.impulse_I + impulse_I;
  }

  template <class Torque, class T>
  static Vec3<T> in_body(const Quat<T>& q, const TorqueSample<T>& tau) {
    if constexpr (Torque::kInertial) {
      return tau.body + rotate_inverse(q, tau.inertial);
    } else {
      return tau.body;
    }
  }

  template <class T>
  static void add(TorqueSample<T>& sum, const T& weight, const TorqueSample<T>& tau) {
    sum = {sum.body + weight * tau.body, sum.inertial + weight * tau.inertial};
  }
};

struct SplittingStrang : Splitting<Strang, MoserVeselov16> {
  static constexpr const char* kName = "splitting_strang";
  static constexpr double kPushLimit = 0.2;  ///< guard.hpp; those of order 4 and (10, 2) need none
};
struct SplittingBlanesMoan4 : Splitting<BlanesMoan4, MoserVeselov16> {
  static constexpr const char* kName = "splitting_blanes_moan4";
};
struct SplittingMcLachlan84 : Splitting<McLachlan84, MoserVeselov16> {
  static constexpr const char* kName = "splitting_mclachlan84";
};
struct SplittingMcLachlan102 : Splitting<McLachlan102, MoserVeselov16> {
  static constexpr const char* kName = "splitting_mclachlan102";
};

}  // namespace adstar
