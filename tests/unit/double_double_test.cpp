// Pairs of doubles against 100 digits.
#include "adstar/double_double.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/random_motion.hpp"
#include "tests/support/wide.hpp"

namespace adstar {
namespace {

using test::Generator;
using test::kEpsilon;
using test::Wide;

Wide value(const DoubleDouble& x) { return Wide(x.hi) + Wide(x.lo); }

DoubleDouble some(Generator& random) {
  const double hi = test::log_uniform(random, 1e-6, 1e6) * (random() % 2 == 0 ? 1 : -1);
  return DoubleDouble(hi) + DoubleDouble(hi * 1e-17 * test::uniform(random, -1, 1));
}

TEST(DoubleDouble, computes_to_a_hundred_bits) {
  Generator random(91);
  const double tolerance = std::ldexp(1.0, -100);
  for (int i = 0; i < 20'000; ++i) {
    const DoubleDouble a = some(random), b = some(random);
    const Wide x = value(a), y = value(b);
    ASSERT_LE(abs(value(a + b) - (x + y)), tolerance * abs(x + y));
    ASSERT_LE(abs(value(a - b) - (x - y)), tolerance * abs(x - y));
    ASSERT_LE(abs(value(a * b) - x * y), tolerance * abs(x * y));
    ASSERT_LE(abs(value(a * b.hi) - x * b.hi), tolerance * abs(x * b.hi));
    ASSERT_LE(abs(value(a / b) - x / y), tolerance * abs(x / y));
    ASSERT_LE(abs(value(sqrt(abs(a))) - sqrt(abs(x))), tolerance * sqrt(abs(x)));
  }
}

TEST(DoubleDouble, loses_nothing_of_a_product_or_a_sum_of_two_doubles) {
  Generator random(92);
  for (int i = 0; i < 20'000; ++i) {
    const double a = some(random).hi, b = some(random).hi;
    ASSERT_EQ(value(detail::two_product(a, b)), Wide(a) * Wide(b));
    ASSERT_EQ(value(detail::two_sum(a, b)), Wide(a) + Wide(b));
  }
}

TEST(DoubleDouble, sine_and_cosine_keep_their_phase_at_every_size) {
  Generator random(93);
  for (int i = 0; i < 20'000; ++i) {
    const double hi = test::log_uniform(random, 1e-9, 9e14) * (i % 2 == 0 ? 1 : -1);
    const DoubleDouble x{hi, 0.4 * kEpsilon * hi * test::uniform(random, -1, 1)};
    const SinCos<double> a = sincos(x);
    ASSERT_LT(abs(Wide(a.sin) - sin(value(x))), 1.5 * kEpsilon) << hi;
    ASSERT_LT(abs(Wide(a.cos) - cos(value(x))), 1.5 * kEpsilon) << hi;
  }
  EXPECT_TRUE(std::isnan(sincos(DoubleDouble(1e17)).sin));
  EXPECT_TRUE(std::isnan(sincos(DoubleDouble(std::nan(""))).cos));
}

TEST(DoubleDouble, roots_of_zero_and_below_are_zero_and_none) {
  EXPECT_EQ(sqrt(DoubleDouble(0.0)), DoubleDouble(0.0));
  EXPECT_TRUE(std::isnan(sqrt(DoubleDouble(-1.0)).hi));
}

TEST(ArcTangent, is_within_one_and_a_half_ulp_and_odd) {
  Generator random(94);
  double worst = 0;
  for (int i = 0; i < 50'000; ++i) {
    const double x =
        i % 2 == 0 ? test::log_uniform(random, 1e-300, 1e300) : test::uniform(random, 0, 1.5);
    const double error = static_cast<double>(abs(Wide(atan(x)) - atan(Wide(x))));
    worst = std::max(worst, error / test::ulp(std::atan(x)));
    ASSERT_EQ(adstar::atan(-x), -adstar::atan(x));
  }
  EXPECT_LT(worst, 1.5);
  EXPECT_EQ(adstar::atan(0.0), 0);
  EXPECT_EQ(adstar::atan(INFINITY), std::acos(0.0));
  EXPECT_TRUE(std::isnan(adstar::atan(std::nan(""))));
}

}  // namespace
}  // namespace adstar
