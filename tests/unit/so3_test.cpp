#include "adstar/so3.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/random_motion.hpp"
#include "tests/support/so3_reference.hpp"

namespace adstar {

// Tags, because ctest names a typed test by its type and that of 113 bits fills three lines.
struct Bits53 {
  using Scalar = double;
};
struct Bits64 {
  using Scalar = long double;
};
struct Bits113 {
  using Scalar = test::Quad;
};

namespace {

using test::Generator;
using test::Quad;
using test::Wide;

constexpr double kPi = 3.141592653589793;

/// Where one series gives way to the next; the last stands in the library as u = (θ/2)² = 2.5.
const double kThresholds[] = {kTinyAngleRad, kSmallAngleRad, 2 * std::sqrt(2.5)};

/// 1e-12 to π, by ratios and by differences, and both sides of every threshold.
std::vector<double> angles(int by_ratio, int by_difference) {
  std::vector<double> angles;
  for (int i = 0; i <= by_ratio; ++i) {
    angles.push_back(1e-12 * std::pow(kPi / 1e-12, static_cast<double>(i) / by_ratio));
  }
  for (int i = 1; i <= by_difference; ++i) {
    angles.push_back(kPi * i / by_difference);
  }
  for (const double threshold : kThresholds) {
    for (const double side : {-1e-9, -1e-15, 0.0, 1e-15, 1e-9}) {
      angles.push_back(threshold * (1 + side));
    }
  }
  return angles;
}

template <class T>
Wide length(const Vec3<T>& v) {
  return norm(test::convert<Wide>(v));
}

template <class Tag>
class RotationOf : public testing::Test {
 public:
  using Scalar = typename Tag::Scalar;
  static double epsilon() { return static_cast<double>(std::numeric_limits<Scalar>::epsilon()); }

  /// |got - exact| in units of the scalar's rounding.
  static double error(const Vec3<Scalar>& got, const Vec3<Wide>& exact) {
    return static_cast<double>(norm(test::convert<Wide>(got) - exact)) / epsilon();
  }
  static double absolute(const Scalar& got, const Wide& exact) {
    return static_cast<double>(abs(Wide(got) - exact)) / epsilon();
  }
};

using Scalars = testing::Types<Bits53, Bits64, Bits113>;
TYPED_TEST_SUITE(RotationOf, Scalars);

/// The five maps, by the closed forms.
struct Exact {
  Vec3<Wide> exp, exp_inverse, dexp, dexpinv, dexpinv_minus;
};

Exact exact_maps(const Vec3<Wide>& psi, const Vec3<Wide>& v) {
  const test::ClosedForms f = test::closed_forms(norm(psi));
  const Vec3<Wide> c = cross(psi, v), cc = cross(psi, c);
  const Wide half = Wide(1) / 2;
  return {v + f.A * c + f.B * cc, v - f.A * c + f.B * cc, v + f.B * c + f.E * cc,
          v - half * c + f.g * cc, v + half * c + f.g * cc};
}

TYPED_TEST(RotationOf, agrees_with_the_closed_forms_up_to_half_a_turn) {
  using T = typename TypeParam::Scalar;
  Generator random(51);
  double worst = 0;
  for (const double angle : angles(800, 400)) {
    const Vec3<T> psi = test::convert<T>(angle * test::unit_vector(random));
    const Vec3<T> v = test::convert<T>(test::unit_vector(random));
    const Rotation<T> turn(psi);
    const Exact exact = exact_maps(test::convert<Wide>(psi), test::convert<Wide>(v));
    for (const double error :
         {this->error(turn.exp(v), exact.exp), this->error(turn.exp_inverse(v), exact.exp_inverse),
          this->error(turn.dexp(v), exact.dexp), this->error(turn.dexpinv(v), exact.dexpinv),
          this->error(turn.dexpinv_minus(v), exact.dexpinv_minus)}) {
      ASSERT_LT(error, 8) << angle;
      worst = std::fmax(worst, error);
    }
  }
  this->RecordProperty("worst_in_epsilons", std::to_string(worst));
}

TYPED_TEST(RotationOf, agrees_with_the_closed_forms_about_each_axis) {
  using T = typename TypeParam::Scalar;
  for (const double angle : angles(60, 30)) {
    for (int axis = 0; axis < 3; ++axis) {
      Vec3<T> psi{};
      (axis == 0 ? psi.x : axis == 1 ? psi.y : psi.z) = T(angle);
      for (const Vec3<T>& v :
           {Vec3<T>{T(1), T(0), T(0)}, Vec3<T>{T(0), T(1), T(0)}, Vec3<T>{T(0), T(0), T(1)}}) {
        const Exact exact = exact_maps(test::convert<Wide>(psi), test::convert<Wide>(v));
        const Rotation<T> turn(psi);
        ASSERT_LT(this->error(turn.exp(v), exact.exp), 6) << angle;
        ASSERT_LT(this->error(turn.exp_inverse(v), exact.exp_inverse), 6) << angle;
        ASSERT_LT(this->error(turn.dexp(v), exact.dexp), 6) << angle;
        ASSERT_LT(this->error(turn.dexpinv(v), exact.dexpinv), 6) << angle;
        ASSERT_LT(this->error(turn.dexpinv_minus(v), exact.dexpinv_minus), 6) << angle;
      }
    }
  }
}

TYPED_TEST(RotationOf, turns_vectors_as_the_power_series_does) {
  using T = typename TypeParam::Scalar;
  Generator random(52);
  for (const double angle : angles(30, 15)) {
    const Vec3<T> psi = test::convert<T>(angle * test::unit_vector(random));
    const Vec3<T> v = test::convert<T>(test::unit_vector(random));
    const Vec3<Wide> p = test::convert<Wide>(psi), w = test::convert<Wide>(v);
    const Rotation<T> turn(psi);
    ASSERT_LT(this->error(turn.exp(v), test::exp_series(p) * w), 8) << angle;
    ASSERT_LT(this->error(turn.exp_inverse(v), test::exp_series(-p) * w), 8) << angle;
    ASSERT_LT(this->error(turn.dexp(v), test::dexp_series(p) * w), 8) << angle;
    ASSERT_LT(this->error(turn.dexpinv(v), test::dexpinv_matrix(p) * w), 8) << angle;
    ASSERT_LT(this->error(turn.dexpinv_minus(v), test::dexpinv_matrix(-p) * w), 8) << angle;
  }
}

TYPED_TEST(RotationOf, turns_about_each_axis_by_the_right_hand) {
  using T = typename TypeParam::Scalar;
  using std::acos;
  const T quarter = acos(T(0));
  const Vec3<T> x{T(1), T(0), T(0)}, y{T(0), T(1), T(0)}, z{T(0), T(0), T(1)};
  EXPECT_LT(this->error(Rotation<T>(quarter * z).exp(x), test::convert<Wide>(y)), 4);
  EXPECT_LT(this->error(Rotation<T>(quarter * x).exp(y), test::convert<Wide>(z)), 4);
  EXPECT_LT(this->error(Rotation<T>(quarter * y).exp(z), test::convert<Wide>(x)), 4);
  EXPECT_LT(this->error(Rotation<T>(quarter * z).exp_inverse(y), test::convert<Wide>(x)), 4);
}

TYPED_TEST(RotationOf, undoes_dexp_by_dexpinv_and_exp_by_its_inverse) {
  using T = typename TypeParam::Scalar;
  Generator random(53);
  for (const double angle : angles(100, 50)) {
    const Rotation<T> turn(test::convert<T>(angle * test::unit_vector(random)));
    const Vec3<T> v = test::convert<T>(test::unit_vector(random));
    const Vec3<Wide> exact = test::convert<Wide>(v);
    ASSERT_LT(this->error(turn.dexp(turn.dexpinv(v)), exact), 16) << angle;
    ASSERT_LT(this->error(turn.dexpinv(turn.dexp(v)), exact), 16) << angle;
    ASSERT_LT(this->error(turn.exp(turn.exp_inverse(v)), exact), 16) << angle;
  }
}

TYPED_TEST(RotationOf, has_a_unit_quaternion_that_turns_as_exp_does) {
  using T = typename TypeParam::Scalar;
  Generator random(54);
  for (const double angle : angles(200, 100)) {
    const Vec3<T> psi = test::convert<T>(angle * test::unit_vector(random));
    const Vec3<T> v = test::convert<T>(test::unit_vector(random));
    const Rotation<T> turn(psi);
    const Quat<T> q = turn.quaternion();
    ASSERT_LT(this->absolute(squared_norm(q), Wide(1)), 4) << angle;
    ASSERT_LT(this->error(rotate(q, v), test::convert<Wide>(turn.exp(v))), 16) << angle;
    const Wide exact_angle = length(psi);
    const test::ClosedForms exact = test::closed_forms(exact_angle);
    ASSERT_LT(this->absolute(q.w, exact.half_cos), 3) << angle;
    const Wide factor = exact.half_sin / exact_angle;
    // Relative to the angle, or a slow spin would drift.
    const Wide relative =
        norm(test::convert<Wide>(Vec3<T>{q.x, q.y, q.z}) - factor * test::convert<Wide>(psi)) /
        exact.half_sin;
    ASSERT_LT(static_cast<double>(relative) / this->epsilon(), 4) << angle;
  }
}

TYPED_TEST(RotationOf, at_zero_is_the_identity_exactly) {
  using T = typename TypeParam::Scalar;
  const Rotation<T> still(Vec3<T>{});
  const Vec3<T> v{T(1), T(-2), T(3)};
  EXPECT_EQ(still.exp(v), v);
  EXPECT_EQ(still.exp_inverse(v), v);
  EXPECT_EQ(still.dexp(v), v);
  EXPECT_EQ(still.dexpinv(v), v);
  EXPECT_EQ(still.dexpinv_minus(v), v);
  EXPECT_EQ(still.quaternion(), Quat<T>{});
}

TYPED_TEST(RotationOf, does_not_jump_where_its_series_change) {
  using T = typename TypeParam::Scalar;
  const Vec3<T> v{T(0), T(1), T(0)};
  for (const double threshold : kThresholds) {
    const Rotation<T> below(Vec3<T>{T(threshold) * (T(1) - T(4 * this->epsilon())), T(0), T(0)});
    const Rotation<T> above(Vec3<T>{T(threshold) * (T(1) + T(4 * this->epsilon())), T(0), T(0)});
    // The two angles are up to 26 units apart at the last threshold; no map moves faster than they.
    const double allowed = 8 * threshold + 6;
    EXPECT_LT(this->error(below.exp(v), test::convert<Wide>(above.exp(v))), allowed) << threshold;
    EXPECT_LT(this->error(below.dexp(v), test::convert<Wide>(above.dexp(v))), allowed) << threshold;
    EXPECT_LT(this->error(below.dexpinv(v), test::convert<Wide>(above.dexpinv(v))), allowed)
        << threshold;
    EXPECT_LT(this->error(below.dexpinv_minus(v), test::convert<Wide>(above.dexpinv_minus(v))),
              allowed)
        << threshold;
  }
}

TYPED_TEST(RotationOf, stays_right_from_half_a_turn_to_near_the_singularity) {
  using T = typename TypeParam::Scalar;
  Generator random(55);
  for (double angle = 3.2; angle < 6.2; angle += 0.03) {
    const Vec3<T> psi = test::convert<T>(angle * test::unit_vector(random));
    const Vec3<T> v = test::convert<T>(test::unit_vector(random));
    const Rotation<T> turn(psi);
    const Exact exact = exact_maps(test::convert<Wide>(psi), test::convert<Wide>(v));
    ASSERT_LT(this->error(turn.exp(v), exact.exp), 32) << angle;
    ASSERT_LT(this->error(turn.dexp(v), exact.dexp), 32) << angle;
    // dexpinv has a pole at 2π: its error grows as the distance to it shrinks.
    const double distance = std::sin(angle / 2);
    ASSERT_LT(this->error(turn.dexpinv(v), exact.dexpinv) * distance * distance, 32) << angle;
    ASSERT_LT(this->error(turn.dexpinv_minus(v), exact.dexpinv_minus) * distance * distance, 32)
        << angle;
  }
}

/// R' of a matrix-valued R(t) = exp(psi + t rate), by central differences in 100 digits.
test::WideMatrix rate_of_exp(const Vec3<Wide>& psi, const Vec3<Wide>& rate) {
  const Wide step("1e-30");
  return (Wide(1) / (2 * step)) *
         (test::exp_series(psi + step * rate) + Wide(-1) * test::exp_series(psi - step * rate));
}

Vec3<Wide> axial(const test::WideMatrix& skew) {
  return {skew.m[2][1], skew.m[0][2], skew.m[1][0]};
}

TEST(Kinematics, dexp_gives_the_inertial_rate_and_dexpinv_undoes_it) {
  Generator random(56);
  for (const double angle : {1e-6, 0.01, 0.3, 0.5, 1.0, 2.0, 3.0}) {
    const Vec3<Wide> psi = test::convert<Wide>(angle * test::unit_vector(random));
    const Vec3<Wide> rate = test::convert<Wide>(test::unit_vector(random));
    // R' = hat(omega_I) R
    const Vec3<Wide> omega_I = axial(rate_of_exp(psi, rate) * test::exp_series(-psi));
    const Rotation<Quad> turn(test::convert<Quad>(psi));
    const Vec3<Quad> dexp = turn.dexp(test::convert<Quad>(rate));
    EXPECT_LT(test::to_double(norm(test::convert<Wide>(dexp) - omega_I)), 1e-31) << angle;
    const Vec3<Quad> back = turn.dexpinv(test::convert<Quad>(omega_I));
    EXPECT_LT(test::to_double(norm(test::convert<Wide>(back) - rate)), 1e-31) << angle;
  }
}

TEST(Kinematics, dexpinv_minus_gives_the_rate_of_psi_from_the_body_rate) {
  Generator random(57);
  for (const double angle : {1e-6, 0.01, 0.3, 0.5, 1.0, 2.0, 3.0}) {
    const Vec3<Wide> psi = test::convert<Wide>(angle * test::unit_vector(random));
    const Vec3<Wide> rate = test::convert<Wide>(test::unit_vector(random));
    // R' = R hat(omega_B): with the sign the other way about this fails by |psi|.
    const Vec3<Wide> omega_B = axial(test::exp_series(-psi) * rate_of_exp(psi, rate));
    const Vec3<Quad> got =
        Rotation<Quad>(test::convert<Quad>(psi)).dexpinv_minus(test::convert<Quad>(omega_B));
    EXPECT_LT(test::to_double(norm(test::convert<Wide>(got) - rate)), 1e-31) << angle;
  }
}

TEST(Kinematics, dexpinv_minus_begins_with_plus_half_of_psi_cross_v) {
  const Vec3<double> psi{1e-5, -2e-5, 1.5e-5}, v{0.3, 0.8, -0.5};
  const Rotation<double> turn(psi);
  EXPECT_LT(norm(turn.dexpinv_minus(v) - (v + 0.5 * cross(psi, v))), 1e-9);
  EXPECT_LT(norm(turn.dexpinv(v) - (v - 0.5 * cross(psi, v))), 1e-9);
}

TEST(Rotation, in_double_agrees_with_itself_in_long_double) {
  Generator random(58);
  for (const double angle : angles(20'000, 20'000)) {
    const Vec3<double> psi = angle * test::unit_vector(random), v = test::unit_vector(random);
    const Rotation<double> turn(psi);
    const Rotation<long double> longer(test::convert<long double>(psi));
    const Vec3<long double> w = test::convert<long double>(v);
    const auto apart = [](const Vec3<double>& a, const Vec3<long double>& b) {
      return static_cast<double>(norm(test::convert<long double>(a) - b));
    };
    ASSERT_LT(apart(turn.exp(v), longer.exp(w)), 8 * test::kEpsilon) << angle;
    ASSERT_LT(apart(turn.exp_inverse(v), longer.exp_inverse(w)), 8 * test::kEpsilon) << angle;
    ASSERT_LT(apart(turn.dexp(v), longer.dexp(w)), 8 * test::kEpsilon) << angle;
    ASSERT_LT(apart(turn.dexpinv(v), longer.dexpinv(w)), 8 * test::kEpsilon) << angle;
    ASSERT_LT(apart(turn.dexpinv_minus(v), longer.dexpinv_minus(w)), 8 * test::kEpsilon) << angle;
  }
}

TEST(Hat, is_the_matrix_of_the_cross_product) {
  const Eigen::Vector3d v(1, -2, 3), w(0.5, 4, -1);
  EXPECT_EQ(hat<double>(v) * w, v.cross(w));
}

TEST(RotationMatrix, has_the_body_axes_for_columns) {
  const Quat<double> q_IB = Rotation<double>(Vec3<double>{0.3, -0.4, 1.2}).quaternion();
  const Eigen::Matrix3d R_IB = rotation_matrix(q_IB);
  EXPECT_EQ(Eigen::Vector3d(R_IB.col(1)), to_eigen(rotate(q_IB, Vec3<double>{0, 1, 0})));
  EXPECT_LT((R_IB.transpose() * R_IB - Eigen::Matrix3d::Identity()).norm(), 16 * test::kEpsilon);
  EXPECT_NEAR(R_IB.determinant(), 1, 16 * test::kEpsilon);
}

TEST(ClosedForms, agree_with_the_power_series) {
  Generator random(59);
  for (const double angle : {1e-9, 0.1, 1.0, 3.0}) {
    const Vec3<Wide> psi = test::convert<Wide>(angle * test::unit_vector(random));
    const Vec3<Wide> v = test::convert<Wide>(test::unit_vector(random));
    const test::ClosedForms f = test::closed_forms(norm(psi));
    const Vec3<Wide> c = cross(psi, v), cc = cross(psi, c);
    EXPECT_LT(test::to_double(norm(v + f.A * c + f.B * cc - test::exp_series(psi) * v)), 1e-60);
    EXPECT_LT(test::to_double(norm(v + f.B * c + f.E * cc - test::dexp_series(psi) * v)), 1e-60);
    const Vec3<Wide> inverse = v - Wide(0.5) * c + f.g * cc;
    EXPECT_LT(test::to_double(norm(inverse - test::dexpinv_matrix(psi) * v)), 1e-60);
  }
}

}  // namespace
}  // namespace adstar
