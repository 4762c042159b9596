#pragma once
// How many equal parts a step needs so that no part goes further than the scheme can follow.
//
// Turn. dexpinv is singular at 2π, so h·|omega| per part is limited; |omega| is bounded before the
// step (motion_bounds.hpp).
//
// Light axis. The turn alone is not enough where a step reads Pi_B through an attitude of its own (a
// coadjoint stage, a projected step): an attitude error e there spins the lightest axis at e·leak, leak =
// |Pi|/J_min, which for a needle is up to 1e6 times |omega|. A part of length h is short enough when
//   (h|omega|)^p · h·leak ≤ limit^(p+1),     p = Scheme::kLeakPower
// with p = 1 where the leak feeds back within the step (the error then swings at the geometric mean of
// both rates), p = the order where only the finished step's error leaks, and 0: no leak at all.
//
// A splitting turns the body by its free drifts alone (kWeakReach: the longest, in steps). Under a
// torque so weak that its impulse changes no rate by more than a thousandth of |omega|,
//   impulse/J_min ≤ 1e-3 |omega|,
// it is therefore the drift that must not turn too far, not the step: were the kicks all in the wrong
// place, a radian turned would be off by about 1e-3 rad.
//
// Separatrix. Beside it an error of the first part has grown by G at the end of the step. An error of
// order q per part falls with the angle^q, so parts are short enough when
//   (h|omega|)^q · G ≤ limit^q,     q = the order of the scheme on this motion
// of a step that has several; one part is the scheme's own business.
//
// Push. A splitting of order 2 does not see within a part how turn and torque work on one another:
//   h|omega| · I/(|Pi| + I) ≤ limit²,     I the torque's impulse in the part, limit = Scheme::kPushLimit
//
// Damping. A torque -c omega_B takes the rate down at J⁻¹c; an explicit step is unstable where h J⁻¹c
// passes some 2 to 4, and coarse well before: h J⁻¹c ≤ decay_limit().
// Limits: measured, service/decisions/0010-guard-limits.md.

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "adstar/bodies/rigid_body.hpp"
#include "adstar/integrators/motion_bounds.hpp"
#include "adstar/integrators/scheme.hpp"
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

/// True only if one part will do, from |omega| ≤ (|H| + impulse)/J_min alone: no root, no rotation.
/// Most steps are so far from the limit. A mask for lanes.
template <class AnyBody, class T>
auto surely_one_part(const AnyBody& body, const Vec3<T>& H_I, const T& impulse, const T& h,
                     const T& stage_reach, const StepLimits& limits) {
  const T turn = h * stage_reach * body.inverse_moments()[0];
  const T limit = T(limits.substep_angle_rad);
  return turn * turn * T(2) * (squared_norm(H_I) + impulse * impulse) <= limit * limit;
}

/// What stands in the way of a step.
enum class Obstacle : std::uint8_t { none, turn, light_axis, separatrix, damping };

struct SubstepCount {
  std::int64_t parts = 1;
  bool within_limit = true;
  Obstacle obstacle = Obstacle::none;  ///< that the limit of parts does not overcome
};

/// What a scheme is sensitive to beside the turn.
struct Sensitivity {
  int leak_power = 0;  ///< kLeakPower
  int order = 0;       ///< under torque; 0: no error that could grow
  Reading reading = Reading::none;
  double push_limit = 0;  ///< 0: none
  int free_order = 0;  ///< without. What keeps energy and momentum keeps δ: it errs in time alone
};

template <class Scheme>
constexpr double push_limit_of() {
  if constexpr (requires { Scheme::kPushLimit; }) {
    return Scheme::kPushLimit;
  } else {
    return 0;
  }
}

template <class Scheme>
constexpr Sensitivity sensitivity_of() {
  const int order = Scheme::kOrder == kExactOrder ? 0 : Scheme::kOrder;
  const Reading reading = Scheme::kLeakPower == 1          ? Reading::at_stages
                          : Scheme::kClaims.exact_momentum ? Reading::once
                                                           : Reading::none;
  return {Scheme::kLeakPower, order, reading, push_limit_of<Scheme>(),
          Scheme::kClaims.exact_energy ? 0 : order};
}

/// How much of a damping rate a part may see, h·J⁻¹c, for an error per part below some 3e-4 of what is
/// left: x^(p+1)/(p+1)!, the first term that e^-x has beyond an order p.
constexpr double decay_limit(int order) {
  return order >= 8 ? 1 : order >= 5 ? 0.75 : order >= 4 ? 0.5 : 0.1;
}

/// Whether `parts` of a step keep factor · angle^power within 1, both over the whole in units of what
/// one part may have.
template <class T>
bool within_unit(const T& factor, const T& angle, int power, std::int64_t parts) {
  const T each = angle / T(parts);
  T product = factor;
  for (int i = 0; i < power; ++i) {
    product = product * each;
  }
  return product <= T(1);
}

/// The least number of parts, from `few` to `most`, that is enough; 0 when none is.
template <class Enough>
std::int64_t least_parts(std::int64_t few, std::int64_t most, const Enough& enough) {
  if (enough(few)) {
    return few;
  }
  if (!enough(most)) {
    return 0;
  }
  while (most - few > 1) {
    const std::int64_t middle = few + (most - few) / 2;
    (enough(middle) ? most : few) = middle;
  }
  return most;
}

/// Parts for a segment of length h [s]; `stage_reach` is the scheme's largest Σ_j |a_ij|, at least 1,
/// or reach_of() it; `decay`: the damping's decay_rate() [1/s].
template <class T>
SubstepCount count_substeps(const RigidBody<T>& body, const Vec3<T>& Pi_B, const T& impulse,
                            const T& h, const T& stage_reach, const StepLimits& limits,
                            const Sensitivity& scheme = {}, const T& decay = T(0)) {
  using std::ceil;
  using std::sqrt;
  const MotionBounds<T> motion(body, Pi_B, impulse);
  const T limit = T(limits.substep_angle_rad);
  const T reach = h * stage_reach;
  const T angle_squared = reach * reach * angular_speed_bound_squared(motion);
  std::int64_t parts = 1;
  if (!(angle_squared <= limit * limit)) {
    const T wanted = ceil(sqrt(angle_squared) / limit);
    if (!(wanted <= T(limits.substeps))) {  // also NaN
      return {limits.substeps, false, Obstacle::turn};
    }
    parts = static_cast<std::int64_t>(wanted);
  }
  const int order = impulse > T(0) ? scheme.order : scheme.free_order;
  if (decay > T(0)) {
    const T wanted = ceil(decay * h / T(decay_limit(scheme.order)));
    if (!(wanted <= T(limits.substeps))) {
      return {limits.substeps, false, Obstacle::damping};
    }
    parts = std::max(parts, static_cast<std::int64_t>(wanted));
  }
  if (scheme.push_limit > 0 && motion.impulse > T(0)) {
    const T push = sqrt(angle_squared) * motion.impulse / (motion.P + motion.impulse);
    const T wanted = ceil(sqrt(push) / T(scheme.push_limit));
    if (!(wanted <= T(limits.substeps))) {
      return {limits.substeps, false, Obstacle::turn};
    }
    parts = std::max(parts, static_cast<std::int64_t>(wanted));
  }
  const T turn = sqrt(angle_squared) / limit;
  if (scheme.leak_power > 0) {
    const T leak = reach * (motion.P + motion.impulse) * motion.rate[0] / limit;
    parts = least_parts(parts, limits.substeps, [&](std::int64_t n) {
      return within_unit(leak / T(n), turn, scheme.leak_power, n);
    });
    if (parts == 0) {
      return {limits.substeps, false, Obstacle::light_axis};
    }
  }
  if (parts > 1 && order > 0) {
    const T growth = error_growth(motion, h, scheme.reading);
    parts = least_parts(parts, limits.substeps,
                        [&](std::int64_t n) { return within_unit(growth, turn, order, n); });
    if (parts == 0) {
      return {limits.substeps, false, Obstacle::separatrix};
    }
  }
  return {parts, true, Obstacle::none};
}

/// Of |omega|, what a weak torque's impulse may change.
inline constexpr double kWeakShare = 1e-3;

/// How far, in steps, the scheme turns the body between two looks at it.
template <class Scheme, class T>
T reach_of(const RigidBody<T>& body, const Vec3<T>& Pi_B, const T& impulse) {
  if constexpr (requires { Scheme::kWeakReach; }) {
    const T change = impulse * body.inverse_moments()[0];
    if (change * change <=
        T(kWeakShare * kWeakShare) * angular_speed_bound_squared(body, Pi_B, T(0))) {
      return T(Scheme::kWeakReach);
    }
  }
  return T(Scheme::kStageReach);
}

/// The same for a scheme, within the limits that hold for it.
template <class Scheme, class T>
SubstepCount count_parts(const RigidBody<T>& body, const Vec3<T>& Pi_B, const T& impulse,
                         const T& h, const StepLimits& limits, const T& decay = T(0)) {
  return count_substeps(body, Pi_B, impulse, h, reach_of<Scheme>(body, Pi_B, impulse),
                        limits_for<Scheme>(limits), sensitivity_of<Scheme>(), decay);
}

}  // namespace adstar
