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
//
// The turn alone is not enough where a step reads Pi_B through an attitude of its own (a coadjoint
// stage, a projected step): an attitude error e there spins the lightest axis at e·leak, leak =
// |Pi|/J_min, which for a needle is up to 1e6 times |omega|. A part of length h is short enough when
//   (h|omega|)^p · h·leak ≤ limit^(p+1),     p = Scheme::kLeakPower
// with p = 1 where the leak feeds back within the step (the error then swings at the geometric mean of
// both rates), p = the order where only the finished step's error leaks, and 0: no leak at all.
// Limits: measured, service/decisions/0010-guard-limits.md.

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "adstar/bodies/rigid_body.hpp"
#include "adstar/vec3.hpp"

namespace adstar {

/// Limits of one step, from the scene. Past `substeps` or `edges` the step is reported as
/// unresolved.
struct StepLimits {
  /// A part of a step may turn this far; 0: as far as its scheme can follow (kSubstepAngleRad).
  double substep_angle_rad = 0;
  std::int64_t substeps = 64;  ///< parts of one smooth segment, at most
  std::int64_t edges = 64;     ///< torque edges inside one step, at most
};

/// The limits as they hold for a scheme: its own angle where none is set.
template <class Scheme>
constexpr StepLimits limits_for(StepLimits limits) {
  if (!(limits.substep_angle_rad > 0)) {
    limits.substep_angle_rad = Scheme::kSubstepAngleRad;
  }
  return limits;
}

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

/// Whether `parts` are enough against the leak; turn and leak over the whole, in units of the limit.
template <class T>
bool leaks_little(const T& turn, const T& leak, int leak_power, std::int64_t parts) {
  const T each = T(1) / T(parts);
  T product = leak * each;
  for (int i = 0; i < leak_power; ++i) {
    product = product * (turn * each);
  }
  return product <= T(1);
}

/// Parts for a segment of length h [s]; `stage_reach` is the scheme's largest Σ_j |a_ij|, at
/// least 1; `leak_power` as above.
template <class T>
SubstepCount count_substeps(const RigidBody<T>& body, const Vec3<T>& Pi_B, const T& impulse,
                            const T& h, const T& stage_reach, const StepLimits& limits,
                            int leak_power = 0) {
  using std::ceil;
  using std::sqrt;
  const T limit = T(limits.substep_angle_rad);
  const T reach = h * stage_reach;
  const T angle_squared = reach * reach * angular_speed_bound_squared(body, Pi_B, impulse);
  std::int64_t parts = 1;
  if (!(angle_squared <= limit * limit)) {
    const T wanted = ceil(sqrt(angle_squared) / limit);
    if (!(wanted <= T(limits.substeps))) {  // also NaN
      return {limits.substeps, false};
    }
    parts = static_cast<std::int64_t>(wanted);
  }
  if (leak_power == 0) {
    return {parts, true};
  }
  const T turn = sqrt(angle_squared) / limit;
  const T leak = reach * (sqrt(squared_norm(Pi_B)) + impulse) * body.inverse_moments()[0] / limit;
  if (leaks_little(turn, leak, leak_power, parts)) {
    return {parts, true};
  }
  if (!leaks_little(turn, leak, leak_power, limits.substeps)) {
    return {limits.substeps, false};
  }
  std::int64_t few = parts, enough = limits.substeps;  // the least that is enough, by halving
  while (enough - few > 1) {
    const std::int64_t middle = few + (enough - few) / 2;
    (leaks_little(turn, leak, leak_power, middle) ? enough : few) = middle;
  }
  return {enough, true};
}

/// The same for a scheme, within the limits that hold for it.
template <class Scheme, class T>
SubstepCount count_parts(const RigidBody<T>& body, const Vec3<T>& Pi_B, const T& impulse,
                         const T& h, const StepLimits& limits) {
  return count_substeps(body, Pi_B, impulse, h, T(Scheme::kStageReach), limits_for<Scheme>(limits),
                        Scheme::kLeakPower);
}

}  // namespace adstar
