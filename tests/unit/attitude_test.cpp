#include "adstar/attitude.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "adstar/so3.hpp"
#include "tests/support/random_motion.hpp"
#include "tests/support/wide.hpp"

namespace adstar {
namespace {

using test::Generator;
using test::kEpsilon;

double distance(const Vec3<double>& a, const Vec3<double>& b) { return norm(a - b); }

Quat<double> about_axis(const Vec3<double>& axis, double angle) {
  const double s = std::sin(angle / 2);
  return {std::cos(angle / 2), s * axis.x, s * axis.y, s * axis.z};
}

TEST(Quat, is_the_identity_by_default) {
  const Vec3<double> v{1, -2, 3};
  EXPECT_EQ(rotate(Quat<double>{}, v), v);
  EXPECT_EQ(rotate_inverse(Quat<double>{}, v), v);
}

TEST(Quat, multiplies_as_Hamilton_did) {
  const Quat<double> i{0, 1, 0, 0}, j{0, 0, 1, 0}, k{0, 0, 0, 1}, minus_one{-1, 0, 0, 0};
  EXPECT_EQ(i * j, k);
  EXPECT_EQ(j * k, i);
  EXPECT_EQ(k * i, j);
  EXPECT_EQ(i * i, minus_one);
  EXPECT_EQ(i * j * k, minus_one);
}

TEST(Quat, turns_the_body_x_axis_to_the_inertial_y_axis_by_a_quarter_turn_about_z) {
  const Quat<double> q_IB = about_axis({0, 0, 1}, std::acos(-1.0) / 2);
  EXPECT_LT(distance(rotate(q_IB, Vec3<double>{1, 0, 0}), {0, 1, 0}), 2 * kEpsilon);
  EXPECT_LT(distance(rotate_inverse(q_IB, Vec3<double>{0, 1, 0}), {1, 0, 0}), 2 * kEpsilon);
}

TEST(Quat, product_rotates_by_the_right_factor_first) {
  Generator random(11);
  for (int i = 0; i < 1000; ++i) {
    const Quat<double> p = test::unit_quaternion(random), q = test::unit_quaternion(random);
    const Vec3<double> v = test::unit_vector(random);
    ASSERT_LT(distance(rotate(p * q, v), rotate(p, rotate(q, v))), 16 * kEpsilon);
  }
}

TEST(Quat, rotates_as_Eigen_does_and_back_again) {
  Generator random(12);
  for (int i = 0; i < 1000; ++i) {
    const Quat<double> q = test::unit_quaternion(random);
    const Vec3<double> v = test::unit_vector(random);
    const Eigen::Vector3d theirs = to_eigen(q).toRotationMatrix() * to_eigen(v);
    ASSERT_LT(distance(rotate(q, v), from_eigen(theirs)), 8 * kEpsilon);
    ASSERT_LT(distance(rotate_inverse(q, rotate(q, v)), v), 16 * kEpsilon);
    ASSERT_LT((rotation_matrix(q) - to_eigen(q).toRotationMatrix()).norm(), 16 * kEpsilon);
  }
}

TEST(Quat, crosses_to_Eigen_and_back_with_every_component_in_its_place) {
  const Quat<double> q{0.1, 0.2, 0.3, 0.4};
  const Eigen::Quaterniond e = to_eigen(q);
  EXPECT_EQ(e.w(), 0.1);
  EXPECT_EQ(e.x(), 0.2);
  EXPECT_EQ(e.y(), 0.3);
  EXPECT_EQ(e.z(), 0.4);
  EXPECT_EQ(from_eigen(e), q);
}

TEST(Quat, renormalises_a_product_of_unit_quaternions_to_round_off) {
  Generator random(13);
  for (int i = 0; i < 1000; ++i) {
    const Quat<double> q = test::unit_quaternion(random);
    const double scale = 1 + test::uniform(random, -3e-9, 3e-9);
    const Quat<double> r =
        renormalised(Quat<double>{scale * q.w, scale * q.x, scale * q.y, scale * q.z});
    ASSERT_NEAR(squared_norm(r), 1.0, 6 * kEpsilon);
    ASSERT_LT(angle_between(q, r), 4 * kEpsilon);
  }
}

TEST(Quat, normalises_any_length_but_zero) {
  Generator random(14);
  for (const double scale : {1e-300, 1e-160, 1e-20, 1.0, 1e20, 1e160, 1e300}) {
    for (int i = 0; i < 100; ++i) {
      const Quat<double> q = test::unit_quaternion(random);
      const Quat<double> r =
          normalised(Quat<double>{scale * q.w, scale * q.x, scale * q.y, scale * q.z});
      ASSERT_NEAR(squared_norm(r), 1.0, 8 * kEpsilon) << "scale " << scale;
      ASSERT_LT(angle_between(q, r), 8 * kEpsilon) << "scale " << scale;
    }
  }
}

TEST(AngleBetween, measures_from_a_picoradian_to_half_a_turn) {
  Generator random(15);
  const double pi = std::acos(-1.0);
  for (const double angle : {1e-15, 1e-12, 1e-9, 1e-4, 0.1, 1.0, 2.0, 3.0, pi - 1e-6, pi}) {
    for (int i = 0; i < 50; ++i) {
      const Quat<double> a = test::unit_quaternion(random);
      const Quat<double> b = a * about_axis(test::unit_vector(random), angle);
      ASSERT_NEAR(angle_between(a, b), angle, 8 * kEpsilon) << "angle " << angle;
      ASSERT_NEAR(angle_between(b, a), angle, 8 * kEpsilon) << "angle " << angle;
    }
  }
}

TEST(AngleBetween, takes_q_and_minus_q_for_one_attitude) {
  Generator random(16);
  for (int i = 0; i < 100; ++i) {
    const Quat<double> q = test::unit_quaternion(random);
    ASSERT_LT(angle_between(q, Quat<double>{-q.w, -q.x, -q.y, -q.z}), 4 * kEpsilon);
  }
}

}  // namespace
}  // namespace adstar
