#pragma once
// How many equal parts a step needs so that no part turns further than the scheme can follow.
//
// dexpinv is singular at 2π, so h·|omega| per part is limited. |omega| is bounded before the step:
// with a_i = 1/J_i, the free motion keeps P² = |Pi|² = Σ x_i and 2E = Σ a_i x_i (x_i = Pi_i²), and
// |omega|² = Σ a_i² x_i is linear in x ≥ 0, so its maximum lies where only two x_i differ from
// zero:
//   |omega|² = (a_i + a_j) 2E - a_i a_j P².
// Pair (smallest J, largest J) is always feasible; the other is (1,2) or (2,3) by the side of the
// separatrix. A torque with ∫|tau| dt ≤ I moves P by at most I and √(2E) by at most I/√J_min (dE/dt
// = omega·tau).

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "adstar/bodies/rigid_body.hpp"
#include "adstar/vec3.hpp"

namespace adstar {

/// Limits of one step, from the scene. Past `substeps` or `edges` the step is reported as
/// unresolved.
struct StepLimits {
  double substep_angle_rad = 1.0;  ///< a part of a step may turn this far
  std::int64_t substeps = 64;      ///< parts of one smooth segment, at most
  std::int64_t edges = 64;         ///< torque edges inside one step, at most
};

/// Upper bound of |omega_B|² [rad²/s²] over a span in which the torques' impulse is at most
/// `impulse` [N m s].
template <class T>
T angular_speed_bound_squared(const RigidBody<T>& body, const Vec3<T>& Pi_B, const T& impulse) {
  using std::isnan;
  using std::sqrt;
  // Not max(): what is no number must stay none, or a ruined momentum would count as a slow one.
  const auto not_negative = [](const T& x) { return x < T(0) ? T(0) : x; };
  const auto& [a1, a2, a3] = body.inverse_moments();
  T P_squared = squared_norm(Pi_B);
  T two_E = T(2) * body.energy(Pi_B);
  if (!(impulse <= T(0))) {
    const T P = not_negative(sqrt(P_squared) - impulse);
    const T root = sqrt(not_negative(two_E)) + impulse * sqrt(a1);
    P_squared = P * P;
    two_E = root * root;
  }
  const T outer = (a1 + a3) * two_E - a1 * a3 * P_squared;
  const T inner = two_E >= a2 * P_squared ? (a1 + a2) * two_E - a1 * a2 * P_squared
                                          : (a2 + a3) * two_E - a2 * a3 * P_squared;
  return not_negative(inner > outer || isnan(inner) ? inner : outer);
}

/// True only if one part will do, from |omega| ≤ (|H| + impulse)/J_min alone: no root, no rotation.
/// Most steps are so far from the limit. A mask for lanes.
template <class AnyBody, class T>
auto surely_one_part(const AnyBody& body, const Vec3<T>& H_I, const T& impulse, const T& h,
                     const T& stage_reach, const StepLimits& limits) {
  const T turn = h * stage_reach * body.inverse_moments()[0];
  const T limit = T(limits.substep_angle_rad);
  return turn * turn * T(2) * (squared_norm(H_I) + impulse * impulse) <= limit * limit;
}

struct SubstepCount {
  std::int64_t parts = 1;
  bool within_limit = true;
};

/// Parts for a segment of length h [s]; `stage_reach` is the scheme's largest Σ_j |a_ij|, at
/// least 1.
template <class T>
SubstepCount count_substeps(const RigidBody<T>& body, const Vec3<T>& Pi_B, const T& impulse,
                            const T& h, const T& stage_reach, const StepLimits& limits) {
  const T reach = h * stage_reach;
  const T limit = T(limits.substep_angle_rad);
  const T angle_squared = reach * reach * angular_speed_bound_squared(body, Pi_B, impulse);
  if (angle_squared <= limit * limit) {
    return {};
  }
  using std::ceil;
  using std::sqrt;
  const T parts = ceil(sqrt(angle_squared) / limit);
  if (!(parts <= T(limits.substeps))) {  // also NaN
    return {limits.substeps, false};
  }
  return {static_cast<std::int64_t>(parts), true};
}

}  // namespace adstar
