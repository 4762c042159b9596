// The closed form of the free body against values that share nothing with it, against itself in 113
// bits at every shape and start, and as a flow: it composes, turns back, and keeps energy.
#include "adstar/integrators/free_exact.hpp"

#include <algorithm>
#include <cmath>
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
    for (const V& direction : directions(rigid.moments())) {
      for (const double turn : {1e-12, 1e-3, 0.7, -30.0, 1234.5, 1e6}) {
        State<double> s = start_of(rigid, direction, rigid.moments()[1]);
        const double t = turn;
        const Quat<Quad> truth = wide_end(wide, s, t);
        const double bound = 8 * kEpsilon * (1 + least_turn(rigid, s, t));
        FreeExact::step(body, s, t, NoTorque{});
        const double error = test::to_double(angle_between(truth, quad(s.q_IB)));
        worst = std::max(worst, error / bound);
        EXPECT_LT(error, bound) << shape.name << " from " << direction.x << " " << direction.y
                                << " " << direction.z << ", t " << t;
      }
    }
  }
  RecordProperty("worst_of_bound", std::to_string(worst));
}

/// How far an end moves when the start's attitude or momentum does, per radian or relative: by
/// differences in 113 bits. Beside the separatrix it grows like exp(λ t).
double condition(const FreeBody<Quad>& body, const State<double>& start, const Quad& t) {
  const Quad tiny("1e-25");
  const State<Quad> s = quad(start);
  State<Quad> plain = s;
  FreeExact::step(body, plain, t, NoTorque{});
  double most = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const Quat<Quad> nudge{Quad(1), axis == 0 ? tiny : Quad(0), axis == 1 ? tiny : Quad(0),
                           axis == 2 ? tiny : Quad(0)};
    State<Quad> nudged = make_state(s.q_IB * nudge, s.H_I.value());
    FreeExact::step(body, nudged, t, NoTorque{});
    most = std::max(most, test::to_double(angle_between(plain.q_IB, nudged.q_IB) / (2 * tiny)));
  }
  return most;
}

struct RandomCase {
  RigidBody<double> rigid;
  State<double> start;
  double t_1, t_2;
};

RandomCase random_case(Generator& random) {
  const Eigen::Matrix3d J =
      test::rotated_inertia(test::moments(random), test::unit_quaternion(random));
  const RigidBody<double> rigid(J);
  const V omega = test::log_uniform(random, 1e-3, 10) * test::unit_vector(random);
  const Quat<double> q = test::unit_quaternion(random);
  const auto span = [&] {
    return test::log_uniform(random, 1e-3, 1e2) * (random() % 2 == 0 ? 1 : -1);
  };
  return {rigid, make_state(q, rotate(q, rigid.momentum(omega))), span(), span()};
}

TEST(FreeExact, is_a_flow_two_steps_are_their_sum_and_back_is_the_start) {
  Generator random(41);
  for (int i = 0; i < 2000; ++i) {
    const RandomCase c = random_case(random);
    const FreeBody<double> body(c.rigid);
    const FreeBody<Quad> wide{RigidBody<Quad>(quad(Eigen::Matrix3d(
        (Eigen::Matrix3d() << c.rigid.inertia().xx, c.rigid.inertia().xy, c.rigid.inertia().xz,
         c.rigid.inertia().xy, c.rigid.inertia().yy, c.rigid.inertia().yz, c.rigid.inertia().xz,
         c.rigid.inertia().yz, c.rigid.inertia().zz)
            .finished())))};
    State<double> first = c.start, sum = c.start;
    FreeExact::step(body, first, c.t_1, NoTorque{});
    const double amplified = condition(wide, first, Quad(c.t_2));
    const double back_amplified = condition(wide, first, Quad(-c.t_1));
    State<double> second = first, back = first;
    FreeExact::step(body, second, c.t_2, NoTorque{});
    FreeExact::step(body, back, -c.t_1, NoTorque{});
    FreeExact::step(body, sum, c.t_1 + c.t_2, NoTorque{});
    // The sum of the times is rounded, too.
    const double turn = least_turn(c.rigid, c.start, std::fabs(c.t_1) + std::fabs(c.t_2));
    const double turn_1 = least_turn(c.rigid, c.start, c.t_1);
    EXPECT_LT(angle_between(second.q_IB, sum.q_IB),
              8 * kEpsilon * (1 + turn) + 8 * kEpsilon * (1 + turn_1) * amplified)
        << "case " << i;
    EXPECT_LT(angle_between(back.q_IB, c.start.q_IB),
              8 * kEpsilon * (1 + turn_1) * (1 + back_amplified))
        << "case " << i;
    EXPECT_EQ(second.H_I, c.start.H_I);
  }
}

TEST(FreeExact, agrees_with_fine_coadjoint_steps) {
  Generator random(42);
  for (int i = 0; i < 300; ++i) {
    const RandomCase c = random_case(random);
    const FreeBody<double> body(c.rigid);
    State<double> exact = c.start, stepped = c.start;
    // |H|/J_min bounds |omega|: 3 rad in 2000 steps.
    const double t = 3 * c.rigid.moments()[0] / norm(c.start.H_I.value());
    FreeExact::step(body, exact, t, NoTorque{});
    for (int n = 0; n < 2000; ++n) {
      CoadjointRk4::step(c.rigid, stepped, t / 2000, NoTorque{});
    }
    EXPECT_LT(angle_between(exact.q_IB, stepped.q_IB), 2e-13) << "case " << i;
  }
}

TEST(FreeExact, keeps_energy_to_round_off_in_a_shot_and_over_many) {
  Generator random(43);
  for (int i = 0; i < 2000; ++i) {
    const RandomCase c = random_case(random);
    const FreeBody<double> body(c.rigid);
    State<double> state = c.start;
    const double before = c.rigid.energy(body_momentum(state));
    const V Pi = body_momentum(state);
    // An attitude rounded by eps moves the energy by eps |Pi| |omega|.
    const double unit = kEpsilon * norm(Pi) * norm(Pi) / c.rigid.moments()[0];
    FreeExact::step(body, state, 1e3 * c.t_1, NoTorque{});
    EXPECT_LT(std::fabs(c.rigid.energy(body_momentum(state)) - before), 8 * unit);
    for (int n = 0; n < 100; ++n) {
      FreeExact::step(body, state, c.t_2, NoTorque{});
    }
    EXPECT_LT(std::fabs(c.rigid.energy(body_momentum(state)) - before), 8 * 10 * unit);
    EXPECT_EQ(state.H_I, c.start.H_I);
  }
}

TEST(FreeExact, on_the_separatrix_comes_to_rest_on_the_middle_axis) {
  // x_1 (I_2 - I_1)/I_1 = x_3 (I_3 - I_2)/I_3 without rounding: Pi_2 = |Pi| tanh(λ t).
  const RigidBody<double> rigid(diagonal(1, 1.5, 3));
  const FreeBody<double> body(rigid);
  const double P = std::sqrt(2.0), lambda = P * std::sqrt((1.5 - 1) * (3 - 1.5) / (1.5 * 1.5 * 3));
  for (const double first : {1.0, -1.0}) {
    for (const double third : {1.0, -1.0}) {
      const double sense = first * third;
      for (const double t : {0.3, -2.0, 10.0, 50.0, -300.0, 1e4, -1e7}) {
        State<double> state = make_state(Quat<double>{}, {first, 0, third});
        FreeExact::step(body, state, t, NoTorque{});
        const double expected = sense * P * std::tanh(lambda * t);
        EXPECT_NEAR(body_momentum(state).y, expected, 8 * kEpsilon) << "t " << t;
        EXPECT_NEAR(body_momentum(state).x, first / std::cosh(lambda * t), 8 * kEpsilon);
        EXPECT_NEAR(body_momentum(state).z, third / std::cosh(lambda * t), 8 * kEpsilon);
      }
    }
  }
  // At rest there it turns about H by |Pi|/I_2: two late times differ by that.
  State<double> late = make_state(Quat<double>{}, {1, 0, 1}), later = late;
  FreeExact::step(body, late, 1000.0, NoTorque{});
  FreeExact::step(body, later, 1001.5, NoTorque{});
  EXPECT_NEAR(angle_between(late.q_IB, later.q_IB), 1.5 * P / 1.5, 8 * kEpsilon * 1000);
  // Before it gets there, against the plain equations.
  const State<double> start = make_state(Quat<double>{}, {1, 0, 1});
  const auto truth =
      PlainMotion(quad(diagonal(1, 1.5, 3)), nullptr)
          .run(test::plain_state(quad(start.q_IB), {Quad(1), Quad(0), Quad(1)}), 0, Quad(20), 256);
  State<double> state = start;
  FreeExact::step(body, state, 20.0, NoTorque{});
  EXPECT_LT(test::to_double(angle_between(normalised(truth.q_IB()), quad(state.q_IB))),
            8 * kEpsilon * 20);
}

TEST(FreeExact, is_as_good_at_the_ends_of_the_range) {
  const Eigen::Matrix3d J = diagonal(0.9144, 1.098, 1.66);
  const RigidBody<double> rigid(J);
  const FreeBody<double> body(rigid);
  const FreeBody<Quad> wide{RigidBody<Quad>(quad(J))};
  for (const double size : {5e-324, 1e-310, 1e-300, 1e-200, 1e200, 1e300, 1.5e308}) {
    const State<double> start = make_state(Quat<double>{1, 2, 3, 4}, size * V{0.4, 0.8, 0.3});
    const double t = std::min(3 / size, 1e300);
    State<double> state = start;
    FreeExact::step(body, state, t, NoTorque{});
    EXPECT_LT(test::to_double(angle_between(quad(state.q_IB), wide_end(wide, start, t))),
              32 * kEpsilon)
        << size;
    EXPECT_EQ(state.H_I, start.H_I);
  }
}

TEST(FreeExact, says_so_where_it_knows_no_attitude) {
  const RigidBody<double> rigid(diagonal(0.9144, 1.098, 1.66));
  const FreeBody<double> body(rigid);
  const double inf = std::numeric_limits<double>::infinity(), nan = std::nan("");
  const State<double> start = make_state(Quat<double>{}, {1, 2, 3});
  for (const double t : {inf, -inf, nan, 1e16, 1e300}) {
    State<double> state = start;
    FreeExact::step(body, state, t, NoTorque{});
    EXPECT_TRUE(std::isnan(state.q_IB.w)) << t;
  }
  for (const double bad : {inf, -inf, nan}) {
    for (const V& H : {V{bad, 1, 1}, V{1, bad, 1}, V{1, 1, bad}, V{bad, bad, bad}}) {
      State<double> state = make_state(Quat<double>{}, H);
      const StepReport report = advance<FreeExact>(body, state, {}, 0, 10'000'000);
      EXPECT_TRUE(report.unresolved_angle);
      EXPECT_EQ(state.q_IB, Quat<double>{});
    }
  }
  State<double> pushed = start;
  const std::vector<Torque<double>> torques{Constant<double>{Frame::body, {1, 0, 0}}};
  EXPECT_TRUE(advance<FreeExact>(body, pushed, std::span<const Torque<double>>(torques), 0, 1000)
                  .unresolved_angle);
}

TEST(FreeExact, takes_any_step_in_one_part) {
  const RigidBody<double> rigid(diagonal(0.9144, 1.098, 1.66));
  const FreeBody<double> body(rigid);
  State<double> whole = make_state(Quat<double>{}, {1, 2, 3}), shot = whole;
  const StepReport report =
      advance<FreeExact>(body, whole, {}, 0, std::int64_t{1'000'000} * 1'000'000'000);
  EXPECT_TRUE(report.resolved());
  EXPECT_EQ(report.parts, 1);
  FreeExact::step(body, shot, 1e6, NoTorque{});
  EXPECT_EQ(whole, shot);
}

TEST(FreeExact, in_float_is_as_good_as_float) {
  const RigidBody<float> rigid(Eigen::Matrix3f(Eigen::Vector3f(0.9F, 1.1F, 1.7F).asDiagonal()));
  const FreeBody<float> body(rigid);
  const FreeBody<double> twice{RigidBody<double>(
      Eigen::Matrix3d(Eigen::Vector3f(0.9F, 1.1F, 1.7F).cast<double>().asDiagonal()))};
  for (const float t : {0.01F, 1.0F, 100.0F, 1e5F}) {
    State<float> state = make_state(Quat<float>{}, Vec3<float>{0.4F, 0.9F, 0.1F});
    State<double> truth = make_state(Quat<double>{}, test::convert<double>(state.H_I.value()));
    FreeExact::step(body, state, t, NoTorque{});
    FreeExact::step(twice, truth, static_cast<double>(t), NoTorque{});
    EXPECT_LT(angle_between(truth.q_IB, test::convert<double>(state.q_IB)), 1e-6) << t;
  }
}

}  // namespace
}  // namespace adstar
