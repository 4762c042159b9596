// exp and dexp⁻¹ of se(3), against power series in 100 digits.
#include "adstar/multibody/se3.hpp"

#include <cmath>
#include <random>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "tests/support/random_motion.hpp"
#include "tests/support/wide.hpp"

namespace adstar::multibody {
namespace {

using test::Quad;
using test::Wide;
using Wide6 = Eigen::Matrix<Wide, 6, 6>;

/// a and b of the textbook, in the whole angle, in 100 digits.
DexpinvCoefficients<Wide> closed(const Wide& t) {
  return {2 / (t * t) + (t + 3 * sin(t)) / (4 * t * (cos(t) - 1)),
          1 / (t * t * t * t) + (t + sin(t)) / (4 * t * t * t * (cos(t) - 1))};
}

template <class T>
Eigen::Matrix<T, 6, 6> ad_matrix(const Twist<T>& xi) {
  Eigen::Matrix<T, 6, 6> m = Eigen::Matrix<T, 6, 6>::Zero();
  m.template topLeftCorner<3, 3>() = hat<T>(to_eigen(xi.angular));
  m.template bottomRightCorner<3, 3>() = m.template topLeftCorner<3, 3>();
  m.template bottomLeftCorner<3, 3>() = hat<T>(to_eigen(xi.linear));
  return m;
}

/// dexp(-xi) = Σ (-ad)ⁿ/(n+1)!, inverted.
Wide6 dexp_minus_inverse(const Twist<Wide>& xi) {
  const Wide6 A = -ad_matrix(xi);
  Wide6 term = Wide6::Identity(), sum = term;
  for (int n = 1; n < 100; ++n) {
    term = term * A / Wide(n + 1);
    sum += term;
  }
  return sum.inverse();
}

Twist<Wide> wide(const Twist<double>& xi) {
  return {test::convert<Wide>(xi.angular), test::convert<Wide>(xi.linear)};
}

TEST(Se3Coefficients, are_those_of_the_closed_forms_on_both_sides_of_every_threshold) {
  std::vector<double> angles;
  for (double t = 1e-8; t < 6; t *= 1.07) {
    angles.push_back(t);
  }
  for (const double side : {-1e-9, 0.0, 1e-9}) {
    angles.push_back(kSeriesAngleRad * (1 + side));
    angles.push_back(kWideSeriesAngleRad * (1 + side));
  }
  for (const double t : angles) {
    const auto exact = closed(Wide(t));
    const auto got = dexpinv_coefficients(t * t);
    EXPECT_NEAR(got.a, static_cast<double>(exact.a), 2e-15 * std::fabs(got.a) + 1e-16) << t;
    EXPECT_NEAR(got.b * t * t * t * t, static_cast<double>(exact.b) * t * t * t * t, 4e-15) << t;
    EXPECT_NEAR(got.b, static_cast<double>(exact.b), 1e-12) << t;
    const auto quad = dexpinv_coefficients(Quad(t) * Quad(t));
    EXPECT_LT(test::to_double(abs(Wide(quad.a) - exact.a)), 1e-30) << t;
    EXPECT_LT(test::to_double(abs(Wide(quad.b) - exact.b)), 1e-27) << t;
  }
  const auto zero = dexpinv_coefficients(0.0);
  EXPECT_EQ(zero.a, 1.0 / 12);
  EXPECT_EQ(zero.b, -1.0 / 720);
}

TEST(Se3Dexpinv, is_the_inverse_of_the_summed_series) {
  test::Generator random(1);
  for (int i = 0; i < 60; ++i) {
    const double angle = test::log_uniform(random, 1e-6, 3.1);
    const Twist<double> xi{angle * test::unit_vector(random), test::unit_vector(random)};
    const Twist<double> v{test::unit_vector(random), test::unit_vector(random)};
    const Twist<double> got = dexpinv_minus(xi, v);
    Eigen::Matrix<Wide, 6, 1> V;
    V << to_eigen(wide(v).angular), to_eigen(wide(v).linear);
    const Eigen::Matrix<Wide, 6, 1> exact = dexp_minus_inverse(wide(xi)) * V;
    const Vec3<Wide> angular{exact[0], exact[1], exact[2]}, linear{exact[3], exact[4], exact[5]};
    EXPECT_LT(test::to_double(norm(wide(got).angular - angular)), 4e-15) << angle;
    EXPECT_LT(test::to_double(norm(wide(got).linear - linear)), 1e-14) << angle;
  }
}

TEST(Se3Exp, is_the_exponential_of_the_matrix) {
  test::Generator random(2);
  for (int i = 0; i < 30; ++i) {
    const Twist<double> xi{test::log_uniform(random, 1e-6, 3.1) * test::unit_vector(random),
                           test::unit_vector(random)};
    using Wide4 = Eigen::Matrix<Wide, 4, 4>;
    Wide4 X = Wide4::Zero();
    X.topLeftCorner<3, 3>() = hat<Wide>(to_eigen(wide(xi).angular));
    X.topRightCorner<3, 1>() = to_eigen(wide(xi).linear);
    Wide4 term = Wide4::Identity(), sum = term;
    for (int n = 1; n < 100; ++n) {
      term = term * X / Wide(n);
      sum += term;
    }
    const Vec3<Wide> exact{sum(0, 3), sum(1, 3), sum(2, 3)};
    const Vec3<double> got = exp_translation(Rotation<double>(xi.angular), xi.linear);
    EXPECT_LT(test::to_double(norm(test::convert<Wide>(got) - exact)), 1e-15);
  }
}

TEST(Se3Dexpinv,
     turns_the_body_twist_into_the_rate_of_xi_with_the_sign_of_the_left_trivialisation) {
  // g(t) = g_n exp(xi(t)); its body twist is g⁻¹ g'. One difference quotient in 113 bits.
  const Twist<Quad> xi{{Quad(0.7), Quad(-0.4), Quad(1.1)}, {Quad(0.3), Quad(0.9), Quad(-0.5)}};
  const Twist<Quad> V{{Quad(0.2), Quad(0.8), Quad(-0.6)}, {Quad(-0.1), Quad(0.4), Quad(0.7)}};
  const Twist<Quad> rate = dexpinv_minus(xi, V);
  const Quad e = 1e-9;
  const auto pose = [&](const Quad& t) {
    const Twist<Quad> at{xi.angular + t * rate.angular, xi.linear + t * rate.linear};
    const Rotation<Quad> turn(at.angular);
    return std::pair(turn.quaternion(), exp_translation(turn, at.linear));
  };
  const auto [q0, x0] = pose(-e);
  const auto [q1, x1] = pose(e);
  const auto [q, x] = pose(0);
  const Quat<Quad> d = Quat<Quad>{q0.w, -q0.x, -q0.y, -q0.z} * q1;
  const Vec3<Quad> omega = (1 / e) * Vec3<Quad>{d.x, d.y, d.z};
  const Vec3<Quad> v = rotate_inverse(q, (1 / (2 * e)) * (x1 - x0));
  EXPECT_LT(static_cast<double>(norm(omega - V.angular)), 1e-15);
  EXPECT_LT(static_cast<double>(norm(v - V.linear)), 1e-15);
}

}  // namespace
}  // namespace adstar::multibody
