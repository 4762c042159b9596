#include "adstar/exponential.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/support/random_motion.hpp"
#include "tests/support/wide.hpp"

namespace adstar {
namespace {

using test::Generator;

/// In units of the last place of the true value, which below the normal numbers is that of all subnormal ones.
double error_ulp(double x) {
  const long double truth = std::exp(static_cast<long double>(x));
  const double nearest = static_cast<double>(truth);
  const double below = std::nextafter(nearest, 0.0);
  const long double place = nearest == 0 ? std::numeric_limits<double>::denorm_min()
                                         : static_cast<long double>(nearest) - below;
  return static_cast<double>(std::fabs(static_cast<long double>(exponential(x)) - truth) / place);
}

TEST(Exponential, stays_below_one_and_a_half_ulp_over_the_whole_range) {
  Generator random(1);
  double worst = 0, worst_at = 0;
  const auto probe = [&](double x) {
    const double error = error_ulp(x);
    if (!(error <= worst)) {
      worst = error;
      worst_at = x;
    }
  };
  for (int i = 0; i < 200'000; ++i) {
    probe(test::uniform(random, -1, 1));
    probe(test::uniform(random, -40, 5));
    probe(test::uniform(random, -708.3, 709.7));
    probe(-test::log_uniform(random, 1e-18, 700));
    probe(test::log_uniform(random, 1e-18, 700));
  }
  for (int n = -1020; n <= 1022; ++n) {  // where the pieces meet
    const double edge = (n + 0.5) * 0.6931471805599453;
    for (const double x : {std::nextafter(edge, -1e4), edge, std::nextafter(edge, 1e4)}) {
      probe(x);
    }
  }
  EXPECT_LT(worst, 1.5) << "at x = " << worst_at;
  RecordProperty("worst_ulp", std::to_string(worst));
}

TEST(Exponential, of_a_subnormal_result_holds_the_same_bound) {
  Generator random(2);
  for (int i = 0; i < 100'000; ++i) {
    const double x = test::uniform(random, -745.13, -708.3);
    ASSERT_LT(error_ulp(x), 1.5) << x;
  }
}

TEST(Exponential, ends_where_double_ends) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(exponential(0.0), 1.0);
  EXPECT_EQ(exponential(-0.0), 1.0);
  EXPECT_EQ(exponential(1e-300), 1.0);
  EXPECT_LT(error_ulp(0x1.62e42fefa39efp+9), 1.5);
  EXPECT_EQ(exponential(709.79), kInfinity);
  EXPECT_EQ(exponential(kInfinity), kInfinity);
  EXPECT_EQ(exponential(-745.2), 0.0);
  EXPECT_EQ(exponential(-1e300), 0.0);
  EXPECT_EQ(exponential(-kInfinity), 0.0);
  EXPECT_EQ(exponential(-745.1), std::numeric_limits<double>::denorm_min());
  EXPECT_TRUE(std::isnan(exponential(std::numeric_limits<double>::quiet_NaN())));
}

TEST(Exponential, does_not_fall_as_its_argument_rises) {
  double before = 0;
  for (double x = -745.5; x < 709.7; x += 0.00173) {
    const double y = exponential(x);
    ASSERT_GE(y, before) << x;
    before = y;
  }
}

TEST(Exponential, of_another_scalar_is_that_scalars_own) {
  const test::Quad x("0.123456789012345678901234567890123");
  EXPECT_EQ(exponential(x), exp(x));
}

}  // namespace
}  // namespace adstar
