// What stages in float cost, and what they do not (integrators/coadjoint_float.hpp).
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "adstar/propagator.hpp"
#include "tests/support/random_motion.hpp"
#include "tests/support/wide.hpp"

namespace adstar {
namespace {

using V = Vec3<double>;

constexpr V kOmega{0.45549, 0.82623, 0.03476};
constexpr double kSpeed = 0.944;  ///< |kOmega| [rad/s]

Eigen::Matrix3d paper() { return Eigen::Vector3d(0.9144, 1.098, 1.66).asDiagonal(); }

Eigen::Matrix3d full() {
  return test::rotated_inertia({0.9144, 1.098, 1.66}, normalised(Quat<double>{4, 1, -2, 1}));
}

State<double> spinning(const Eigen::Matrix3d& J, const V& omega_B) {
  const Quat<double> q = normalised(Quat<double>{1, 2, -1, 0.5});
  return make_state(q, rotate(q, RigidBody<double>(J).momentum(omega_B)));
}

template <class Scheme>
State<double> run(const Eigen::Matrix3d& J, State<double> state,
                  const std::vector<Torque<double>>& torques, double duration_s, double h_s) {
  const BodyOf<Scheme, double> body{RigidBody<double>(J)};
  const auto h_ns = static_cast<std::int64_t>(std::round(1e9 * h_s));
  const auto end_ns = static_cast<std::int64_t>(std::round(1e9 * duration_s));
  for (std::int64_t t = 0; t < end_ns; t += h_ns) {
    EXPECT_TRUE(
        advance<Scheme>(body, state, std::span<const Torque<double>>(torques), t, h_ns).resolved());
  }
  return state;
}

std::vector<std::vector<Torque<double>>> loads() {
  return {{},
          {Constant<double>{Frame::body, {0.02, -0.01, 0.01}}},
          {Constant<double>{Frame::inertial, {0.02, -0.01, 0.01}}},
          {Harmonic<double>{Frame::body, {0.02, 0.015, 0.01}, {0.5, 0.3, 0.7}, {0, 1.57, 0.3}},
           Harmonic<double>{Frame::inertial, {0, 0.015, 0.01}, {0.5, 0.3, 0.7}, {0, 1, 2}}}};
}

template <class Float, class Double>
struct Pair {
  using InFloat = Float;
  using InDouble = Double;
};

template <class Schemes>
class FloatStages : public testing::Test {};
using Pairs = testing::Types<Pair<CoadjointRk4Float, CoadjointRk4>,
                             Pair<CoadjointMidpoint2Float, CoadjointMidpoint2>>;
TYPED_TEST_SUITE(FloatStages, Pairs);

TYPED_TEST(FloatStages, cost_a_rounding_of_float_of_what_turns_within_a_step) {
  // eps_float |psi| per radian turned.
  constexpr double kEpsilon = TypeParam::InFloat::kClaims.stage_epsilon;
  for (const Eigen::Matrix3d& J : {paper(), full()}) {
    for (const auto& torques : loads()) {
      for (const double h : {0.1, 0.01, 0.001}) {
        const State<double> start = spinning(J, kOmega);
        const auto in_float = run<typename TypeParam::InFloat>(J, start, torques, 20, h);
        const auto in_double = run<typename TypeParam::InDouble>(J, start, torques, 20, h);
        const double apart = angle_between(in_float.q_IB, in_double.q_IB);
        EXPECT_LT(apart, kEpsilon * (kSpeed * h) * (kSpeed * 20)) << h;
        EXPECT_GT(apart, 1e-4 * kEpsilon * (kSpeed * h) * (kSpeed * 20)) << "not in float?";
      }
    }
  }
}

TYPED_TEST(FloatStages, keep_the_order_in_double_down_to_that) {
  const BodyOf<FreeExact, double> exact{RigidBody<double>(paper())};
  State<double> truth = spinning(paper(), {0.45549, 0.82623, -0.43476});
  const State<double> start = truth;
  FreeExact::step(exact, truth, 20.0, NoTorque{});
  const auto error = [&](double h) {
    return angle_between(truth.q_IB,
                         run<typename TypeParam::InFloat>(paper(), start, {}, 20, h).q_IB);
  };
  constexpr int kOrder = TypeParam::InFloat::kOrder;
  const double h = kOrder == 4 ? 0.125 : 0.05;
  EXPECT_NEAR(std::log2(error(h) / error(h / 2)), kOrder, 0.15);
}

TYPED_TEST(FloatStages, ask_for_the_torque_in_double_and_deliver_its_impulse_in_double) {
  // What the frame's turn adds to the impulse of a torque in B is float's; the torque is not.
  for (const double h : {0.01, 0.001}) {
    const State<double> start = spinning(full(), kOmega);
    const std::vector<Torque<double>> torques{Constant<double>{Frame::body, {0.1, 0.2, -0.1}}};
    const auto in_float = run<typename TypeParam::InFloat>(full(), start, torques, h, h);
    const auto in_double = run<typename TypeParam::InDouble>(full(), start, torques, h, h);
    const double impulse = 0.245 * h;
    EXPECT_LT(norm(in_float.H_I.value() - in_double.H_I.value()),
              kSpeed * h * impulse * TypeParam::InFloat::kClaims.stage_epsilon + 1e-16);
    EXPECT_NEAR(in_float.work.value, in_double.work.value,
                kSpeed * kSpeed * h * impulse * TypeParam::InFloat::kClaims.stage_epsilon + 1e-17);
  }
}

TYPED_TEST(FloatStages, give_a_body_scaled_by_a_power_of_two_the_same_attitude_to_the_bit) {
  // From 1e-60 to 1e60 kg m², where float ends at 1e38: only ratios are narrowed.
  const V torque{0.02, -0.01, 0.01};
  for (const bool pushed : {false, true}) {
    const auto run_scaled = [&](double scale) {
      State<double> state = spinning(full(), kOmega);
      const V H = scale * state.H_I.value();
      state.H_I = {};
      state.H_I.add(H);
      std::vector<Torque<double>> torques;
      if (pushed) {
        torques = {Constant<double>{Frame::body, scale * torque},
                   Constant<double>{Frame::inertial, scale * torque}};
      }
      return run<typename TypeParam::InFloat>(scale * full(), state, torques, 5, 0.05);
    };
    const State<double> one = run_scaled(1);
    for (const int exponent : {-200, -40, 40, 200}) {
      const double scale = std::ldexp(1.0, exponent);
      const State<double> other = run_scaled(scale);
      EXPECT_EQ(one.q_IB, other.q_IB) << exponent;
      EXPECT_EQ(scale * one.H_I.value(), other.H_I.value()) << exponent;
      EXPECT_EQ(scale * one.work.value, other.work.value) << exponent;
    }
  }
}

TYPED_TEST(FloatStages, of_a_turn_beyond_the_range_of_float_are_reported) {
  const BodyOf<typename TypeParam::InFloat, double> body{RigidBody<double>(full())};
  StepLimits wide_open;
  wide_open.substep_angle_rad = 1e300;
  for (const double speed : {1e21, 1e40, 1e80}) {
    State<double> state = spinning(full(), speed * kOmega);
    const State<double> before = state;
    EXPECT_TRUE(
        (advance<typename TypeParam::InFloat, double>(body, state, {}, 0, 10'000'000, wide_open)
             .unresolved_angle))
        << speed;
    EXPECT_EQ(state, before) << speed;
  }
}

TYPED_TEST(FloatStages, turn_a_body_at_a_crawl_as_double_does) {
  // 1e-30 rad/s: its squares underflow in float, and add nothing in double either.
  const State<double> start = spinning(full(), 1e-30 * kOmega);
  const auto in_float = run<typename TypeParam::InFloat>(full(), start, {}, 1e9, 1e6);
  const auto in_double = run<typename TypeParam::InDouble>(full(), start, {}, 1e9, 1e6);
  EXPECT_EQ(in_float.H_I, in_double.H_I);
  EXPECT_EQ(in_float.q_IB, in_double.q_IB);
}

}  // namespace
}  // namespace adstar
