// The discrete Moser-Veselov steps: order, what they keep, how far they reach.
#include "adstar/integrators/moser_veselov.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "adstar/propagator.hpp"
#include "tests/support/plain_motion.hpp"
#include "tests/support/random_motion.hpp"

namespace adstar {
namespace {

using test::Generator;
using test::kEpsilon;
using test::PlainMotion;
using test::Quad;
using test::QuadMatrix;

template <class T>
Eigen::Matrix<T, 3, 3> diagonal(const T& a, const T& b, const T& c) {
  return Eigen::Matrix<T, 3, 1>(a, b, c).asDiagonal();
}

/// Q diag(a, b, c) Qᵀ in 113 bits.
QuadMatrix turned_inertia(const Quad& a, const Quad& b, const Quad& c) {
  const Eigen::Matrix<Quad, 3, 3> Q =
      rotation_matrix(normalised(Quat<Quad>{Quad(4), Quad(1), Quad(-2), Quad(1)}));
  return Q * diagonal<Quad>(a, b, c) * Q.transpose();
}

template <class Scheme>
class MoserVeselovOf : public testing::Test {};
using Members = testing::Types<MoserVeselov2, MoserVeselov4, MoserVeselov6, MoserVeselov8,
                               MoserVeselov10, MoserVeselov16>;
TYPED_TEST_SUITE(MoserVeselovOf, Members);

TYPED_TEST(MoserVeselovOf, its_order_is_as_stated_for_every_kind_of_body) {
  const Quad small("0.0001");
  struct Body {
    const char* name;
    QuadMatrix J;
    Vec3<Quad> omega_B;
  };
  const Vec3<Quad> omega{Quad("0.45549"), Quad("0.82623"), Quad("-0.33476")};
  const std::vector<Body> bodies{
      {"ascending moments", diagonal<Quad>(Quad("0.9144"), Quad("1.098"), Quad("1.66")), omega},
      {"other order", diagonal<Quad>(Quad("1.66"), Quad("0.9144"), Quad("1.098")), omega},
      {"full tensor", turned_inertia(Quad("0.9144"), Quad("1.098"), Quad("1.66")), omega},
      {"flat disc", diagonal<Quad>(Quad(1), Quad("1.2"), Quad("2.2")), omega},
      {"needle across", diagonal<Quad>(small, Quad(1), Quad(1) + small / 2), omega},
      {"needle along",
       diagonal<Quad>(small, Quad(1), Quad(1) + small / 2),
       {Quad(1), Quad("0.0004"), Quad("0.0003")}},
      {"top", diagonal<Quad>(Quad("1.3"), Quad("1.3"), Quad("0.7")), omega},
      {"sphere", diagonal<Quad>(Quad(2), Quad(2), Quad(2)), omega}};
  for (const Body& b : bodies) {
    SCOPED_TRACE(b.name);
    const RigidBody<Quad> rigid(b.J);
    const MoserVeselovBody<Quad, TypeParam::kOrder> body(rigid);
    const Quat<Quad> q = normalised(Quat<Quad>{Quad(3), Quad(-1), Quad(2), Quad(1)});
    const State<Quad> start = make_state(q, rotate(q, rigid.momentum(b.omega_B)));
    const Quad end(2);
    const auto exact = PlainMotion(b.J, nullptr)
                           .run(test::plain_state(q, body_momentum(start)), Quad(0), end, 128);
    const auto error = [&](int steps) {
      State<Quad> state = start;
      for (int n = 0; n < steps; ++n) {
        TypeParam::step(body, state, end / steps, NoTorque{});
      }
      EXPECT_EQ(state.H_I, start.H_I);
      // Energy has no error: what is left is round-off.
      EXPECT_LT(test::to_double(Quad(abs(
                    rigid.energy(body_momentum(state)) / rigid.energy(body_momentum(start)) - 1))),
                1e-29);
      return angle_between(normalised(exact.q_IB()), state.q_IB);
    };
    // Few steps for high orders, or nothing would be left of 113 bits.
    constexpr int kCoarse = TypeParam::kOrder > 10 ? 8 : 32;
    EXPECT_NEAR(std::log2(static_cast<double>(error(kCoarse) / error(2 * kCoarse))),
                TypeParam::kOrder, 0.15);
  }
}

TYPED_TEST(MoserVeselovOf, its_energy_does_what_rounding_does_and_no_more) {
  for (const bool full : {false, true}) {
    for (const double h : {0.01, 0.2}) {
      const Quat<double> Q = normalised(Quat<double>{4, 1, -2, 1});
      const RigidBody<double> rigid(full ? test::rotated_inertia({0.9144, 1.098, 1.66}, Q)
                                         : diagonal(0.9144, 1.098, 1.66));
      const MoserVeselovBody<double, TypeParam::kOrder> body(rigid);
      const Quat<double> q = normalised(Quat<double>{1, 2, -1, 0.5});
      State<double> state = make_state(q, rotate(q, rigid.momentum({0.45549, 0.82623, 0.03476})));
      const auto energy = [&] {  // whatever |q|² is
        const Vec3<double> Pi = body_momentum(state);
        return rigid.energy(Pi) / squared_norm(Pi);
      };
      const double energy_0 = energy();
      double worst = 0;
      constexpr int kSteps = 1'000'000;
      for (int n = 0; n < kSteps; ++n) {
        TypeParam::step(body, state, h, NoTorque{});
        if (n % 64 == 0) {
          worst = std::fmax(worst, std::fabs(energy() / energy_0 - 1));
        }
      }
      // A random walk from q_IB's rounding, and a drift from that of κ, which is the same every step.
      const double drift = kSteps * std::pow(h * 0.95, 3);
      EXPECT_LT(worst, kEpsilon * (std::sqrt(1.0 * kSteps) + drift))
          << "full: " << full << ", h = " << h;
      EXPECT_NEAR(squared_norm(state.q_IB), 1, 4 * kEpsilon);
    }
  }
}

TYPED_TEST(MoserVeselovOf, a_step_back_undoes_a_step) {
  Generator random(17);
  for (int i = 0; i < 1000; ++i) {
    const MoserVeselovBody<double, TypeParam::kOrder> body(RigidBody<double>(
        test::rotated_inertia(test::moments(random), test::unit_quaternion(random))));
    const Quat<double> q = test::unit_quaternion(random);
    const Vec3<double> Pi = body.momentum(test::unit_vector(random));
    const double h = 0.7 / std::sqrt(angular_speed_bound_squared<double>(body, Pi, 0));
    const State<double> start = make_state(q, rotate(q, Pi));
    State<double> state = start;
    TypeParam::step(body, state, h, NoTorque{});
    TypeParam::step(body, state, -h, NoTorque{});
    const double said = kEpsilon * (1 + h * norm(Pi) / body.moments()[0]);
    ASSERT_LT(angle_between(start.q_IB, state.q_IB), 8 * said);
  }
}

TYPED_TEST(MoserVeselovOf, leaves_a_body_at_rest_where_it_is) {
  const MoserVeselovBody<double, TypeParam::kOrder> body(
      RigidBody<double>(diagonal(1.0, 1.5, 2.0)));
  const State<double> rest = make_state(normalised(Quat<double>{1, 2, -1, 0.5}), Vec3<double>{});
  State<double> state = rest;
  for (int n = 0; n < 1000; ++n) {
    TypeParam::step(body, state, 0.01, NoTorque{});
  }
  EXPECT_LT(angle_between(rest.q_IB, state.q_IB), 2 * kEpsilon);
}

/// Bodies of every shape turning at most 1 rad a step, whatever the axis.
struct Shape {
  Eigen::Vector3d moments;
  Vec3<double> omega_B;
};
Shape any_shape(Generator& random) {
  const Vec3<double> w = test::unit_vector(random);
  const double thin = test::log_uniform(random, 1e-9, 1e-1);
  switch (static_cast<int>(test::uniform(random, 0, 4))) {
    case 0:
      return {test::moments(random), w};
    case 1:
      return {{thin, 1, 1 + thin * test::uniform(random, -1, 1)}, w};
    case 2:
      return {{1, 1 + thin, 2 + thin}, w};
    default:
      return {{1, 1 + 1e-12, 1 + 2e-12}, w};
  }
}

TYPED_TEST(MoserVeselovOf, follows_every_body_as_far_as_the_guard_lets_it) {
  Generator random(23);
  for (int i = 0; i < 20'000; ++i) {
    const Shape shape = any_shape(random);
    const RigidBody<double> rigid(Eigen::Matrix3d(shape.moments.asDiagonal()));
    const Vec3<double> Pi = rigid.momentum(shape.omega_B);
    const double h =
        1 / (TypeParam::kStageReach * std::sqrt(angular_speed_bound_squared<double>(rigid, Pi, 0)));
    State<double> state = make_state(Quat<double>{}, Pi);
    TypeParam::step(rigid, state, h, NoTorque{});
    ASSERT_NEAR(squared_norm(state.q_IB), 1, 8 * kEpsilon) << shape.moments.transpose();
    ASSERT_NEAR(rigid.energy(body_momentum(state)) / rigid.energy(Pi), 1, 16 * kEpsilon)
        << shape.moments.transpose();
  }
}

TYPED_TEST(MoserVeselovOf, double_loses_no_digits_whatever_the_shape) {
  // The same step of the same state in 113 bits. Angles are judged by what H_I in double can say:
  // half a unit in the last place of |H| over each moment.
  Generator random(29);
  for (int i = 0; i < 300; ++i) {
    const Shape shape = any_shape(random);
    const RigidBody<double> rigid(Eigen::Matrix3d(shape.moments.asDiagonal()));
    const RigidBody<Quad> wide(
        diagonal<Quad>(Quad(shape.moments[0]), Quad(shape.moments[1]), Quad(shape.moments[2])));
    const Vec3<double> Pi = rigid.momentum(shape.omega_B);
    const double h = 0.5 / std::sqrt(angular_speed_bound_squared<double>(rigid, Pi, 0));
    State<double> state = make_state(Quat<double>{}, Pi);
    State<Quad> exact = make_state(Quat<Quad>{}, test::convert<Quad>(state.H_I.value()));
    TypeParam::step(rigid, state, h, NoTorque{});
    TypeParam::step(wide, exact, Quad(h), NoTorque{});
    const double said = kEpsilon * (1 + h * norm(Pi) / shape.moments.minCoeff());
    ASSERT_LT(test::to_double(angle_between(exact.q_IB, test::convert<Quad>(state.q_IB))), 4 * said)
        << shape.moments.transpose();
  }
}

TYPED_TEST(MoserVeselovOf, refuses_a_quarter_turn_and_says_so) {
  Generator random(31);
  for (int i = 0; i < 1000; ++i) {
    const MoserVeselovBody<double, TypeParam::kOrder> body(
        RigidBody<double>(Eigen::Matrix3d(test::moments(random).asDiagonal())));
    const Vec3<double> omega = test::unit_vector(random);
    const double angle = test::uniform(random, 1.5708, 20);
    State<double> state = make_state(test::unit_quaternion(random), Vec3<double>{});
    state.H_I.add(rotate(state.q_IB, body.momentum(omega)));
    const State<double> before = state;
    StepLimits wide_open;
    wide_open.substep_angle_rad = 1e9;
    const auto report = advance<TypeParam, double>(
        body, state, {}, 0, static_cast<std::int64_t>(angle * 1e9), wide_open);
    ASSERT_TRUE(report.unresolved_angle) << angle;
    ASSERT_EQ(state, before);
  }
}

TYPED_TEST(MoserVeselovOf, knows_no_torque_and_says_so) {
  const MoserVeselovBody<double, TypeParam::kOrder> body(
      RigidBody<double>(diagonal(1.0, 1.5, 2.0)));
  State<double> state = make_state(Quat<double>{}, body.momentum({0.1, 0.2, 0.3}));
  const std::vector<Torque<double>> torques{Constant<double>{Frame::body, {0.01, 0, 0}}};
  EXPECT_TRUE((advance<TypeParam, double>(body, state, torques, 0, 1'000'000).unresolved_angle));
  EXPECT_TRUE(TypeParam::kClaims.free_only);
}

TEST(MoserVeselov10,
     holds_a_nanoradian_over_100_s_of_the_papers_body_in_steps_of_two_fifths_of_a_second) {
  // tests/reference/reference.csv, paper_free
  const Quat<double> truth{0.935775148083090281138, -0.3054767877725239776492,
                           -0.1396046546315324997902, 0.1073282104922155699108};
  const MoserVeselovBody<double, 10> body(RigidBody<double>(diagonal(0.9144, 1.098, 1.66)));
  State<double> state = make_state(Quat<double>{}, body.momentum({0.45549, 0.82623, 0.03476}));
  for (int n = 0; n < 250; ++n) {
    MoserVeselov10::step(body, state, 0.4, NoTorque{});
  }
  EXPECT_LT(angle_between(truth, state.q_IB), 1e-9);
}

}  // namespace
}  // namespace adstar
