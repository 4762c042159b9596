#pragma once
// The preprocessed discrete Moser-Veselov step of a free body: momentum and energy kept to
// round-off, at any of the even orders 2 to 16 (Moser and Veselov 1991; McLachlan and Zanna 2005;
// Hairer and Vilmart 2006).
//
// With y = Pi_B in principal axes, ρ the unit quaternion of the step's rotation Ω, and the modified
// moments Ĩ_j of moser_veselov_moments.hpp,
//   (h/2) y_1 = Ĩ_1 ρ_0 ρ_1 + (Ĩ_3 - Ĩ_2) ρ_2 ρ_3   and cyclically     (Hairer and Vilmart 2006, §2)
//   q_{n+1} = q_n ρ,   y_{n+1} = Ωᵀ y_n
// Here it is solved for r_j = ρ_j/ρ_0, with α_j = I_m/Ĩ_j and η = h y/I_m (I_m the middle moment):
//   r_1 + κ_1 r_2 r_3 = b_1 (1 + |r|²),   b_j = α_j η_j/2,   κ_1 = α_1 (α_2 - α_3)/(α_2 α_3)
// by Newton's method, until the next correction would be below round-off. |κ| ≤ 1.
//
// How far. The solution wanted leaves r = 0 with h; where the body turns by a quarter (a sphere at
// |r| = 1) it meets another, which past that would be found in its place. A step with h|omega| near
// π/2 is therefore refused, and so is one that Newton's method does not settle. At order 2 the moments
// of a sphere lead it there at h|omega| = 1 already: kStageReach.
//
// H_I: not touched, so constant to the last bit. Energy: kept by the step whatever s and d are; what
// moves it is rounding: that of q_IB at random (7e-14 of it after 1e7 steps of the paper's body), and
// that of κ, the same every step, by at most eps (h|omega|)³ a step (measured: 4e-19 at h = 0.2 s at
// worst, none to be seen at 0.01 s). Symmetric: a step of -h undoes one of h. Order: the
// attitude's; the energy has no error. Knows no torque: integrators/splitting.hpp adds it.

#include <limits>
#include <type_traits>

#include "adstar/bodies/rigid_body.hpp"
#include "adstar/integrators/moser_veselov_moments.hpp"
#include "adstar/integrators/scheme.hpp"
#include "adstar/integrators/stage_torque.hpp"
#include "adstar/state.hpp"

namespace adstar {

/// A rigid body and what a Moser-Veselov step of that order needs of it.
template <class T, int Order>
class MoserVeselovBody : public RigidBody<T> {
 public:
  MoserVeselovBody(const RigidBody<T>& body)  // NOLINT: a body is a body
      : RigidBody<T>(body),
        axes_(body.principal_axes()),
        middle_inverse_(body.inverse_moments()[1]),
        moments_(in_own_order(body)),
        beta_{relative(body, moments_.x), relative(body, moments_.y), relative(body, moments_.z)},
        delta_{delta(body, moments_.y, moments_.z), delta(body, moments_.z, moments_.x),
               delta(body, moments_.x, moments_.y)},
        scale_(detail::kScale, sum(body), product(body)),
        shift_(detail::kShift, sum(body), product(body)) {}

  /// The rotation, in B, by which a free body of body momentum Pi_B [N m s] turns in h [s]; not a
  /// number where the iteration finds none.
  [[gnu::always_inline]] Turn<T> free_turn(const Vec3<T>& Pi_B, const T& h) const {
    if (diagonal_) {
      return turn_in_principal_axes(Pi_B, h);
    }
    const Turn<T> rho = turn_in_principal_axes(rotate_inverse(axes_, Pi_B), h);
    return {rho.u, rotate(axes_, rho.v)};
  }

 private:
  static constexpr int kDegree = (Order - 2) / 2;
  static constexpr int kMostIterations = 20;
  static constexpr double kFarthestSquared = 2.4;  ///< (π/2)² is 2.47

  [[gnu::always_inline]] Turn<T> turn_in_principal_axes(const Vec3<T>& y, const T& h) const {
    using std::sqrt;
    const T unit = h * middle_inverse_;
    const Vec3<T> eta = unit * y;
    const T xx = eta.x * eta.x, yy = eta.y * eta.y, zz = eta.z * eta.z;
    const Vec3<T> angle{eta.x + beta_.x * eta.x, eta.y + beta_.y * eta.y,
                        eta.z + beta_.z * eta.z};  // h omega
    const T c = T(0.5) * (xx + yy + zz);
    const T b = T(0.5) * (beta_.x * xx + beta_.y * yy + beta_.z * zz);
    const T scale = T(1) + scale_(c, b), shift = shift_(c, b);
    const Vec3<T> alpha{scale + (beta_.x * scale + shift), scale + (beta_.y * scale + shift),
                        scale + (beta_.z * scale + shift)};
    const T g = scale / (alpha.x * alpha.y * alpha.z);
    const Vec3<T> kappa{(alpha.x * alpha.x * g) * delta_.x, (alpha.y * alpha.y * g) * delta_.y,
                        (alpha.z * alpha.z * g) * delta_.z};
    const Vec3<T> half{T(0.5) * (alpha.x * eta.x), T(0.5) * (alpha.y * eta.y),
                       T(0.5) * (alpha.z * eta.z)};
    Vec3<T> r{half.x, half.y, half.z};
    r = fixed_point(kappa, half, r);
    r = fixed_point(kappa, half, r);
    for (int i = 0; i < kMostIterations; ++i) {
      const Vec3<T> step = newton(kappa, half, r);
      r = r + step;
      // The next correction is about κ |step|².
      const T kTolerance = std::numeric_limits<T>::epsilon() / T(1024);
      const T size = squared_norm(step);
      if (size * size <= (kTolerance * kTolerance) * squared_norm(half)) {
        if (!(squared_norm(angle) <= T(kFarthestSquared))) [[unlikely]] {
          break;
        }
        // ρ = (1, r)/t, t = √(1 + |r|²); ρ_0 - 1 = -|r|²/(t (1 + t))
        const T s = squared_norm(r), t = sqrt(T(1) + s);
        const T k = T(1) / (t + t * t);
        return {-(s * k), (k + k * t) * r};
      }
    }
    const T none = std::numeric_limits<T>::quiet_NaN();
    return {none, {none, none, none}};
  }

  /// b (1 + |r|²) - κ r r
  static Vec3<T> fixed_point(const Vec3<T>& kappa, const Vec3<T>& b, const Vec3<T>& r) {
    const T s = squared_norm(r);
    return {b.x + (b.x * s - kappa.x * (r.y * r.z)), b.y + (b.y * s - kappa.y * (r.z * r.x)),
            b.z + (b.z * s - kappa.z * (r.x * r.y))};
  }

  /// -(dF/dr)⁻¹ F of F = r + κ r r - b (1 + |r|²), by cofactors.
  static Vec3<T> newton(const Vec3<T>& kappa, const Vec3<T>& b, const Vec3<T>& r) {
    const Vec3<T> F = fixed_point(kappa, b, r) - r;
    const Vec3<T> d = T(2) * r;
    const Vec3<T> row_1{T(1) - b.x * d.x, kappa.x * r.z - b.x * d.y, kappa.x * r.y - b.x * d.z};
    const Vec3<T> row_2{kappa.y * r.z - b.y * d.x, T(1) - b.y * d.y, kappa.y * r.x - b.y * d.z};
    const Vec3<T> row_3{kappa.z * r.y - b.z * d.x, kappa.z * r.x - b.z * d.y, T(1) - b.z * d.z};
    const Vec3<T> c_1 = cross(row_2, row_3), c_2 = cross(row_3, row_1), c_3 = cross(row_1, row_2);
    return (T(1) / dot(row_1, c_1)) * (F.x * c_1 + (F.y * c_2 + F.z * c_3));
  }

  static bool is_diagonal(const RigidBody<T>& body) {
    const Sym3<T>& J = body.inertia();
    return J.xy == T(0) && J.xz == T(0) && J.yz == T(0);
  }

  /// A diagonal tensor's moments stay where they are; another's ascend.
  static Vec3<T> in_own_order(const RigidBody<T>& body) {
    if (is_diagonal(body)) {
      return {body.inertia().xx, body.inertia().yy, body.inertia().zz};
    }
    return {body.moments()[0], body.moments()[1], body.moments()[2]};
  }

  /// β = (I_m - I)/I
  static T relative(const RigidBody<T>& body, const T& moment) {
    return (body.moments()[1] - moment) / moment;
  }
  /// β_j - β_k = I_m (I_k - I_j)/(I_j I_k)
  static T delta(const RigidBody<T>& body, const T& I_j, const T& I_k) {
    return (body.moments()[1] / I_j) * ((I_k - I_j) / I_k);
  }
  static T sum(const RigidBody<T>& body) {
    return relative(body, body.moments()[0]) + relative(body, body.moments()[2]);
  }
  static T product(const RigidBody<T>& body) {
    return relative(body, body.moments()[0]) * relative(body, body.moments()[2]);
  }

  Quat<T> axes_;  ///< q_BP
  T middle_inverse_;
  Vec3<T> moments_, beta_, delta_;
  InvariantPolynomial<T, kDegree> scale_, shift_;
  bool diagonal_ = is_diagonal(*this);
};

template <int Order>
struct MoserVeselov {
  static_assert(Order >= 2 && Order <= 16 && Order % 2 == 0);
  static constexpr int kOrder = Order;
  static constexpr double kStageReach = Order == 2 ? 1.25 : 1;
  static constexpr double kSubstepAngleRad = Order == 2   ? 0.075
                                             : Order == 4 ? 0.5
                                             : Order == 6 ? 1
                                             : Order == 8 ? 1.25
                                                          : 1.5;
  static constexpr int kLeakPower = 0;  ///< the energy, which it keeps, leaves nothing to leak
  static constexpr Claims kClaims{
      .exact_momentum = true, .exact_energy = true, .free_only = true, .reversible = true};
  template <class T>
  using Body = MoserVeselovBody<T, Order>;

  /// Advances `state` by h [s], negative too. Never throws, never allocates. Under a torque, which it
  /// does not know, q_IB is left no number.
  template <class T, class Torque>
  static void step(const std::type_identity_t<Body<T>>& body, State<T>& state, const T& h,
                   const Torque&) {
    if constexpr (Torque::kFree) {
      state.q_IB = moved(body, state.q_IB, state.H_I.value(), h);
    } else {
      state.q_IB.w = std::numeric_limits<T>::quiet_NaN();
    }
  }

  /// The attitude h [s] after q_IB, of a free body of momentum H_I [N m s].
  template <class T>
  [[gnu::always_inline]] static Quat<T> moved(const Body<T>& body, const Quat<T>& q_IB,
                                              const Vec3<T>& H_I, const T& h) {
    return turned(q_IB, body.free_turn(rotate_inverse_exactly(q_IB, H_I), h));
  }
};

struct MoserVeselov2 : MoserVeselov<2> {
  static constexpr const char* kName = "moser_veselov2";
};
struct MoserVeselov4 : MoserVeselov<4> {
  static constexpr const char* kName = "moser_veselov4";
};
struct MoserVeselov6 : MoserVeselov<6> {
  static constexpr const char* kName = "moser_veselov6";
};
struct MoserVeselov8 : MoserVeselov<8> {
  static constexpr const char* kName = "moser_veselov8";
};
struct MoserVeselov10 : MoserVeselov<10> {
  static constexpr const char* kName = "moser_veselov10";
};
struct MoserVeselov16 : MoserVeselov<16> {
  static constexpr const char* kName = "moser_veselov16";
};

}  // namespace adstar
