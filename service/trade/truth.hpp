#pragma once
// Where the spacecraft of a scene really are: the best reference there is for it.
//
// A free spacecraft follows the closed form (free_exact) in 64-bit-mantissa arithmetic, one shot per
// instant. A forced one is run by the order-8 coadjoint scheme in the same arithmetic, the step
// halved until two runs agree; what still separates them is the reference's own uncertainty. It is
// the library's own scheme at a finer step and a wider scalar, so an error of the equations
// themselves would not show here: tests/reference holds them to independent values.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "adstar/attitude.hpp"
#include "adstar/vec3.hpp"
#include "service/scene/scene.hpp"

namespace adstar::trade {

/// 64-bit mantissa on x86-64.
using Wide = long double;

struct TrueState {
  Quat<Wide> q_IB;
  Vec3<Wide> H_I;  ///< [N m s]
  Wide energy_j = 0;
};

struct Truth {
  std::vector<std::int64_t> times_ns;              ///< ascending, the last is the horizon
  std::vector<std::vector<TrueState>> spacecraft;  ///< [spacecraft][instant]
  double uncertainty_rad = 0;                      ///< of the worst spacecraft
  std::string how;                                 ///< for people
};

/// Called now and then with what is done, from 0 to 1; returning false ends it by throwing
/// Interrupted.
using Progress = std::function<bool(double)>;
struct Interrupted {};

/// States of all spacecraft at `times_ns`. `goal_rad`: how certain it should be.
Truth find_truth(const std::vector<scene::Spacecraft>& spacecraft,
                 const std::vector<std::int64_t>& times_ns, double goal_rad,
                 const Progress& progress);

}  // namespace adstar::trade
