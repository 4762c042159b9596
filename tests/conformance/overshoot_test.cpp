// At the guard's limit a coadjoint step of high order is right or says that it is not: over random
// bodies, ordinary ones and needles, one part that turns as far as it may.
#include <algorithm>
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
    // Never split: the limit is a little above the turn, which the clock's nanoseconds cut.
    const StepReport report = advance<Scheme>(body, state, std::span<const Torque<double>>{}, 0,
                                              motion.h_ns, {1.001, 64, 64});
    EXPECT_EQ(report.parts, 1);
    EXPECT_EQ(state.H_I, motion.start.H_I);
    if (report.resolved()) {
      outcome.worst = std::max(outcome.worst, angle_between(motion.truth, state.q_IB));
    } else {
      ++outcome.reported;
      EXPECT_EQ(state.q_IB, motion.start.q_IB);
    }
  }
  return outcome;
}

template <class Scheme>
class Overshoot : public testing::Test {};
using HighOrder = testing::Types<CoadjointDopri5, CoadjointVerner6, CoadjointFehlberg8>;
TYPED_TEST_SUITE(Overshoot, HighOrder);

TYPED_TEST(Overshoot, of_an_ordinary_body_is_rare_at_the_limit_and_never_silent) {
  const Outcome outcome_at_limit = outcome<TypeParam>(motions(false, 1.0));
  EXPECT_LT(outcome_at_limit.worst, 0.1);
  EXPECT_LT(outcome_at_limit.reported, 15);
}

TYPED_TEST(Overshoot, of_an_ordinary_body_is_none_at_a_quarter_of_the_limit) {
  const Outcome outcome_at_quarter = outcome<TypeParam>(motions(false, 0.25));
  EXPECT_LT(outcome_at_quarter.worst, 1e-3);
  EXPECT_EQ(outcome_at_quarter.reported, 0);
}

TYPED_TEST(Overshoot, of_a_needle_is_reported) {
  for (const double angle : {0.5, 1.0}) {
    const Outcome outcome_of_needles = outcome<TypeParam>(motions(true, angle));
    EXPECT_LT(outcome_of_needles.worst, 0.15) << angle;
    EXPECT_GT(outcome_of_needles.reported, 50) << angle << ": nothing was put to the test";
  }
}

}  // namespace
}  // namespace adstar
