#pragma once
// The free rigid body in closed form, a step of any length in one shot (Jacobi 1849; after Celledoni,
// Fassò, Säfström, Zanna 2008, "The exact computation of the free rigid body motion and its use in
// splitting methods", and van Zon and Schofield 2007).
//
// In principal axes, c the one of the least and the greatest moment that the momentum circles about,
// a the other, b the middle one, signs such that M_c ≥ 0 and a, b, c are right-handed; P = |M|:
//   M(t) = (A cn u, B sn u, C dn u),   u = u_0 ± λ t                              (their Prop. 2.1)
//   R_IB(t) = R_IB(0) Y(0)ᵀ exp(ϑ(t) e_c) Y(t),   Y(t) the shortest turn of M(t)/P to e_c
//   ϑ' = (2E + P M_c/I_c)/(P + M_c)                                               (their Prop. 3.2)
// ϑ is a mean rate times t and a periodic part, an integral of the third kind (elliptic.hpp). Every
// constant is a sum of positive terms of squares of M; only the distance from the separatrix,
//   D = M_3² (I_3 - I_2)/I_3 - M_1² (I_2 - I_1)/I_1,   the sign of which tells c = 3 from c = 1,
// cancels. Momentum, rates and phases are therefore carried in twice the digits (DoubleDouble), and
// what a period leaves over in T.
//
// Order: none, the only error is round-off: at most about 8 eps (1 + ∫|omega_B| dt) in angle
// (tests/conformance/free_exact_test.cpp). H_I: never touched. Energy: kept to round-off. On the
// separatrix (D = 0) the body comes to rest on the middle axis; beside it, D is known to 1e-31 P²
// only, so that what happens more than 36/λ after is decided by digits that the state has not.
// Cost: some 1.3 µs whatever the length of the step, most of it divisions and roots in twice the digits.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>

#include "adstar/bodies/rigid_body.hpp"
#include "adstar/elliptic.hpp"
#include "adstar/integrators/scheme.hpp"
#include "adstar/integrators/stage_torque.hpp"
#include "adstar/state.hpp"

namespace adstar {

/// A rigid body and the constants of its free motion. Moments are in units of the power of two next
/// to the greatest.
template <class T>
struct FreeBody : RigidBody<T> {
  using W = WiderOf<T>;

  /// Constants of the motion about axis c; zero where the body is too symmetric to have it.
  struct About {
    W rho_squared{};  ///< (B/A)² = I_b |I_c - I_a| / (I_a |I_c - I_b|)
    W rho{};
    W gamma{};       ///< C² = M_c² + γ M_b²,  γ = I_c |I_b - I_a| / (I_b |I_c - I_a|)
    W lambda{};      ///< λ = this C: √(|I_c - I_a| |I_c - I_b| / (I_a I_b)) / I_c
    W modulus{};     ///< m = this A²/C²: I_c |I_a - I_b| / (I_a |I_c - I_b|)
    W pole{};        ///< 1/√modulus; zero on a symmetric top
    W complement{};  ///< 1 - m = this D/C²: I_c / |I_c - I_b|
  };

  FreeBody(const RigidBody<T>& body) : RigidBody<T>(body) {  // NOLINT: a body is a body
    using std::frexp;
    using std::ldexp;
    int exponent = 0;
    frexp(body.moments()[2], &exponent);
    unit = ldexp(T(1), -exponent);
    const Sym3<T>& J = body.inertia();
    const auto entry = [this](const T& x) { return W(unit * x); };
    const PrincipalFrame<W> frame = principal_frame(
        Sym3<W>{entry(J.xx), entry(J.yy), entry(J.zz), entry(J.xy), entry(J.xz), entry(J.yz)});
    axes = frame.axes;
    turned = !(axes == Quat<W>{W(1), W(0), W(0), W(0)});
    const auto& I = frame.moments;
    for (std::size_t i = 0; i < 3; ++i) {
      inverse_moment[i] = W(1) / I[i];
    }
    distance[0] = (I[1] - I[0]) / I[0];
    distance[1] = (I[2] - I[1]) / I[2];
    about[0] = constants(I[2], I[1], I[0]);
    about[1] = constants(I[0], I[1], I[2]);
  }

  static About constants(const W& I_a, const W& I_b, const W& I_c) {
    using std::abs;
    using std::sqrt;
    const W ca = abs(I_c - I_a), cb = abs(I_c - I_b), ab = abs(I_a - I_b);
    About k;
    if (cb == W(0)) {
      return k;
    }
    k.rho_squared = (I_b * ca) / (I_a * cb);
    k.rho = sqrt(k.rho_squared);
    k.gamma = (I_c * ab) / (I_b * ca);
    k.lambda = sqrt((ca * cb) / (I_a * I_b)) / I_c;
    k.modulus = (I_c * ab) / (I_a * cb);
    k.pole = ab == W(0) ? W(0) : W(1) / sqrt(k.modulus);
    k.complement = I_c / cb;
    return k;
  }

  T unit;               ///< one over the unit of moments, a power of two
  Quat<W> axes;         ///< q_BP in the wider type
  bool turned;          ///< principal axes are not the body's
  W inverse_moment[3];  ///< in that unit, ascending moments
  W distance[2];        ///< (I_2 - I_1)/I_1, (I_3 - I_2)/I_3
  About about[2];       ///< the axis of the least moment, of the greatest
};

struct FreeExact {
  static constexpr const char* kName = "free_exact";
  static constexpr int kOrder = kExactOrder;
  static constexpr double kStageReach = 0;
  static constexpr double kSubstepAngleRad = 1;  ///< of a reach of 0: any turn will do
  static constexpr int kLeakPower = 0;
  static constexpr Claims kClaims{
      .exact_momentum = true, .exact_energy = true, .free_only = true, .reversible = true};
  template <class T>
  using Body = FreeBody<T>;

  /// Advances `state` by h [s], of any length and sign. Knows no torque: with one, or where the turn
  /// exceeds one over 8 eps and has no phase left, q_IB is left no number.
  template <class T, class Torque>
  static void step(const FreeBody<T>& body, State<T>& state, const T& h, const Torque&) {
    if constexpr (Torque::kFree) {
      advance_free(body, state, h);
    } else {
      state.q_IB = not_an_attitude<T>();
    }
  }

 private:
  template <class T>
  static Quat<T> not_an_attitude() {
    const T none = std::numeric_limits<T>::quiet_NaN();
    return {none, none, none, none};
  }

  /// v + (2/|q|²) (u×(u×v) - w u×v): Rᵀ v for q of any length, v in the wider type.
  template <class Q, class W>
  static Vec3<W> turned_back(const Quat<Q>& q, const W& two_over_norm, const Vec3<W>& v) {
    const auto cross_u = [&](const Vec3<W>& p) {
      return Vec3<W>{q.y * p.z - q.z * p.y, q.z * p.x - q.x * p.z, q.x * p.y - q.y * p.x};
    };
    const Vec3<W> t = cross_u(v);
    const Vec3<W> s = cross_u(t);
    return {v.x + two_over_norm * (s.x - q.w * t.x), v.y + two_over_norm * (s.y - q.w * t.y),
            v.z + two_over_norm * (s.z - q.w * t.z)};
  }

  template <class T>
  static void advance_free(const FreeBody<T>& body, State<T>& state, const T& h) {
    using W = WiderOf<T>;
    using std::abs;
    using std::frexp;
    using std::ldexp;
    const VecSum<T>& H = state.H_I;
    const T largest = std::max(std::max(abs(H.x.value), abs(H.y.value)), abs(H.z.value));
    if (largest == T(0)) {
      return;
    }
    if (!(largest <= std::numeric_limits<T>::max()) || !(abs(h) <= std::numeric_limits<T>::max())) {
      state.q_IB = not_an_attitude<T>();
      return;
    }
    // Momentum in units of a power of two, and time so that rates stay rates.
    int exponent = 0;
    frexp(largest, &exponent);
    exponent = std::max(exponent, std::numeric_limits<T>::min_exponent + 24);
    const T scale = ldexp(T(1), -exponent);
    const T time = ldexp(h * body.unit, exponent);
    const auto entry = [&scale](const Sum<T>& x) {
      return widened(scale * x.value, scale * x.carry);
    };
    const Quat<T> q{state.q_IB.w, state.q_IB.x, state.q_IB.y, state.q_IB.z};
    const W norm_q = squared(q.w) + squared(q.x) + (squared(q.y) + squared(q.z));
    Vec3<W> M = turned_back(q, W(2) / norm_q, Vec3<W>{entry(H.x), entry(H.y), entry(H.z)});
    if (body.turned) {
      M = turned_back(body.axes, W(2), M);
    }
    const Quat<T> turn = turn_in_principal_axes(body, M, time);
    Vec3<T> v{turn.x, turn.y, turn.z};
    if (body.turned) {
      const Quat<T> axes{rounded<T>(body.axes.w), rounded<T>(body.axes.x), rounded<T>(body.axes.y),
                         rounded<T>(body.axes.z)};
      v = rotate(axes, v);
    }
    state.q_IB = renormalised(renormalised(q) * Quat<T>{turn.w, v.x, v.y, v.z});
  }

  template <class T>
  static WiderOf<T> widened(const T& value, const T& carry) {
    if constexpr (std::is_same_v<T, double>) {
      return {value, carry};
    } else {
      return WiderOf<T>(value) + WiderOf<T>(carry);
    }
  }
  template <class T>
  static WiderOf<T> squared(const T& x) {
    if constexpr (std::is_same_v<T, double>) {
      return detail::two_product(x, x);
    } else {
      return WiderOf<T>(x) * WiderOf<T>(x);
    }
  }

  /// R(0)ᵀ R(t) of the body whose momentum in principal axes is M, |M| of order one.
  template <class T, class W>
  static Quat<T> turn_in_principal_axes(const FreeBody<T>& body, const Vec3<W>& M, const T& time) {
    using std::abs;
    using std::sqrt;
    const W x1 = M.x * M.x, x2 = M.y * M.y, x3 = M.z * M.z;
    const W P = sqrt(x1 + x2 + x3);
    const W D1 = x1 * body.distance[0], D3 = x3 * body.distance[1];
    const bool greatest = !(D3 < D1);
    const W D = greatest ? D3 - D1 : D1 - D3;
    const T limit = T(0.125) / std::numeric_limits<T>::epsilon();
    if (D == W(0) && D1 == W(0)) {  // on a permanent axis of a symmetric body, or on the middle one
      const W half = (P * body.inverse_moment[1]) * (T(0.5) * time);
      if (!(abs(rounded<T>(half)) < limit)) {
        return not_an_attitude<T>();
      }
      const SinCos<T> a = phase_of<T>(half);
      const W s = W(1) / P;
      return {a.cos, a.sin * rounded<T>(M.x * s), a.sin * rounded<T>(M.y * s),
              a.sin * rounded<T>(M.z * s)};
    }

    const auto& k = body.about[greatest ? 1 : 0];
    const W& inverse_I_c = body.inverse_moment[greatest ? 2 : 0];
    // a, b, c of the head of this file.
    W M_a = greatest ? M.x : M.z, M_b = greatest ? M.y : -M.y, M_c = greatest ? M.z : M.x;
    const bool reversed = M_c < W(0);
    if (reversed) {
      M_a = -M_a;
      M_c = -M_c;
    }
    const W x_a = greatest ? x1 : x3, x_c = greatest ? x3 : x1;
    const W B_squared = x2 + k.rho_squared * x_a;
    const W C_squared = x_c + k.gamma * x2;
    const W B = sqrt(B_squared), C = sqrt(C_squared);
    const W over_C_squared = W(1) / C_squared;
    const W m = (B_squared / k.rho_squared) * k.modulus * over_C_squared;
    W complement = D * k.complement * over_C_squared;
    // On the separatrix K is made finite, but too long for the difference to be told in T.
    const T least = separatrix_complement<T>();
    const bool separatrix = !(rounded<T>(complement) > least);
    if (separatrix) {
      complement = W(least);
    }
    const W k_prime = complement > W(1) ? W(1) : W(sqrt(complement));
    const EllipticLadder<T> ladder = elliptic_ladder<T>(k_prime, m);
    ThirdKind<T> third;
    const W P_and_C = P + C;
    if (!(k.pole == W(0))) {
      third = third_kind<T>(ladder, (k_prime + W(1)) * (k.pole * C / P_and_C));
    }
    // u = ± λ t:  u' = λ where c is the axis of the greatest moment, -λ where of the least.
    const W lambda = k.lambda * C;
    const W phase_rate = lambda * ladder.mean;
    const W two_E =
        x1 * body.inverse_moment[0] + x2 * body.inverse_moment[1] + x3 * body.inverse_moment[2];
    const W start_rate = (two_E + P * C * inverse_I_c) / P_and_C;  // ϑ' at u = 0
    const W correction = lambda * third.mean_over_start;
    const W mean_rate = greatest ? start_rate + correction : start_rate - correction;

    T elliptic_time = time;
    W beyond{};  // angle about H after the separatrix's end
    W phase = phase_rate * time;
    SinCos<T> turn_phase;
    const T quarter = half_pi<T>();
    if (separatrix && abs(rounded<T>(phase)) >= quarter) {
      const T sign = time < T(0) ? T(-1) : T(1);
      elliptic_time = sign * quarter / rounded<T>(phase_rate);
      beyond = (P * body.inverse_moment[1]) * (time - elliptic_time);
      turn_phase = {sign, T(0)};
    } else {
      turn_phase = phase_of<T>(phase);
    }
    if (!greatest) {
      turn_phase.sin = -turn_phase.sin;
    }
    const W mean_angle = mean_rate * elliptic_time + beyond;
    if (!(abs(rounded<T>(mean_angle)) < limit)) {
      return not_an_attitude<T>();
    }

    // M(t), by the addition theorem from M(0): no initial phase, no rounding of it.
    Jacobi<T> start{T(0), T(1), T(1)};
    if (B > W(0)) {
      const W over_B = W(1) / B;
      start = {rounded<T>(M_b * over_B), rounded<T>(k.rho * M_a * over_B), T(1)};
    }
    start.d = rounded<T>(M_c / C);
    const Jacobi<T> passed = elliptic_rung_1(ladder, turn_phase);
    const Jacobi<T> end = elliptic_sum(start, elliptic_rung_0(ladder, passed), rounded<T>(m));
    const T A_t = rounded<T>(B / k.rho), B_t = rounded<T>(B), C_t = rounded<T>(C);
    const T a_0 = rounded<T>(M_a), b_0 = rounded<T>(M_b), c_0 = rounded<T>(M_c);
    const T a_t = A_t * end.c, b_t = B_t * end.s, c_t = C_t * end.d;

    T periodic = T(0);
    if (third.terms > 0) {
      periodic = third_kind_angle(ladder, third, passed) +
                 third_kind_sum_angle(third, sine_on_rung_1(ladder, start), passed.s,
                                      sine_on_rung_1(ladder, end));
    }
    const SinCos<T> half_mean = phase_of<T>(T(0.5) * mean_angle);
    const SinCos<T> half_periodic = sincos(T(0.5) * periodic);
    const T cosine = half_mean.cos * half_periodic.cos - half_mean.sin * half_periodic.sin;
    const T sine = half_mean.sin * half_periodic.cos + half_mean.cos * half_periodic.sin;

    // Y = (P + M_c, M_b, -M_a, 0)/√(2P (P + M_c))
    const T P_t = rounded<T>(P);
    const Quat<T> back{P_t + c_0, -b_0, a_0, T(0)}, on{P_t + c_t, b_t, -a_t, T(0)};
    const Quat<T> turn = normalised(back * (Quat<T>{cosine, T(0), T(0), sine} * on));
    const T sign = reversed ? T(-1) : T(1);
    const T v_a = sign * turn.x, v_b = turn.y, v_c = sign * turn.z;
    return greatest ? Quat<T>{turn.w, v_a, v_b, v_c} : Quat<T>{turn.w, v_c, -v_b, v_a};
  }

  template <class T, class W>
  static SinCos<T> phase_of(const W& x) {
    const auto a = sincos(x);
    return {static_cast<T>(a.sin), static_cast<T>(a.cos)};
  }

  template <class T>
  static T half_pi() {
    if constexpr (std::is_same_v<T, double> || std::is_same_v<T, float>) {
      return T(1.5707963267948966);
    } else {
      using std::atan;
      return T(2) * atan(T(1));
    }
  }

  template <class T>
  static T separatrix_complement() {
    return std::numeric_limits<T>::min() / std::numeric_limits<T>::epsilon();
  }
};

}  // namespace adstar
