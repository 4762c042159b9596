// A commanded pulse delivers its impulse, whatever its phase against the step: through gate and
// fleet.

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/gate_harness.hpp"
#include "tests/support/plain_motion.hpp"
#include "tests/support/random_motion.hpp"

namespace adstar::runtime {
namespace {

using test::GateHarness;
using test::kAlice;
using test::kMs;
using test::make_craft;
using test::Quad;

constexpr std::int64_t kStep = 10 * kMs;

CommandRecord pulse(std::int64_t start_ns, std::int64_t end_ns, const Vec3<double>& torque) {
  CommandRecord command;
  command.commander = kAlice;
  command.sequence = 1;
  command.start_ns = start_ns;
  command.end_ns = end_ns;
  command.value = {torque.x, torque.y, torque.z};
  return command;
}

/// |H_end - H_0 - torque · length| / max(|H_0|, impulse) after a pulse sent at t = 0.
double impulse_defect(std::int64_t start_ns, std::int64_t end_ns, const Vec3<double>& torque) {
  GateHarness gate({make_craft(1, Frame::inertial)}, kStep);
  const Vec3<double> H_0 = gate.fleet().vehicles()[0].H_0;
  gate.receive(pulse(start_ns, end_ns, torque));
  gate.run_until(end_ns + 3 * kStep);
  const Vec3<double> impulse = (static_cast<double>(end_ns - start_ns) * 1e-9) * torque;
  const Vec3<double> H = gate.fleet().vehicles()[0].state.H_I.value();
  return norm((H - H_0) - impulse) / std::max(norm(H_0), norm(impulse));
}

TEST(Pulse, in_the_inertial_frame_changes_momentum_by_its_impulse_at_any_phase_of_start_and_end) {
  const std::int64_t phases[] = {0,         1,         2,         999,      kStep / 3,
                                 kStep / 2, 7'777'777, kStep - 2, kStep - 1};
  for (const std::int64_t steps : {0, 1, 2, 17}) {
    for (const std::int64_t start : phases) {
      for (const std::int64_t end : phases) {
        const std::int64_t from = 5 * kStep + start, to = (5 + steps) * kStep + end;
        if (to > from) {
          ASSERT_LT(impulse_defect(from, to, {0.3, -0.7, 0.2}), 1e-12) << from << " to " << to;
        }
      }
    }
  }
}

TEST(Pulse, in_the_inertial_frame_holds_its_impulse_for_random_pulses_small_and_large) {
  test::Generator random(4711);
  std::uniform_int_distribution<std::int64_t> start(0, 20 * kStep), length(1, 40 * kStep);
  for (int n = 0; n < 500; ++n) {
    const Vec3<double> torque = test::log_uniform(random, 1e-9, 5) * test::unit_vector(random);
    const std::int64_t from = start(random);
    const std::int64_t to = from + length(random);
    ASSERT_LT(impulse_defect(from, to, torque), 1e-12) << from << " to " << to;
  }
}

TEST(Pulse, in_the_inertial_frame_adds_up_over_a_hundred_pulses) {
  GateHarness gate({make_craft(1, Frame::inertial)}, kStep);
  test::Generator random(99);
  const Vec3<double> H_0 = gate.fleet().vehicles()[0].H_0;
  Vec3<double> impulse;
  std::uint64_t sequence = 0;
  for (int n = 0; n < 100; ++n) {
    const std::int64_t from =
        gate.now_ns() + std::uniform_int_distribution<std::int64_t>(0, 2 * kStep)(random);
    const std::int64_t to =
        from + std::uniform_int_distribution<std::int64_t>(1, 2 * kStep)(random);
    const Vec3<double> torque = 2.0 * test::unit_vector(random);
    CommandRecord command = pulse(from, to, torque);
    command.sequence = ++sequence;
    gate.receive(command);
    gate.run_until(to);
    impulse = impulse + (static_cast<double>(to - from) * 1e-9) * torque;
  }
  const Vec3<double> H = gate.fleet().vehicles()[0].state.H_I.value();
  EXPECT_LT(norm((H - H_0) - impulse), 1e-12 * norm(H_0));
}

TEST(Pulse, from_two_actuators_at_once_is_the_sum) {
  GateHarness gate({make_craft(2, Frame::inertial)}, kStep);
  const Vec3<double> H_0 = gate.fleet().vehicles()[0].H_0;
  gate.receive(pulse(3'000'001, 83'000'000, {0.5, 0, 0}));
  CommandRecord other = pulse(42'424'242, 61'616'161, {0, -0.25, 1});
  other.actuator = 1;
  gate.receive(other);
  gate.run_until(20 * kStep);
  const Vec3<double> impulse =
      Vec3<double>{0.5 * 79'999'999e-9, 0, 0} + 19'191'919e-9 * Vec3<double>{0, -0.25, 1};
  const Vec3<double> H = gate.fleet().vehicles()[0].state.H_I.value();
  EXPECT_LT(norm((H - H_0) - impulse), 1e-12 * norm(H_0));
}

// ---- in the body frame, against 113 bits ----

constexpr std::int64_t kPulseFrom = 1'234'567'891, kPulseTo = 6'543'210'987;
constexpr std::int64_t kRun = 10'000 * kMs;
constexpr Vec3<double> kTorque{0.11, -0.07, 0.05};

struct End {
  Quat<double> q_IB;
  Vec3<double> H_I;
};

End flown(std::int64_t step_ns) {
  GateHarness gate({make_craft(1, Frame::body)}, step_ns);
  gate.receive(pulse(kPulseFrom, kPulseTo, kTorque));
  gate.run_until(kRun);
  EXPECT_EQ(gate.now_ns(), kRun);
  const State<double>& state = gate.fleet().vehicles()[0].state;
  return {state.q_IB, state.H_I.value()};
}

End truth() {
  const scene::Spacecraft craft = make_craft(1);
  const Quat<Quad> q = normalised(test::convert<Quad>(craft.initial.q_IB));
  const Vec3<Quad> H = test::convert<Quad>(craft.initial.H_I.value());
  const test::QuadMatrix J = craft.inertia_body_kg_m2.cast<Quad>();
  const test::PlainMotion free(J, {});
  const test::PlainMotion forced(J, [](const Quad&, const Quat<Quad>&, const Vec3<Quad>&) {
    return test::convert<Quad>(kTorque);
  });
  const auto at = [](std::int64_t ns) { return seconds<Quad>(ns); };
  test::PlainState state = test::plain_state(q, rotate_inverse(q, H));
  state = free.run(state, Quad(0), at(kPulseFrom), 30);
  state = forced.run(state, at(kPulseFrom), at(kPulseTo), 100);
  state = free.run(state, at(kPulseTo), at(kRun), 70);
  const Quat<Quad> q_end = normalised(state.q_IB());
  return {test::convert<double>(q_end), test::convert<double>(rotate(q_end, state.Pi_B()))};
}

TEST(Pulse, in_the_body_frame_agrees_with_113_bits_to_the_order_of_the_scheme) {
  const End exact = truth();
  const auto errors = [&](std::int64_t step_ns) {
    const End end = flown(step_ns);
    return std::pair{angle_between(end.q_IB, exact.q_IB), norm(end.H_I - exact.H_I)};
  };
  const auto [angle_coarse, momentum_coarse] = errors(50 * kMs);
  const auto [angle_fine, momentum_fine] = errors(25 * kMs);
  EXPECT_NEAR(std::log2(angle_coarse / angle_fine), 4, 0.2) << angle_coarse << " " << angle_fine;
  EXPECT_NEAR(std::log2(momentum_coarse / momentum_fine), 4, 0.2)
      << momentum_coarse << " " << momentum_fine;
  const auto [angle_small, momentum_small] = errors(5 * kMs);
  EXPECT_LT(angle_small, 1e-10);
  EXPECT_LT(momentum_small, 1e-10);
}

TEST(Pulse, in_the_body_frame_keeps_the_impulse_balance_to_round_off) {
  GateHarness gate({make_craft(1, Frame::body)}, 50 * kMs);
  gate.receive(pulse(kPulseFrom, kPulseTo, kTorque));
  gate.run_until(kRun);
  EXPECT_LT(momentum_residual_relative(gate.fleet().vehicles()[0]), 1e-14);
  EXPECT_GT(norm(gate.fleet().vehicles()[0].state.impulse_I.value()), 0.1);
}

}  // namespace
}  // namespace adstar::runtime
