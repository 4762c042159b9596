// adstar::advance: edges inside a step, sub-steps, and what is reported when neither suffices.
#include "adstar/propagator.hpp"

#include <cmath>
#include <cstring>
#include <limits>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/compiled_schemes.hpp"
#include "tests/support/plain_motion.hpp"
#include "tests/support/random_motion.hpp"
#include "tests/support/schemes.hpp"
#include "tests/support/wide.hpp"

namespace adstar {
namespace {

using test::Compiled;
using test::Generator;
using test::kEpsilon;
using test::Quad;
using V = Vec3<double>;

constexpr std::int64_t kMillisecond = 1'000'000;
constexpr std::int64_t kStep = 10 * kMillisecond;

Eigen::Matrix3d inertia() {
  return test::rotated_inertia({0.9144, 1.098, 1.66}, normalised(Quat<double>{4, 1, -2, 1}));
}

template <class Scheme>
class Advance : public testing::Test {
 public:
  BodyOf<Scheme, double> body{RigidBody<double>(inertia())};
  State<double> start = spinning({0.45549, 0.82623, 0.03476});

  State<double> spinning(const V& omega_B) const {
    const Quat<double> q = normalised(Quat<double>{1, 2, -1, 0.5});
    return make_state(q, rotate(q, body.momentum(omega_B)));
  }
  StepReport advance_to(State<double>& state, const std::vector<Torque<double>>& torques,
                        std::int64_t t_ns, std::int64_t h_ns, const StepLimits& limits = {}) const {
    return Compiled<Scheme>::advance(body, state, torques, t_ns, h_ns, limits);
  }
  State<double> run(const std::vector<Torque<double>>& torques, std::int64_t h_ns,
                    int steps) const {
    State<double> state = start;
    for (int n = 0; n < steps; ++n) {
      EXPECT_TRUE(advance_to(state, torques, n * h_ns, h_ns).resolved());
    }
    return state;
  }
};
TYPED_TEST_SUITE(Advance, test::ForcedSchemeTypes);

Commanded<double> pulse(Frame frame, std::int64_t start_ns, std::int64_t end_ns, const V& torque) {
  Commanded<double> commanded;
  commanded.frame = frame;
  commanded.window[0] = {start_ns, end_ns, torque};
  commanded.intervals = 1;
  return commanded;
}

TYPED_TEST(Advance, delivers_an_inertial_pulse_at_any_phase_against_the_step) {
  Generator random(71);
  for (int i = 0; i < 200; ++i) {
    const auto from = static_cast<std::int64_t>(test::uniform(random, 0, 5e7));
    const auto length = 1 + static_cast<std::int64_t>(test::log_uniform(random, 1, 4e7));
    const V torque = test::log_uniform(random, 1e-3, 1) * test::unit_vector(random);
    const State<double> end =
        this->run({pulse(Frame::inertial, from, from + length, torque)}, kStep, 10);
    const V impulse = seconds<double>(length) * torque;
    const V change = end.H_I.value() - this->start.H_I.value();
    if (TypeParam::kClaims.exact_momentum) {
      ASSERT_LT(norm(change - impulse), 4 * kEpsilon * norm(this->start.H_I.value()))
          << from << " + " << length;
    }
    // Weights of both signs round what cancels in their sum: Σ|b_i| of dop853 is 13.
    constexpr bool kDop853 = std::string_view(TypeParam::kName).ends_with("dop853");
    ASSERT_LT(norm(end.impulse_I.value() - impulse), (kDop853 ? 13 : 4) * kEpsilon * norm(impulse))
        << from << " + " << length;
  }
}

TYPED_TEST(Advance, splits_the_step_at_an_edge_as_two_shorter_steps_would) {
  const std::vector<Torque<double>> torques{
      pulse(Frame::body, 3 * kMillisecond, kStep, {0.3, -0.2, 0.1})};
  State<double> whole = this->start, parts = this->start;
  EXPECT_EQ(this->advance_to(whole, torques, 0, kStep).parts, 2);
  EXPECT_EQ(this->advance_to(parts, torques, 0, 3 * kMillisecond).parts, 1);
  EXPECT_EQ(this->advance_to(parts, torques, 3 * kMillisecond, 7 * kMillisecond).parts, 1);
  EXPECT_EQ(whole, parts);
}

TYPED_TEST(Advance, does_not_split_at_an_edge_on_its_own_bounds) {
  const std::vector<Torque<double>> torques{pulse(Frame::body, 0, kStep, {0.3, -0.2, 0.1})};
  State<double> state = this->start;
  EXPECT_EQ(this->advance_to(state, torques, 0, kStep).parts, 1);
  const State<double> after = state;
  EXPECT_EQ(this->advance_to(state, torques, kStep, kStep).parts, 1);
  EXPECT_EQ(state.impulse_I, after.impulse_I);
}

TYPED_TEST(Advance, takes_the_free_step_when_every_torque_is_silent) {
  const std::vector<Torque<double>> silent{pulse(Frame::body, -5, -1, {1, 1, 1}), Table<double>{},
                                           Constant<double>{}};
  State<double> state = this->start, free = this->start;
  for (int n = 0; n < 100; ++n) {
    this->advance_to(state, silent, n * kStep, kStep);
    Compiled<TypeParam>::step(this->body, free, 0.01, NoTorque{});
  }
  EXPECT_EQ(state, free);
}

TYPED_TEST(Advance, adds_up_all_torques_of_both_frames) {
  const V a{0.1, -0.05, 0.02}, b{-0.03, 0.08, 0.01};
  const std::vector<Torque<double>> apart{
      Constant<double>{Frame::body, a}, Constant<double>{Frame::inertial, b},
      Constant<double>{Frame::body, b}, Constant<double>{Frame::inertial, a}};
  const std::vector<Torque<double>> joined{Constant<double>{Frame::body, a + b},
                                           Constant<double>{Frame::inertial, a + b}};
  const State<double> first = this->run(apart, kStep, 100), second = this->run(joined, kStep, 100);
  EXPECT_LT(angle_between(first.q_IB, second.q_IB), 1e-13);
  EXPECT_LT(norm(first.H_I.value() - second.H_I.value()), 1e-14);
}

TYPED_TEST(Advance, gives_a_harmonic_torque_the_absolute_time) {
  const Harmonic<double> torque{Frame::inertial, {0.3, 0, 0}, {2, 0, 0}, {0.4, 0, 0}};
  const std::int64_t origin = 7'000'000'000;
  State<double> state = this->start;
  for (int n = 0; n < 100; ++n) {
    this->advance_to(state, {torque}, origin + n * kMillisecond, kMillisecond);
  }
  // ∫ 0.3 sin(2t + 0.4) dt from 7 s to 7.1 s
  const double expected = 0.15 * (std::cos(2 * 7.0 + 0.4) - std::cos(2 * 7.1 + 0.4));
  EXPECT_NEAR(state.impulse_I.value().x, expected, TypeParam::kOrder >= 4 ? 1e-14 : 1e-8);
}

TYPED_TEST(Advance, integrates_a_linear_table_exactly_in_the_inertial_frame) {
  Table<double> ramp{Frame::inertial,
                     Interpolation::linear,
                     AfterEnd::zero,
                     {kMillisecond, 17 * kMillisecond, 40 * kMillisecond},
                     {{0, 0, 0}, {1, -2, 0.5}, {-1, 0, 0}}};
  const State<double> end = this->run({ramp}, kStep, 10);
  // Trapezia: 16 ms · ½ (0 + p), 23 ms · ½ (p + q).
  const V expected = 0.008 * V{1, -2, 0.5} + 0.0115 * V{0, -2, 0.5};
  EXPECT_LT(norm(end.impulse_I.value() - expected), 1e-16);
}

TYPED_TEST(Advance, keeps_its_order_when_torques_jump_inside_the_steps) {
  // The truth, segment by segment between the edges.
  const std::int64_t from = 123'456'789, to = 617'283'945, end = 800 * kMillisecond;
  const V torque{0.9, -0.6, 0.4};
  const test::QuadMatrix J = inertia().cast<Quad>();
  const test::PlainMotion free(J, {});
  const test::PlainMotion pushed(J, [&](const Quad&, const Quat<Quad>&, const Vec3<Quad>&) {
    return test::convert<Quad>(torque);
  });
  const Quad t1 = seconds<Quad>(from), t2 = seconds<Quad>(to), t3 = seconds<Quad>(end);
  auto exact = test::plain_state(test::convert<Quad>(this->start.q_IB),
                                 test::convert<Quad>(body_momentum(this->start)));
  exact = free.run(exact, 0, t1, 4);
  exact = pushed.run(exact, t1, t2, 8);
  exact = free.run(exact, t2, t3, 4);
  const Quat<double> truth = test::convert<double>(normalised(exact.q_IB()));
  const auto error = [&](std::int64_t h_ns) {
    const auto steps = static_cast<int>(end / h_ns);
    return angle_between(truth,
                         this->run({pulse(Frame::body, from, to, torque)}, h_ns, steps).q_IB);
  };
  if (TypeParam::kOrder > 6) {  // at round-off, which an edge overlooked would not be
    EXPECT_LT(error(200 * kMillisecond), 1e-11);
    return;
  }
  // The splits differ from step to step: the measured order scatters, upwards for a scheme whose
  // leading error is small.
  const int ms = TypeParam::kOrder > 4 ? 200 : TypeParam::kOrder > 2 ? 100 : 50;
  const std::int64_t h = ms * kMillisecond;
  const double order = std::log2(error(h) / error(h / 2));
  EXPECT_GT(order, TypeParam::kOrder - 0.5);
  EXPECT_LT(order, TypeParam::kOrder + (TypeParam::kOrder > 4 ? 2 : 0.5));
}

TYPED_TEST(Advance, splits_a_step_that_turns_too_far) {
  const double speed = 25;
  State<double> state = this->spinning({0, 0, speed});
  const double bound =
      std::sqrt(angular_speed_bound_squared(this->body, body_momentum(state), 0.0));
  const StepReport report = this->advance_to(state, {}, 0, 100 * kMillisecond, {0.5, 64, 64});
  EXPECT_TRUE(report.resolved());
  const double reach =
      reach_of<TypeParam>(this->body, body_momentum(this->spinning({0, 0, speed})), 0.0);
  EXPECT_EQ(report.parts, static_cast<std::int64_t>(std::ceil(0.1 * bound * reach / 0.5)));
}

TYPED_TEST(Advance, gives_sub_steps_the_bits_of_the_same_steps_taken_one_by_one) {
  State<double> split = this->spinning({3, -20, 8}), single = split;
  const StepReport report = this->advance_to(split, {}, 0, 128 * kMillisecond, {0.25, 64, 64});
  ASSERT_GT(report.parts, 2);
  for (std::int64_t i = 0; i < report.parts; ++i) {
    Compiled<TypeParam>::step(this->body, single, 0.128 / static_cast<double>(report.parts),
                              NoTorque{});
  }
  EXPECT_EQ(split, single);
}

TYPED_TEST(Advance, reports_a_spin_that_the_sub_step_limit_cannot_follow_and_keeps_the_momentum) {
  const State<double> fast = this->spinning({0, 0, 1e5});
  State<double> state = fast;
  const std::vector<Torque<double>> push{Constant<double>{Frame::inertial, {100, 0, 0}}};
  const StepReport report = this->advance_to(state, push, 0, kStep);
  EXPECT_TRUE(report.unresolved_angle);
  EXPECT_FALSE(report.unresolved_edges);
  EXPECT_FALSE(report.resolved());
  EXPECT_LT(norm(state.H_I.value() - fast.H_I.value() - V{1, 0, 0}),
            4 * kEpsilon * norm(fast.H_I.value()));
  EXPECT_NEAR(squared_norm(state.q_IB), 1, 1e-12);
}

TYPED_TEST(Advance, keeps_a_finite_attitude_whatever_the_momentum) {
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               inf = std::numeric_limits<double>::infinity();
  for (const double bad : {1e20, 1e100, 1e200, 1e308, inf, -inf, nan}) {
    for (const bool pushed : {false, true}) {
      State<double> state = this->start;
      state.H_I = {};
      state.H_I.add({1, bad, 1});
      std::vector<Torque<double>> torques;
      if (pushed) {
        torques = {Constant<double>{Frame::body, {1, 2, 3}}};
      }
      for (int n = 0; n < 5; ++n) {
        const StepReport report = this->advance_to(state, torques, n * kStep, kStep);
        EXPECT_TRUE(report.unresolved_angle) << bad;
      }
      EXPECT_NEAR(squared_norm(state.q_IB), 1, 0.5) << bad;
    }
  }
}

TYPED_TEST(Advance, bounds_the_turn_under_torque_before_the_step) {
  // At rest, yet 40 rad/s at the end of the step.
  State<double> state = make_state(Quat<double>{}, V{});
  const std::vector<Torque<double>> push{Constant<double>{Frame::body, {0, 0, 600}}};
  EXPECT_GT(this->advance_to(state, push, 0, 100 * kMillisecond).parts, 3);
}

Table<double> busy_table(int knots) {
  Table<double> table{Frame::inertial, Interpolation::hold, AfterEnd::zero, {}, {}};
  for (int i = 0; i < knots; ++i) {
    table.time_ns.push_back(i * 10'000 + 5'000);
    table.torque_n_m.push_back({0.1 * (i % 2), 0, 0});
  }
  return table;
}

TYPED_TEST(Advance, reports_more_edges_than_the_limit) {
  State<double> state = this->start;
  const StepReport report = this->advance_to(state, {busy_table(100)}, 0, kStep, {1.0, 64, 20});
  EXPECT_TRUE(report.unresolved_edges);
  EXPECT_FALSE(report.unresolved_angle);
  EXPECT_EQ(report.parts, 21);
}

TYPED_TEST(Advance, follows_edges_up_to_the_limit_exactly) {
  State<double> state = this->start;
  const StepReport report = this->advance_to(state, {busy_table(20)}, 0, kStep, {1.0, 64, 20});
  EXPECT_TRUE(report.resolved());
  EXPECT_EQ(report.parts, 21);
  EXPECT_NEAR(state.impulse_I.value().x, 9 * 0.1 * 1e-5, 1e-20);  // the last knot ends it
}

TYPED_TEST(Advance, gives_the_same_bits_whatever_else_runs_beside_it) {
  const std::vector<Torque<double>> torques{
      Harmonic<double>{Frame::body, {0.1, 0.2, 0.3}, {1, 2, 3}, {0, 0, 0}},
      pulse(Frame::body, 33 * kMillisecond + 7, 77 * kMillisecond + 1, {0.2, 0, -0.1})};
  const State<double> alone = this->run(torques, kStep, 100);
  State<double> here = this->start, other = this->spinning({-2, 1, 0.5});
  for (int n = 0; n < 100; ++n) {
    this->advance_to(other, {}, n * kStep, kStep);
    this->advance_to(here, torques, n * kStep, kStep);
  }
  EXPECT_EQ(std::memcmp(&alone, &here, sizeof here), 0);
}

}  // namespace
}  // namespace adstar
