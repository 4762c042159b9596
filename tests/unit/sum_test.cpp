#include <cmath>

#include <gtest/gtest.h>

#include "adstar/state.hpp"
#include "tests/support/random_motion.hpp"
#include "tests/support/wide.hpp"

namespace adstar {
namespace {

using test::Generator;
using test::Quad;

/// Units in the last place between the sum and the exact one.
double error_ulp(const Sum<double>& sum, const Quad& exact) {
  return test::to_double(abs(Quad(sum.value) - exact)) / test::ulp(test::to_double(exact));
}

TEST(Sum, of_ten_million_tenths_is_right_to_the_last_place) {
  Sum<double> sum;
  double plain = 0;
  Quad exact = 0;
  for (int i = 0; i < 10'000'000; ++i) {
    sum.add(0.1);
    plain += 0.1;
    exact += Quad(0.1);
  }
  EXPECT_LE(error_ulp(sum, exact), 1.0);
  EXPECT_GT(std::fabs(plain - test::to_double(exact)), 1e-6) << "the plain sum would have done";
}

TEST(Sum, of_terms_of_any_sign_and_size_is_right_to_the_last_place_of_its_largest) {
  Generator random(41);
  Sum<double> sum;
  Quad exact = 0;
  double largest = 0;
  for (int i = 0; i < 1'000'000; ++i) {
    const double term =
        test::log_uniform(random, 1e-9, 1) * (test::uniform(random, -1, 1) < 0 ? -1 : 1);
    sum.add(term);
    exact += Quad(term);
    largest = std::fmax(largest, std::fabs(sum.value));
  }
  EXPECT_LE(test::to_double(abs(Quad(sum.value) - exact)), test::ulp(largest));
}

TEST(Sum, with_its_carry_is_closer_than_a_double_can_tell) {
  Generator random(42);
  Sum<double> sum;
  Quad exact = 0;
  for (int i = 0; i < 100'000; ++i) {
    const double term = test::uniform(random, 0, 1e-3);
    sum.add(term);
    exact += Quad(term);
    ASSERT_LE(std::fabs(sum.carry), test::ulp(sum.value) / 2);
  }
  EXPECT_LE(test::to_double(abs(Quad(sum.value) + Quad(sum.carry) - exact)),
            1e-3 * test::ulp(sum.value));
}

TEST(Sum, keeps_what_a_single_addition_would_lose) {
  Sum<double> sum;
  sum.add(1.0);
  for (int i = 0; i < 1024; ++i) {
    sum.add(0x1p-60);
  }
  EXPECT_EQ(sum.value, 1.0 + 0x1p-50);
}

TEST(Sum, takes_a_term_far_larger_than_itself) {
  Sum<double> sum;
  sum.add(1.0);
  sum.add(1e20);
  EXPECT_EQ(sum.value, 1e20);
  EXPECT_EQ(sum.carry, 1.0);
}

TEST(Sum, is_not_moved_by_zero) {
  Sum<double> sum;
  sum.add(0.1);
  sum.add(0x1p-60);
  const Sum<double> before = sum;
  for (int i = 0; i < 10; ++i) {
    sum.add(0.0);
  }
  EXPECT_EQ(sum, before);
}

TEST(VecSum, adds_axis_by_axis) {
  VecSum<double> sum;
  sum.add({1, 2, 3});
  sum.add({10, 20, 30});
  EXPECT_EQ(sum.value(), (Vec3<double>{11, 22, 33}));
}

TEST(State, begins_with_a_unit_attitude_and_the_momentum_as_given) {
  const Vec3<double> H_I{0.1, -0.2, 0.3};
  const State<double> state = make_state(Quat<double>{2, 0, 0, 2}, H_I);
  EXPECT_NEAR(squared_norm(state.q_IB), 1, 4 * test::kEpsilon);
  EXPECT_EQ(state.H_I.value(), H_I);
  EXPECT_EQ(state.impulse_I.value(), Vec3<double>{});
  EXPECT_EQ(state.work.value, 0);
}

TEST(State, body_momentum_is_the_inertial_one_seen_from_the_body) {
  Generator random(43);
  for (int i = 0; i < 200; ++i) {
    const Vec3<double> Pi_B = test::unit_vector(random);
    const Quat<double> q_IB = test::unit_quaternion(random);
    const State<double> state = make_state(q_IB, rotate(q_IB, Pi_B));
    ASSERT_LT(norm(body_momentum(state) - Pi_B), 16 * test::kEpsilon);
  }
}

}  // namespace
}  // namespace adstar
