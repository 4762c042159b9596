// A viscous torque: the closed forms of its decay, its work, and what is said when it is too stiff.
#include <cmath>
#include <cstring>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/compiled_schemes.hpp"
#include "tests/support/random_motion.hpp"
#include "tests/support/schemes.hpp"

namespace adstar {
namespace {

using V = Vec3<double>;

constexpr std::int64_t kMillisecond = 1'000'000;

template <class Scheme>
class Damped : public testing::Test {
 public:
  /// Of order 2, after some seconds at 20 ms; any higher order is far below it.
  static constexpr double kTolerance = Scheme::kOrder == 2 ? 3e-4 : 1e-7;

  static State<double> spinning(const Eigen::Matrix3d& J, const V& omega_B) {
    return make_state(Quat<double>{}, RigidBody<double>(J).momentum(omega_B));
  }
  static StepReport advance_to(const Eigen::Matrix3d& J, State<double>& state,
                               const std::vector<Torque<double>>& torques, std::int64_t t_ns,
                               std::int64_t h_ns, const StepLimits& limits = {}) {
    const BodyOf<Scheme, double> body{RigidBody<double>(J)};
    return test::Compiled<Scheme>::advance(body, state, torques, t_ns, h_ns, limits);
  }
  /// Four seconds in steps of 20 ms.
  static State<double> run(const Eigen::Matrix3d& J, const V& omega_B, const V& c) {
    State<double> state = spinning(J, omega_B);
    for (std::int64_t n = 0; n < 200; ++n) {
      EXPECT_TRUE(
          advance_to(J, state, {Damping<double>{c}}, n * 20 * kMillisecond, 20 * kMillisecond)
              .resolved());
    }
    return state;
  }
};
TYPED_TEST_SUITE(Damped, test::ForcedSchemeTypes);

Eigen::Matrix3d sphere() { return 2 * Eigen::Matrix3d::Identity(); }
Eigen::Matrix3d ordinary() { return Eigen::Vector3d(0.9144, 1.098, 1.66).asDiagonal(); }

TYPED_TEST(Damped, sphere_slows_down_exponentially_about_an_axis_that_stands_still) {
  const V omega{0.3, -0.8, 0.5};
  const State<double> end = this->run(sphere(), omega, {0.6, 0.6, 0.6});
  const double left = std::exp(-0.6 / 2 * 4), speed = norm(omega);
  EXPECT_LT(norm(end.H_I.value() - (2 * left) * omega), this->kTolerance);
  const double angle = speed * (1 - left) * 2 / 0.6;
  const V axis = (1 / speed) * omega;
  const double s = std::sin(angle / 2);
  const Quat<double> expected{std::cos(angle / 2), s * axis.x, s * axis.y, s * axis.z};
  EXPECT_LT(angle_between(end.q_IB, expected), this->kTolerance);
}

TYPED_TEST(Damped, body_about_a_principal_axis_slows_down_at_that_axis_own_rate) {
  const State<double> end = this->run(ordinary(), {0, 0, 1.2}, {5, 7, 0.4});
  const double left = std::exp(-0.4 / 1.66 * 4);
  EXPECT_NEAR(end.H_I.value().z, 1.66 * 1.2 * left, this->kTolerance);
  const double angle = 1.2 * (1 - left) * 1.66 / 0.4;
  EXPECT_LT(angle_between(end.q_IB, {std::cos(angle / 2), 0, 0, std::sin(angle / 2)}),
            this->kTolerance);
}

TYPED_TEST(Damped, body_loses_the_energy_that_the_work_says) {
  const RigidBody<double> body(ordinary());
  const State<double> begin = this->spinning(ordinary(), {0.45549, 0.82623, 0.03476});
  const State<double> end = this->run(ordinary(), {0.45549, 0.82623, 0.03476}, {0.1, 0.3, 0.05});
  const double E_0 = body.energy(body_momentum(begin)), E = body.energy(body_momentum(end));
  EXPECT_LT(E, 0.6 * E_0);
  EXPECT_NEAR(E - E_0, end.work.value, this->kTolerance);
  EXPECT_LT(norm((end.H_I.value() - begin.H_I.value()) - end.impulse_I.value()),
            TypeParam::kClaims.exact_momentum ? 1e-15 : this->kTolerance);
}

TYPED_TEST(Damped, step_has_the_parts_that_the_damping_needs) {
  // Ten times the damping's own time, and hardly a turn.
  const V omega{0, 0, 1e-3};
  State<double> state = this->spinning(sphere(), omega);
  const StepLimits limits{0, 1000, 64};
  const StepReport report = this->advance_to(sphere(), state, {Damping<double>{{20, 20, 20}}}, 0,
                                             1000 * kMillisecond, limits);
  EXPECT_TRUE(report.resolved());
  EXPECT_GE(report.parts, 10);
  const double angle = 1e-3 * (1 - std::exp(-10)) / 10;
  EXPECT_NEAR(2 * state.q_IB.z, angle, 1e-3 * angle);
}

TYPED_TEST(Damped, step_too_stiff_for_its_parts_is_reported_as_that) {
  State<double> state = this->spinning(sphere(), {0, 0, 1e-3});
  const StepReport report = this->advance_to(sphere(), state, {Damping<double>{{2000, 2000, 2000}}},
                                             0, 1000 * kMillisecond);
  EXPECT_TRUE(report.unresolved_damping);
  EXPECT_FALSE(report.unresolved_edges);
  EXPECT_FALSE(report.resolved());
  EXPECT_NEAR(squared_norm(state.q_IB), 1, 0.5) << "a finite attitude";
}

TYPED_TEST(Damped, body_in_skew_axes_moves_as_the_same_body_in_its_own) {
  // The same damping about every axis has no axes.
  const Quat<double> q = normalised(Quat<double>{4, 1, -2, 1});
  const Eigen::Matrix3d skew = test::rotated_inertia({0.9144, 1.098, 1.66}, q);
  const V omega{0.45549, 0.82623, 0.03476}, c{0.2, 0.2, 0.2};
  const State<double> own = this->run(ordinary(), omega, c);
  const State<double> other = this->run(skew, rotate(q, omega), c);
  // Stages in float round what turns within a step of 20 ms.
  const double rounding = 1e-12 + 0.02 * 0.944 * TypeParam::kClaims.stage_epsilon;
  EXPECT_LT(norm(other.H_I.value() - rotate(q, own.H_I.value())), rounding);
}

TYPED_TEST(Damped, nothing_at_all_leaves_the_bits_of_no_torque) {
  const V omega{0.45549, 0.82623, 0.03476};
  const State<double> none = this->run(ordinary(), omega, {});
  State<double> free = this->spinning(ordinary(), omega);
  for (std::int64_t n = 0; n < 200; ++n) {
    this->advance_to(ordinary(), free, {}, n * 20 * kMillisecond, 20 * kMillisecond);
  }
  EXPECT_EQ(std::memcmp(&none, &free, sizeof free), 0);
}

}  // namespace
}  // namespace adstar
