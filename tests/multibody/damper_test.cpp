// A point mass on a spring along the spin axis: the damper of a spinner's nutation, and of sloshing propellant.

#include <cmath>

#include <gtest/gtest.h>

#include "adstar/integrators/tableaus.hpp"
#include "adstar/multibody/advance.hpp"
#include "adstar/multibody/placement.hpp"

namespace adstar::multibody {
namespace {

using V = Vec3<double>;

/// A hub that spins about z at 1 rad/s, nutating a little, with 0.4 kg on a damped spring 1 m off the axis.
Assembly<double> spinner(const V& moments) {
  std::vector<BodySpec<double>> bodies(2);
  bodies[0].name = "hub";
  bodies[0].mass_kg = 60;
  bodies[0].inertia_B = Eigen::Vector3d(moments.x, moments.y, moments.z).asDiagonal();
  bodies[0].omega_B = {0.1, 0, 1};
  bodies[1].name = "mass";
  bodies[1].mass_kg = 0.4;
  bodies[1].inertia_B = 1e-4 * Eigen::Matrix3d::Identity();
  std::vector<Joint<double>> joints(1);
  joints[0].name = "tube";
  joints[0].kind = JointKind::prismatic;
  joints[0].body_a = 0;
  joints[0].body_b = 1;
  joints[0].a = frame_about<double>({1, 0, 0}, {0, 0, 1});
  joints[0].b = frame_about<double>({0, 0, 0}, {0, 0, 1});
  joints[0].laws[0].stiffness = 0.1;
  joints[0].laws[0].damping = 0.2;
  const std::vector<JointStart<double>> starts(1);
  place<double>(bodies, joints, starts);
  centre(bodies);
  return Assembly<double>(bodies, joints, {Formulation::se3, {}});
}

struct Nutation {
  double
      first = 0,
      last =
          0;  ///< largest angle between H and the spin axis [rad], in the first and last five seconds
  double drift = 0;  ///< of H, relative
};

Nutation fly(const V& moments) {
  const Assembly<double> assembly = spinner(moments);
  Workspace<double> work(assembly);
  AssemblyState<double> state = make_state(assembly);
  const V H_0 = total_momentum(assembly, state).H_I.value();
  Nutation seen;
  constexpr int kSteps = 30'000, kSpan = 250;
  for (int n = 0; n < kSteps; ++n) {
    EXPECT_TRUE(advance<Rk4>(assembly, work, state, 20'000'000).resolved());
    const V axis = rotate(state.bodies[0].q_IB, V{0, 0, 1});
    const V H = total_momentum(assembly, state).H_I.value();
    const double angle = std::atan2(norm(cross(H, axis)), std::fabs(dot(H, axis)));
    if (n < kSpan) {
      seen.first = std::max(seen.first, angle);
    } else if (n >= kSteps - kSpan) {
      seen.last = std::max(seen.last, angle);
    }
  }
  seen.drift = norm(total_momentum(assembly, state).H_I.value() - H_0) / norm(H_0);
  return seen;
}

TEST(PointMassDamper, takes_the_nutation_of_a_spin_about_the_largest_moment) {
  const Nutation seen = fly({12, 13, 18});
  EXPECT_LT(seen.last, 0.5 * seen.first);
  EXPECT_LT(seen.drift, 1e-14);
}

TEST(PointMassDamper, drives_the_nutation_of_a_spin_about_the_smallest) {
  const Nutation seen = fly({18, 17, 12});
  EXPECT_GT(seen.last, 1.5 * seen.first);
  EXPECT_LT(seen.drift, 1e-14);
}

}  // namespace
}  // namespace adstar::multibody
