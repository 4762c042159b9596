// A thinned stability map: every scheme, from a turn of 1e-12 to 20 rad a step, over bodies from a
// needle to a flat disc and from a chipsat to a station. Where a scheme cannot resolve the motion it
// says so; nothing is wrong in silence.
//
// The truth is the closed form in 64-bit-mantissa arithmetic. Wrong: off by more than a hundredth of
// the angle turned (10 times what the default limits are chosen for), and by more than round-off.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/compiled_schemes.hpp"
#include "tests/support/random_motion.hpp"
#include "tests/support/schemes.hpp"

namespace adstar {
namespace {

using Wide = long double;
using V = Vec3<double>;

constexpr double kWrongPerRad = 1e-2;
constexpr double kRoundOff = 1e-7;  ///< of a needle: eps · |Pi|/J_min h
constexpr int kSteps = 3;

struct Shape {
  std::string name;
  Eigen::Vector3d moments;
};

const std::vector<Shape>& shapes() {
  static const std::vector<Shape> all = {{"needle", {1e-6, 1, 1 + 5e-7}},
                                         {"thin", {1e-3, 1, 1 + 5e-4}},
                                         {"near sphere", {1, 1 + 1e-12, 1 + 2e-12}},
                                         {"flat disc", {0.5, 0.7, 1.2}},
                                         {"ordinary", {0.9144, 1.098, 1.66}},
                                         {"chipsat", {1e-9, 2e-9, 2.5e-9}},
                                         {"station", {1e9, 2e9, 2.5e9}}};
  return all;
}

/// Body momenta of unit size: about each axis and slightly off it, and in random directions.
std::vector<V> directions() {
  test::Generator random(91);
  std::vector<V> all = {{1, 1e-3, 1e-3}, {1e-3, 1e-3, 1}, {1, 0, 0}, {0, 0, 1}};
  for (int i = 0; i < 12; ++i) {
    all.push_back(test::unit_vector(random));
  }
  return all;
}

Quat<Wide> widened(const Quat<double>& q) { return {q.w, q.x, q.y, q.z}; }

struct Cell {
  bool reported = false;
  double error_rad = 0, turned_rad = 0;
  bool wrong() const {
    return !reported && !(error_rad <= std::max(kRoundOff, kWrongPerRad * turned_rad));
  }
};

/// On the separatrix or beside it, far from the middle axis and near it.
std::vector<V> directions_beside_separatrix(const Eigen::Vector3d& J) {
  const double A = (J[1] - J[0]) / J[0], B = (J[2] - J[1]) / J[2];
  std::vector<V> all;
  for (const double aside : {0.0, 1e-12, 1e-6, 1e-2}) {
    for (const double middle : {1e-6, 1e-2, 1.0}) {
      all.push_back({std::sqrt(B) * (1 + aside), std::sqrt(A + B) * middle, std::sqrt(A)});
    }
  }
  return all;
}

template <class Scheme>
Cell run(const Eigen::Vector3d& moments, const V& direction, double turn, int steps = kSteps) {
  const Eigen::Matrix3d J = moments.asDiagonal();
  const RigidBody<double> body(J);
  // The momentum that turns by `turn` in a step of a second.
  const double fastest = std::sqrt(angular_speed_bound_squared(body, direction, 0.0));
  const V Pi = (turn / fastest) * direction;
  State<double> state = make_state(Quat<double>{}, Pi);
  State<Wide> truth = make_state(Quat<Wide>{1, 0, 0, 0}, Vec3<Wide>{Pi.x, Pi.y, Pi.z});
  const BodyOf<Scheme, double> prepared(body);
  Cell cell;
  for (std::int64_t n = 0; n < steps && !cell.reported; ++n) {
    cell.reported =
        !test::Compiled<Scheme>::advance(prepared, state, {}, n * 1'000'000'000, 1'000'000'000)
             .resolved();
  }
  const BodyOf<FreeExact, Wide> exact{RigidBody<Wide>(J.cast<Wide>())};
  FreeExact::step(exact, truth, Wide(steps), NoTorque{});
  cell.turned_rad = turn * steps;
  cell.error_rad =
      static_cast<double>(angle_between(normalised(truth.q_IB), normalised(widened(state.q_IB))));
  return cell;
}

template <class Scheme>
class Stability : public testing::Test {};
TYPED_TEST_SUITE(Stability, test::SchemeTypes);

TYPED_TEST(Stability, of_free_motion_is_never_wrong_in_silence) {
  for (const Shape& shape : shapes()) {
    for (const V& direction : directions()) {
      for (const double turn : {1e-12, 1e-6, 1e-3, 0.03, 0.1, 0.3, 0.7, 1.0, 1.5, 3.0, 7.0, 20.0}) {
        const Cell cell = run<TypeParam>(shape.moments, direction, turn);
        EXPECT_FALSE(cell.wrong())
            << shape.name << " about (" << direction.x << ", " << direction.y << ", " << direction.z
            << "), |omega|h = " << turn << ": off by " << cell.error_rad << " rad";
      }
    }
  }
}

TYPED_TEST(Stability, of_a_step_beside_the_separatrix_is_never_wrong_in_silence) {
  const std::vector<Eigen::Vector3d> bodies = {
      {0.8, 1.2, 2}, {0.9144, 1.098, 1.66}, {0.066, 0.85, 0.894}, {1e-4, 1, 1.00005}};
  for (const Eigen::Vector3d& J : bodies) {
    for (const V& direction : directions_beside_separatrix(J)) {
      for (const double turn : {1.0, 3.0, 7.0, 12.0, 20.0}) {
        const Cell cell = run<TypeParam>(J, direction, turn, 1);
        EXPECT_FALSE(cell.wrong())
            << "J = " << J.transpose() << ", Pi along (" << direction.x << ", " << direction.y
            << ", " << direction.z << "), |omega|h = " << turn << ": off by " << cell.error_rad
            << " rad";
      }
    }
  }
}

TYPED_TEST(Stability, of_an_ordinary_body_is_resolved_up_to_three_radians_a_step) {
  for (const V& direction : directions()) {
    for (const double turn : {0.1, 1.0, 3.0}) {
      EXPECT_FALSE(run<TypeParam>({0.9144, 1.098, 1.66}, direction, turn).reported) << turn;
    }
  }
}

TYPED_TEST(Stability, of_a_momentum_of_nothing_or_next_to_it_is_rest) {
  for (const double tiny : {0.0, 5e-324, 1e-310}) {
    const RigidBody<double> body(Eigen::Matrix3d(Eigen::Vector3d(1, 1.5, 2).asDiagonal()));
    State<double> state = make_state(Quat<double>{}, V{tiny, tiny, 0});
    const BodyOf<TypeParam, double> prepared(body);
    const StepReport report =
        test::Compiled<TypeParam>::advance(prepared, state, {}, 0, 1'000'000'000);
    EXPECT_TRUE(report.resolved()) << tiny;
    EXPECT_LT(angle_between(state.q_IB, Quat<double>{}), 1e-15) << tiny;
  }
}

TYPED_TEST(Stability, of_a_momentum_too_large_to_square_is_reported) {
  if (TypeParam::kStageReach == 0) {
    GTEST_SKIP() << "answers any turn";
  }
  const RigidBody<double> body(Eigen::Matrix3d(Eigen::Vector3d(1, 1.5, 2).asDiagonal()));
  for (const double huge : {1e100, 1e154, 1e200, 1e308}) {
    State<double> state = make_state(Quat<double>{}, V{huge, 0.5 * huge, 0.1 * huge});
    const BodyOf<TypeParam, double> prepared(body);
    EXPECT_FALSE(
        (test::Compiled<TypeParam>::advance(prepared, state, {}, 0, 1'000'000'000).resolved()))
        << huge;
  }
}

}  // namespace
}  // namespace adstar
