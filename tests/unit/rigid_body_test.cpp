#include "adstar/bodies/rigid_body.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "tests/support/random_motion.hpp"
#include "tests/support/wide.hpp"

namespace adstar {
namespace {

using test::Generator;
using test::kEpsilon;

Vec3<double> times(const Eigen::Matrix3d& J, const Vec3<double>& v) {
  return from_eigen(Eigen::Vector3d(J * to_eigen(v)));
}

Sym3<double> packed(const Eigen::Matrix3d& J) {
  return {J(0, 0), J(1, 1), J(2, 2), J(1, 0), J(2, 0), J(2, 1)};
}

const std::array<Eigen::Vector3d, 5> kShapes{
    Eigen::Vector3d{1, 1, 1}, Eigen::Vector3d{0.9144, 1.098, 1.66}, Eigen::Vector3d{1, 1, 2},
    Eigen::Vector3d{1, 1, 1e-6}, Eigen::Vector3d{1, 1 - 1e-9, 1e-3}};

TEST(RigidBody, momentum_is_inertia_times_angular_velocity) {
  Generator random(21);
  for (int i = 0; i < 500; ++i) {
    const Eigen::Matrix3d J =
        test::rotated_inertia(test::moments(random), test::unit_quaternion(random));
    const Vec3<double> omega = test::unit_vector(random);
    ASSERT_LT(norm(RigidBody<double>(J).momentum(omega) - times(J, omega)),
              4 * kEpsilon * J.norm());
  }
}

TEST(RigidBody, angular_velocity_undoes_momentum_at_every_scale_and_shape) {
  Generator random(22);
  for (const Eigen::Vector3d& shape : kShapes) {
    const double condition = shape.maxCoeff() / shape.minCoeff();
    for (const double scale : {1e-120, 1e-60, 1e-9, 1.0, 1e9, 1e60, 1e120}) {
      for (int i = 0; i < 50; ++i) {
        const Eigen::Matrix3d J =
            scale * test::rotated_inertia(shape, test::unit_quaternion(random));
        const RigidBody<double> body(J);
        const Vec3<double> omega = test::unit_vector(random);
        ASSERT_LT(norm(body.angular_velocity(body.momentum(omega)) - omega),
                  16 * condition * kEpsilon)
            << "shape " << shape.transpose() << ", scale " << scale;
      }
    }
  }
}

TEST(RigidBody, with_principal_axes_divides_by_each_moment) {
  const RigidBody<double> body(Eigen::Matrix3d(Eigen::Vector3d(0.5, 2.0, 1e-6).asDiagonal()));
  const Vec3<double> omega = body.angular_velocity({1, 1, 1});
  EXPECT_DOUBLE_EQ(omega.x, 2.0);
  EXPECT_DOUBLE_EQ(omega.y, 0.5);
  EXPECT_DOUBLE_EQ(omega.z, 1e6);
}

TEST(RigidBody, energy_is_half_of_omega_dot_momentum) {
  Generator random(23);
  for (int i = 0; i < 500; ++i) {
    const Eigen::Matrix3d J =
        test::rotated_inertia(test::moments(random), test::unit_quaternion(random));
    const RigidBody<double> body(J);
    const Eigen::Vector3d omega = to_eigen(test::unit_vector(random));
    const double expected = 0.5 * omega.dot(J * omega);
    ASSERT_NEAR(body.energy(body.momentum(from_eigen(omega))), expected, 1e-12 * expected);
  }
}

TEST(RigidBody, reads_the_lower_triangle) {
  Eigen::Matrix3d J = Eigen::Vector3d(2, 3, 4).asDiagonal();
  J(1, 0) = 0.1;
  J(2, 0) = 0.2;
  J(2, 1) = 0.3;
  const Vec3<double> Pi = RigidBody<double>(J).momentum({1, 10, 100});
  EXPECT_DOUBLE_EQ(Pi.x, 2 + 1 + 20);
  EXPECT_DOUBLE_EQ(Pi.y, 0.1 + 30 + 30);
  EXPECT_DOUBLE_EQ(Pi.z, 0.2 + 3 + 400);
}

TEST(RigidBody, works_in_113_bits) {
  using test::Quad;
  Eigen::Matrix<Quad, 3, 3> J;
  J << Quad(2), Quad("0.1"), Quad("0.2"), Quad("0.1"), Quad(3), Quad("0.3"), Quad("0.2"),
      Quad("0.3"), Quad(4);
  const RigidBody<Quad> body(J);
  const Vec3<Quad> omega{Quad("0.3"), Quad("-0.7"), Quad("1.1")};
  EXPECT_LT(test::to_double(norm(body.angular_velocity(body.momentum(omega)) - omega)), 1e-32);
  EXPECT_LT(test::to_double(abs(body.moments()[0] + body.moments()[1] + body.moments()[2] - 9)),
            1e-32);
}

TEST(PrincipalMoments, agree_with_Eigen_at_every_scale_and_shape) {
  Generator random(24);
  for (const Eigen::Vector3d& shape : kShapes) {
    for (const double scale : {1e-120, 1e-9, 1.0, 1e9, 1e120}) {
      for (int i = 0; i < 50; ++i) {
        const Eigen::Matrix3d J =
            scale * test::rotated_inertia(shape, test::unit_quaternion(random));
        const auto ours = principal_moments(packed(J));
        // Eigen is asked at scale one, where its own squares stay in range.
        const Eigen::Vector3d theirs =
            Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(J / scale).eigenvalues();
        for (int k = 0; k < 3; ++k) {
          ASSERT_NEAR(ours[static_cast<std::size_t>(k)] / scale, theirs[k],
                      16 * kEpsilon * shape.maxCoeff())
              << "shape " << shape.transpose() << ", scale " << scale;
        }
      }
    }
  }
}

TEST(PrincipalMoments, of_a_diagonal_tensor_are_its_diagonal_ascending) {
  const auto moments = principal_moments(Sym3<double>{3, 1, 2, 0, 0, 0});
  EXPECT_EQ(moments, (std::array<double, 3>{1, 2, 3}));
}

TEST(PrincipalMoments, survive_products_of_inertia_that_are_nearly_nothing) {
  for (const double tiny : {1e-300, 1e-200, 1e-30, 1e-17}) {
    const auto moments = principal_moments(Sym3<double>{3, 1, 2, tiny, -tiny, tiny});
    EXPECT_NEAR(moments[0], 1, 4 * kEpsilon) << tiny;
    EXPECT_NEAR(moments[1], 2, 4 * kEpsilon) << tiny;
    EXPECT_NEAR(moments[2], 3, 4 * kEpsilon) << tiny;
  }
}

/// Largest entry of Rᵀ J R - diag(moments), R from principal to body axes.
double off_the_axes(const PrincipalFrame<double>& frame, const Eigen::Matrix3d& J) {
  const Eigen::Matrix3d R = to_eigen(frame.axes).toRotationMatrix();
  const Eigen::Vector3d moments(frame.moments[0], frame.moments[1], frame.moments[2]);
  return (R.transpose() * J * R - Eigen::Matrix3d(moments.asDiagonal())).cwiseAbs().maxCoeff();
}

TEST(PrincipalFrame, makes_the_tensor_diagonal_at_every_scale_and_shape) {
  Generator random(25);
  for (const Eigen::Vector3d& shape : kShapes) {
    for (const double scale : {1e-120, 1e-9, 1.0, 1e9, 1e120}) {
      for (int i = 0; i < 50; ++i) {
        const Eigen::Matrix3d J =
            scale * test::rotated_inertia(shape, test::unit_quaternion(random));
        const RigidBody<double> body(J);
        ASSERT_EQ(body.moments(), principal_moments(packed(J)));
        ASSERT_LT(off_the_axes({body.moments(), body.principal_axes()}, J),
                  32 * kEpsilon * scale * shape.maxCoeff())
            << "shape " << shape.transpose() << ", scale " << scale;
        ASSERT_NEAR(squared_norm(body.principal_axes()), 1, 4 * kEpsilon);
      }
    }
  }
}

TEST(PrincipalFrame, of_a_diagonal_tensor_permutes_its_axes) {
  std::array<double, 3> moments{1, 2, 3};
  do {
    const Eigen::Matrix3d J = Eigen::Vector3d(moments[0], moments[1], moments[2]).asDiagonal();
    const auto frame = principal_frame(packed(J));
    EXPECT_EQ(frame.moments, (std::array<double, 3>{1, 2, 3}));
    EXPECT_LT(off_the_axes(frame, J), 8 * kEpsilon) << moments[0] << moments[1] << moments[2];
  } while (std::next_permutation(moments.begin(), moments.end()));
  EXPECT_EQ(principal_frame(Sym3<double>{1, 2, 3, 0, 0, 0}).axes, Quat<double>{});
}

}  // namespace
}  // namespace adstar
