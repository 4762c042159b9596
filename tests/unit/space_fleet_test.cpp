// A vehicle in the space around: its actuators at the gate, its lagging coils over a reset, its attitude against the orbit.

#include <gtest/gtest.h>

#include "adstar/orbit/orbital_frame.hpp"
#include "service/runtime/fleet_snapshot.hpp"
#include "tests/support/gate_harness.hpp"

namespace adstar::runtime {
namespace {

using test::GateHarness;
using test::kMs;

CommandRecord command(std::uint32_t actuator, Quantity quantity, double x, std::int64_t start_ns,
                      std::int64_t end_ns) {
  CommandRecord record;
  record.commander = test::kAlice;
  static std::uint64_t sequence = 0;
  record.sequence = ++sequence;
  record.actuator = actuator;
  record.quantity = quantity;
  record.start_ns = start_ns;
  record.end_ns = end_ns;
  record.value = {x, 0, 0};
  return record;
}

TEST(SpaceActuators, a_dipole_is_clamped_to_the_coils_and_a_torque_has_no_authority_there) {
  GateHarness gate({test::in_space(test::make_craft(0))});
  gate.receive(command(0, Quantity::dipole, 50, kStartAtNextBeat, 100 * kMs));
  const auto clamped = gate.beat();
  ASSERT_EQ(clamped.size(), 1U);
  EXPECT_EQ(clamped[0].verdict, Verdict::clamped);
  EXPECT_EQ(clamped[0].value[0], 20);
  const auto torque = gate.ask(command(0, Quantity::torque, 1, kStartAtNextBeat, 100 * kMs));
  ASSERT_EQ(torque.size(), 1U);
  EXPECT_EQ(torque[0].reason, Reason::no_authority);
  const auto thrust = gate.ask(command(0, Quantity::thrust, 1, kStartAtNextBeat, 100 * kMs));
  EXPECT_EQ(thrust.at(0).reason, Reason::no_authority);
}

TEST(SpaceActuators, a_thruster_stays_on_for_its_least_time_and_the_verdict_says_so) {
  GateHarness gate({test::in_space(test::make_craft(0))});
  gate.receive(command(1, Quantity::thrust, 1, 2 * kMs, 3 * kMs));
  const auto on = gate.beat();
  ASSERT_EQ(on.size(), 1U);
  EXPECT_EQ(on[0].end_ns, 17 * kMs);
  Vehicle& vehicle = gate.fleet().vehicles()[0];
  const auto& jet = std::get<Thruster<double>>(vehicle.torques[1]);
  EXPECT_TRUE(jet.is_on(16 * kMs));
  EXPECT_FALSE(jet.is_on(17 * kMs));
}

TEST(SpaceActuators,
     a_thruster_that_is_told_to_fire_at_the_end_of_time_or_never_is_answered_as_asked) {
  GateHarness gate({test::in_space(test::make_craft(0))});
  constexpr std::int64_t kEnd = std::numeric_limits<std::int64_t>::max();
  const auto last = gate.ask(command(1, Quantity::thrust, 1, kEnd - 10, kEnd - 5));
  ASSERT_EQ(last.size(), 1U);
  EXPECT_GE(last[0].end_ns, last[0].start_ns);
  const auto never = gate.ask(command(1, Quantity::thrust, 1, 5, 1));
  ASSERT_EQ(never.size(), 1U);
  EXPECT_EQ(never[0].verdict, Verdict::refused);
  EXPECT_EQ(never[0].end_ns, 1);
}

TEST(SpaceVehicle, a_reset_sets_the_coils_lag_back_too) {
  GateHarness gate({test::in_space(test::make_craft(0))});
  Fleet& fleet = gate.fleet();
  fleet.keep_start();
  const FleetState start = state_of(fleet);
  gate.receive(command(0, Quantity::dipole, 5, kStartAtNextBeat, 40 * kMs));
  for (int i = 0; i < 6; ++i) {
    gate.beat();
  }
  EXPECT_NE(state_of(fleet).memory, start.memory);
  ASSERT_TRUE(fleet.reset());
  EXPECT_EQ(state_of(fleet).memory, start.memory);
}

TEST(SpaceVehicle, restored_in_the_middle_of_a_pulse_goes_on_with_the_same_bits) {
  const std::vector<scene::Spacecraft> craft{test::in_space(test::make_craft(0))};
  GateHarness gate(craft);
  gate.receive(command(0, Quantity::dipole, 5, 3 * kMs, 7 * kMs));  // within one beat
  gate.beat();
  Fleet other(craft, "coadjoint_rk4", StepLimits{});
  ASSERT_TRUE(restore(other, state_of(gate.fleet())));
  gate.beat();
  other.step(10 * kMs, 10 * kMs);
  const FleetState a = state_of(gate.fleet()), b = state_of(other);
  EXPECT_EQ(a.memory, b.memory);
  EXPECT_EQ(a.vehicles[0].state.H_I.value(), b.vehicles[0].state.H_I.value());
}

TEST(Pointing, is_told_against_the_orbital_frame) {
  scene::Spacecraft craft = test::in_space(test::make_craft(0));
  const OrbitMotion<double> motion = motion_at(*craft.orbit, 0.0);
  const OrbitalFrame<double> frame = orbital_frame(motion);
  const Rotation<double> off(Vec3<double>{1e-3, -2e-3, 3e-3});
  const Quat<double> q_IB = frame.q_IO * off.quaternion();
  const RigidBody<double> body(craft.inertia_body_kg_m2);
  const Vec3<double> omega_B = rotate_inverse(off.quaternion(), frame.omega_O);
  craft.initial = make_state(q_IB, rotate(normalised(q_IB), body.momentum(omega_B)));
  const Fleet fleet({craft}, "coadjoint_rk4", StepLimits{});
  const PointingRecord told = pointing(fleet.vehicles()[0], 0.0);
  EXPECT_EQ(told.flags, kPointingOrbit | kPointingTarget);
  EXPECT_NEAR(told.error_B_rad[0], 1e-3, 1e-15);
  EXPECT_NEAR(told.error_B_rad[1], -2e-3, 1e-15);
  EXPECT_NEAR(told.error_B_rad[2], 3e-3, 1e-15);
  for (const double rate : told.omega_B_to_O_B_rad_s) {
    EXPECT_NEAR(rate, 0, 1e-17) << "it turns with the frame";
  }
  EXPECT_EQ(told.position_I_m[0], motion.r_I.x);
  EXPECT_NEAR(told.q_OB[0], 1, 1e-5);
}

/// Against differences of the frame itself, whose plane J2 turns by 1e-6 rad/s here.
TEST(Pointing, of_an_orbit_whose_plane_turns_is_told_against_what_turns_with_it) {
  scene::Spacecraft craft = test::in_space(test::make_craft(0));
  craft.orbit = make_secular_orbit<double>({7e6, 0.02, 0.9, 0.4, 0.7, 0.2});
  constexpr double t = 1000, h = 0.5;
  const auto attitude = [&](double at_s) { return orbital_frame_at(*craft.orbit, at_s).q_IO; };
  const Vec3<double> omega_B = (0.5 / h) * rotation_vector(attitude(t - h), attitude(t + h));
  const RigidBody<double> body(craft.inertia_body_kg_m2);
  craft.initial = make_state(attitude(t), rotate(attitude(t), body.momentum(omega_B)));
  const Fleet fleet({craft}, "coadjoint_rk4", StepLimits{});
  for (const double rate : pointing(fleet.vehicles()[0], t).omega_B_to_O_B_rad_s) {
    EXPECT_NEAR(rate, 0, 1e-9);
  }
  EXPECT_GT(norm(omega_B - orbital_frame(motion_at(*craft.orbit, t)).omega_O), 1e-7);
}

}  // namespace
}  // namespace adstar::runtime
