// Elimination along the tree against one dense system of everything.
#include "adstar/multibody/elimination.hpp"

#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "tests/multibody/mechanisms.hpp"
#include "tests/support/random_motion.hpp"

namespace adstar {
namespace {

using multibody::JointKind;
using multibody::kGround;
using test::Flight;
using test::Mechanism;

using Matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
using Vector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

/// A tree that branches, with every kind of joint, some given from child to parent.
Mechanism<double> branching(bool grounded, double light) {
  test::Generator random(11);
  Mechanism<double> m;
  for (int i = 0; i < 9; ++i) {
    const double mass = i % 2 == 0 ? 1.0 + i : light;
    m.add_body(test::numbered("b", i), mass, {0.1 * mass, 0.15 * mass, 0.2 * mass});
  }
  const auto join = [&](int a, int b, JointKind kind) {
    auto& joint = m.add_joint(test::numbered("j", static_cast<int>(m.joints.size())), kind, a, b,
                              0.5 * test::unit_vector(random), 0.4 * test::unit_vector(random),
                              {{0.3, -0.2, 0.4}, {0.5, 0.1, -0.3}});
    joint.a.q_BF = test::unit_quaternion(random);
    joint.b.q_BF = test::unit_quaternion(random);
  };
  if (grounded) {
    join(kGround, 0, JointKind::revolute);
  }
  join(0, 1, JointKind::spherical);
  join(2, 0, JointKind::universal);
  join(1, 3, JointKind::prismatic);
  join(4, 1, JointKind::revolute);
  join(2, 5, JointKind::fixed);
  join(5, 6, JointKind::revolute);
  join(7, 6, JointKind::spherical);
  join(6, 8, JointKind::universal);
  m.place();
  return m;
}

/// Closes a loop between two bodies where they are.
void close_loop(Mechanism<double>& m, int a, int b) {
  const auto& first = m.bodies[static_cast<std::size_t>(a)];
  const auto& second = m.bodies[static_cast<std::size_t>(b)];
  const test::V point = 0.5 * (first.x_I + second.x_I);
  m.add_joint("loop", JointKind::spherical, a, b,
              rotate_inverse(normalised(first.q_IB), point - first.x_I),
              rotate_inverse(normalised(second.q_IB), point - second.x_I));
}

/// Largest error of accelerations and of multipliers, each by the largest of its kind.
double error_of(const Mechanism<double>& m) {
  Flight<double> flight(m);
  multibody::observe(flight.assembly, flight.work, flight.state);
  auto& work = flight.work;
  const auto bodies = static_cast<int>(work.motions.size());
  int rows = 0;
  for (const auto& joint : work.joints) {
    rows += joint.shape.rows();
  }
  Matrix A = Matrix::Zero(6 * bodies + rows, 6 * bodies + rows);
  Vector right = Vector::Zero(6 * bodies + rows);
  test::Generator random(5);
  std::vector<multibody::Spatial<double>> f(work.motions.size());
  for (int i = 0; i < bodies; ++i) {
    const auto& block = work.masses[static_cast<std::size_t>(i)];
    const Sym3<double>& J = block.J_I;
    const double inertia[3][3] = {{J.xx, J.xy, J.xz}, {J.xy, J.yy, J.yz}, {J.xz, J.yz, J.zz}};
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) {
        A(6 * i + r, 6 * i + c) = inertia[r][c];
      }
      A(6 * i + 3 + r, 6 * i + 3 + r) = block.mass;
    }
    for (int k = 0; k < 6; ++k) {
      f[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)] = test::uniform(random, -1, 1);
      right(6 * i + k) = f[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)];
    }
  }
  int row = 6 * bodies;
  for (std::size_t j = 0; j < work.joints.size(); ++j) {
    const auto& joint = flight.assembly.joints()[j];
    const auto& jacobian = work.elimination.jacobians()[j];
    for (int k = 0; k < work.joints[j].shape.rows(); ++k, ++row) {
      const auto put = [&](int body, const double* c) {
        for (int n = 0; body != kGround && n < 6; ++n) {
          A(row, 6 * body + n) = c[n];
          A(6 * body + n, row) = -static_cast<long double>(c[n]);
        }
      };
      put(joint.body_a, jacobian.a.row[k]);
      put(joint.body_b, jacobian.b.row[k]);
      work.gamma[j][static_cast<std::size_t>(k)] = test::uniform(random, -1, 1);
      right(row) = work.gamma[j][static_cast<std::size_t>(k)];
    }
  }
  const Vector exact = A.fullPivLu().solve(right);
  work.elimination.solve(f, work.gamma, work.lambda);
  double error = 0;
  for (int i = 0; i < 6 * bodies; ++i) {
    const double got = f[static_cast<std::size_t>(i / 6)][static_cast<std::size_t>(i % 6)];
    error = std::max(error, std::fabs(got - static_cast<double>(exact(i))) /
                                static_cast<double>(exact.head(6 * bodies).cwiseAbs().maxCoeff()));
  }
  row = 6 * bodies;
  for (std::size_t j = 0; j < work.joints.size(); ++j) {
    for (int k = 0; k < work.joints[j].shape.rows(); ++k, ++row) {
      const double got = work.lambda[j][static_cast<std::size_t>(k)];
      error = std::max(error, std::fabs(got - static_cast<double>(exact(row))) /
                                  static_cast<double>(exact.tail(rows).cwiseAbs().maxCoeff()));
    }
  }
  return error;
}

TEST(Elimination, solves_what_one_dense_system_solves_on_trees) {
  EXPECT_LT(error_of(branching(false, 1)), 1e-13);
  EXPECT_LT(error_of(branching(true, 1)), 1e-13);
}

TEST(Elimination, solves_what_one_dense_system_solves_with_loops) {
  for (const bool grounded : {false, true}) {
    auto m = branching(grounded, 1);
    for (auto& start : m.starts) {
      start.rate = {};  // at rest the loop fits at once
    }
    m.place();
    close_loop(m, 3, 8);
    EXPECT_LT(error_of(m), 1e-12);
  }
}

TEST(Elimination, keeps_its_digits_between_bodies_a_million_times_heavier) {
  EXPECT_LT(error_of(branching(false, 1e-6)), 1e-8);
  EXPECT_LT(error_of(branching(true, 1e-6)), 1e-8);
}

}  // namespace
}  // namespace adstar
