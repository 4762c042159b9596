// Joints that close loops: which of their rows are redundant, and the motion of a four-bar.
#include <cmath>
#include <numbers>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <gtest/gtest.h>

#include "adstar/integrators/dop853.hpp"
#include "tests/multibody/mechanisms.hpp"

namespace adstar {
namespace {

using multibody::Formulation;
using multibody::JointKind;
using multibody::kGround;
using test::Flight;
using test::Mechanism;
using test::V;

/// Crank, coupler and rocker of a crank-rocker, lengths, with the ground's last.
constexpr double kCrank = 1, kCoupler = 3, kRocker = 2.5, kBase = 3;
constexpr double kMass[] = {1, 2, 1.5}, kInertia[] = {0.1, 1.6, 0.8};

struct Closure {
  double coupler, rocker;            ///< angles [rad]
  double coupler_rate, rocker_rate;  ///< by the crank's angle
};

Closure closure(double crank) {
  const double bx = kCrank * std::cos(crank), by = kCrank * std::sin(crank);
  const double dx = kBase - bx, dy = -by, d = std::hypot(dx, dy);
  // Triangle of coupler, rocker and the diagonal d.
  const double corner =
      std::acos((kCoupler * kCoupler + d * d - kRocker * kRocker) / (2 * kCoupler * d));
  const double coupler = std::atan2(dy, dx) + corner;
  const double cx = bx + kCoupler * std::cos(coupler), cy = by + kCoupler * std::sin(coupler);
  const double rocker = std::atan2(cy, cx - kBase);
  // L1 u'(θ) + L2 u'(φ2) φ2' = L3 u'(φ3) φ3'
  const double s = std::sin(coupler - rocker);
  return {coupler, rocker, kCrank * std::sin(rocker - crank) / (kCoupler * s),
          kCrank * std::sin(coupler - crank) / (kRocker * s)};
}

/// Reduced inertia about the crank's pivot: E = ½ A(θ) θ'².
double reduced_inertia(double crank) {
  const Closure c = closure(crank);
  const double vx = -kCrank * std::sin(crank) - kCoupler / 2 * std::sin(c.coupler) * c.coupler_rate;
  const double vy = kCrank * std::cos(crank) + kCoupler / 2 * std::cos(c.coupler) * c.coupler_rate;
  return kInertia[0] + kMass[0] * kCrank * kCrank / 4 + kMass[1] * (vx * vx + vy * vy) +
         kInertia[1] * c.coupler_rate * c.coupler_rate +
         (kInertia[2] + kMass[2] * kRocker * kRocker / 4) * c.rocker_rate * c.rocker_rate;
}

Mechanism<double> four_bar(double crank, double rate) {
  const Closure c = closure(crank);
  Mechanism<double> m;
  const char* const names[] = {"crank", "coupler", "rocker"};
  const double lengths[] = {kCrank, kCoupler, kRocker};
  for (int i = 0; i < 3; ++i) {
    m.add_body(names[i], kMass[i], {kInertia[i], kInertia[i], kInertia[i]});
  }
  const auto near_end = [&](int i) { return V{-lengths[i] / 2, 0, 0}; };
  const auto far_end = [&](int i) { return V{lengths[i] / 2, 0, 0}; };
  m.add_joint("A", JointKind::revolute, kGround, 0, {}, near_end(0), {{crank, 0, 0}, {rate, 0, 0}});
  m.add_joint("B", JointKind::revolute, 0, 1, far_end(0), near_end(1),
              {{c.coupler - crank, 0, 0}, {(c.coupler_rate - 1) * rate, 0, 0}});
  m.add_joint("D", JointKind::revolute, kGround, 2, {kBase, 0, 0}, near_end(2),
              {{c.rocker, 0, 0}, {c.rocker_rate * rate, 0, 0}});
  m.add_joint("C", JointKind::revolute, 1, 2, far_end(1), far_end(2));
  m.place();
  return m;
}

TEST(FourBar, has_three_redundant_rows_and_says_which) {
  const Flight<double> flight(four_bar(0.5, 1));
  ASSERT_EQ(flight.assembly.loops().size(), 1U);
  const auto& loop = flight.assembly.loops()[0];
  EXPECT_EQ(loop.name, "C");
  EXPECT_EQ(loop.held, (std::vector<int>{0, 1}));
  EXPECT_EQ(loop.redundant, (std::vector<int>{2, 3, 4}));
  EXPECT_EQ(loop.describe(JointKind::revolute),
            "joint 'C' closes a loop; the other joints already hold its translation along z, "
            "rotation about x, rotation about y");
}

TEST(FourBar, takes_the_time_from_angle_to_angle_that_its_reduced_inertia_says) {
  const double theta_0 = 0.5, rate = 2;
  const double E = 0.5 * reduced_inertia(theta_0) * rate * rate;
  for (const Formulation formulation : {Formulation::se3, Formulation::direct_product}) {
    Flight<double> flight(four_bar(theta_0, rate), {formulation, {}});
    EXPECT_NEAR(flight.energy(), E, 1e-13);
    flight.run<Dop853>(1000, 5'000'000);
    EXPECT_TRUE(flight.worst.resolved());
    EXPECT_LT(flight.worst.gap, 1e-12);
    const double theta = flight.coordinate(0);
    EXPECT_GT(theta, theta_0 + 2 * std::numbers::pi);  // went round
    const double t = boost::math::quadrature::gauss_kronrod<double, 61>::integrate(
        [&](double at) { return std::sqrt(reduced_inertia(at) / (2 * E)); }, theta_0, theta, 12,
        1e-13);
    EXPECT_NEAR(t, 5, 1e-9);
    EXPECT_NEAR(flight.energy(), E, 1e-9);
    // The joint that closes the loop is closed in the rows that were left out too.
    const V d = flight.work.joints[3].d;
    EXPECT_LT(norm(d), 1e-13);
  }
}

TEST(FourBar, on_rk4_converges_at_its_order) {
  const auto end = [](std::int64_t h_ns) {
    Flight<double> flight(four_bar(0.5, 2));
    flight.run<Rk4>(2'000'000'000 / h_ns, h_ns);
    return flight.coordinate(0);
  };
  const double exact = end(1'000'000);
  EXPECT_GT(std::fabs(end(20'000'000) - exact) / std::fabs(end(10'000'000) - exact), 11);
}

/// Four bodies in a ring on spherical joints, free: nothing is redundant.
TEST(ARingOnSphericalJoints, holds_all_its_rows_and_keeps_both_totals) {
  Mechanism<double> m;
  for (int i = 0; i < 4; ++i) {
    m.add_body(test::numbered("b", i), 1 + i, {0.1, 0.12, 0.15});
    const double turn = i * std::numbers::pi / 4;
    auto& body = m.bodies.back();
    body.q_IB = {std::cos(turn), 0, 0, std::sin(turn)};
    body.x_I = rotate(body.q_IB, V{0, -0.5, 0});
    body.omega_B = {0, 0, 0.8};
    body.v_I = cross(V{0, 0, 0.8}, body.x_I);
  }
  for (int i = 0; i < 4; ++i) {
    m.add_joint(test::numbered("j", i), JointKind::spherical, i, (i + 1) % 4, {0.5, 0, 0},
                {-0.5, 0, 0});
  }
  multibody::centre(m.bodies);
  Flight<double> flight(m);
  ASSERT_EQ(flight.assembly.loops().size(), 1U);
  EXPECT_TRUE(flight.assembly.loops()[0].redundant.empty());
  const auto push = [](const multibody::LoadStage<double>& stage) {
    multibody::BodyLoad<double> load;
    load.torque_I = stage.body == 1 ? V{0.3, 0.2, 0} : V{};
    return load;
  };
  flight.run<Rk4>(200, 10'000'000, nullptr, push);
  const auto before = multibody::total_momentum(flight.assembly, flight.state);
  flight.run<Rk4>(5000, 10'000'000);
  const auto after = multibody::total_momentum(flight.assembly, flight.state);
  EXPECT_LT(norm(after.H_I.value() - before.H_I.value()), 1e-14 * norm(before.H_I.value()));
  EXPECT_LT(norm(after.p_I.value() - before.p_I.value()), 1e-14);
  EXPECT_LT(flight.worst.gap, 1e-12);
  EXPECT_TRUE(flight.worst.resolved());
}

TEST(TwoWelds, between_the_same_bodies_are_redundant_in_all_rows) {
  Mechanism<double> m;
  m.add_body("a", 1, {1, 1, 1});
  m.add_body("b", 1, {1, 1, 1});
  m.add_joint("first", JointKind::fixed, 0, 1, {0.5, 0, 0}, {-0.5, 0, 0});
  m.add_joint("second", JointKind::fixed, 0, 1, {0.5, 0.1, 0}, {-0.5, 0.1, 0});
  m.bodies[0].omega_B = {0.1, 0.2, 0.3};
  m.place();
  Flight<double> flight(m);
  EXPECT_EQ(flight.assembly.loops()[0].redundant.size(), 6U);
  flight.run<Rk4>(100, 10'000'000);
  EXPECT_TRUE(flight.worst.resolved());
  EXPECT_LT(flight.worst.gap, 1e-14);
}

}  // namespace
}  // namespace adstar
