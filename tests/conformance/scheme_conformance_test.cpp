// What every scheme keeps, step by step, whatever its order (tests/conformance/order_test.cpp
// measures that).
#include <cmath>
#include <cstring>
#include <string_view>

#include <gtest/gtest.h>

#include "tests/support/compiled_schemes.hpp"
#include "tests/support/random_motion.hpp"
#include "tests/support/schemes.hpp"
#include "tests/support/wide.hpp"

namespace adstar {
namespace {

using test::Compiled;
using test::Generator;
using test::kEpsilon;
using V = Vec3<double>;

State<double> at(const RigidBody<double>& body, const Quat<double>& q, const V& omega_B) {
  return make_state(q, rotate(normalised(q), body.momentum(omega_B)));
}

bool same_bits(const State<double>& a, const State<double>& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

template <class Scheme>
class SchemeOf : public testing::Test {
 public:
  BodyOf<Scheme, double> body{RigidBody<double>(
      test::rotated_inertia({0.9144, 1.098, 1.66}, normalised(Quat<double>{4, 1, -2, 1})))};
  State<double> start = at(body, {1, 2, -1, 0.5}, {0.45549, 0.82623, 0.03476});

  static TorqueSample<double> turning(double t) {
    return {{0.02 * std::sin(0.5 * t), 0.015 * std::cos(0.3 * t), 0.01}, {}};
  }
};
TYPED_TEST_SUITE(SchemeOf, test::ForcedSchemeTypes);

TYPED_TEST(SchemeOf, keeps_the_inertial_momentum_of_a_free_body_to_the_last_bit) {
  if constexpr (!TypeParam::kClaims.exact_momentum) {
    GTEST_SKIP() << "claims no exact momentum";
  }
  State<double> state = this->start;
  for (int n = 0; n < 100'000; ++n) {
    Compiled<TypeParam>::step(this->body, state, 0.01, NoTorque{});
  }
  EXPECT_EQ(state.H_I, this->start.H_I);
  EXPECT_EQ(state.impulse_I, (VecSum<double>{}));
  EXPECT_EQ(state.work, (Sum<double>{}));
  EXPECT_GT(angle_between(state.q_IB, this->start.q_IB), 1e-3) << "the body never turned";
}

TYPED_TEST(SchemeOf, keeps_it_at_a_step_so_coarse_that_the_attitude_is_lost) {
  if constexpr (!TypeParam::kClaims.exact_momentum) {
    GTEST_SKIP() << "claims no exact momentum";
  }
  State<double> state = this->start;
  for (int n = 0; n < 1000; ++n) {
    Compiled<TypeParam>::step(this->body, state, 1.5, NoTorque{});
  }
  EXPECT_EQ(state.H_I, this->start.H_I);
  EXPECT_NEAR(squared_norm(state.q_IB), 1, 8 * kEpsilon);
}

TYPED_TEST(SchemeOf, stays_on_the_rotation_group) {
  State<double> state = this->start;
  double worst = 0;
  for (int n = 0; n < 100'000; ++n) {
    Compiled<TypeParam>::step(this->body, state, 0.01, NoTorque{});
    worst = std::fmax(worst, std::fabs(squared_norm(state.q_IB) - 1));
  }
  EXPECT_LT(worst, 8 * kEpsilon);
  const Eigen::Matrix3d R = rotation_matrix(state.q_IB);
  EXPECT_LT((R.transpose() * R - Eigen::Matrix3d::Identity()).norm(), 5e-15);
  EXPECT_NEAR(R.determinant(), 1, 5e-15);
}

TYPED_TEST(SchemeOf, changes_momentum_by_the_impulse_alone) {
  if constexpr (!TypeParam::kClaims.exact_momentum || TypeParam::kClaims.free_only) {
    GTEST_SKIP() << "claims no exact momentum, or knows no torque";
  }
  State<double> state = this->start;
  const double h = 0.01;
  for (int n = 0; n < 100'000; ++n) {
    Compiled<TypeParam>::step(this->body, state, h, body_torque([&](const Stage<double>& stage) {
                                return this->turning(n * h + stage.time_s);
                              }));
  }
  const V balance = state.H_I.value() - this->start.H_I.value() - state.impulse_I.value();
  EXPECT_LT(norm(balance),
            4 * kEpsilon * (norm(state.H_I.value()) + norm(state.impulse_I.value())));
  EXPECT_GT(norm(state.impulse_I.value()), 0.05) << "the torque did nothing";
}

TYPED_TEST(SchemeOf, delivers_a_constant_inertial_torque_exactly) {
  if constexpr (!TypeParam::kClaims.exact_momentum || TypeParam::kClaims.free_only) {
    GTEST_SKIP() << "claims no exact momentum, or knows no torque";
  }
  State<double> state = this->start;
  // Spun up to turns of radians a step; schemes that refuse such turns get less.
  constexpr bool kTakesAnyTurn = requires { TypeParam::kTakesLanes; }
  &&TypeParam::kOrder <= 4;
  constexpr double kShare = kTakesAnyTurn ? 1 : 1. / 64;
  const TorqueSample<double> tau{{}, {kShare * 0.25, kShare * -0.5, kShare * 0.125}};
  const double h = 1.0 / 128;
  for (int n = 0; n < 100'000; ++n) {
    Compiled<TypeParam>::step(this->body, state, h,
                              mixed_torque([&](const Stage<double>&) { return tau; }));
  }
  const V expected = this->start.H_I.value() + (100'000 * h) * tau.inertial;
  EXPECT_LT(norm(state.H_I.value() - expected), 2 * kEpsilon * norm(expected));
}

TYPED_TEST(SchemeOf, accounts_for_the_energy_by_the_work) {
  if constexpr (TypeParam::kClaims.free_only) {
    GTEST_SKIP() << "knows no torque";
  }
  for (const bool inertial : {false, true}) {
    State<double> state = this->start;
    const double h = 1e-3, energy_0 = this->body.energy(body_momentum(state));
    for (int n = 0; n < 10'000; ++n) {
      Compiled<TypeParam>::step(this->body, state, h, mixed_torque([&](const Stage<double>& stage) {
                                  TorqueSample<double> tau = this->turning(n * h + stage.time_s);
                                  if (inertial) {
                                    std::swap(tau.body, tau.inertial);
                                  }
                                  return tau;
                                }));
    }
    const double gained = this->body.energy(body_momentum(state)) - energy_0;
    const double round_off = (TypeParam::kClaims.exact_momentum ? 1e-13 : 1e-11) +
                             TypeParam::kClaims.stage_epsilon * h;  // of what turns in a step
    EXPECT_NEAR(gained, state.work.value, TypeParam::kOrder >= 4 ? round_off : 1e-6)
        << "inertial: " << inertial;
    EXPECT_GT(std::fabs(gained), 1e-3);
  }
}

TYPED_TEST(SchemeOf, turns_a_body_about_a_principal_axis_by_omega_times_time) {
  const BodyOf<TypeParam, double> brick(
      RigidBody<double>(Eigen::Matrix3d(Eigen::Vector3d(1.0, 1.5, 2.0).asDiagonal())));
  const double pi = std::acos(-1.0), h = 0.01;
  for (int axis = 0; axis < 3; ++axis) {
    const double speed = pi / 30;  // half a turn in 30 s
    V omega{};
    (axis == 0 ? omega.x : axis == 1 ? omega.y : omega.z) = speed;
    State<double> state = at(brick, {}, omega);
    for (int n = 0; n < 3000; ++n) {
      Compiled<TypeParam>::step(brick, state, h, NoTorque{});
    }
    const V vector{state.q_IB.x, state.q_IB.y, state.q_IB.z};
    EXPECT_NEAR(std::fabs(state.q_IB.w), 0, 1e-13) << "axis " << axis;
    EXPECT_NEAR(std::fabs(dot(vector, (1 / speed) * omega)), 1, 1e-14) << "axis " << axis;
    EXPECT_LT(norm(brick.angular_velocity(body_momentum(state)) - omega), 1e-15) << "axis " << axis;
  }
}

TYPED_TEST(SchemeOf, leaves_a_body_at_rest_where_it_is) {
  const State<double> rest = make_state(this->start.q_IB, V{});
  State<double> state = rest;
  for (int n = 0; n < 1000; ++n) {
    Compiled<TypeParam>::step(this->body, state, 0.01, NoTorque{});
  }
  EXPECT_LT(angle_between(rest.q_IB, state.q_IB), 2 * kEpsilon);
  EXPECT_EQ(state.H_I.value(), V{});
}

TYPED_TEST(SchemeOf, spins_up_a_body_from_rest_by_torque_over_inertia) {
  if constexpr (TypeParam::kClaims.free_only) {
    GTEST_SKIP() << "knows no torque";
  }
  const BodyOf<TypeParam, double> brick(
      RigidBody<double>(Eigen::Matrix3d(Eigen::Vector3d(1.0, 1.5, 2.0).asDiagonal())));
  State<double> state = make_state(Quat<double>{}, V{});
  const TorqueSample<double> tau{{0, 0, 0.5}, {}};
  for (int n = 0; n < 1000; ++n) {
    Compiled<TypeParam>::step(brick, state, 1e-3,
                              body_torque([&](const Stage<double>&) { return tau; }));
  }
  EXPECT_NEAR(brick.angular_velocity(body_momentum(state)).z, 0.25,
              TypeParam::kClaims.exact_momentum ? 1e-15 : 2e-14);
  const double of_float = TypeParam::kClaims.stage_epsilon * 1e-3;  // of what turns in a step
  EXPECT_NEAR(angle_between(Quat<double>{}, state.q_IB), 0.125, 1e-13 + of_float);  // ½ (tau/J) t²
  EXPECT_NEAR(state.work.value, 0.0625, 1e-14 + of_float);
}

TYPED_TEST(SchemeOf, asks_for_the_torque_once_a_stage_and_within_the_step) {
  if constexpr (TypeParam::kClaims.free_only) {
    GTEST_SKIP() << "knows no torque";
  }
  State<double> state = this->start;
  int asked = 0;
  double earliest = 1, latest = -1;
  Compiled<TypeParam>::step(this->body, state, 0.5,
                            rateless_body_torque([&](const Stage<double>& stage) {
                              ++asked;
                              earliest = std::fmin(earliest, stage.time_s);
                              latest = std::fmax(latest, stage.time_s);
                              return TorqueSample<double>{};
                            }));
  EXPECT_GE(asked, 1);
  EXPECT_LE(asked, 4 * TypeParam::kOrder);
  if (test::free_order<TypeParam>() == TypeParam::kOrder) {
    EXPECT_EQ(earliest, 0.0);
  } else {  // a splitting drifts before it kicks
    EXPECT_GT(earliest, 0.0);
  }
  EXPECT_LE(latest, 0.5);
  EXPECT_GT(latest, 0.0);
}

/// Stages of these are quaternions off the sphere: a turn of x is off by some x³.
template <class Tableau, bool Projected>
constexpr bool leaves_the_sphere(const QuaternionRk<Tableau, Projected>*) {
  return true;
}
constexpr bool leaves_the_sphere(const void*) { return false; }

TYPED_TEST(SchemeOf, tells_the_torque_the_attitude_and_rate_that_it_acts_at) {
  if constexpr (TypeParam::kClaims.free_only) {
    GTEST_SKIP() << "knows no torque";
  }
  const BodyOf<TypeParam, double> brick(
      RigidBody<double>(Eigen::Matrix3d(Eigen::Vector3d(1.0, 1.5, 2.0).asDiagonal())));
  const V omega{0, 0, 0.4};
  for (const double h : {0.5, 1e-4}) {
    const double x = 0.4 * h;
    const double off = leaves_the_sphere(static_cast<TypeParam*>(nullptr)) ? 0.1 * x * x * x : 0;
    State<double> state = at(brick, {}, omega);
    Compiled<TypeParam>::step(brick, state, h, body_torque([&](const Stage<double>& stage) {
                                const double half = 0.5 * 0.4 * stage.time_s;
                                const Quat<double> expected{std::cos(half), 0, 0, std::sin(half)};
                                EXPECT_LT(angle_between(expected, stage.q_IB()), 1e-15 + off);
                                EXPECT_LT(norm(stage.omega_B - omega), 1e-15);
                                return TorqueSample<double>{};
                              }));
  }
}

TYPED_TEST(SchemeOf, gives_the_same_bits_twice) {
  const auto run = [&] {
    State<double> state = this->start;
    for (int n = 0; n < 10'000; ++n) {
      Compiled<TypeParam>::step(
          this->body, state, 0.01, mixed_torque([&](const Stage<double>& stage) {
            return TorqueSample<double>{{0.1 * stage.omega_B.x, 0.01, 0}, {0, 0, stage.time_s}};
          }));
    }
    return state;
  };
  const State<double> first = run();
  EXPECT_TRUE(same_bits(first, run()));
}

TYPED_TEST(SchemeOf, gives_a_zero_torque_the_motion_of_no_torque) {
  if constexpr (TypeParam::kClaims.free_only) {
    GTEST_SKIP() << "knows no torque";
  }
  State<double> free = this->start, forced = this->start;
  for (int n = 0; n < 1000; ++n) {
    Compiled<TypeParam>::step(this->body, free, 0.01, NoTorque{});
    Compiled<TypeParam>::step(this->body, forced, 0.01, mixed_torque([](const Stage<double>&) {
                                return TorqueSample<double>{};
                              }));
  }
  EXPECT_EQ(free.q_IB, forced.q_IB);
  EXPECT_EQ(free.H_I.value(), forced.H_I.value());
}

TYPED_TEST(SchemeOf, is_found_by_its_name) {
  bool found = false;
  EXPECT_TRUE(with_scheme(
      TypeParam::kName, [&](auto scheme) { found = std::is_same_v<decltype(scheme), TypeParam>; }));
  EXPECT_TRUE(found);
}

TEST(Schemes, are_refused_by_a_name_that_is_none_of_theirs) {
  EXPECT_FALSE(with_scheme("coadjoint_rk5", [](auto) { FAIL(); }));
  EXPECT_FALSE(with_scheme("", [](auto) { FAIL(); }));
}

TEST(Schemes, have_names_of_their_own_and_begin_with_the_papers) {
  const auto names = scheme_names();
  ASSERT_EQ(names.size(), std::tuple_size_v<Schemes>);
  EXPECT_EQ(names.front(), "coadjoint_rk4");
  for (std::size_t i = 0; i < names.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_NE(names[i], names[j]);
    }
  }
}

}  // namespace
}  // namespace adstar
