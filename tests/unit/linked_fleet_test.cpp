// A vehicle of linked bodies in a fleet: what is seen of it, its motors at the gate, its state saved and set back.

#include <cmath>

#include <gtest/gtest.h>

#include "service/runtime/fleet_snapshot.hpp"
#include "service/runtime/linked_stepper.hpp"
#include "tests/support/gate_harness.hpp"

namespace adstar::runtime {
namespace {

using test::GateHarness;
using test::kMs;

constexpr const char* kScene = R"(
[simulation]
step = "10ms"
[[spacecraft]]
name = "sat1"
mass_kg = 100
inertia_body_kg_m2 = [9, 11, 16]
angular_velocity_body_rad_s = [0.1, -0.05, 0.2]
[[spacecraft.body]]
name = "panel"
mass_kg = 5
inertia_body_kg_m2 = [0.5, 0.2, 0.6]
[[spacecraft.body]]
name = "boom"
mass_kg = 2
inertia_body_kg_m2 = [0.3, 0.3, 0.01]
[[spacecraft.joint]]
name = "hinge"
kind = "revolute"
from = "hub"
to = "panel"
point_from_body_m = [0, 0.5, 0]
point_to_body_m = [0, -1, 0]
axis_body = [1, 0, 0]
coordinate = 0.4
stiffness = 3.0
damping = 0.1
max_motor_torque = 0.5
commanded = true
[[spacecraft.joint]]
name = "ball"
kind = "spherical"
from = "hub"
to = "boom"
point_from_body_m = [0, 0, -0.6]
point_to_body_m = [0, 0, 0.8]
rate = [0.1, 0.0, 0.3]
)";

std::vector<scene::Spacecraft> craft(const std::string& more = "") {
  return scene::parse(kScene + more, "scene.toml").spacecraft;
}

CommandRecord push(std::uint64_t sequence, double torque, std::int64_t start_ns,
                   std::int64_t end_ns) {
  CommandRecord record;
  record.commander = test::kAlice;
  record.sequence = sequence;
  record.start_ns = start_ns;
  record.end_ns = end_ns;
  record.value = {torque, 0, 0};
  return record;
}

TEST(LinkedFleet, keeps_the_momentum_of_the_whole_while_springs_swing_and_dampers_brake) {
  Fleet fleet(craft(), "coadjoint_rk4", StepLimits{});
  const Vehicle& vehicle = fleet.vehicles()[0];
  const Vec3<double> H_0 = vehicle.state.H_I.value();
  const double E_0 = energy_of(vehicle);
  for (std::int64_t n = 0; n < 2000; ++n) {
    ASSERT_EQ(fleet.step(n * 10 * kMs, 10 * kMs), 0U) << n;
  }
  EXPECT_LT(norm(vehicle.state.H_I.value() - H_0), 1e-14 * norm(H_0));
  EXPECT_LT(momentum_residual_relative(vehicle), 1e-14);
  const TelemetryRecord told = sample(vehicle);
  EXPECT_LT(told.work_j, -1e-3) << "the damper took energy";
  EXPECT_LT(std::fabs(told.energy_residual_j), 1e-7 * E_0);
  EXPECT_GT(std::fabs(vehicle.linked->state.coordinates[0][0] - 0.4), 0.05) << "it swings";
}

TEST(LinkedFleet, a_command_on_a_motor_turns_the_joint_and_is_clamped_to_it) {
  GateHarness gate(craft());
  gate.receive(push(1, 7, kStartAtNextBeat, 3'000 * kMs));
  const auto verdict = gate.beat();
  ASSERT_EQ(verdict.size(), 1U);
  EXPECT_EQ(verdict[0].verdict, Verdict::clamped);
  EXPECT_EQ(verdict[0].value[0], 0.5);
  Fleet still(craft(), "coadjoint_rk4", StepLimits{});
  for (std::int64_t n = 0; n < 50; ++n) {
    still.step(n * 10 * kMs, 10 * kMs);
  }
  gate.run_until(500 * kMs);
  const auto angle = [](const Fleet& f) { return f.vehicles()[0].linked->state.coordinates[0][0]; };
  EXPECT_GT(angle(gate.fleet()), angle(still) + 0.01);
  // An internal torque: the momentum of the whole does not hear of it.
  EXPECT_LT(
      norm(gate.fleet().vehicles()[0].state.H_I.value() - still.vehicles()[0].state.H_I.value()),
      1e-14);
}

TEST(LinkedFleet, a_torque_on_a_body_gives_the_whole_its_impulse) {
  Fleet fleet(craft("[[spacecraft.torque]]\nmodel = \"constant\"\nframe = \"inertial\"\n"
                    "torque_n_m = [0.01, 0.02, -0.03]\nbody = \"boom\"\n"),
              "coadjoint_rk4", StepLimits{});
  const Vehicle& vehicle = fleet.vehicles()[0];
  const Vec3<double> H_0 = vehicle.state.H_I.value();
  for (std::int64_t n = 0; n < 100; ++n) {
    fleet.step(n * 10 * kMs, 10 * kMs);
  }
  const Vec3<double> gained = vehicle.state.H_I.value() - H_0;
  EXPECT_LT(norm(gained - Vec3<double>{0.01, 0.02, -0.03}), 1e-14);
  EXPECT_LT(momentum_residual_relative(vehicle), 1e-14);
}

TEST(LinkedFleet, goes_on_from_a_saved_state_with_the_same_bits) {
  GateHarness gate(craft());
  gate.receive(push(1, 0.3, 15 * kMs, 18 * kMs));
  gate.run_until(200 * kMs);
  Fleet other(craft(), "coadjoint_rk4", StepLimits{});
  const FleetState saved = state_of(gate.fleet());
  ASSERT_TRUE(restore(other, saved));
  for (std::int64_t n = 20; n < 60; ++n) {
    gate.beat();
    other.step(n * 10 * kMs, 10 * kMs);
  }
  EXPECT_EQ(state_of(gate.fleet()).memory, state_of(other).memory);
  EXPECT_EQ(gate.fleet().vehicles()[0].state, other.vehicles()[0].state);
}

TEST(LinkedFleet, a_reset_brings_the_start_back) {
  Fleet fleet(craft(), "coadjoint_rk4", StepLimits{});
  fleet.keep_start();
  const FleetState start = state_of(fleet);
  for (std::int64_t n = 0; n < 30; ++n) {
    fleet.step(n * 10 * kMs, 10 * kMs);
  }
  ASSERT_TRUE(fleet.reset());
  EXPECT_EQ(state_of(fleet).memory, start.memory);
  EXPECT_EQ(fleet.vehicles()[0].linked->state.work.value, 0);
}

TEST(LinkedFleet, another_state_or_body_is_refused) {
  Fleet fleet(craft(), "coadjoint_rk4", StepLimits{});
  EXPECT_FALSE(fleet.set_motion(0, {}, {0, 0, 1}));
  EXPECT_FALSE(fleet.can_have_body(0, fleet.vehicles()[0].body));
}

/// The load of a joint at rest under a torque on the panel alone: the hinge passes on what the hub needs to turn with it.
TEST(LinkedFleet, a_joint_tells_what_it_carries) {
  std::string text = kScene;
  text.replace(text.find("kind = \"revolute\""), 17, "kind = \"fixed\"   ");
  for (const char* const key :
       {"axis_body = [1, 0, 0]\n", "coordinate = 0.4\n", "stiffness = 3.0\n", "damping = 0.1\n",
        "max_motor_torque = 0.5\n", "commanded = true\n", "rate = [0.1, 0.0, 0.3]\n",
        "angular_velocity_body_rad_s = [0.1, -0.05, 0.2]\n"}) {
    text.erase(text.find(key), std::string(key).size());
  }
  text +=
      "[[spacecraft.torque]]\nmodel = \"constant\"\nframe = \"body\"\ntorque_n_m = [1, 0, 0]\n"
      "body = \"panel\"\n";
  Fleet fleet(scene::parse(text, "scene.toml").spacecraft, "coadjoint_rk4", StepLimits{});
  Vehicle& vehicle = fleet.vehicles()[0];
  observe(vehicle, 0);
  const JointRecord fixed = sample_joint(vehicle, 0);
  EXPECT_EQ(fixed.coordinates, 0U);
  // The panel's own equation: torque + couple + lever × force = J omega'; its centre accelerates by the force.
  const auto& acceleration = vehicle.linked->work.accelerations[1];
  const Vec3<double> force{fixed.force_I_n[0], fixed.force_I_n[1], fixed.force_I_n[2]};
  const Vec3<double> couple{fixed.couple_I_n_m[0], fixed.couple_I_n_m[1], fixed.couple_I_n_m[2]};
  const Vec3<double> lever{0, -1, 0};
  const Vec3<double> moment = Vec3<double>{1, 0, 0} + couple + cross(lever, force);
  EXPECT_NEAR(moment.x, 0.5 * acceleration[0], 1e-14);
  EXPECT_NEAR(force.z, 5 * acceleration[5], 1e-14);
  EXPECT_GT(acceleration[0], 0.01);
}

}  // namespace
}  // namespace adstar::runtime
