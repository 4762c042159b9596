// What the paper's Fig. 3 claims (Terze, Müller, Zlatar): on its free body the coadjoint scheme keeps
// the inertial momentum, Munthe-Kaas with a momentum equation in vector space and Lie-Newmark lose it.
// The paper names no step and no numbers, so the ordering is asserted, at every step tried.
#include <algorithm>

#include <gtest/gtest.h>

#include "adstar/propagator.hpp"
#include "tests/support/wide.hpp"

namespace adstar {
namespace {

using V = Vec3<double>;

struct Drift {
  double momentum = 0;       ///< largest |H_I - H_0|/|H_0| on the way
  double rotation = 0;       ///< largest ||q|² - 1| on the way
  double late_momentum = 0;  ///< the same as `momentum`, over the second half of the run
};

/// 200 s of the paper's free body.
template <class Scheme>
Drift drift_of(double h) {
  const RigidBody<double> body(Eigen::Matrix3d(Eigen::Vector3d(0.9144, 1.098, 1.66).asDiagonal()));
  State<double> state = make_state(Quat<double>{}, body.momentum(V{0.45549, 0.82623, 0.03476}));
  const V H_0 = state.H_I.value();
  const int steps = static_cast<int>(200 / h);
  Drift drift;
  for (int n = 0; n < steps; ++n) {
    Scheme::step(body, state, h, NoTorque{});
    const double off = norm(state.H_I.value() - H_0) / norm(H_0);
    drift.momentum = std::max(drift.momentum, off);
    if (n > steps / 2) {
      drift.late_momentum = std::max(drift.late_momentum, off);
    }
    drift.rotation = std::max(drift.rotation, std::fabs(squared_norm(state.q_IB) - 1));
  }
  return drift;
}

constexpr double kSteps[] = {0.5, 0.2, 0.1, 0.05, 0.02};

TEST(MomentumDrift, is_none_for_the_coadjoint_and_projected_schemes_at_every_step) {
  for (const double h : kSteps) {
    EXPECT_EQ(drift_of<CoadjointRk4>(h).momentum, 0) << h;
    EXPECT_EQ(drift_of<CoadjointFehlberg8>(h).momentum, 0) << h;
    EXPECT_EQ(drift_of<ProjectedRk4>(h).momentum, 0) << h;
  }
}

TEST(MomentumDrift, of_munthe_kaas_lies_between_the_coadjoint_scheme_and_lie_newmark) {
  for (const double h : kSteps) {
    const double munthe_kaas = drift_of<Rkmk4>(h).momentum;
    const double lie_newmark = drift_of<LieNewmark>(h).momentum;
    EXPECT_GT(munthe_kaas, drift_of<CoadjointRk4>(h).momentum + 1e-11) << h;
    EXPECT_GT(lie_newmark, 10 * munthe_kaas) << h;
  }
}

TEST(MomentumDrift, of_the_classical_quaternion_scheme_is_there_and_shrinks_with_the_step) {
  double before = 1;
  for (const double h : kSteps) {
    const double now = drift_of<QuaternionRk4>(h).momentum;
    EXPECT_GT(now, 1e-12) << h;
    EXPECT_LT(now, before / 4) << h;
    before = now;
  }
}

TEST(MomentumDrift, of_munthe_kaas_grows_with_time) {
  const Drift drift = drift_of<Rkmk4>(0.1);
  EXPECT_GT(drift.late_momentum, 0.9 * drift.momentum);
}

TEST(RotationDefect, is_round_off_for_all_of_them) {
  for (const double h : kSteps) {
    EXPECT_LT(drift_of<CoadjointRk4>(h).rotation, 8 * test::kEpsilon) << h;
    EXPECT_LT(drift_of<Rkmk4>(h).rotation, 8 * test::kEpsilon) << h;
    EXPECT_LT(drift_of<LieNewmark>(h).rotation, 8 * test::kEpsilon) << h;
    EXPECT_LT(drift_of<QuaternionRk4>(h).rotation, 8 * test::kEpsilon) << h;
  }
}

}  // namespace
}  // namespace adstar
