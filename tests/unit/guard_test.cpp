#include "adstar/integrators/guard.hpp"

#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include "tests/support/random_motion.hpp"
#include "tests/support/wide.hpp"

namespace adstar {
namespace {

using test::Generator;

/// Fastest |omega_B| along the motion, from the plain Euler equations Ṗi = Pi × J⁻¹Pi + tau in
/// principal axes.
struct Motion {
  Eigen::Vector3d J;
  std::function<Eigen::Vector3d(double)> tau = [](double) {
    return Eigen::Vector3d::Zero().eval();
  };

  Eigen::Vector3d rate(double t, const Eigen::Vector3d& Pi) const {
    return Pi.cross(Pi.cwiseQuotient(J)) + tau(t);
  }
  Eigen::Vector3d advance(double t, double h, const Eigen::Vector3d& Pi) const {
    const Eigen::Vector3d k1 = rate(t, Pi), k2 = rate(t + h / 2, Pi + h / 2 * k1),
                          k3 = rate(t + h / 2, Pi + h / 2 * k2), k4 = rate(t + h, Pi + h * k3);
    return Pi + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  double speed(const Eigen::Vector3d& Pi) const { return Pi.cwiseQuotient(J).norm(); }
};

RigidBody<double> principal(const Eigen::Vector3d& J) {
  return RigidBody<double>(Eigen::Matrix3d(J.asDiagonal()));
}

double bound(const RigidBody<double>& body, const Eigen::Vector3d& Pi, double impulse) {
  return std::sqrt(angular_speed_bound_squared(body, from_eigen(Pi), impulse));
}

TEST(AngularSpeedBound, of_a_free_body_is_reached_and_never_passed) {
  Generator random(31);
  int judged = 0;
  for (int i = 0; i < 60; ++i) {
    const Motion motion{test::moments(random)};
    Eigen::Vector3d Pi = to_eigen(test::unit_vector(random));
    const double limit = bound(principal(motion.J), Pi, 0);
    const double h = 1e-3 / limit;
    double fastest = motion.speed(Pi);
    // The extremes of |omega| lie where a component of Pi changes its sign: go on until all have
    // been seen.
    int crossings = 0;
    for (int step = 0; step < 400'000 && crossings < 5; ++step) {
      const Eigen::Vector3d next = motion.advance(0, h, Pi);
      crossings += static_cast<int>((next.array() * Pi.array() < 0).count());
      Pi = next;
      fastest = std::fmax(fastest, motion.speed(Pi));
    }
    ASSERT_LE(fastest, limit * (1 + 1e-9)) << "J = " << motion.J.transpose();
    if (crossings >= 5) {
      ++judged;
      ASSERT_GE(fastest, limit * (1 - 1e-6)) << "J = " << motion.J.transpose();
    }
  }
  EXPECT_GT(judged, 50);
}

TEST(AngularSpeedBound, is_sharp_for_a_needle_in_transverse_spin) {
  const RigidBody<double> needle = principal({1e-6, 1, 1});
  const Eigen::Vector3d Pi(0, 0.6, 0.8);
  EXPECT_NEAR(bound(needle, Pi, 0), 1.0, 1e-6);
}

TEST(AngularSpeedBound, does_not_depend_on_the_axes_that_the_tensor_is_given_in) {
  Generator random(32);
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3d J = test::moments(random);
    const Quat<double> q = test::unit_quaternion(random);
    const RigidBody<double> turned(test::rotated_inertia(J, q));
    const Vec3<double> Pi = test::unit_vector(random);
    const double expected = angular_speed_bound_squared(principal(J), Pi, 0.0);
    ASSERT_NEAR(angular_speed_bound_squared(turned, rotate(q, Pi), 0.0), expected,
                1e-11 * expected);
  }
}

TEST(AngularSpeedBound, holds_under_any_torque_of_the_stated_impulse) {
  Generator random(33);
  for (int i = 0; i < 200; ++i) {
    Motion motion{test::moments(random)};
    Eigen::Vector3d Pi = to_eigen(test::unit_vector(random));
    const double impulse = test::log_uniform(random, 1e-3, 10);
    const double span = test::log_uniform(random, 1e-2, 10);
    const Eigen::Vector3d axis = to_eigen(test::unit_vector(random));
    const Eigen::AngleAxisd turn(test::uniform(random, 0, 6), to_eigen(test::unit_vector(random)));
    const double strength = impulse / span;
    motion.tau = [=](double t) -> Eigen::Vector3d {
      return strength * (Eigen::AngleAxisd(turn.angle() * t, turn.axis()) * axis);
    };
    const double limit = bound(principal(motion.J), Pi, impulse);
    const int steps = 2000 + static_cast<int>(200 * span * limit);
    const double h = span / steps;
    for (int n = 0; n < steps; ++n) {
      Pi = motion.advance(n * h, h, Pi);
      ASSERT_LE(motion.speed(Pi), limit * (1 + 1e-6)) << "J = " << motion.J.transpose();
    }
  }
}

TEST(AngularSpeedBound, holds_for_a_torque_that_spins_up_the_light_axis) {
  const Eigen::Vector3d J(0.01, 1, 1.005);
  Motion motion{J};
  motion.tau = [](double) { return Eigen::Vector3d(1, 0, 0); };
  Eigen::Vector3d Pi(1, 0, 0);
  const double limit = bound(principal(J), Pi, 0.5);
  for (int n = 0; n < 500; ++n) {
    Pi = motion.advance(n * 1e-3, 1e-3, Pi);
  }
  EXPECT_NEAR(motion.speed(Pi), 150, 1e-9);
  EXPECT_GE(limit, 150);
}

TEST(AngularSpeedBound, of_a_body_at_rest_is_zero) {
  EXPECT_EQ(angular_speed_bound_squared(principal({1, 2, 2.5}), Vec3<double>{}, 0.0), 0.0);
}

StepLimits limits(double angle, std::int64_t substeps) { return {angle, substeps, 64}; }

SubstepCount count(double speed, double h, double reach, const StepLimits& limits) {
  return count_substeps(principal({1, 1, 1}), Vec3<double>{0, 0, speed}, 0.0, h, reach, limits);
}

TEST(CountSubsteps, is_one_up_to_the_limit_and_then_the_next_whole_number) {
  EXPECT_EQ(count(1.0, 0.5, 1.0, limits(1, 64)).parts, 1);
  EXPECT_EQ(count(1.0, 1.0, 1.0, limits(1, 64)).parts, 1);
  EXPECT_EQ(count(1.0, 1.001, 1.0, limits(1, 64)).parts, 2);
  EXPECT_EQ(count(1.0, 2.5, 1.0, limits(1, 64)).parts, 3);
  EXPECT_EQ(count(1.0, 2.5, 1.0, limits(0.5, 64)).parts, 5);
  EXPECT_EQ(count(10.0, 1.0, 1.0, limits(1, 64)).parts, 10);
}

TEST(CountSubsteps, leaves_no_part_that_turns_further_than_the_limit) {
  Generator random(34);
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d J = test::moments(random);
    const Vec3<double> Pi = test::log_uniform(random, 1e-3, 1e3) * test::unit_vector(random);
    const double h = test::log_uniform(random, 1e-4, 1), impulse = test::uniform(random, -0.1, 0.1);
    const auto got =
        count_substeps(principal(J), Pi, std::fmax(0, impulse), h, 1.0, limits(0.7, 1'000'000));
    ASSERT_TRUE(got.within_limit);
    const double fastest =
        std::sqrt(angular_speed_bound_squared(principal(J), Pi, std::fmax(0, impulse)));
    ASSERT_LE(h * fastest / static_cast<double>(got.parts), 0.7 * (1 + 1e-12));
    ASSERT_TRUE(got.parts == 1 ||
                h * fastest / static_cast<double>(got.parts - 1) > 0.7 * (1 - 1e-12));
  }
}

TEST(SurelyOnePart, never_says_so_of_a_body_that_may_turn_too_far) {
  Generator random(35);
  int sure = 0, unsure = 0;
  for (int i = 0; i < 20'000; ++i) {
    const RigidBody<double> body = principal(test::moments(random));
    const Vec3<double> H_I = test::log_uniform(random, 1e-3, 1e2) * test::unit_vector(random);
    const double impulse = i % 2 == 0 ? 0 : test::log_uniform(random, 1e-4, 10);
    const double h = test::log_uniform(random, 1e-4, 1);
    if (surely_one_part(body, H_I, impulse, h, 1.0, limits(0.7, 1'000'000))) {
      ++sure;
      ASSERT_LE(h * (norm(H_I) + impulse) / body.moments()[0], 0.7 * (1 + 1e-12));
      if (impulse == 0) {
        ASSERT_EQ(count_substeps(body, H_I, impulse, h, 1.0, limits(0.7, 1'000'000)).parts, 1);
      }
    } else {
      ++unsure;
    }
  }
  EXPECT_GT(sure, 1000);
  EXPECT_GT(unsure, 1000);
}

TEST(SurelyOnePart, is_not_sure_of_what_is_no_number) {
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               inf = std::numeric_limits<double>::infinity();
  const auto body = principal({1, 2, 2.5});
  for (const double bad : {nan, inf, -inf, 1e200}) {
    EXPECT_FALSE(surely_one_part(body, Vec3<double>{1, bad, 1}, 0.0, 0.01, 1.0, limits(1, 64)))
        << bad;
  }
  EXPECT_FALSE(surely_one_part(body, Vec3<double>{1, 1, 1}, nan, 0.01, 1.0, limits(1, 64)));
  EXPECT_FALSE(surely_one_part(body, Vec3<double>{1, 1, 1}, inf, 0.01, 1.0, limits(1, 64)));
}

TEST(CountSubsteps, counts_the_stages_that_reach_beyond_the_step) {
  EXPECT_EQ(count(1.0, 1.0, 3.5, limits(1, 64)).parts, 4);
}

TEST(CountSubsteps, stops_at_the_cap_and_says_so) {
  const SubstepCount at_cap = count(64.0, 1.0, 1.0, limits(1, 64));
  EXPECT_EQ(at_cap.parts, 64);
  EXPECT_TRUE(at_cap.within_limit);
  const SubstepCount beyond = count(64.5, 1.0, 1.0, limits(1, 64));
  EXPECT_EQ(beyond.parts, 64);
  EXPECT_FALSE(beyond.within_limit);
  EXPECT_FALSE(count(1e150, 1.0, 1.0, limits(1, 64)).within_limit);
}

TEST(CountSubsteps, never_calls_a_momentum_that_is_no_number_resolved) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinity, -infinity, 1e200}) {
    for (int axis = 0; axis < 3; ++axis) {
      Eigen::Vector3d Pi(1, 1, 1);
      Pi[axis] = bad;
      const auto body = principal({1, 2, 2.5});
      EXPECT_FALSE(count_substeps(body, from_eigen(Pi), 0.0, 0.01, 1.0, limits(1, 64)).within_limit)
          << bad << " on axis " << axis;
      EXPECT_FALSE(count_substeps(body, from_eigen(Pi), 0.1, 0.01, 1.0, limits(1, 64)).within_limit)
          << bad << " on axis " << axis << ", under torque";
    }
  }
}

TEST(CountSubsteps, never_calls_a_torque_that_is_no_number_resolved) {
  const auto body = principal({1, 2, 2.5});
  const Vec3<double> Pi{1, 1, 1};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(count_substeps(body, Pi, nan, 0.01, 1.0, limits(1, 64)).within_limit);
  EXPECT_FALSE(count_substeps(body, Pi, infinity, 0.01, 1.0, limits(1, 64)).within_limit);
}

}  // namespace
}  // namespace adstar
