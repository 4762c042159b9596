#pragma once
// The forced coadjoint scheme with a state in double and what the stages add in float.
//
// It is the scheme of coadjoint.hpp, written for what changes within a step. With omega_n, Pi_n, tau_i in
// double and e_i, d_i in float:
//   psi'  = omega_n + d,    d = δomega + (dexpinv(-psi, omega_B) - omega_B)
//   J'    = tau_B + e,      e = exp(psi) tau_B - tau_B
//   δPi   = J + (exp(-psi) - 1) (Pi_n + J),    δomega = J_B⁻¹ δPi,    omega_B = omega_n + δomega
//   W'    = omega_n · tau + δomega · tau
// The first term of each is summed in double, the second in float. A rounding of float then meets only
// what turns within the step: the error is about eps_float |psi| per radian turned, 6e-8 of the second
// order of the step, where stages all in float would lose eps_float per radian whatever the step
// (service/decisions/0012).
//
// Order: the tableau's, down to that error. H_I and the unit quaternion are double's: constant to the
// last bit on a free body, impulse balance to round-off. Stage momenta are divided by the smallest
// moment, J_min, before they are narrowed, and J_B⁻¹ multiplied by it: rates of any body fit a float.
// What does not (past 1e19 rad a step) makes q_IB no number, and advance() says so. A needle: an error of
// float leaks eps_float |psi| h|Pi|/J_min [rad], which the guard bounds by eps_float limit² (guard.hpp).
//
// With any other scalar than double (and lanes of it) nothing is narrowed.

#include <utility>

#include "adstar/added_turn.hpp"
#include "adstar/bodies/rigid_body.hpp"
#include "adstar/integrators/coadjoint.hpp"
#include "adstar/integrators/scheme.hpp"
#include "adstar/integrators/stage_torque.hpp"
#include "adstar/integrators/tableaus.hpp"
#include "adstar/narrow.hpp"
#include "adstar/state.hpp"

namespace adstar {

/// J_min J_B⁻¹, no entry above one.
template <class N>
struct ScaledInertia {
  Sym3<N> inverse;
  bool diagonal;

  [[gnu::always_inline]] Vec3<N> angular_velocity(const Vec3<N>& v) const {
    if (diagonal) {
      return {inverse.xx * v.x, inverse.yy * v.y, inverse.zz * v.z};
    }
    return inverse * v;
  }
};

template <class T>
class FloatStageBody : public RigidBody<T> {
 public:
  using To = Narrower<T>;

  explicit FloatStageBody(const RigidBody<T>& body)
      : RigidBody<T>(body),
        smallest_moment_(T(1) / body.inverse_moments()[0]),
        scaled_{scaled(body.inverse_inertia(), smallest_moment_), body.is_diagonal()} {}

  /// J_min [kg m²]
  const T& smallest_moment() const { return smallest_moment_; }
  const ScaledInertia<NarrowOf<T>>& scaled_inertia() const { return scaled_; }

 private:
  static Sym3<NarrowOf<T>> scaled(const Sym3<T>& m, const T& s) {
    return {To::narrow(s * m.xx), To::narrow(s * m.yy), To::narrow(s * m.zz),
            To::narrow(s * m.xy), To::narrow(s * m.xz), To::narrow(s * m.yz)};
  }

  T smallest_moment_;
  ScaledInertia<NarrowOf<T>> scaled_;
};

/// J_min J_B⁻¹ of the bodies whose lanes make one narrow number; lanes have their own.
template <class T>
[[gnu::always_inline]] inline const ScaledInertia<NarrowOf<T>>& scaled_inertia(
    const FloatStageBody<T>& body) {
  return body.scaled_inertia();
}

template <class Tableau>
struct CoadjointFloat {
  using Wide = Coadjoint<Tableau>;
  static_assert(Wide::kTakesLanes, "stages that overshoot are watched in coadjoint.hpp only");
  static constexpr int kOrder = Wide::kOrder;
  static constexpr double kStageReach = Wide::kStageReach;
  static constexpr double kSubstepAngleRad = Wide::kSubstepAngleRad;
  static constexpr int kLeakPower = Wide::kLeakPower;
  static constexpr Claims kClaims{.exact_momentum = true, .stage_epsilon = 0x1p-23};
  static constexpr bool kTakesLanes = true;
  static constexpr bool kFloatStages = true;
  template <class T>
  using Body = FloatStageBody<T>;

  /// Advances `state` by h [s]. Never throws, never allocates.
  template <class T, class Torque>
  [[gnu::always_inline]] static void step(const FloatStageBody<T>& body, State<T>& state,
                                          const T& h, const Torque& torque) {
    Member<0, FloatStageBody<T>, T, Torque> member(body, state, torque);
    run(h, kAll, member);
  }

  /// The same for the bodies of two registers, whose stages share one.
  template <class Bodies, class L, class Torque>
  [[gnu::always_inline]] static void step(const Bodies& low_bodies, State<L>& low,
                                          const Torque& low_torque, const Bodies& high_bodies,
                                          State<L>& high, const Torque& high_torque, const L& h) {
    Member<0, Bodies, L, Torque> first(low_bodies, low, low_torque);
    Member<1, Bodies, L, Torque> second(high_bodies, high, high_torque);
    run(h, kAll, first, second);
  }

 private:
  static constexpr std::make_integer_sequence<int, Tableau::kStages> kAll{};

  /// What is wide: the start of a step, and the torques that were asked.
  template <int Part, class AnyBody, class T, class Torque>
  struct Member {
    using Scalar = T;
    static constexpr int kPart = Part;
    static constexpr bool kFree = Torque::kFree;
    static constexpr bool kInertial = Torque::kInertial;

    const AnyBody& body;
    State<T>& state;
    const Torque& torque;
    Quat<T> q_n;
    Vec3<T> omega_n;  ///< [rad/s]
    Vec3<T> rate_n;   ///< Pi_n/J_min [rad/s]
    Vec3<T> tau_B[kFree ? 1 : Tableau::kStages];
    Vec3<T> tau_I[kInertial ? Tableau::kStages : 1];

    [[gnu::always_inline]] Member(const AnyBody& of, State<T>& from, const Torque& under)
        : body(of),
          state(from),
          torque(under),
          q_n{from.q_IB.w, from.q_IB.x, from.q_IB.y, from.q_IB.z} {
      const Vec3<T> Pi_n = rotate_inverse(q_n, state.H_I.value());
      omega_n = body.angular_velocity(Pi_n);
      rate_n = body.inverse_moments()[0] * Pi_n;
    }
  };

  /// What is narrow: the start again, and slopes. At the first stage d, e and the work are zero and
  /// not kept.
  template <class N, bool kFree>
  struct Stages {
    static constexpr int kForced = kFree ? 1 : Tableau::kStages;
    Vec3<N> omega, rate;
    Quat<N> q;
    N h;
    Vec3<N> d[Tableau::kStages];  ///< psi' - omega_n [rad/s]
    Vec3<N> j[kForced];           ///< (J' + R_nᵀ G')/J_min [rad/s²]
    Vec3<N> e[kForced];           ///< (J' - tau_B)/J_min [rad/s²]
    N work[kForced];              ///< (W' - omega_n · tau)/J_min [rad²/s³]
  };

  template <class T, int... I, class First, class... More>
  [[gnu::always_inline]] static void run(const T& h, std::integer_sequence<int, I...> stages,
                                         First& first, More&... more) {
    using To = Narrower<T>;
    using N = NarrowOf<T>;
    static_assert(1 + sizeof...(More) == To::kParts);
    Stages<N, First::kFree> k;
    k.omega = narrow(first.omega_n, more.omega_n...);
    k.rate = narrow(first.rate_n, more.rate_n...);
    if constexpr (First::kInertial) {
      k.q = {To::narrow(first.q_n.w, more.q_n.w...), To::narrow(first.q_n.x, more.q_n.x...),
             To::narrow(first.q_n.y, more.q_n.y...), To::narrow(first.q_n.z, more.q_n.z...)};
    }
    k.h = To::narrow(h, (static_cast<void>(more), h)...);
    const auto& inertia = scaled_inertia(first.body, more.body...);
    (stage<I>(inertia, h, k, first, more...), ...);
    const Vec3<N> d = weighted(N(1), k.d, stages);
    Vec3<N> e{};
    N work{};
    if constexpr (!First::kFree) {
      e = weighted(k.h, k.e, stages);
      work = weighted(k.h, k.work, stages);
    }
    finish(h, d, e, work, stages, first);
    (finish(h, d, e, work, stages, more), ...);
  }

  template <int I, class Inertia, class T, class N, bool kFree, class... Members>
  [[gnu::always_inline]] static void stage(const Inertia& inertia, const T& h, Stages<N, kFree>& k,
                                           Members&... members) {
    if constexpr (I == 0) {
      if constexpr (!kFree) {
        const Rotation<T> none;
        (ask<0>(members, Stage<T>{T(0), members.omega_n, members.q_n, none}), ...);
        narrow_torques<0>(k, members...);
      }
    } else {
      constexpr auto earlier = std::make_integer_sequence<int, I>{};
      // psi = c_i h omega_n + h Σ a_ij d_j
      const Vec3<N> bend = combined<I, 1>(k.h, k.d, earlier);
      const AddedTurn<N> turn((k.h * Tableau::c[I].template as<N>()) * k.omega + bend);
      // δPi = J + (exp(-psi) - 1) (Pi_n + J)
      Vec3<N> change;
      if constexpr (kFree) {
        change = turn.exp_inverse(k.rate);
      } else {
        const Vec3<N> impulse = combined<I, 0>(k.h, k.j, earlier);
        change = impulse + turn.exp_inverse(k.rate + impulse);
      }
      const Vec3<N> delta = inertia.angular_velocity(change);
      const Vec3<N> omega_B = k.omega + delta;
      k.d[I] = delta + turn.dexpinv_minus(omega_B);
      if constexpr (!kFree) {
        const T since = h * Tableau::c[I].template as<T>();
        (ask_at<I>(members, since, bend, delta), ...);
        const Vec3<N> tau_I = narrow_torques<I>(k, members...);
        k.e[I] = turn.exp(k.j[I]);
        k.work[I] = dot(delta, k.j[I]);
        k.j[I] = k.j[I] + k.e[I];
        if constexpr ((Members::kInertial && ...)) {
          // (exp(psi) omega_B - omega_n) · R_nᵀ tau_I
          k.work[I] = k.work[I] + dot(delta + turn.exp(omega_B), tau_I);
          k.j[I] = k.j[I] + tau_I;
        }
      }
    }
  }

  /// The torque at a stage, wide; `bend` and `delta` are what it adds to c_i h omega_n and omega_n.
  template <int I, class Member, class T, class N>
  [[gnu::always_inline]] static void ask_at(Member& member, const T& since, const Vec3<N>& bend,
                                            const Vec3<N>& delta) {
    const Rotation<T> turn(since * member.omega_n + widen<T, Member::kPart>(bend));
    ask<I>(member,
           Stage<T>{since, member.omega_n + widen<T, Member::kPart>(delta), member.q_n, turn});
  }

  template <int I, class Member, class T>
  [[gnu::always_inline]] static void ask(Member& member, const Stage<T>& at) {
    const TorqueSample<T> tau = member.torque.function(at);
    member.tau_B[I] = {tau.body.x, tau.body.y, tau.body.z};
    if constexpr (Member::kInertial) {
      member.tau_I[I] = {tau.inertial.x, tau.inertial.y, tau.inertial.z};
    }
  }

  /// k.j[I] := tau_B/J_min; returns R_nᵀ tau_I/J_min.
  template <int I, class N, bool kFree, class... Members>
  [[gnu::always_inline]] static Vec3<N> narrow_torques(Stages<N, kFree>& k,
                                                       const Members&... members) {
    k.j[I] = narrow(members.body.inverse_moments()[0] * members.tau_B[I]...);
    if constexpr ((Members::kInertial && ...)) {
      const Vec3<N> tau_I =
          rotate_inverse(k.q, narrow(members.body.inverse_moments()[0] * members.tau_I[I]...));
      if constexpr (I == 0) {
        k.j[0] = k.j[0] + tau_I;
      }
      return tau_I;
    }
    return {};
  }

  /// The new state, all in double: d, e and the work are the stages' sums.
  template <class T, class N, int... I, class Member>
  [[gnu::always_inline]] static void finish(const T& h, const Vec3<N>& d, const Vec3<N>& e,
                                            const N& work, std::integer_sequence<int, I...>,
                                            Member& m) {
    constexpr int kPart = Member::kPart;
    State<T>& state = m.state;
    if constexpr (!Member::kFree) {
      const T& J_min = m.body.smallest_moment();
      Vec3<T> impulse_B{};
      (accumulate<!Tableau::b[I].is_zero()>(impulse_B, h, Tableau::b[I], m.tau_B[I]), ...);
      Vec3<T> impulse_I = rotate(m.q_n, impulse_B + J_min * widen<T, kPart>(e));
      T done = dot(m.omega_n, impulse_B) + J_min * Narrower<T>::template widen<kPart>(work);
      if constexpr (Member::kInertial) {
        Vec3<T> G{};
        (accumulate<!Tableau::b[I].is_zero()>(G, h, Tableau::b[I], m.tau_I[I]), ...);
        impulse_I = impulse_I + G;
        done = done + dot(m.omega_n, rotate_inverse(m.q_n, G));
      }
      state.H_I.add(impulse_I);
      state.impulse_I.add(impulse_I);
      state.work.add(done);
    }
    // psi = h (omega_n + Σ b_i d_i)
    const Rotation<T> turn(h * (m.omega_n + widen<T, kPart>(d)));
    state.q_IB = renormalised(m.q_n) * turn.quaternion();
  }

  /// h Σ a_Ij k_j, From ≤ j < I.
  template <int I, int From, class N, int... J>
  [[gnu::always_inline]] static Vec3<N> combined(const N& h, const Vec3<N>* k,
                                                 std::integer_sequence<int, J...>) {
    Vec3<N> sum{};
    (accumulate < (J >= From) && !Tableau::a[I][J].is_zero() > (sum, h, Tableau::a[I][J], k[J]),
     ...);
    return sum;
  }

  /// h Σ b_i k_i, 1 ≤ i.
  template <class N, class Slope, int... I>
  [[gnu::always_inline]] static Slope weighted(const N& h, const Slope* k,
                                               std::integer_sequence<int, I...>) {
    Slope sum{};
    (accumulate < (I > 0) && !Tableau::b[I].is_zero() > (sum, h, Tableau::b[I], k[I]), ...);
    return sum;
  }

  template <bool Present, class N, class Slope>
  [[gnu::always_inline]] static void accumulate(Slope& sum, const N& h, const Fraction& weight,
                                                const Slope& k) {
    if constexpr (Present) {
      sum = sum + (h * weight.template as<N>()) * k;
    }
  }
};

struct CoadjointRk4Float : CoadjointFloat<Rk4> {
  static constexpr const char* kName = "coadjoint_rk4_float";
};

struct CoadjointMidpoint2Float : CoadjointFloat<Midpoint2> {
  static constexpr const char* kName = "coadjoint_midpoint2_float";
};

}  // namespace adstar
