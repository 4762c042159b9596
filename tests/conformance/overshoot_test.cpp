// A coadjoint step of high order that turns by up to a radian is right or says that it is not: over
// random bodies, ordinary ones and needles, without the guard that would split it.
#include <algorithm>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

#include "adstar/propagator.hpp"
#include "tests/support/plain_motion.hpp"
#include "tests/support/random_motion.hpp"
#include "tests/support/wide.hpp"

namespace adstar {
namespace {

using test::Generator;
using test::Quad;
using V = Vec3<double>;

struct Motion {
  Eigen::Matrix3d J;
  State<double> start;
  std::int64_t h_ns;
  Quat<double> truth;  ///< attitude h later
};

Eigen::Vector3d needle(Generator& random) {
  const double thin = test::log_uniform(random, 1e-6, 1e-2);
  return {0.9 * thin, 1, 1 + 0.5 * thin};
}

/// Free motions whose bound of the turn within h is `angle` [rad].
std::vector<Motion> motions(bool needles, double angle) {
  Generator random(needles ? 81 : 82);
  std::vector<Motion> all;
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d moments = needles ? needle(random) : test::moments(random);
    const Eigen::Matrix3d J = moments.asDiagonal();
    const RigidBody<double> body(J);
    const V direction = test::unit_vector(random);
    const V Pi = i % 2 == 0 ? direction : body.momentum(direction);
    const double speed = std::sqrt(angular_speed_bound_squared(body, Pi, 0.0));
    const auto h_ns = static_cast<std::int64_t>(1e9 * angle / speed);
    const State<double> start = make_state(Quat<double>{}, Pi);
    const auto end = test::PlainMotion(J.cast<Quad>(), {})
                         .run(test::plain_state(Quat<Quad>{}, test::convert<Quad>(Pi)), 0,
                              seconds<Quad>(h_ns), 2);
    all.push_back({J, start, h_ns, test::convert<double>(normalised(end.q_IB()))});
  }
  return all;
}

struct Outcome {
  int reported = 0;
  double worst = 0;  ///< attitude error of what was not reported [rad]
};

template <class Scheme>
Outcome outcome(const std::vector<Motion>& motions) {
  Outcome outcome;
  for (const Motion& motion : motions) {
    const RigidBody<double> body(motion.J);
    State<double> state = motion.start;
    // The scheme alone: the guard would split what it expects to leak.
    Scheme::step(body, state, seconds<double>(motion.h_ns), NoTorque{});
    EXPECT_EQ(state.H_I, motion.start.H_I);
    const double q_squared = squared_norm(state.q_IB);
    if (q_squared > 0.5 && q_squared < 2) {
      outcome.worst = std::max(outcome.worst, angle_between(motion.truth, state.q_IB));
    } else {
      ++outcome.reported;
    }
  }
  return outcome;
}

template <class Scheme>
class Overshoot : public testing::Test {};
using HighOrder =
    testing::Types<CoadjointDopri5, CoadjointVerner6, CoadjointFehlberg8, CoadjointDop853>;
TYPED_TEST_SUITE(Overshoot, HighOrder);

TYPED_TEST(Overshoot, of_an_ordinary_body_is_rare_at_one_radian_and_never_silent) {
  const Outcome at_one_radian = outcome<TypeParam>(motions(false, 1.0));
  EXPECT_LT(at_one_radian.worst, 0.1);
  EXPECT_LT(at_one_radian.reported, 15);
}

TYPED_TEST(Overshoot, of_an_ordinary_body_is_none_at_a_quarter_of_a_radian) {
  const Outcome at_a_quarter = outcome<TypeParam>(motions(false, 0.25));
  EXPECT_LT(at_a_quarter.worst, 1e-3);
  EXPECT_EQ(at_a_quarter.reported, 0);
}

TYPED_TEST(Overshoot, of_a_needle_is_reported) {
  // One of 300 slips by Dop853 at half a radian; the guard's leak splits such steps (stability_test).
  constexpr double kMost = std::is_same_v<TypeParam, CoadjointDop853> ? 0.3 : 0.15;
  for (const double angle : {0.5, 1.0}) {
    const Outcome outcome_of_needles = outcome<TypeParam>(motions(true, angle));
    EXPECT_LT(outcome_of_needles.worst, kMost) << angle;
    EXPECT_GT(outcome_of_needles.reported, 50) << angle << ": nothing was put to the test";
  }
}

}  // namespace
}  // namespace adstar
