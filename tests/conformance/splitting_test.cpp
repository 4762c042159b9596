// Compositions meet their conditions; splittings keep what kicks and free motion keep.
#include "adstar/integrators/splitting.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "adstar/integrators/quaternion.hpp"
#include "adstar/integrators/tableaus.hpp"
#include "adstar/propagator.hpp"
#include "tests/support/plain_motion.hpp"
#include "tests/support/random_motion.hpp"

namespace adstar {
namespace {

using test::kEpsilon;
using test::Quad;
using test::QuadMatrix;
using V = Vec3<double>;

// ---- the conditions of compositions.hpp ----------------------------------------------------------

struct Moments {
  Quad sum_a = 0, sum_b = 0;
  std::vector<Quad> kicks;  ///< Σ b_i (c_i - ½)^{2k}, k = 1 ..
  Quad drifts = 0;          ///< Σ a_i (d_i - ½)²
};

template <class Composition>
Moments moments() {
  Moments m;
  m.kicks.assign(5, Quad(0));
  Quad c = 0, d = 0;
  const Quad half = Quad(1) / 2;
  for (int i = 0; i <= Composition::kKicks; ++i) {
    const Quad a = Composition::a[i].template as<Quad>();
    m.drifts += a * (d - half) * (d - half);
    m.sum_a += a;
    c += a;
    if (i < Composition::kKicks) {
      const Quad b = Composition::b[i].template as<Quad>();
      Quad power = b;
      for (Quad& sum : m.kicks) {
        power *= (c - half) * (c - half);
        sum += power;
      }
      m.sum_b += b;
      d += b;
    }
  }
  return m;
}

template <class Composition>
void expect_palindrome() {
  constexpr int n = Composition::kKicks;
  for (int i = 0; i <= n; ++i) {
    EXPECT_EQ(Composition::a[i].high, Composition::a[n - i].high);
    EXPECT_EQ(Composition::a[i].low, Composition::a[n - i].low);
    if (i < n) {
      EXPECT_EQ(Composition::b[i].high, Composition::b[n - 1 - i].high);
      EXPECT_EQ(Composition::b[i].low, Composition::b[n - 1 - i].low);
    }
  }
}

bool near(const Quad& a, const Quad& b) { return abs(a - b) < Quad("1e-31"); }

/// As many kick conditions hold as `quadrature` says and no more; the drift condition if `fourth`.
template <class Composition>
void expect_conditions(std::size_t quadrature, bool fourth) {
  expect_palindrome<Composition>();
  const Moments m = moments<Composition>();
  EXPECT_TRUE(near(m.sum_a, 1));
  EXPECT_TRUE(near(m.sum_b, 1));
  Quad four_k = 1;
  for (std::size_t k = 1; k <= m.kicks.size(); ++k) {
    four_k *= 4;
    EXPECT_EQ(near(m.kicks[k - 1], 1 / (Quad(2 * k + 1) * four_k)), k <= quadrature) << k;
  }
  EXPECT_EQ(near(m.drifts, Quad(1) / 12), fourth);
}

TEST(Composition, meets_the_conditions_of_its_orders_and_no_others) {
  expect_conditions<Strang>(0, false);
  expect_conditions<BlanesMoan4>(1, true);
  expect_conditions<McLachlan84>(3, true);
  expect_conditions<McLachlan102>(4, false);
}

// ---- small torques ---------------------------------------------------------------------------------

/// A torque of time and attitude, ε times one of the size of the momentum.
TorqueSample<Quad> weak(const Quad& epsilon, const Quad& t, const Quat<Quad>& q) {
  const Vec3<Quad> down = rotate_inverse(q, Vec3<Quad>{Quad(0), Quad(0), Quad(1)});
  const Vec3<Quad> body{Quad(0), cos(t), sin(2 * t)};
  return {epsilon * (body + cross(down, Vec3<Quad>{Quad("0.3"), Quad("0.2"), Quad("-0.4")})), {}};
}

/// As good as exact beside the errors of a composition: the free scheme in parts.
struct Exact : MoserVeselov10 {
  template <class T>
  static Quat<T> moved(const Body<T>& body, const Quat<T>& q, const Vec3<T>& H, const T& h) {
    Quat<T> end = q;
    for (int i = 0; i < 64; ++i) {
      end = MoserVeselov10::moved(body, end, H, T(h / 64));
    }
    return end;
  }
};

/// Attitude error after 4 s over a free scheme that is as good as exact.
template <class Composition>
Quad error(const Quad& epsilon, int steps) {
  QuadMatrix J = QuadMatrix::Zero();
  J(0, 0) = Quad("0.9144");
  J(1, 1) = Quad("1.098");
  J(2, 2) = Quad("1.66");
  const RigidBody<Quad> rigid(J);
  const BodyOf<Exact, Quad> body(rigid);
  const Quat<Quad> q = normalised(Quat<Quad>{Quad(3), Quad(-1), Quad(2), Quad(1)});
  State<Quad> state = make_state(
      q, rotate(q, rigid.momentum({Quad("0.45549"), Quad("0.82623"), Quad("-0.33476")})));
  const auto exact =
      test::PlainMotion(J, [&](const Quad& t, const Quat<Quad>& at, const Vec3<Quad>&) {
        return weak(epsilon, t, at).body;
      }).run(test::plain_state(q, body_momentum(state)), 0, 4, 128);
  const Quad h = Quad(4) / steps;
  for (int n = 0; n < steps; ++n) {
    Splitting<Composition, Exact>::step(body, state, h,
                                        rateless_body_torque([&](const Stage<Quad>& stage) {
                                          return weak(epsilon, n * h + stage.time_s, stage.q_IB());
                                        }));
  }
  return angle_between(normalised(exact.q_IB()), state.q_IB);
}

double doublings(const Quad& large, const Quad& small) {
  return std::log2(static_cast<double>(large / small));
}

TEST(SplittingMcLachlan84,
     has_an_error_of_the_eighth_power_for_very_weak_torques_and_of_the_fourth_for_weak_ones) {
  const Quad faint("1e-13"), weak_one("1e-2");
  EXPECT_NEAR(doublings(error<McLachlan84>(faint, 8), error<McLachlan84>(faint, 16)), 8, 0.3);
  EXPECT_NEAR(doublings(error<McLachlan84>(weak_one, 8), error<McLachlan84>(weak_one, 16)), 4, 0.3);
  // ε² where the fourth power leads, ε where the eighth does.
  EXPECT_NEAR(doublings(error<McLachlan84>(2 * weak_one, 32), error<McLachlan84>(weak_one, 32)), 2,
              0.15);
  EXPECT_NEAR(doublings(error<McLachlan84>(2 * faint, 8), error<McLachlan84>(faint, 8)), 1, 0.01);
}

TEST(SplittingMcLachlan102,
     has_an_error_of_the_tenth_power_for_very_weak_torques_and_of_the_second_for_weak_ones) {
  const Quad faint("1e-13"), weak_one("1e-2");
  EXPECT_NEAR(doublings(error<McLachlan102>(faint, 8), error<McLachlan102>(faint, 16)), 10, 0.3);
  EXPECT_NEAR(doublings(error<McLachlan102>(weak_one, 8), error<McLachlan102>(weak_one, 16)), 2,
              0.15);
  EXPECT_NEAR(doublings(error<McLachlan102>(2 * weak_one, 32), error<McLachlan102>(weak_one, 32)),
              2, 0.15);
}

// ---- what they keep --------------------------------------------------------------------------------

template <class Scheme>
class SplittingOf : public testing::Test {
 public:
  const RigidBody<double> rigid{
      test::rotated_inertia({0.9144, 1.098, 1.66}, normalised(Quat<double>{4, 1, -2, 1}))};
  const BodyOf<Scheme, double> body{rigid};
  State<double> start = from({0.45549, 0.82623, 0.03476});

  State<double> from(const V& omega_B) const {
    const Quat<double> q = normalised(Quat<double>{1, 2, -1, 0.5});
    return make_state(q, rotate(q, rigid.momentum(omega_B)));
  }
};
using Members = testing::Types<SplittingStrang, SplittingBlanesMoan4, SplittingMcLachlan84,
                               SplittingMcLachlan102>;
TYPED_TEST_SUITE(SplittingOf, Members);

TYPED_TEST(SplittingOf, every_kick_pays_for_its_energy_however_coarse_the_step) {
  State<double> state = this->start;
  const double energy_0 = this->rigid.energy(body_momentum(state)), h = 0.7;
  double lowest = energy_0, highest = energy_0;
  for (int n = 0; n < 10'000; ++n) {
    TypeParam::step(this->body, state, h, mixed_torque([&](const Stage<double>& stage) {
                      const double t = n * h + stage.time_s;
                      return TorqueSample<double>{
                          {0.2 * std::sin(t) - 0.05 * stage.omega_B.x, 0.1 * std::cos(0.3 * t), 0},
                          {0, 0.05 * std::sin(0.7 * t), -0.02 * stage.omega_B.y}};
                    }));
    const double energy = this->rigid.energy(body_momentum(state));
    ASSERT_NEAR(energy - energy_0, state.work.value, 1e-12) << n;
    lowest = std::fmin(lowest, energy);
    highest = std::fmax(highest, energy);
  }
  EXPECT_GT(highest - lowest, 0.1) << "the torque did nothing";
  const V balance = state.H_I.value() - this->start.H_I.value() - state.impulse_I.value();
  EXPECT_LT(norm(balance),
            4 * kEpsilon * (norm(state.H_I.value()) + norm(state.impulse_I.value())));
}

TYPED_TEST(SplittingOf, a_step_back_undoes_a_step_under_a_torque_of_time_and_attitude) {
  State<double> state = this->start;
  const auto torque = [](double t, const Quat<double>& q) {
    return TorqueSample<double>{{0.3 * q.x, 0.2 * std::sin(t), 0.1 * q.y * q.z}, {0, 0.1, 0}};
  };
  for (const double h : {0.5, -0.5}) {
    const double begun = h > 0 ? 0 : 0.5;
    TypeParam::step(this->body, state, h, rateless_mixed_torque([&](const Stage<double>& stage) {
                      return torque(begun + stage.time_s, stage.q_IB());
                    }));
  }
  EXPECT_LT(angle_between(this->start.q_IB, state.q_IB), 32 * kEpsilon);
  EXPECT_LT(norm(this->start.H_I.value() - state.H_I.value()), 32 * kEpsilon);
}

TYPED_TEST(SplittingOf, asks_once_a_kick_when_told_that_the_rate_does_not_matter) {
  int asked = 0, asked_of_rate = 0;
  State<double> state = this->start, same = this->start;
  TypeParam::step(this->body, state, 0.1, rateless_body_torque([&](const Stage<double>& stage) {
                    ++asked;
                    return TorqueSample<double>{{0.1, stage.time_s, 0}, {}};
                  }));
  TypeParam::step(this->body, same, 0.1, body_torque([&](const Stage<double>& stage) {
                    ++asked_of_rate;
                    return TorqueSample<double>{{0.1, stage.time_s, 0}, {}};
                  }));
  EXPECT_EQ(asked_of_rate, 4 * asked);
  EXPECT_LT(angle_between(state.q_IB, same.q_IB), 4 * kEpsilon);
  EXPECT_LT(norm(state.H_I.value() - same.H_I.value()), 4 * kEpsilon);
}

TYPED_TEST(SplittingOf, a_step_too_far_keeps_the_attitude_delivers_the_impulse_and_says_so) {
  State<double> state = this->from({0, 20, 0});
  const State<double> before = state;
  const std::vector<Torque<double>> torques{Constant<double>{Frame::inertial, {0.25, 0, 0}}};
  StepLimits wide_open;
  wide_open.substep_angle_rad = 1e9;
  const auto report =
      advance<TypeParam, double>(this->body, state, torques, 0, 1'000'000'000, wide_open);
  EXPECT_TRUE(report.unresolved_angle);
  EXPECT_EQ(state.q_IB, before.q_IB);
  EXPECT_LT(norm(state.H_I.value() - before.H_I.value() - V{0.25, 0, 0}), 1e-14);
}

TYPED_TEST(SplittingOf,
           is_split_by_its_longest_drift_under_a_weak_torque_and_by_the_step_under_a_strong_one) {
  const RigidBody<double> sphere(Eigen::Matrix3d(Eigen::Matrix3d::Identity()));
  const BodyOf<TypeParam, double> prepared(sphere);
  const auto parts = [&](double torque_n_m) {
    State<double> state = make_state(Quat<double>{}, V{0, 0, 1});
    const std::vector<Torque<double>> torques{Constant<double>{Frame::body, {torque_n_m, 0, 0}}};
    const auto report =
        advance<TypeParam, double>(prepared, state, torques, 0, 10'000'000'000);  // 10 rad
    EXPECT_TRUE(report.resolved());
    return static_cast<double>(report.parts);
  };
  const double longest = TypeParam::kWeakReach, limit = TypeParam::kSubstepAngleRad;
  EXPECT_LT(longest, 0.6);
  EXPECT_EQ(parts(0.9e-4), std::ceil(10 * longest / limit * 1.0009));
  EXPECT_GE(parts(1.1e-4), std::ceil(10 / limit));
}

/// Off by, per radian turned, after three steps that turn by `turn` each, against Fehlberg's method.
template <class Scheme>
double error_per_rad(const Eigen::Vector3d& moments, const V& direction, double turn,
                     const Vec3<double>& torque, double share) {
  using Wide = long double;
  const Eigen::Matrix3d J = moments.asDiagonal();
  const RigidBody<double> rigid(J);
  const double fastest = std::sqrt(angular_speed_bound_squared(rigid, direction, 0.0));
  const V Pi = (turn / fastest) * direction;  // in a step of a second
  const V tau = (share * turn * moments.minCoeff()) * torque;
  const BodyOf<Scheme, double> body(rigid);
  State<double> state = make_state(Quat<double>{}, Pi);
  const std::vector<Torque<double>> torques{Constant<double>{Frame::body, tau}};
  bool resolved = true;
  for (std::int64_t n = 0; n < 3; ++n) {
    resolved = advance<Scheme, double>(body, state, torques, n * 1'000'000'000, 1'000'000'000)
                   .resolved() &&
               resolved;
  }
  EXPECT_TRUE(resolved) << "turn " << turn << ", share " << share;
  const RigidBody<Wide> wide(J.cast<Wide>());
  State<Wide> truth = make_state(Quat<Wide>{1, 0, 0, 0}, Vec3<Wide>{Pi.x, Pi.y, Pi.z});
  const Vec3<Wide> tau_wide{tau.x, tau.y, tau.z};
  constexpr int kFine = 600;
  for (int n = 0; n < kFine; ++n) {
    QuaternionRk<Fehlberg8, false>::step(wide, truth, Wide(3) / kFine,
                                         body_torque([&](const Stage<Wide>&) {
                                           return TorqueSample<Wide>{tau_wide, {}};
                                         }));
  }
  const Quat<Wide> q =
      normalised(Quat<Wide>{state.q_IB.w, state.q_IB.x, state.q_IB.y, state.q_IB.z});
  return static_cast<double>(angle_between(normalised(truth.q_IB), q)) / (3 * turn);
}

TYPED_TEST(SplittingOf, is_never_wrong_in_silence_for_a_torque_on_either_side_of_weak) {
  for (const Eigen::Vector3d& moments :
       {Eigen::Vector3d(0.9144, 1.098, 1.66), Eigen::Vector3d(1e-2, 1, 1.005),
        Eigen::Vector3d(0.5, 0.7, 1.2), Eigen::Vector3d(1, 1 + 1e-12, 1 + 2e-12)}) {
    test::Generator random(97);
    for (int i = 0; i < 6; ++i) {
      const V direction = test::unit_vector(random), torque = test::unit_vector(random);
      for (const double turn : {0.3, 1.4, 3.0, 5.0}) {
        for (const double share : {1e-6, 0.9e-3, 1.1e-3, 1e-2}) {
          EXPECT_LT(error_per_rad<TypeParam>(moments, direction, turn, torque, share), 1e-2)
              << moments.transpose() << ", turn " << turn << ", share " << share;
        }
      }
    }
  }
}

TEST(SplittingMcLachlan102, holds_a_weakly_forced_body_to_a_nanoradian_at_four_seconds_a_step) {
  // The paper's body under 1e-5 of its torque, 100 s.
  QuadMatrix J = QuadMatrix::Zero();
  J(0, 0) = Quad("0.9144");
  J(1, 1) = Quad("1.098");
  J(2, 2) = Quad("1.66");
  const auto exact =
      test::PlainMotion(J,
                        [](const Quad& t, const Quat<Quad>&, const Vec3<Quad>&) {
                          return Vec3<Quad>{Quad("2e-7") * sin(t / 2),
                                            Quad("1.5e-7") * cos(3 * t / 10), Quad("1e-7")};
                        })
          .run(test::plain_state(Quat<Quad>{},
                                 {Quad("0.9144") * Quad("0.45549"), Quad("1.098") * Quad("0.82623"),
                                  Quad("1.66") * Quad("0.03476")}),
               0, 100, 400);
  const RigidBody<double> rigid(Eigen::Matrix3d(Eigen::Vector3d(0.9144, 1.098, 1.66).asDiagonal()));
  const BodyOf<SplittingMcLachlan102, double> body(rigid);
  State<double> state = make_state(Quat<double>{}, rigid.momentum({0.45549, 0.82623, 0.03476}));
  const double h = 4;  // 3.8 rad
  for (int n = 0; n < 25; ++n) {
    SplittingMcLachlan102::step(
        body, state, h, rateless_body_torque([&](const Stage<double>& stage) {
          const double t = n * h + stage.time_s;
          return TorqueSample<double>{{2e-7 * std::sin(0.5 * t), 1.5e-7 * std::cos(0.3 * t), 1e-7},
                                      {}};
        }));
  }
  EXPECT_LT(angle_between(test::convert<double>(normalised(exact.q_IB())), state.q_IB), 1e-9);
}

}  // namespace
}  // namespace adstar
