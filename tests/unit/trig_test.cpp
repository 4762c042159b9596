#include "adstar/trig.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "adstar/sine.hpp"
#include "tests/support/random_motion.hpp"
#include "tests/support/wide.hpp"

namespace adstar {
namespace {

using test::Generator;
using test::Wide;

const Wide& half_pi() {
  static const Wide value = boost::multiprecision::atan(Wide(1)) * 2;
  return value;
}

struct Truth {
  Wide sin, cos;
};

/// Reduced in 100 digits, so that no argument of a double is too large.
Truth truth_of(double x) {
  const Wide n = round(Wide(x) / half_pi());
  const test::Quad r = static_cast<test::Quad>(Wide(x) - n * half_pi());
  const Wide s(sin(r)), c(cos(r));
  const int quadrant = static_cast<int>(static_cast<long long>(fmod(n, Wide(4))));
  switch ((quadrant + 4) % 4) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

/// Larger error of the two, in the last place of the larger of sine and cosine (which lies in [√½,
/// 1)).
double error_ulp(double x) {
  const SinCos<double> got = sincos(x);
  const Truth truth = truth_of(x);
  const double last_place = 0x1p-53;
  const double sine_error = test::to_double(abs(Wide(got.sin) - truth.sin));
  const double cosine_error = test::to_double(abs(Wide(got.cos) - truth.cos));
  return std::fmax(sine_error, cosine_error) / last_place;
}

TEST(SinCos, stays_below_one_and_a_half_ulp_within_1e8) {
  Generator random(1);
  double worst = 0, worst_at = 0;
  const auto probe = [&](double x) {
    const double error = error_ulp(x);
    if (!(error <= worst)) {
      worst = error;
      worst_at = x;
    }
  };
  for (int i = 0; i < 20000; ++i) {
    probe(test::uniform(random, -7, 7));
    probe(test::uniform(random, -1e4, 1e4));
    probe(test::uniform(random, -1e8, 1e8));
    probe(test::log_uniform(random, 1e-12, 1e8));
  }
  probe(0.0);
  probe(1e8);
  probe(-1e8);
  EXPECT_LT(worst, 1.5) << "at x = " << worst_at;
  RecordProperty("worst_ulp", std::to_string(worst));
}

TEST(SinCos, holds_its_bound_beside_every_multiple_of_a_quarter_turn) {
  Generator random(2);
  for (int i = 0; i < 3000; ++i) {
    const double n = i < 64 ? i : std::floor(test::log_uniform(random, 64, 1e8 / 1.6));
    double x = test::to_double(Wide(n) * half_pi());
    x = std::nextafter(x, -1e300);
    for (int k = 0; k < 3; ++k, x = std::nextafter(x, 1e300)) {
      ASSERT_LT(error_ulp(x), 1.5) << "n = " << n << ", x = " << x;
      ASSERT_LT(error_ulp(-x), 1.5) << "n = " << n << ", x = " << -x;
    }
  }
}

TEST(SinCos, holds_its_bound_where_the_octants_meet) {
  for (int n = -40; n <= 40; ++n) {
    double x = test::to_double((Wide(n) + Wide(0.5)) * half_pi());
    x = std::nextafter(std::nextafter(x, -1e300), -1e300);
    for (int k = 0; k < 5; ++k, x = std::nextafter(x, 1e300)) {
      ASSERT_LT(error_ulp(x), 1.5) << "n = " << n << ", x = " << x;
    }
  }
}

TEST(SinCos, beyond_1e8_errs_by_less_than_half_the_arguments_last_place) {
  Generator random(3);
  for (int i = 0; i < 3000; ++i) {
    // Above 1e16 the argument's own last place exceeds a radian: no error can be told any more.
    const double x = (i % 2 == 0 ? 1 : -1) * test::log_uniform(random, 1e8, 1e16);
    const double allowed = 1.5 + (4e-17 * std::fabs(x)) / 0x1p-53;
    ASSERT_LT(error_ulp(x), allowed) << "x = " << x;
  }
}

TEST(SinCos, lies_on_the_unit_circle_at_any_magnitude) {
  Generator random(4);
  for (int i = 0; i < 20000; ++i) {
    const double x = test::log_uniform(random, 1e-300, 1e300);
    const SinCos<double> a = sincos(x);
    ASSERT_NEAR(a.sin * a.sin + a.cos * a.cos, 1.0, 8 * test::kEpsilon) << "x = " << x;
  }
}

TEST(SinCos, keeps_the_relative_accuracy_of_a_small_sine) {
  Generator random(5);
  for (int i = 0; i < 5000; ++i) {
    const double x = test::log_uniform(random, 1e-18, 0.7);
    const Wide truth = truth_of(x).sin;
    const double relative = test::to_double(abs(Wide(sincos(x).sin) / truth - 1));
    ASSERT_LT(relative, 1.5 * test::kEpsilon) << "x = " << x;
  }
  EXPECT_EQ(sincos(1e-300).sin, 1e-300);
  EXPECT_EQ(sincos(0.0).sin, 0.0);
  EXPECT_EQ(sincos(0.0).cos, 1.0);
}

TEST(SinCos, is_odd_and_even) {
  Generator random(6);
  for (int i = 0; i < 10000; ++i) {
    const double x = test::log_uniform(random, 1e-6, 1e12);
    ASSERT_EQ(sincos(-x).sin, -sincos(x).sin) << "x = " << x;
    ASSERT_EQ(sincos(-x).cos, sincos(x).cos) << "x = " << x;
  }
}

TEST(SinCos, gives_nan_for_nan_and_infinity) {
  const double inf = std::numeric_limits<double>::infinity();
  for (const double x : {inf, -inf, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_TRUE(std::isnan(sincos(x).sin)) << x;
    EXPECT_TRUE(std::isnan(sincos(x).cos)) << x;
  }
}

TEST(SinCos, of_another_scalar_is_that_scalars_own) {
  const test::Quad x("0.123456789012345678901234567890123");
  EXPECT_EQ(sincos(x).sin, sin(x));
  EXPECT_EQ(sincos(x).cos, cos(x));
  EXPECT_EQ(sincos(1.25L).sin, std::sin(1.25L));
}

/// Absolute error of the sine for torques.
double sine_error(double x) { return test::to_double(abs(Wide(sine(x)) - truth_of(x).sin)); }

TEST(Sine, errs_by_less_than_4e_16_within_1e8) {
  Generator random(11);
  for (int i = 0; i < 20'000; ++i) {
    const double x = test::log_uniform(random, 1e-12, 1e8) * (i % 2 == 0 ? 1 : -1);
    EXPECT_LT(sine_error(x), 4e-16) << x;
  }
}

TEST(Sine, holds_its_bound_beside_every_multiple_of_a_quarter_turn) {
  for (int n = -2000; n <= 2000; ++n) {
    const double x = test::to_double(n * half_pi());
    for (const double at : {std::nextafter(x, -1e9), x, std::nextafter(x, 1e9)}) {
      EXPECT_LT(sine_error(at), 4e-16) << at;
    }
  }
}

TEST(Sine, keeps_the_relative_accuracy_of_a_small_argument) {
  for (const double x : {1e-300, 1e-20, 1e-8, 1e-3, -1e-5}) {
    EXPECT_NEAR(sine(x) / test::to_double(truth_of(x).sin), 1, 3e-16) << x;
  }
  EXPECT_EQ(sine(0.0), 0.0);
}

TEST(Sine, is_the_pairs_sine_beyond_1e8_and_nan_where_that_is) {
  for (const double x : {1.7e8, -3e9, 5e15, 1e300}) {
    EXPECT_NEAR(sine(x), sincos(x).sin, 6e-16) << x;
  }
  EXPECT_TRUE(std::isnan(sine(std::numeric_limits<double>::infinity())));
  EXPECT_TRUE(std::isnan(sine(std::numeric_limits<double>::quiet_NaN())));
}

TEST(Sines, have_the_bits_of_the_sine_of_each) {
  Generator random(12);
  for (int i = 0; i < 2'000; ++i) {
    double angles[7];
    for (double& angle : angles) {
      angle = test::log_uniform(random, 1e-12, i % 2 == 0 ? 1e8 : 1e12) * (i % 3 == 0 ? -1 : 1);
    }
    double sines[7];
    std::copy(std::begin(angles), std::end(angles), sines);
    replace_by_sines(sines);
    for (int k = 0; k < 7; ++k) {
      EXPECT_EQ(sines[k], sine(angles[k])) << angles[k];
    }
  }
}

}  // namespace
}  // namespace adstar
