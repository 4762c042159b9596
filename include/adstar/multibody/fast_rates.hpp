#pragma once
// How fast springs, stops and dampers of an assembly may swing and die away: what the parts of a step are counted from
// beside the rates (advance.hpp says how).

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "adstar/multibody/joint_coordinates.hpp"
#include "adstar/multibody/workspace.hpp"

namespace adstar::multibody::detail {

/// Fastest rates of springs, stops within reach, and dampers, at work.motions [1/s].
template <class T>
struct FastRates {
  T oscillation{}, decay{};
};

template <class T>
FastRates<T> fast_rates(const Assembly<T>& assembly, Workspace<T>& work, const T& h) {
  using std::abs;
  using std::max;
  using std::sqrt;
  // work.accelerations lends its memory: [0] Σ k/m, [1] Σ c/m by body.
  for (Spatial<T>& each : work.accelerations) {
    each = {};
  }
  FastRates<T> rates;
  for (std::size_t j = 0; j < work.joints.size(); ++j) {
    const Joint<T>& joint = assembly.joints()[j];
    const JointMotion<T>& m = work.joints[j];
    const std::array<T, 3> rate = joint_rates(joint.kind, m);
    T stiffness{}, damping{};
    for (int k = 0; k < m.shape.coordinates; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const CoordinateLaw<T>& law = joint.laws[i];
      const T q = work.coordinates[j][i], reach = T(2) * h * abs(rate[i]);
      stiffness = stiffness + law.stiffness;
      damping = damping + law.damping;
      if (law.stops && (q + reach > law.upper || q - reach < law.lower)) {
        stiffness = stiffness + law.stop_stiffness;
        damping = damping + law.stop_stiffness * law.stop_dissipation * abs(stop_depth(law, q));
      }
    }
    if (!(stiffness > T(0)) && !(damping > T(0))) {
      continue;
    }
    const auto add = [&](int body, const Vec3<T>& lever) {
      if (body == kGround) {
        return;
      }
      const Body<T>& own = assembly.bodies()[static_cast<std::size_t>(body)];
      const T about = own.rigid.inverse_moments()[0];
      const T mobility = joint.kind == JointKind::prismatic
                             ? T(1) / own.mass + squared_norm(cross(lever, m.z_F)) * about
                             : about;
      Spatial<T>& sums = work.accelerations[static_cast<std::size_t>(body)];
      sums[0] = sums[0] + stiffness * mobility;
      sums[1] = sums[1] + damping * mobility;
      rates.oscillation = max(rates.oscillation, sums[0]);
      rates.decay = max(rates.decay, sums[1]);
    };
    add(joint.body_a, m.s);
    add(joint.body_b, m.r);
  }
  rates.oscillation = sqrt(T(2) * rates.oscillation);
  rates.decay = T(2) * rates.decay;
  return rates;
}

}  // namespace adstar::multibody::detail
