// Wheels in a fleet, under the command gate and under run control.
#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "service/runtime/fleet_snapshot.hpp"
#include "service/runtime/run_control.hpp"
#include "tests/support/gate_harness.hpp"

namespace adstar::runtime {
namespace {

using test::GateHarness;
using test::kAlice;
using test::kBob;
using test::kMs;
using test::make_craft;
using test::with_wheels;

void fly(Fleet& fleet, std::int64_t steps) {
  for (std::int64_t n = 0; n < steps; ++n) {
    EXPECT_EQ(fleet.step(n * 10 * kMs, 10 * kMs), 0U);
  }
}

TEST(FleetSnapshot, is_of_one_step_in_however_many_parts_it_is_handed_over) {
  std::vector<scene::Spacecraft> crafts(7, with_wheels(make_craft(0)));
  for (const std::size_t parts : {1U, 2U, 5U, 100U}) {
    Fleet fleet(crafts, "coadjoint_rk4", StepLimits{});
    FleetSnapshot snapshot(fleet);
    fly(fleet, 3);
    const FleetState then = state_of(fleet);
    snapshot.prepare(0, parts);
    ASSERT_TRUE(snapshot.take(fleet.vehicles(), {0, 3}, parts));
    for (std::size_t part = 0; part < parts; ++part) {
      EXPECT_FALSE(snapshot.ready());
      fly(fleet, 1);
      snapshot.hand_over(1);
    }
    ASSERT_TRUE(snapshot.ready());
    EXPECT_EQ(snapshot.at(), (Instant{0, 3}));
    EXPECT_EQ(std::memcmp(snapshot.state().vehicles.data(), then.vehicles.data(),
                          then.vehicles.size() * sizeof(VehicleState)),
              0);
    ASSERT_EQ(snapshot.state().wheel_momenta.size(), then.wheel_momenta.size());
    for (std::size_t i = 0; i < then.wheel_momenta.size(); ++i) {
      EXPECT_EQ(snapshot.state().wheel_momenta[i].value, then.wheel_momenta[i].value);
    }
    EXPECT_EQ(snapshot.state().memory, then.memory);
    EXPECT_FALSE(snapshot.take(fleet.vehicles(), {0, 4}, parts)) << "it is still being read";
    snapshot.done();
    EXPECT_TRUE(snapshot.take(fleet.vehicles(), {0, 4}, parts));
  }
}

TEST(WheelFleet, steps_each_vehicle_as_if_it_were_alone) {
  std::vector<scene::Spacecraft> crafts;
  for (int i = 0; i < 70; ++i) {
    crafts.push_back(i % 7 == 3 || i > 60 ? with_wheels(make_craft(0)) : make_craft(0));
  }
  Fleet together(crafts, "coadjoint_rk4", StepLimits{}, Lanewise::automatic, 2);
  fly(together, 100);
  for (const std::size_t i : {0U, 3U, 4U, 66U, 69U}) {
    Fleet alone({crafts[i]}, "coadjoint_rk4", StepLimits{});
    fly(alone, 100);
    EXPECT_EQ(alone.vehicles()[0].state, together.vehicles()[i].state) << i;
    ASSERT_EQ(alone.vehicles()[0].wheels == nullptr, together.vehicles()[i].wheels == nullptr);
    if (alone.vehicles()[0].wheels != nullptr) {
      EXPECT_EQ(alone.vehicles()[0].wheels->spinning[1].h,
                together.vehicles()[i].wheels->spinning[1].h);
    }
  }
}

TEST(WheelFleet, keeps_the_total_momentum_while_its_wheels_spin_up) {
  Fleet fleet({with_wheels(make_craft(0))}, "coadjoint_rk4", StepLimits{});
  const Vehicle& vehicle = fleet.vehicles()[0];
  const VecSum<double> H = vehicle.state.H_I;
  const double before = vehicle.wheels->spinning[1].h.value;
  fly(fleet, 1000);
  EXPECT_EQ(vehicle.state.H_I, H);
  EXPECT_GT(std::fabs(vehicle.wheels->spinning[1].h.value - before), 0.01);
  EXPECT_NEAR(sample(vehicle).energy_residual_j, 0, 1e-8);
  EXPECT_EQ(momentum_residual_relative(vehicle), 0);
}

TEST(WheelFleet, refuses_a_scheme_that_carries_none) {
  EXPECT_THROW(Fleet({with_wheels(make_craft(0))}, "splitting_strang", StepLimits{}),
               std::invalid_argument);
}

TEST(WheelFleet, comes_back_from_its_saved_state_with_the_same_bits) {
  const std::vector<scene::Spacecraft> crafts{make_craft(0), with_wheels(make_craft(0))};
  Fleet first(crafts, "coadjoint_rk4", StepLimits{}), second(crafts, "coadjoint_rk4", StepLimits{});
  fly(first, 50);
  ASSERT_TRUE(restore(second, state_of(first)));
  fly(first, 50);
  fly(second, 50);
  EXPECT_EQ(first.vehicles()[1].state, second.vehicles()[1].state);
  EXPECT_EQ(first.vehicles()[1].wheels->spinning[0].h, second.vehicles()[1].wheels->spinning[0].h);
  Fleet other({make_craft(0), make_craft(0)}, "coadjoint_rk4", StepLimits{});
  EXPECT_FALSE(restore(other, state_of(first))) << "it has no wheels";
}

TEST(WheelFleet, reset_brings_wheels_and_orders_back) {
  Fleet fleet({with_wheels(make_craft(0))}, "coadjoint_rk4", StepLimits{});
  fleet.keep_start();
  SpinningWheel<double>& wheel = fleet.vehicles()[0].wheels->spinning[0];
  const Sum<double> h = wheel.h;
  wheel.motor.window[0] = {0, kNever, {false, 0.2}};
  wheel.motor.intervals = 1;
  fly(fleet, 50);
  ASSERT_NE(wheel.h, h);
  ASSERT_TRUE(fleet.reset());
  EXPECT_EQ(wheel.h, h);
  EXPECT_EQ(wheel.motor.intervals, 0U);
}

ControlRecord control(ControlAction action) {
  ControlRecord record;
  record.action = action;
  record.attitude = {1, 0, 0, 0};
  record.omega_B_rad_s = {0.1, -0.2, 0.3};
  record.inertia_body_kg_m2 = {1.5, 2.0, 1.25, 0.1, -0.05, 0.2};
  return record;
}

TEST(WheelControl, a_state_that_is_set_leaves_the_wheels_their_speeds) {
  Fleet fleet({with_wheels(make_craft(0))}, "coadjoint_rk4", StepLimits{});
  fly(fleet, 50);
  const Vehicle& vehicle = fleet.vehicles()[0];
  const auto speed = [&] {
    return vehicle.wheels->spinning[0].speed(angular_velocity_of(vehicle));
  };
  const double before = speed();
  ASSERT_EQ(apply_control(control(ControlAction::set_state), fleet).refusal, ControlRefusal::none);
  EXPECT_NEAR(speed(), before, 1e-11);
  EXPECT_LT(norm(angular_velocity_of(vehicle) - Vec3<double>{0.1, -0.2, 0.3}), 1e-14);
}

TEST(WheelControl, an_inertia_that_is_set_leaves_every_momentum_alone) {
  Fleet fleet({with_wheels(make_craft(0))}, "coadjoint_rk4", StepLimits{});
  fly(fleet, 50);
  const Vehicle& vehicle = fleet.vehicles()[0];
  const VecSum<double> H = vehicle.state.H_I;
  const Sum<double> h = vehicle.wheels->spinning[0].h;
  const Vec3<double> omega_B = angular_velocity_of(vehicle);
  ASSERT_EQ(apply_control(control(ControlAction::set_inertia), fleet).refusal,
            ControlRefusal::none);
  EXPECT_EQ(vehicle.state.H_I, H);
  EXPECT_EQ(vehicle.wheels->spinning[0].h, h);
  EXPECT_NE(angular_velocity_of(vehicle), omega_B);
  EXPECT_EQ(sample(vehicle).energy_residual_j, 0);
}

TEST(WheelControl, an_inertia_smaller_than_the_wheels_is_refused) {
  Fleet fleet({with_wheels(make_craft(0))}, "coadjoint_rk4", StepLimits{});
  ControlRecord light = control(ControlAction::set_inertia);
  light.inertia_body_kg_m2 = {0.02, 0.03, 0.03, 0, 0, 0};  // wheel w1: 0.02 about x
  const Sym3<double> before = fleet.vehicles()[0].body.inertia();
  EXPECT_EQ(apply_control(light, fleet).refusal, ControlRefusal::bad_inertia);
  EXPECT_EQ(fleet.vehicles()[0].body.inertia(), before);
}

// ---- the gate ----

CommandRecord of_wheel(std::uint64_t sequence, double value, bool of_speed) {
  CommandRecord record;
  record.commander = kAlice;
  record.sequence = sequence;
  record.actuator = 1;
  record.quantity = of_speed ? Quantity::wheel_speed : Quantity::torque;
  record.duration_ns = 100 * kMs;
  record.value = {value, 0, 0};
  return record;
}

class WheelGate : public testing::Test {
 protected:
  VerdictRecord answer(const CommandRecord& command) {
    auto verdicts = gate.ask(command);
    if (verdicts.empty()) {
      verdicts = gate.beat();
    }
    return verdicts.size() == 1 ? verdicts.front() : VerdictRecord{};
  }
  const Motor<double>& motor() { return gate.fleet().vehicles()[0].wheels->spinning[0].motor; }

  GateHarness gate{{with_wheels(make_craft(1))}};
};

TEST_F(WheelGate, hands_a_torque_to_the_motor) {
  const VerdictRecord v = answer(of_wheel(1, 0.3, false));
  EXPECT_EQ(v.verdict, Verdict::applied);
  ASSERT_EQ(motor().intervals, 1U);
  EXPECT_FALSE(motor().window[0].order.of_speed);
  EXPECT_EQ(motor().window[0].order.value, 0.3);
}

TEST_F(WheelGate, clamps_a_torque_and_a_speed_each_to_its_own_limit) {
  const VerdictRecord torque = answer(of_wheel(1, -3, false));
  EXPECT_EQ(torque.verdict, Verdict::clamped);
  EXPECT_EQ(torque.value[0], -0.5);
  const VerdictRecord speed = answer(of_wheel(2, 900, true));
  EXPECT_EQ(speed.verdict, Verdict::clamped);
  EXPECT_EQ(speed.quantity, Quantity::wheel_speed);
  EXPECT_EQ(speed.value[0], 600);
  ASSERT_EQ(motor().intervals, 1U) << "the newer one took its place";
  EXPECT_TRUE(motor().window[0].order.of_speed);
  EXPECT_EQ(motor().window[0].order.value, 600);
}

TEST_F(WheelGate, refuses_a_speed_of_what_is_no_wheel) {
  CommandRecord command = of_wheel(1, 10, true);
  command.actuator = 0;
  const VerdictRecord v = answer(command);
  EXPECT_EQ(v.verdict, Verdict::refused);
  EXPECT_EQ(v.reason, Reason::no_authority);
}

TEST_F(WheelGate, repeats_its_answer_word_for_word) {
  const VerdictRecord first = answer(of_wheel(1, 250, true));
  const VerdictRecord again = answer(of_wheel(1, 250, true));
  EXPECT_EQ(first, again);
}

}  // namespace
}  // namespace adstar::runtime
