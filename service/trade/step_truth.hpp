#pragma once
// Where one step of one spacecraft really ends, cheaply enough for thousands of them.
//
// A free spacecraft: the closed form in 64-bit mantissa. Any other: the eighth-order tableau on (q,
// omega) in the same arithmetic, which reads no momentum through its attitude (a needle costs no more
// than a sphere), in parts of an eighth of a radian or of the damping's time, then of half that, until
// two runs agree. As in truth.hpp it is independent of the schemes and steps judged, not of the equations.

#include "service/trade/truth.hpp"

namespace adstar::trade {

struct StepTruth {
  Quat<Wide> q_IB;
  double uncertainty_rad = 0;  ///< what separates the last two runs
};

/// Ends when the runs agree within `goal_rad`, or after some halvings. Meant for what some scheme resolves
/// in a few dozen parts: it takes a few hundred per dozen.
StepTruth find_step_truth(const scene::Spacecraft& craft, std::int64_t h_ns, double goal_rad);

}  // namespace adstar::trade
