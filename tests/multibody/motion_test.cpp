// Linked bodies against motions that were found another way.
#include <cmath>
#include <numbers>

#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <gtest/gtest.h>

#include "adstar/integrators/dop853.hpp"
#include "tests/multibody/planar_arm.hpp"

namespace adstar {
namespace {

using multibody::AssemblyLimits;
using multibody::Formulation;
using multibody::JointKind;
using multibody::kGround;
using test::Flight;
using test::Mechanism;
using test::PlanarArm;

constexpr Formulation kBoth[] = {Formulation::se3, Formulation::direct_product};

TEST(PendulumOnTheGround, swings_as_the_elliptic_functions_say) {
  const double m = 2, l = 0.7, J = 0.3, g = 9.81, theta_0 = 2.9;
  const double omega_0 = std::sqrt(m * g * l / (J + m * l * l)), k = std::sin(theta_0 / 2);
  for (const Formulation formulation : kBoth) {
    const auto error_at = [&](double h, auto tableau) {
      Mechanism<double> pendulum;
      pendulum.add_body("bob", m, {0.2, 0.25, J});
      // Hangs along -y: at angle 0 the body's -x, where the joint is, points up.
      auto& joint = pendulum.add_joint("pivot", JointKind::revolute, kGround, 0, {0.1, 0.2, 0.3},
                                       {-l, 0, 0}, {{theta_0, 0, 0}, {}});
      const double down = -std::numbers::pi / 4;
      joint.a.q_BF = {std::cos(down), 0, 0, std::sin(down)};
      pendulum.place();
      Flight<double> flight(pendulum, {formulation, {0, -g, 0}});
      double worst = 0;
      const auto h_ns = static_cast<std::int64_t>(std::llround(h * 1e9));
      const int steps = static_cast<int>(std::llround(8 / h));
      for (int n = 1; n <= steps; ++n) {
        flight.run<decltype(tableau)>(1, h_ns);
        const double exact = 2 * std::asin(k * boost::math::jacobi_cd(k, omega_0 * (n * h)));
        worst = std::max(worst, std::fabs(flight.coordinate(0) - exact));
      }
      EXPECT_TRUE(flight.worst.resolved());
      EXPECT_LT(flight.worst.gap, 1e-14);
      return worst;
    };
    const double coarse = error_at(0.02, Rk4{}), fine = error_at(0.01, Rk4{});
    // Near the upright what energy the scheme loses counts double: so much more of it in SE(3).
    EXPECT_LT(fine, formulation == Formulation::se3 ? 2e-4 : 1e-6);
    EXPECT_GT(coarse / fine, 11);
    EXPECT_LT(error_at(0.01, Dop853{}), 1e-11);
  }
}

TEST(FiveLinkArm, on_the_ground_moves_as_the_minimal_equations_say) {
  auto links = test::five_links();
  links[0].motor = 4;
  const PlanarArm arm(links, false, 9.81);
  const auto truth = arm.run(2);
  const auto motors = arm.motors();
  for (const Formulation formulation : kBoth) {
    Flight<double> flight(arm.mechanism(), arm.options(formulation));
    flight.run<Dop853>(400, 5'000'000, motors.data());
    EXPECT_LT(arm.error(truth, flight.state), 1e-10);
    EXPECT_LT(flight.worst.gap, 1e-14);
    EXPECT_TRUE(flight.worst.resolved());
  }
}

TEST(FiveLinkArm, on_a_free_base_moves_as_the_minimal_equations_say_at_the_order) {
  const PlanarArm arm(test::five_links(), true, 0);
  const auto truth = arm.run(4);
  const auto motors = arm.motors();
  for (const Formulation formulation : kBoth) {
    const auto error_at = [&](std::int64_t h_ns, auto tableau) {
      Flight<double> flight(arm.mechanism(), arm.options(formulation));
      flight.run<decltype(tableau)>(4'000'000'000 / h_ns, h_ns, motors.data());
      EXPECT_TRUE(flight.worst.resolved());
      const auto total = multibody::total_momentum(flight.assembly, flight.state);
      EXPECT_LT(norm(total.p_I.value()) -
                    norm(multibody::total_momentum(flight.assembly,
                                                   multibody::make_state(flight.assembly))
                             .p_I.value()),
                1e-14);
      return arm.error(truth, flight.state);
    };
    const double coarse = error_at(20'000'000, Rk4{}), fine = error_at(10'000'000, Rk4{});
    EXPECT_GT(coarse / fine, 11);
    EXPECT_LT(fine, 1e-5);
    EXPECT_LT(error_at(10'000'000, Dop853{}), 1e-11);
  }
}

TEST(NeighboursAMillionTimesHeavier, stay_stable_and_accurate) {
  for (const bool heavy_first : {true, false}) {
    auto links = test::five_links();
    for (std::size_t i = 0; i < links.size(); ++i) {
      auto& link = links[i];
      link.motor = link.stiffness = link.damping = 0;
      if ((i % 2 == 0) != heavy_first) {
        link.mass *= 1e-6;
        link.inertia *= 1e-6;
      }
    }
    const PlanarArm arm(links, true, 0);
    const auto truth = arm.run(4);
    for (const Formulation formulation : kBoth) {
      Flight<double> flight(arm.mechanism(), arm.options(formulation));
      const double before = flight.energy();
      flight.run<Dop853>(800, 5'000'000);
      EXPECT_LT(arm.error(truth, flight.state), 1e-8) << heavy_first;
      EXPECT_NEAR(flight.energy() / before, 1, 1e-9);
      EXPECT_LT(flight.worst.gap, 1e-12);
      EXPECT_TRUE(flight.worst.resolved());
    }
  }
}

TEST(TwoFormulations, agree_on_four_tumbling_bodies) {
  for (const JointKind kind : {JointKind::spherical, JointKind::universal, JointKind::revolute,
                               JointKind::prismatic, JointKind::fixed}) {
    const auto run = [&](Formulation formulation) {
      Flight<double> flight(test::four_bodies(kind), {formulation, {}});
      flight.run<Dop853>(1000, 2'000'000);
      EXPECT_TRUE(flight.worst.resolved());
      return flight.state;
    };
    EXPECT_LT(test::distance(run(Formulation::se3), run(Formulation::direct_product)), 1e-11);
  }
}

}  // namespace
}  // namespace adstar
