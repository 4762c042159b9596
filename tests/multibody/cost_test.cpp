// What a step costs, counted and not timed; and that it asks nothing of the heap.
#include <gtest/gtest.h>

#include "adstar/integrators/dop853.hpp"
#include "tests/multibody/counted.hpp"
#include "tests/multibody/mechanisms.hpp"
#include "tests/support/count_allocations.hpp"
#include "tests/support/wide.hpp"

namespace adstar {
namespace {

using multibody::Formulation;
using test::Counted;
using test::Flight;
using test::V;

template <class Tableau>
double operations_a_step(int links, Formulation formulation) {
  Flight<Counted> flight(test::tether<Counted>(links), {formulation, {}});
  multibody::AssemblyLimits limits;
  limits.project = false;  // its rounds vary with round-off
  flight.run<Tableau>(1, 10'000'000, nullptr, multibody::NoLoad{}, limits);
  Counted::operations = 0;
  flight.run<Tableau>(2, 10'000'000, nullptr, multibody::NoLoad{}, limits);
  return static_cast<double>(Counted::operations) / 2;
}

TEST(CostOfAStep, is_linear_in_the_links) {
  for (const Formulation formulation : {Formulation::se3, Formulation::direct_product}) {
    const double at_50 = operations_a_step<Rk4>(50, formulation);
    const double at_100 = operations_a_step<Rk4>(100, formulation);
    const double at_200 = operations_a_step<Rk4>(200, formulation);
    EXPECT_NEAR((at_200 - at_100) / (at_100 - at_50), 2, 0.05);
    EXPECT_LT(at_200 / 200, 20'000);
  }
}

TEST(ATetherOfAHundredLinks, steps_with_its_joints_closed_and_its_momentum_kept) {
  Flight<double> flight(test::tether<double>(100));
  const auto before = multibody::total_momentum(flight.assembly, flight.state);
  flight.run<Rk4>(500, 10'000'000);
  const auto after = multibody::total_momentum(flight.assembly, flight.state);
  EXPECT_TRUE(flight.worst.resolved());
  EXPECT_LT(flight.worst.gap, 1e-12);
  EXPECT_LT(norm(after.H_I.value() - before.H_I.value()), 1e-14 * norm(before.H_I.value()));
}

std::uint64_t allocations_of(Flight<double>& flight) {
  const std::array<double, 3> motors[8] = {{0.01, 0, 0}, {0, 0.01, 0}};
  const std::uint64_t before = test::allocation_count();
  const auto load = [](const multibody::LoadStage<double>& stage) {
    multibody::BodyLoad<double> given;
    given.torque_B = {0, 0, stage.body == 0 ? 0.01 : 0.0};
    return given;
  };
  flight.run<Rk4>(20, 10'000'000, motors, load);
  flight.run<Dop853>(20, 10'000'000, motors, load);
  flight.run<Rk4>(2, 1'000'000'000);  // in parts, with steps taken back
  multibody::observe(flight.assembly, flight.work, flight.state, motors, load);
  return test::allocation_count() - before;
}

TEST(AStepOfAnAssembly, never_touches_the_heap) {
  for (const Formulation formulation : {Formulation::se3, Formulation::direct_product}) {
    Flight<double> chain(test::four_bodies(), {formulation, {0, 0, -9.81}});
    EXPECT_EQ(allocations_of(chain), 0U);
    auto m = test::four_bodies();  // and with a loop: the last joint twice
    m.joints.push_back(m.joints.back());
    m.joints.back().name = "again";
    Flight<double> loop(m, {formulation, {}});
    EXPECT_EQ(loop.assembly.loops().size(), 1U);
    EXPECT_EQ(allocations_of(loop), 0U);
  }
}

TEST(AStepOfAnAssembly, runs_in_113_bits_too) {
  using test::Quad;
  Flight<Quad> exact(test::tether<Quad>(3));
  Flight<double> rounded(test::tether<double>(3));
  exact.run<Rk4>(20, 10'000'000);
  rounded.run<Rk4>(20, 10'000'000);
  EXPECT_LT(static_cast<double>(exact.worst.gap), 1e-32);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT(norm(test::convert<double>(exact.state.bodies[i].x_I.value()) - rounded.point(i)),
              1e-14);
  }
}

}  // namespace
}  // namespace adstar
