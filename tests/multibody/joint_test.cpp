// What each joint holds and leaves free, and what acts along what it leaves.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "adstar/integrators/dop853.hpp"
#include "tests/multibody/mechanisms.hpp"
#include "tests/support/random_motion.hpp"

namespace adstar {
namespace {

using multibody::Formulation;
using multibody::Joint;
using multibody::JointKind;
using multibody::JointMotion;
using multibody::kGround;
using test::Flight;
using test::Mechanism;
using test::V;

constexpr JointKind kKinds[] = {JointKind::fixed, JointKind::revolute, JointKind::universal,
                                JointKind::spherical, JointKind::prismatic};

/// Two free bodies, one joint askew in both, moving along all that it leaves.
Mechanism<double> pair_on(JointKind kind) {
  test::Generator random(7);
  Mechanism<double> m;
  m.add_body("a", 2, {0.3, 0.4, 0.5});
  m.add_body("b", 1, {0.1, 0.15, 0.2});
  m.bodies[0].q_IB = test::unit_quaternion(random);
  m.bodies[0].omega_B = {0.2, -0.3, 0.1};
  m.bodies[0].v_I = {0.1, 0.2, 0.3};
  auto& joint = m.add_joint("j", kind, 0, 1, {0.4, 0.1, -0.2}, {-0.3, 0.2, 0.1},
                            {{0.4, -0.3, 0.2}, {0.7, 0.5, -0.6}});
  joint.a.q_BF = test::unit_quaternion(random);
  joint.b.q_BF = test::unit_quaternion(random);
  m.place();
  return m;
}

TEST(EachJoint, is_placed_at_its_coordinates_and_rates) {
  for (const JointKind kind : kKinds) {
    Flight<double> flight(pair_on(kind));
    const auto start = flight.rates(0);
    const double q[] = {0.4, -0.3, 0.2}, rate[] = {0.7, 0.5, -0.6};
    for (int k = 0; k < multibody::shape_of(kind).coordinates; ++k) {
      const auto i = static_cast<std::size_t>(k);
      EXPECT_NEAR(flight.coordinate(0, i), q[i], 1e-14) << multibody::kind_name(kind);
      EXPECT_NEAR(start[i], rate[i], 1e-14) << multibody::kind_name(kind);
    }
  }
}

TEST(EachJoint, is_placed_as_well_when_the_base_is_its_body_b) {
  for (const JointKind kind : kKinds) {
    auto m = pair_on(kind);
    std::swap(m.joints[0].body_a, m.joints[0].body_b);
    m.place();
    Flight<double> flight(m);
    const auto start = flight.rates(0);
    const double q[] = {0.4, -0.3, 0.2}, rate[] = {0.7, 0.5, -0.6};
    for (int k = 0; k < multibody::shape_of(kind).coordinates; ++k) {
      const auto i = static_cast<std::size_t>(k);
      EXPECT_NEAR(flight.coordinate(0, i), q[i], 1e-14) << multibody::kind_name(kind);
      EXPECT_NEAR(start[i], rate[i], 1e-14) << multibody::kind_name(kind);
    }
  }
}

TEST(AFrame, about_an_axis_has_its_z_there_and_is_the_same_seen_from_another_body) {
  test::Generator random(9);
  for (int i = 0; i < 50; ++i) {
    const V axis = i < 3 ? V{i == 0 ? 1.0 : 0, i == 1 ? -1.0 : 0, i == 2 ? 1.0 : 0}
                         : test::unit_vector(random);
    const auto frame = multibody::frame_about(V{0.1, 0.2, 0.3}, 7.0 * axis);
    EXPECT_LT(norm(rotate(frame.q_BF, V{0, 0, 1}) - axis), 1e-15);
    const multibody::BodyMotion<double> a{{1, 2, 3}, test::unit_quaternion(random), {}, {}};
    const multibody::BodyMotion<double> b{{3, 1, 2}, test::unit_quaternion(random), {}, {}};
    Joint<double> joint;
    joint.kind = JointKind::fixed;
    joint.a = frame;
    joint.b = multibody::seen_from(b, a, frame);
    JointMotion<double> m;
    multibody::evaluate(joint, a, b, m);
    for (const double gap : m.gap) {
      EXPECT_NEAR(gap, 0, 1e-14);
    }
  }
  EXPECT_THROW(multibody::frame_about(V{}, V{}), std::invalid_argument);
}

TEST(EachJoint, holds_what_it_holds_and_moves_along_the_rest) {
  for (const JointKind kind : kKinds) {
    for (const Formulation formulation : {Formulation::se3, Formulation::direct_product}) {
      Flight<double> flight(pair_on(kind), {formulation, {}});
      const auto before = flight.state.coordinates[0];
      flight.run<Rk4>(100, 10'000'000);
      multibody::observe(flight.assembly, flight.work, flight.state);
      const JointMotion<double>& m = flight.work.joints[0];
      for (int row = 0; row < m.shape.rows(); ++row) {
        EXPECT_NEAR(m.gap[static_cast<std::size_t>(row)], 0, 1e-14);
        EXPECT_NEAR(m.rate[static_cast<std::size_t>(row)], 0, 1e-14);
      }
      for (int k = 0; k < m.shape.coordinates; ++k) {
        const auto i = static_cast<std::size_t>(k);
        EXPECT_GT(std::fabs(flight.coordinate(0, i) - before[i]), 0.01);
      }
      EXPECT_TRUE(flight.worst.resolved());
    }
  }
}

TEST(EachJoint, has_rates_and_a_right_hand_side_that_are_derivatives_of_its_gap) {
  test::Generator random(3);
  for (const JointKind kind : kKinds) {
    Joint<double> joint;
    joint.kind = kind;
    joint.a = {{0.4, 0.1, -0.2}, test::unit_quaternion(random)};
    joint.b = {{-0.3, 0.2, 0.1}, test::unit_quaternion(random)};
    // Two bodies that go their own ways, the joint wide open: the rates are exact all the same.
    const multibody::BodyMotion<double> a{
        {0.1, 0.2, 0.3}, test::unit_quaternion(random), {0.3, -0.2, 0.5}, {0.4, 0.6, -0.3}};
    const multibody::BodyMotion<double> b{
        {0.5, -0.1, 0.2}, test::unit_quaternion(random), {-0.1, 0.7, 0.2}, {-0.5, 0.2, 0.8}};
    const auto after = [](const multibody::BodyMotion<double>& m, double t) {
      auto moved = m;  // no accelerations: straight on, and turning about a fixed axis
      moved.x_I = m.x_I + t * m.v_I;
      moved.q_IB = Rotation<double>(t * m.omega_I).quaternion() * m.q_IB;
      return moved;
    };
    const auto at = [&](double t) {
      JointMotion<double> m;
      multibody::evaluate(joint, after(a, t), after(b, t), m);
      return m;
    };
    const double e = 1e-4;
    const auto now = at(0), next = at(e), last = at(-e);
    for (int row = 0; row < now.shape.rows(); ++row) {
      const auto i = static_cast<std::size_t>(row);
      EXPECT_NEAR((next.gap[i] - last.gap[i]) / (2 * e), now.rate[i], 1e-7);
      EXPECT_NEAR((next.rate[i] - last.rate[i]) / (2 * e), -now.gamma[i], 1e-7);
      multibody::JacobianBlock<double> C_a, C_b;
      multibody::jacobian_block(now, now.s, -1.0, C_a);
      multibody::jacobian_block(now, now.r, 1.0, C_b);
      const auto times = [&](const double* c, const multibody::BodyMotion<double>& m) {
        return c[0] * m.omega_I.x + c[1] * m.omega_I.y + c[2] * m.omega_I.z + c[3] * m.v_I.x +
               c[4] * m.v_I.y + c[5] * m.v_I.z;
      };
      EXPECT_NEAR(times(C_a.row[i], a) + times(C_b.row[i], b), now.rate[i], 1e-14);
    }
  }
}

TEST(EachJoint, counts_angles_on_through_whole_turns) {
  auto m = pair_on(JointKind::revolute);
  m.starts[0].rate[0] = 9;
  m.place();
  Flight<double> flight(m);
  double last = flight.coordinate(0);
  for (int n = 0; n < 500; ++n) {
    flight.run<Rk4>(1, 10'000'000);
    EXPECT_NEAR(flight.coordinate(0) - last, 0.09, 0.06);
    last = flight.coordinate(0);
  }
  EXPECT_GT(last, 6 * std::numbers::pi);
}

// ---- along one coordinate, against closed forms -------------------------------------------------

/// A body on the ground along one coordinate; its inertia there is 0.5.
Mechanism<double> on_ground(JointKind kind, double q, double rate) {
  Mechanism<double> m;
  m.add_body("b", 0.5, {0.4, 0.45, 0.5});
  m.add_joint("j", kind, kGround, 0, {0.3, 0, 0}, {}, {{q, 0, 0}, {rate, 0, 0}});
  m.place();
  return m;
}
constexpr double kInertia = 0.5;

TEST(ASpring, swings_with_its_period) {
  for (const JointKind kind : {JointKind::revolute, JointKind::prismatic}) {
    auto m = on_ground(kind, 0.7, 0);
    m.joints[0].laws[0].stiffness = 3;
    m.joints[0].laws[0].rest = 0.2;
    Flight<double> flight(m);
    for (int n = 1; n <= 500; ++n) {
      flight.run<Dop853>(1, 20'000'000);
      EXPECT_NEAR(flight.coordinate(0), 0.2 + 0.5 * std::cos(std::sqrt(3 / kInertia) * 0.02 * n),
                  1e-12);
    }
  }
}

TEST(ADamper, slows_a_coordinate_exponentially) {
  for (const JointKind kind : {JointKind::revolute, JointKind::prismatic}) {
    auto m = on_ground(kind, 0, 1.5);
    m.joints[0].laws[0].damping = 0.4;
    Flight<double> flight(m);
    flight.run<Dop853>(100, 20'000'000);
    EXPECT_NEAR(flight.rates(0)[0], 1.5 * std::exp(-0.4 / kInertia * 2), 1e-12);
    const double heat = flight.energy() - 0.5 * kInertia * 1.5 * 1.5;
    EXPECT_NEAR(flight.state.work.value, heat, 1e-12);
  }
}

TEST(AMotor, does_its_torque_times_the_angle_of_work) {
  for (const JointKind kind : {JointKind::revolute, JointKind::prismatic}) {
    Flight<double> flight(on_ground(kind, 0, 0));
    const std::array<double, 3> motor{0.3, 0, 0};
    flight.run<Rk4>(100, 20'000'000, &motor);
    EXPECT_NEAR(flight.coordinate(0), 0.5 * 0.3 / kInertia * 4, 1e-13);
    EXPECT_NEAR(flight.state.work.value, 0.3 * flight.coordinate(0), 1e-13);
    EXPECT_NEAR(flight.energy(), flight.state.work.value, 1e-13);
  }
}

TEST(AStop, turns_a_coordinate_back_with_its_energy_less_what_it_dissipates) {
  for (const JointKind kind : {JointKind::revolute, JointKind::prismatic}) {
    for (const double dissipation : {0.0, 0.4}) {
      auto m = on_ground(kind, 0, 1);
      auto& law = m.joints[0].laws[0];
      law.stops = true;
      law.lower = -0.5;
      law.upper = 0.5;
      law.stop_stiffness = 5000;
      law.stop_dissipation = dissipation;
      Flight<double> flight(m);
      double highest = 0, lowest = 0;
      for (int n = 0; n < 2000; ++n) {
        flight.run<Rk4>(1, 1'000'000);
        highest = std::max(highest, flight.coordinate(0));
        lowest = std::min(lowest, flight.coordinate(0));
      }
      // Depth of an elastic impact: v √(J/k).
      EXPECT_LT(highest, 0.5 + 1.02 * std::sqrt(kInertia / 5000));
      EXPECT_GT(highest, 0.5 + 0.7 * std::sqrt(kInertia / 5000));
      EXPECT_LT(lowest, -0.4);
      EXPECT_TRUE(flight.worst.resolved());
      // A step over the limit is of the order of a kink.
      EXPECT_NEAR(flight.energy() - 0.25, flight.state.work.value, 3e-4);
      if (dissipation == 0) {
        EXPECT_NEAR(flight.energy(), 0.25, 2e-4);
      } else {
        EXPECT_LT(flight.energy(), 0.18);
      }
    }
  }
}

TEST(ASphericalSpring, conserves_energy_at_the_order) {
  const auto error = [](std::int64_t h_ns) {
    auto m = pair_on(JointKind::spherical);
    for (std::size_t k = 0; k < 3; ++k) {
      m.joints[0].laws[k].stiffness = 1.0 + 0.5 * static_cast<double>(k);
    }
    Flight<double> flight(m);
    const double before = flight.energy();
    flight.run<Rk4>(2'000'000'000 / h_ns, h_ns);
    return std::fabs(flight.energy() - before);
  };
  EXPECT_GT(error(20'000'000) / error(10'000'000), 10);
  EXPECT_LT(error(10'000'000), 1e-7);
}

TEST(AUniversalJoint, with_motors_balances_work_and_energy) {
  const auto imbalance = [](std::int64_t h_ns) {
    Flight<double> flight(pair_on(JointKind::universal));
    const double before = flight.energy();
    const std::array<double, 3> motors{0.02, -0.03, 0};
    flight.run<Rk4>(2'000'000'000 / h_ns, h_ns, &motors);
    return std::fabs(flight.energy() - before - flight.state.work.value);
  };
  EXPECT_GT(imbalance(20'000'000) / imbalance(10'000'000), 10);
  EXPECT_LT(imbalance(10'000'000), 1e-7);
}

TEST(JointLoads, of_a_hanging_body_are_its_weight_and_of_a_spinning_one_the_centripetal_force) {
  Mechanism<double> m;
  m.add_body("b", 2, {0.1, 0.2, 0.2});
  m.add_joint("j", JointKind::fixed, kGround, 0, {}, {-0.5, 0, 0});
  m.place();
  Flight<double> hanging(m, {Formulation::se3, {0, 0, -9.81}});
  multibody::observe(hanging.assembly, hanging.work, hanging.state);
  const auto& load = hanging.work.loads[0];
  EXPECT_LT(norm(load.force - V{0, 0, 2 * 9.81}), 1e-13);
  // About the joint: weight 0.5 m ahead along x turns about +y, so the ground holds about -y.
  EXPECT_LT(norm(load.couple - V{0, -0.5 * 2 * 9.81, 0}), 1e-13);

  m.joints[0].kind = JointKind::revolute;
  m.starts[0].rate[0] = 3;
  m.place();
  Flight<double> spinning(m);
  multibody::observe(spinning.assembly, spinning.work, spinning.state);
  EXPECT_LT(norm(spinning.work.loads[0].force - V{-2 * 9 * 0.5, 0, 0}), 1e-13);
}

TEST(AJoint, given_the_other_way_round_moves_the_same) {
  for (const JointKind kind : {JointKind::revolute, JointKind::spherical, JointKind::fixed}) {
    auto m = test::four_bodies(kind);
    Flight<double> forward(m);
    auto& joint = m.joints[1];
    std::swap(joint.body_a, joint.body_b);
    std::swap(joint.a, joint.b);
    Flight<double> backward(m);
    forward.run<Dop853>(300, 5'000'000);
    backward.run<Dop853>(300, 5'000'000);
    EXPECT_LT(test::distance(forward.state, backward.state), 1e-12);
  }
}

}  // namespace
}  // namespace adstar
