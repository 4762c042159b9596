// Orders, and what stays: totals of momentum, joints, the bits of a run that was cut in two.
#include <cmath>
#include <tuple>

#include <gtest/gtest.h>

#include "adstar/integrators/dop853.hpp"
#include "tests/multibody/mechanisms.hpp"

namespace adstar {
namespace {

using multibody::AssemblyLimits;
using multibody::Formulation;
using multibody::JointKind;
using test::Flight;
using test::V;

/// Error of each halving of the step, against a run of high order at a fine step.
template <class Tableau>
std::vector<double> errors(Formulation formulation, std::int64_t coarsest_ns, int halvings) {
  const auto mechanism = test::four_bodies();
  Flight<double> truth(mechanism, {formulation, {}});
  truth.run<Dop853>(2000, 1'000'000);
  std::vector<double> all;
  for (int i = 0; i < halvings; ++i) {
    Flight<double> flight(mechanism, {formulation, {}});
    const std::int64_t h_ns = coarsest_ns >> i;
    flight.run<Tableau>(2'000'000'000 / h_ns, h_ns);
    EXPECT_TRUE(flight.worst.resolved());
    all.push_back(test::distance(flight.state, truth.state));
  }
  return all;
}

template <class Tableau>
void expect_order(std::int64_t coarsest_ns) {
  for (const Formulation formulation : {Formulation::se3, Formulation::direct_product}) {
    const auto error = errors<Tableau>(formulation, coarsest_ns, 3);
    for (std::size_t i = 1; i < error.size(); ++i) {
      EXPECT_TRUE(std::log2(error[i - 1] / error[i]) > Tableau::kOrder - 0.4 || error[i] < 2e-13)
          << error[i - 1] << ", then " << error[i];
    }
  }
}

TEST(FourBodiesOnSphericalJoints, converge_at_the_order_of_rk4) { expect_order<Rk4>(16'000'000); }
TEST(FourBodiesOnSphericalJoints, converge_at_the_order_of_the_midpoint_rule) {
  expect_order<Midpoint2>(4'000'000);
}
TEST(FourBodiesOnSphericalJoints, converge_at_the_order_of_dopri5) {
  expect_order<Dopri5>(16'000'000);
}
TEST(FourBodiesOnSphericalJoints, converge_at_the_order_of_verner6) {
  expect_order<Verner6>(31'250'000);
}
TEST(FourBodiesOnSphericalJoints, converge_at_the_order_of_dop853) {
  expect_order<Dop853>(62'500'000);
}
TEST(FourBodiesOnSphericalJoints, converge_at_the_order_of_fehlberg8) {
  expect_order<Fehlberg8>(62'500'000);
}

struct Drift {
  double p, H;
};

template <class T>
Drift drift(const Flight<T>& flight) {
  const auto now = multibody::total_momentum(flight.assembly, flight.state);
  const auto start =
      multibody::total_momentum(flight.assembly, multibody::make_state(flight.assembly));
  double each = 0;
  for (const auto& body : flight.state.bodies) {
    each = std::max(each, norm(body.p_I.value()));
  }
  return {norm(now.p_I.value() - start.p_I.value()) / each,
          norm(now.H_I.value() - start.H_I.value()) / norm(start.H_I.value())};
}

/// Springs, dampers and motors inside: all internal.
test::Mechanism<double> busy_bodies() {
  auto mechanism = test::four_bodies();
  for (auto& joint : mechanism.joints) {
    for (auto& law : joint.laws) {
      law.stiffness = 2;
      law.damping = 0.01;
      law.rest = 0.1;
    }
  }
  return mechanism;
}

TEST(TotalMomentum, on_se3_stays_within_1e_14_over_1e5_steps) {
  Flight<double> flight(busy_bodies());
  const std::array<double, 3> motors[] = {{0.05, 0, -0.02}, {0, 0.03, 0}, {0.01, 0, 0}};
  flight.run<Rk4>(100'000, 10'000'000, motors);
  const Drift d = drift(flight);
  EXPECT_LT(d.p, 1e-14);
  EXPECT_LT(d.H, 1e-14);
  EXPECT_LT(flight.worst.gap, 1e-12);
  EXPECT_TRUE(flight.worst.resolved());
}

TEST(TotalMomentum, on_se3_does_not_wait_for_the_step_to_be_fine_nor_for_the_tableau) {
  const auto expect_exact = [](auto tableau, std::int64_t h_ns) {
    Flight<double> flight(busy_bodies());
    flight.run<decltype(tableau)>(2000, h_ns);
    EXPECT_LT(drift(flight).p, 5e-15);
    EXPECT_LT(drift(flight).H, 5e-15);
  };
  expect_exact(Midpoint2{}, 10'000'000);
  expect_exact(Rk4{}, 50'000'000);
  expect_exact(Dopri5{}, 50'000'000);
  expect_exact(Dop853{}, 100'000'000);
}

TEST(TotalMomentum, on_the_direct_product_is_exact_in_p_and_of_the_order_in_H) {
  const auto at = [](std::int64_t h_ns) {
    Flight<double> flight(busy_bodies(), {Formulation::direct_product, {}});
    flight.run<Rk4>(4'000'000'000 / h_ns, h_ns);
    return drift(flight);
  };
  const Drift coarse = at(20'000'000), fine = at(10'000'000);
  EXPECT_LT(coarse.p, 1e-14);
  EXPECT_GT(coarse.H, 1e-9);
  EXPECT_GT(coarse.H / fine.H, 10);
}

TEST(Energy, balances_the_work_of_motors_and_dampers_at_the_order) {
  for (const Formulation formulation : {Formulation::se3, Formulation::direct_product}) {
    const auto imbalance = [&](std::int64_t h_ns) {
      Flight<double> flight(busy_bodies(), {formulation, {}});
      const double before = flight.energy();
      const std::array<double, 3> motors[] = {{0.05, 0, -0.02}, {0, 0.03, 0}, {0.01, 0, 0}};
      flight.run<Rk4>(2'000'000'000 / h_ns, h_ns, motors);
      EXPECT_GT(std::fabs(flight.state.work.value), 1e-3);
      return std::fabs(flight.energy() - before - flight.state.work.value);
    };
    const double coarse = imbalance(20'000'000), fine = imbalance(10'000'000);
    EXPECT_LT(fine, 3e-6);
    EXPECT_GT(coarse / fine, 9);
  }
}

TEST(Joints, drift_open_without_projection_and_stay_closed_with_it) {
  for (const Formulation formulation : {Formulation::se3, Formulation::direct_product}) {
    Flight<double> left(test::four_bodies(), {formulation, {}}), held = left;
    AssemblyLimits limits;
    limits.project = false;
    left.run<Rk4>(1000, 10'000'000, nullptr, multibody::NoLoad{}, limits);
    held.run<Rk4>(1000, 10'000'000);
    double gap = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      multibody::observe(left.assembly, left.work, left.state);
      gap = std::max(gap, norm(left.work.joints[j].d));
      multibody::observe(held.assembly, held.work, held.state);
      EXPECT_LT(norm(held.work.joints[j].d), 1e-14);
      EXPECT_LT(norm(held.work.joints[j].w), 1e-14);
    }
    EXPECT_GT(gap, 1e-8);
    EXPECT_LT(gap, 1e-3);
    EXPECT_LT(held.worst.gap, 1e-12);
    EXPECT_LT(drift(held).p, 1e-14);
  }
}

TEST(Loads, from_outside_change_the_totals_by_their_impulse) {
  Flight<double> flight(test::four_bodies());
  const auto before = multibody::total_momentum(flight.assembly, flight.state);
  const V torque{0.02, -0.01, 0.03}, force{0.3, 0.1, -0.2};
  flight.run<Rk4>(500, 10'000'000, nullptr, [&](const multibody::LoadStage<double>& stage) {
    multibody::BodyLoad<double> load;
    if (stage.body == 0) {
      load.torque_I = torque;
    } else if (stage.body == 2) {
      load.force_I = force;
    }
    return load;
  });
  const auto after = multibody::total_momentum(flight.assembly, flight.state);
  EXPECT_LT(norm(after.p_I.value() - before.p_I.value() - 5.0 * force), 1e-13);
  const V H = after.H_I.value() - before.H_I.value() - 5.0 * torque;
  EXPECT_GT(norm(H), 1e-3);                    // x×F of the force,
  EXPECT_LT(std::fabs(dot(H, force)), 1e-14);  // and nothing along it
}

TEST(UniformGravity, moves_the_centre_of_mass_and_nothing_else) {
  const V g{0, 0, -9.81};
  Flight<double> falling(test::four_bodies(), {Formulation::se3, g}), floating(test::four_bodies());
  falling.run<Dop853>(200, 5'000'000);
  floating.run<Dop853>(200, 5'000'000);
  for (std::size_t i = 0; i < 4; ++i) {
    const V fall = falling.point(i) - floating.point(i);
    EXPECT_LT(norm(fall - 0.5 * g), 1e-11);
    EXPECT_LT(angle_between(falling.state.bodies[i].q_IB, floating.state.bodies[i].q_IB), 1e-11);
  }
}

TEST(State, copied_in_the_middle_goes_on_to_the_same_bits) {
  Flight<double> whole(busy_bodies());
  whole.run<Rk4>(100, 10'000'000);
  Flight<double> resumed(busy_bodies());
  resumed.state = whole.state;
  whole.run<Rk4>(100, 10'000'000);
  resumed.run<Rk4>(100, 10'000'000);
  EXPECT_EQ(whole.state, resumed.state);
}

TEST(Recentring, puts_the_centre_of_mass_at_the_origin_and_changes_no_motion) {
  const auto push = [](const multibody::LoadStage<double>& stage) {
    multibody::BodyLoad<double> load;
    load.force_I = stage.body == 1 ? V{1, 2, 3} : V{};
    return load;
  };
  Flight<double> moved(test::four_bodies());
  moved.run<Dop853>(100, 10'000'000, nullptr, push);
  Flight<double> recentred = moved;
  const V shift = multibody::recentre(recentred.assembly, recentred.state);
  EXPECT_GT(norm(shift), 0.1);
  EXPECT_LT(norm(multibody::centre_of_mass(recentred.assembly, recentred.state)), 1e-15);
  moved.run<Dop853>(100, 10'000'000);
  recentred.run<Dop853>(100, 10'000'000);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_LT(norm(moved.point(i) - recentred.point(i) - shift), 1e-12);
    EXPECT_LT(angle_between(moved.state.bodies[i].q_IB, recentred.state.bodies[i].q_IB), 1e-12);
  }
}

}  // namespace
}  // namespace adstar
