// The closed form of the free body against values that share nothing with it, against itself in 113
// bits at every shape and start, and as a flow: it composes, turns back, and keeps energy.
#include "adstar/integrators/free_exact.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "adstar/propagator.hpp"
#include "tests/support/plain_motion.hpp"
#include "tests/support/random_motion.hpp"
#include "tests/support/wide.hpp"

namespace adstar {
namespace {

using test::Generator;
using test::kEpsilon;
using test::PlainMotion;
using test::Quad;
using test::QuadMatrix;
using V = Vec3<double>;

Eigen::Matrix3d diagonal(double a, double b, double c) {
  return Eigen::Vector3d(a, b, c).asDiagonal();
}

struct Shape {
  const char* name;
  Eigen::Matrix3d J;
};

const std::vector<Shape>& shapes() {
  static const Quat<double> q = normalised(Quat<double>{4, 1, -2, 1});
  static const std::vector<Shape> all{
      {"paper", diagonal(0.9144, 1.098, 1.66)},
      {"paper, axes out of order", diagonal(1.66, 0.9144, 1.098)},
      {"paper, full tensor", test::rotated_inertia({0.9144, 1.098, 1.66}, q)},
      {"chipsat", diagonal(1e-9, 1.3e-9, 2e-9)},
      {"station", diagonal(1.1e9, 1.9e9, 2.2e9)},
      {"needle", diagonal(1e-6, 1, 1.0000005)},
      {"round needle", diagonal(1e-6, 1, 1)},
      {"disc", diagonal(0.4, 0.6, 1)},
      {"round disc", diagonal(0.5, 0.5, 1)},
      {"nearly round disc", diagonal(0.5, 0.5 + 1e-15, 1)},
      {"nearly prolate", diagonal(0.5, 1, 1 + 1e-15)},
      {"near-sphere", diagonal(1, 1 + 1e-12, 1 + 3e-12)},
      {"nearest sphere", diagonal(1, 1 + kEpsilon, 1 + 2 * kEpsilon)},
      {"sphere", diagonal(2, 2, 2)},
      {"even separatrix", diagonal(1, 1.5, 3)},
      {"full needle", test::rotated_inertia({1e-3, 1, 1.0005}, q)},
  };
  return all;
}

/// Directions of momentum in principal axes: each axis and beside it, each side of the separatrix
/// and on it, and anywhere.
std::vector<V> directions(const std::array<double, 3>& I) {
  std::vector<V> all{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  for (const double tiny : {1e-3, 1e-8, 1e-16}) {
    for (const V& side : {V{1, tiny, -tiny}, V{tiny, 1, tiny}, V{-tiny, -1, tiny}, V{tiny, 1, 0},
                          V{0, 1, tiny}, V{tiny, -tiny, 1}, V{0, tiny, 1}, V{1, 0, tiny}}) {
      all.push_back(side);
    }
  }
  if (I[2] > I[1] && I[1] > I[0]) {
    // x_1 (I_2 - I_1)/I_1 = x_3 (I_3 - I_2)/I_3
    const double slope = std::sqrt((I[2] - I[1]) / I[2] / ((I[1] - I[0]) / I[0]));
    for (const double distance : {0.0, 1e-3, 1e-6, 1e-9, 1e-12, 1e-15, 1e-16}) {
      for (const double sign : {1.0, -1.0}) {
        for (const double middle : {0.0, 1.0, -3.0, 1e4}) {
          all.push_back({slope * (1 + sign * distance), middle, sign});
        }
      }
    }
  }
  Generator random(31);
  for (int i = 0; i < 12; ++i) {
    all.push_back(test::unit_vector(random));
  }
  return all;
}

Quat<Quad> quad(const Quat<double>& q) { return normalised(test::convert<Quad>(q)); }

QuadMatrix quad(const Eigen::Matrix3d& J) { return J.cast<Quad>(); }

/// |H| = `size` along `direction` of principal axes.
State<double> start_of(const RigidBody<double>& body, const V& direction, double size) {
  const Quat<double> q = normalised(Quat<double>{1, 0.2, -0.3, 0.4});
  const Quat<double> axes = body.principal_axes();
  return make_state(q, rotate(q, rotate(axes, (size / norm(direction)) * direction)));
}

State<Quad> quad(const State<double>& s) {
  return make_state(quad(s.q_IB), test::convert<Quad>(s.H_I.value()));
}

Quat<Quad> wide_end(const FreeBody<Quad>& body, const State<double>& start, double t) {
  State<Quad> state = quad(start);
  FreeExact::step(body, state, Quad(t), NoTorque{});
  return state.q_IB;
}

/// A lower bound of ∫|omega_B| dt: |omega| ≥ 2E/|Pi|.
double least_turn(const RigidBody<double>& body, const State<double>& s, double t) {
  const V Pi = body_momentum(s);
  return std::fabs(t) * 2 * body.energy(Pi) / norm(Pi);
}

TEST(FreeExact, meets_the_papers_reference_in_one_shot) {
  std::ifstream file(ADSTAR_SOURCE_DIR "/tests/reference/reference.csv");
  std::string line, name, cell;
  double value[8] = {};
  while (std::getline(file, line)) {
    std::stringstream cells(line);
    std::getline(cells, name, ',');
    if (name == "paper_free") {
      for (double& x : value) {
        std::getline(cells, cell, ',');
        x = std::stod(cell);
      }
      break;
    }
  }
  ASSERT_EQ(name, "paper_free");
  const RigidBody<double> rigid(diagonal(0.9144, 1.098, 1.66));
  const FreeBody<double> body(rigid);
  State<double> state = make_state(Quat<double>{}, rigid.momentum({0.45549, 0.82623, 0.03476}));
  FreeExact::step(body, state, 100.0, NoTorque{});
  EXPECT_LT(angle_between(Quat<double>{value[1], value[2], value[3], value[4]}, state.q_IB), 1e-13);
  EXPECT_LT(norm(body_momentum(state) - V{value[5], value[6], value[7]}), 1e-13);
}

TEST(FreeExact, in_113_bits_solves_the_plain_equations_at_every_shape_and_start) {
  for (const Shape& shape : shapes()) {
    const RigidBody<double> rigid(shape.J);
    const FreeBody<Quad> body{RigidBody<Quad>(quad(shape.J))};
    const PlainMotion plain(quad(shape.J), nullptr);
    for (const V& direction : directions(rigid.moments())) {
      // Half a radian of |Pi|/J_min at most: the truth is good to 1e-27 there.
      const State<double> s = start_of(rigid, direction, rigid.moments()[0]);
      const State<Quad> q = quad(s);
      for (const double t : {1.5, -0.4}) {
        const auto truth =
            plain.run(test::plain_state(q.q_IB, body_momentum(q)), 0, Quad(t), 10).q_IB();
        const double error =
            test::to_double(angle_between(normalised(truth), wide_end(body, s, t)));
        EXPECT_LT(error, 1e-24) << shape.name << " from " << direction.x << " " << direction.y
                                << " " << direction.z << ", t " << t;
      }
    }
  }
}

TEST(FreeExact, holds_its_bound_in_one_shot_at_every_shape_start_and_length) {
  double worst = 0;
  for (const Shape& shape : shapes()) {
    const RigidBody<double> rigid(shape.J);
    const FreeBody<double> body(rigid);
    const FreeBody<Quad> wide{RigidBody<Quad>(quad(shape.J))};
    double worst_here = 0;
    for (const V& direction : directions(rigid.moments())) {
      for (const double turn : {1e-12, 1e-3, 0.7, -30.0, 1234.5, 1e6}) {
        State<double> s = start_of(rigid, direction, rigid.moments()[1]);
        const double t = turn;
        const Quat<Quad> truth = wide_end(wide, s, t);
        const double bound = 8 * kEpsilon * (1 + least_turn(rigid, s, t));
        FreeExact::step(body, s, t, NoTorque{});
        const double error = test::to_double(angle_between(truth, quad(s.q_IB)));
        worst_here = std::max(worst_here, error / bound);
        EXPECT_LT(error, bound) << shape.name << " from " << direction.x << " " << direction.y
                                << " " << direction.z << ", t " << t;
      }
    }
    std::printf("%s: %.3g\n", shape.name, worst_here);
    worst = std::max(worst, worst_here);
  }
  RecordProperty("worst_of_bound", std::to_string(worst));
}

}  // namespace
}  // namespace adstar
