#pragma once
// What every scheme says of itself. A scheme is a type with
//   kName, kOrder, kStageReach (how far, in steps, a stage may reach; 0: any turn will do), kClaims,
//   kSubstepAngleRad (how far a part may turn where a scene sets no limit), kLeakPower (guard.hpp),
//   kWeakReach, if it has one: the same as kStageReach where the torque is weak (guard.hpp),
//   Body<T>: the rigid body with whatever the scheme prepares once for it, made from a RigidBody<T>,
//   step(body, state, h, torque): one step of h [s]; never throws, never allocates. A step that cannot
//     follow the motion leaves q_IB no number; advance() keeps the attitude before it and says so.

#include "adstar/bodies/rigid_body.hpp"

namespace adstar {

/// What the conformance suite holds a scheme to.
struct Claims {
  bool exact_momentum = false;  ///< H_I changes by the impulse alone; a free body's never
  bool exact_energy = false;    ///< a free body's energy is kept to round-off
  bool free_only = false;       ///< knows no torque: a scene that names one is refused
  bool reversible = false;      ///< a step of -h undoes a step of h, to round-off
  double stage_epsilon = 0;     ///< round-off of what stages add to the start; 0: the state's own
};

/// kOrder of a scheme whose only error is round-off.
inline constexpr int kExactOrder = 1000;

template <class Scheme, class T>
using BodyOf = typename Scheme::template Body<T>;

}  // namespace adstar
