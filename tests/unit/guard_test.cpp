#include "adstar/integrators/guard.hpp"

#include <cmath>
#include <functional>
#include <limits>

#include <Eigen/Eigenvalues>
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

/// A scheme that looks at the body half a step apart where the torque is weak.
struct LongStrider {
  static constexpr double kStageReach = 1, kWeakReach = 0.5, kSubstepAngleRad = 1;
  static constexpr int kLeakPower = 0, kOrder = 2;
  static constexpr Claims kClaims{};
};
struct Plain : LongStrider {
  static constexpr double kWeakReach = kStageReach;
};

TEST(ReachOf, is_the_weak_one_up_to_a_thousandth_of_the_rate_and_the_stages_beyond) {
  const RigidBody<double> body = principal({0.5, 0.8, 1});
  const Vec3<double> Pi{0, 0, 2};  // 2 rad/s
  EXPECT_EQ(reach_of<LongStrider>(body, Pi, 0.0), 0.5);
  EXPECT_EQ(reach_of<LongStrider>(body, Pi, 0.999e-3), 0.5);
  EXPECT_EQ(reach_of<LongStrider>(body, Pi, 1.001e-3), 1);
  EXPECT_EQ(reach_of<Plain>(body, Pi, 0.0), 1);
}

TEST(ReachOf, judges_a_torque_by_what_it_does_to_the_lightest_axis) {
  const RigidBody<double> needle = principal({1e-6, 1, 1});
  const Vec3<double> across{0, 0.6, 0.8};  // 1 rad/s
  EXPECT_EQ(reach_of<LongStrider>(needle, across, 0.999e-9), 0.5);
  EXPECT_EQ(reach_of<LongStrider>(needle, across, 1e-6), 1);
}

TEST(ReachOf, takes_what_is_no_number_and_a_body_at_rest_under_torque_for_no_weak_one) {
  const RigidBody<double> body = principal({0.5, 0.8, 1});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(reach_of<LongStrider>(body, Vec3<double>{1, 0, 0}, nan), 1);
  EXPECT_EQ(reach_of<LongStrider>(body, Vec3<double>{nan, 0, 0}, 1e-9), 1);
  EXPECT_EQ(reach_of<LongStrider>(body, Vec3<double>{}, 1e-9), 1);
}

TEST(CountSubsteps, counts_by_the_drift_under_a_weak_torque_and_by_the_step_under_a_strong_one) {
  const RigidBody<double> body = principal({1, 1, 1});
  const Vec3<double> Pi{0, 0, 1};
  const auto parts = [&](double impulse) {
    return count_parts<LongStrider>(body, Pi, impulse, 5.9, StepLimits{}).parts;
  };
  EXPECT_EQ(parts(0.0), 3);
  EXPECT_EQ(parts(1e-4), 3);
  EXPECT_GE(parts(1e-2), 6);
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

TEST(MotionBounds, are_the_same_for_a_body_of_any_size) {
  const Vec3<double> Pi{0.3, -1, 0.2};
  const double expected = angular_speed_bound_squared(principal({0.9, 1.1, 1.6}), Pi, 0.1);
  for (const double size : {1e-250, 1e-150, 1e-9, 1e9, 1e200, 1e250}) {
    const RigidBody<double> body = principal(size * Eigen::Vector3d(0.9, 1.1, 1.6));
    EXPECT_NEAR(angular_speed_bound_squared(body, size * Pi, size * 0.1), expected,
                1e-13 * expected)
        << size;
  }
}

TEST(GrowthOver, is_the_exponential) {
  for (const double x : {0.0, 1e-9, 0.1, 1.0, 7.0, 30.0, 100.0}) {
    EXPECT_NEAR(growth_over(x), std::exp(x), 1e-5 * std::exp(x)) << x;
  }
}

MotionBounds<double> moving(const Vec3<double>& Pi, double impulse = 0) {
  return MotionBounds<double>(principal({0.8, 1.2, 2}), Pi, impulse);
}

TEST(ErrorGrowth, is_exponential_on_the_separatrix_and_one_far_from_it) {
  // x_1 (J_2 - J_1)/J_1 = x_3 (J_3 - J_2)/J_3
  const Vec3<double> on{std::sqrt(0.4), 1, std::sqrt(0.5)};
  const double P = norm(on), rate = P / 1.2 * std::sqrt(0.5 * 0.4), x = rate * 20;
  EXPECT_NEAR(error_growth(moving(on), 20.0, Reading::once) / (std::exp(x) / x), 1, 0.01);
  EXPECT_EQ(error_growth(moving(on), 0.1, Reading::once), 1.0);
  EXPECT_LT(error_growth(moving({1, 0.01, 0.01}), 20.0, Reading::once), 4);
}

TEST(ErrorGrowth, is_no_more_than_one_passage_makes_of_it) {
  double before = std::numeric_limits<double>::infinity();
  for (const double aside : {1e-9, 1e-6, 1e-3, 1e-1}) {
    const double growth =
        error_growth(moving({std::sqrt(0.4) + aside, 1, std::sqrt(0.5)}), 200.0, Reading::once);
    EXPECT_GT(growth, 0.1 / aside);
    EXPECT_LT(growth, 10 / aside);
    EXPECT_LT(growth, before);
    before = growth;
  }
}

TEST(ErrorGrowth, allows_for_a_torque_that_may_lead_to_the_separatrix) {
  const Vec3<double> beside{std::sqrt(0.4) + 0.1, 1, std::sqrt(0.5)};
  EXPECT_GT(error_growth(moving(beside, 0.2), 40.0, Reading::once),
            100 * error_growth(moving(beside), 40.0, Reading::once));
}

TEST(CountSubsteps, takes_more_parts_beside_the_separatrix_and_says_when_they_do_not_suffice) {
  const auto body = principal({0.8, 1.2, 2});
  const Vec3<double> on{std::sqrt(0.4), 1, std::sqrt(0.5)};
  const Sensitivity fourth{0, 4, Reading::once, 0, 4}, exact{0, 4, Reading::once, 0, 0};
  const auto parts = [&](double h, const Sensitivity& scheme) {
    return count_substeps(body, on, 0.0, h, 1.0, limits(0.5, 64), scheme);
  };
  EXPECT_EQ(parts(2, fourth).parts, parts(2, exact).parts) << "no growth to speak of";
  EXPECT_GT(parts(10, fourth).parts, 2 * parts(10, exact).parts);
  EXPECT_TRUE(parts(10, fourth).within_limit);
  EXPECT_TRUE(parts(15, exact).within_limit);
  EXPECT_FALSE(parts(15, fourth).within_limit);
  EXPECT_EQ(parts(15, fourth).obstacle, Obstacle::separatrix);
  EXPECT_EQ(parts(1000, exact).obstacle, Obstacle::turn);
}

TEST(CountSubsteps, counts_a_damping_by_its_fastest_rate) {
  const auto body = principal({1, 2, 4});
  const Sensitivity fourth{0, 4, Reading::none, 0, 4};
  const double rate = decay_rate(body, Vec3<double>{1, 6, 8});
  EXPECT_EQ(rate, 3);
  const auto at = [&](double h) {
    return count_substeps(body, Vec3<double>{}, 0.0, h, 1.0, limits(1, 64), fourth, rate);
  };
  EXPECT_EQ(at(0.1).parts, 1);
  EXPECT_EQ(at(1).parts, 6);
  EXPECT_EQ(at(100).obstacle, Obstacle::damping);
  EXPECT_FALSE(at(100).within_limit);
}

TEST(CountSubsteps, of_a_scheme_that_feels_a_push_looks_at_turn_and_torque_together) {
  const auto body = principal({1, 1, 1});
  const Sensitivity pushed{0, 2, Reading::none, 0.35, 0};
  const auto parts = [&](double impulse) {
    return count_substeps(body, Vec3<double>{0, 0, 1}, impulse, 1.0, 1.0, limits(1.5, 64), pushed)
        .parts;
  };
  EXPECT_EQ(parts(0), 1);
  EXPECT_EQ(parts(1e-3), 1) << "a weak torque has the whole angle";
  EXPECT_GE(parts(0.45), 2);
  EXPECT_GE(parts(1), 3);
}

TEST(DecayRate, of_a_body_in_skew_axes_is_never_below_the_largest_eigenvalue) {
  Generator random(36);
  for (int i = 0; i < 500; ++i) {
    const Eigen::Matrix3d J =
        test::rotated_inertia(test::moments(random), test::unit_quaternion(random));
    const Eigen::Vector3d c = to_eigen(test::unit_vector(random)).cwiseAbs();
    const double largest =
        (J.inverse() * c.asDiagonal()).eval().eigenvalues().cwiseAbs().maxCoeff();
    const double rate = decay_rate(RigidBody<double>(J), from_eigen(c));
    ASSERT_GE(rate, largest * (1 - 1e-12));
    ASSERT_LE(rate, 3 * largest * (1 + 1e-12));
  }
}

}  // namespace
}  // namespace adstar
