// What a turn adds to the identity, in float, against the closed forms in 113 bits.
#include "adstar/added_turn.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/random_motion.hpp"
#include "tests/support/wide.hpp"

namespace adstar {
namespace {

using test::Quad;

constexpr double kPi = 3.141592653589793;

/// 1e-12 to π by ratios, and both sides of every threshold of the series.
std::vector<double> angles() {
  std::vector<double> all;
  for (int i = 0; i <= 2000; ++i) {
    all.push_back(1e-12 * std::pow(kPi / 1e-12, i / 2000.0));
  }
  for (const double threshold : {kTinyAngleRad, kSmallAngleRad, 2 * std::sqrt(2.5)}) {
    for (const double side : {-1e-3, -1e-7, 0.0, 1e-7, 1e-3}) {
      all.push_back(threshold * (1 + side));
    }
  }
  return all;
}

/// The largest |got - exact| over the angles, in float's rounding of what a turn of θ can add.
template <class Map>
double worst(const std::vector<double>& angles, const Map& map) {
  test::Generator random(17);
  double worst = 0;
  for (const double angle : angles) {
    const Vec3<float> psi = test::convert<float>(angle * test::unit_vector(random));
    const Vec3<float> v = test::convert<float>(test::unit_vector(random));
    const Vec3<float> got = map(AddedTurn<float>(psi), v);
    const Vec3<Quad> exact = map(AddedTurn<Quad>(test::convert<Quad>(psi)), test::convert<Quad>(v));
    const auto off = static_cast<double>(norm(test::convert<Quad>(got) - exact));
    worst = std::fmax(worst, off / (angle * std::numeric_limits<float>::epsilon()));
  }
  return worst;
}

const auto kExp = [](const auto& turn, const auto& v) { return turn.exp(v); };
const auto kExpInverse = [](const auto& turn, const auto& v) { return turn.exp_inverse(v); };
const auto kDexpinvMinus = [](const auto& turn, const auto& v) { return turn.dexpinv_minus(v); };

TEST(AddedTurnOfFloat, is_right_to_the_roundings_of_what_it_adds_up_to_half_a_turn) {
  EXPECT_LT(worst(angles(), kExp), 2);
  EXPECT_LT(worst(angles(), kExpInverse), 2);
  EXPECT_LT(worst(angles(), kDexpinvMinus), 2);
}

TEST(AddedTurnOfFloat, holds_past_half_a_turn_too) {
  const std::vector<double> past{3.2, 4.0, 5.0, 5.5};
  EXPECT_LT(worst(past, kExp), 2);
  EXPECT_LT(worst(past, kDexpinvMinus), 20);  // its pole is at 2π
}

TEST(AddedTurnOfFloat, is_no_number_for_what_is_none_or_too_large_to_square) {
  const float inf = std::numeric_limits<float>::infinity();
  for (const float bad : {inf, std::numeric_limits<float>::quiet_NaN(), 1e30F}) {
    const AddedTurn<float> turn(Vec3<float>{bad, 1, 0});
    EXPECT_TRUE(std::isnan(turn.exp(Vec3<float>{1, 2, 3}).z)) << bad;
    EXPECT_TRUE(std::isnan(turn.dexpinv_minus(Vec3<float>{1, 2, 3}).z)) << bad;
  }
}

}  // namespace
}  // namespace adstar
