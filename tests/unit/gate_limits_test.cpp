// The gate at its limits: full windows, pools and rings, indices and numbers that nobody should
// send.

#include <limits>

#include <gtest/gtest.h>

#include "service/runtime/gate.hpp"
#include "tests/support/gate_harness.hpp"

namespace adstar::runtime {
namespace {

using test::GateHarness;
using test::kAlice;
using test::kBob;
using test::kMs;
using test::make_craft;

CommandRecord command(const CommanderId& commander, std::uint64_t sequence, std::int64_t start_ns,
                      std::int64_t end_ns, std::int32_t priority = 0) {
  CommandRecord record;
  record.commander = commander;
  record.sequence = sequence;
  record.priority = priority;
  record.start_ns = start_ns;
  record.end_ns = end_ns;
  record.value = {1, 0, 0};
  return record;
}

TEST(CommandGateLimits, holds_16_intervals_a_step_and_begins_the_rest_at_the_next_beat) {
  GateHarness gate;
  // 20 of 0.4 ms each in the first step; the last is valid for long.
  for (std::uint64_t n = 1; n <= 20; ++n) {
    const auto start = static_cast<std::int64_t>(n) * 400'000;
    gate.receive(command(kAlice, n, start, n == 20 ? 50 * kMs : start + 400'000));
  }
  auto verdicts = gate.beat();
  ASSERT_EQ(verdicts.size(), 16U);
  const Commanded<double>& window = gate.window();
  ASSERT_EQ(window.intervals, 16U);
  for (std::size_t i = 0; i < 16; ++i) {
    EXPECT_EQ(verdicts[i].verdict, Verdict::applied);
    EXPECT_EQ(window.window[i].start_ns, static_cast<std::int64_t>(i + 1) * 400'000);
    EXPECT_EQ(window.window[i].end_ns, static_cast<std::int64_t>(i + 2) * 400'000);
  }
  verdicts = gate.beat();
  ASSERT_EQ(verdicts.size(), 4U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(verdicts[i].sequence, 17 + i);
    EXPECT_EQ(verdicts[i].verdict, Verdict::expired);
  }
  EXPECT_EQ(verdicts[3].verdict, Verdict::applied_late);
  EXPECT_EQ(verdicts[3].start_ns, 10 * kMs);
  EXPECT_EQ(verdicts[3].step, 1U);
  EXPECT_EQ(gate.window().intervals, 1U);
}

TEST(CommandGateLimits, refuses_for_want_of_capacity_when_the_pool_is_used_up_and_recovers) {
  GateHarness gate({make_craft(3)}, 10 * kMs, 2);
  CommandRecord c = command(kAlice, 1, 20 * kMs, 30 * kMs);
  gate.receive(c);
  c.actuator = 1;
  gate.receive(c);
  gate.take();
  c.actuator = 2;
  const auto refused = gate.ask(c);
  ASSERT_EQ(refused.size(), 1U);
  EXPECT_EQ(refused[0].verdict, Verdict::refused);
  EXPECT_EQ(refused[0].reason, Reason::capacity);
  gate.run_until(50 * kMs);
  c.sequence = 2;
  c.start_ns = 60 * kMs;
  c.end_ns = 70 * kMs;
  EXPECT_EQ(gate.ask(c).at(0).verdict, Verdict::accepted);
}

TEST(CommandGateLimits, an_override_takes_the_place_of_what_it_displaces_in_a_full_pool) {
  GateHarness gate({make_craft(2)}, 10 * kMs, 2);
  gate.receive(command(kAlice, 1, 20 * kMs, 30 * kMs));
  CommandRecord other = command(kAlice, 1, 20 * kMs, 30 * kMs);
  other.actuator = 1;
  gate.receive(other);
  gate.take();
  const auto verdicts = gate.ask(command(kBob, 1, 20 * kMs, 90 * kMs, 7));
  ASSERT_EQ(verdicts.size(), 2U);
  EXPECT_EQ(verdicts[0].verdict, Verdict::outranked);
  EXPECT_EQ(verdicts[0].commander, kAlice);
  EXPECT_EQ(verdicts[1].verdict, Verdict::accepted);
  EXPECT_EQ(verdicts[1].commander, kBob);
}

TEST(CommandGateLimits, a_refusal_for_want_of_room_leaves_the_schedule_as_it_was) {
  GateHarness gate({make_craft(1)}, 10 * kMs, 1);
  gate.receive(command(kAlice, 1, 0, 90 * kMs));
  gate.beat();
  EXPECT_EQ(gate.ask(command(kAlice, 2, 20 * kMs, 30 * kMs)).at(0).reason, Reason::capacity);
  gate.run_until(60 * kMs);
  ASSERT_EQ(gate.window().intervals, 1U);
  EXPECT_EQ(gate.window().window[0].end_ns, 90 * kMs);
}

TEST(CommandGateLimits, counts_a_verdict_that_found_the_ring_full_and_gives_it_on_repeat) {
  GateHarness gate;
  // Fill the ring with answers to nonsense.
  for (std::uint64_t n = 1; n <= VerdictRing::kCapacity; ++n) {
    gate.receive(command(kBob, n, 10, 5));
  }
  EXPECT_EQ(gate.counters().verdicts_lost, 0U);
  const CommandRecord now = command(kAlice, 1, 0, 500 * kMs);
  gate.receive(now);
  const auto before = gate.beat();
  ASSERT_EQ(before.size(), VerdictRing::kCapacity);
  EXPECT_EQ(before.back().commander, kBob);
  EXPECT_EQ(gate.counters().verdicts_lost, 1U);
  EXPECT_EQ(gate.window().intervals, 1U) << "in force all the same";
  const auto again = gate.ask(now);
  ASSERT_EQ(again.size(), 1U);
  EXPECT_EQ(again[0].verdict, Verdict::applied);
  EXPECT_EQ(again[0].step, 0U);
}

TEST(CommandGateLimits, indices_out_of_range_disturb_nothing) {
  GateHarness gate({make_craft(2), make_craft(0), make_craft(1)});
  gate.receive(command(kAlice, 1, 0, 100 * kMs));
  constexpr std::uint32_t kHuge = std::numeric_limits<std::uint32_t>::max();
  for (const auto& [spacecraft, actuator] :
       std::vector<std::pair<std::uint32_t, std::uint32_t>>{{0, 2},
                                                            {0, 3},
                                                            {1, 0},
                                                            {2, 1},
                                                            {3, 0},
                                                            {kHuge, 0},
                                                            {0, kHuge},
                                                            {2, kHuge},
                                                            {2, kHuge - 1},
                                                            {kHuge, kHuge},
                                                            {0x8000'0000U, 0x8000'0000U}}) {
    CommandRecord c = command(kBob, 1, 0, 100 * kMs, 9);
    c.spacecraft = spacecraft;
    c.actuator = actuator;
    gate.receive(c);
  }
  EXPECT_EQ(gate.counters().received, 12U);
  EXPECT_EQ(gate.counters().refused, 11U);
  gate.beat();
  EXPECT_EQ(gate.window(0, 0).intervals, 1U);
  EXPECT_EQ(gate.window(0, 1).intervals, 0U);
  EXPECT_EQ(gate.window(2, 0).intervals, 0U);
  EXPECT_EQ(gate.window(0, 0).window[0].torque_n_m, (Vec3<double>{1, 0, 0}));
}

TEST(CommandGateLimits, survives_a_scene_without_any_spacecraft_or_actuator) {
  for (const auto& fleet : {std::vector<scene::Spacecraft>{}, {make_craft(0)}}) {
    GateHarness gate(fleet);
    gate.receive(command(kAlice, 1, 0, 100 * kMs));
    EXPECT_TRUE(gate.beat().empty());
    EXPECT_EQ(gate.counters().refused, 1U);
  }
}

TEST(CommandGateLimits, no_bad_command_changes_one_bit_of_the_motion) {
  GateHarness quiet({make_craft(2)}), pestered({make_craft(2)});
  constexpr std::int64_t kMin = std::numeric_limits<std::int64_t>::min();
  constexpr std::int64_t kMax = std::numeric_limits<std::int64_t>::max();
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  std::uint64_t sequence = 0;
  for (int n = 0; n < 200; ++n) {
    for (GateHarness* gate : {&quiet, &pestered}) {
      if (n == 20) {
        gate->receive(command(kAlice, 1, 203 * kMs, 1507 * kMs));
      }
    }
    for (const double bad : {kNan, kInf, -kInf}) {
      CommandRecord c = command(kBob, ++sequence, pestered.now_ns(), kMax, 9);
      c.value[static_cast<std::size_t>(n) % 3] = bad;
      pestered.receive(c);
    }
    for (const auto& [start, end] : std::vector<std::pair<std::int64_t, std::int64_t>>{
             {kMax, kMin}, {kMin, kMin + 1}, {kMax, 0}, {5, 5}, {kMin, pestered.now_ns()}}) {
      pestered.receive(command(kBob, ++sequence, start, end, 9));
    }
    CommandRecord c = command(kBob, ++sequence, pestered.now_ns(), 0, 9);
    c.duration_ns = kMin;
    pestered.receive(c);
    pestered.receive(command(kBob, 1, 0, kMax, 9));
    quiet.beat();
    pestered.beat();
    ASSERT_EQ(quiet.fleet().vehicles()[0].state, pestered.fleet().vehicles()[0].state) << n;
  }
  EXPECT_EQ(pestered.counters().refused, pestered.counters().received - 1);
}

TEST(CommandGateLimits, holds_a_command_to_the_end_of_time) {
  GateHarness gate;
  gate.receive(command(kAlice, 1, 0, std::numeric_limits<std::int64_t>::max()));
  EXPECT_EQ(gate.ask(command(kAlice, 2, std::numeric_limits<std::int64_t>::max() - 1,
                             std::numeric_limits<std::int64_t>::max()))
                .at(0)
                .verdict,
            Verdict::accepted);
  gate.run_until(1000 * kMs);
  ASSERT_EQ(gate.window().intervals, 1U);
  EXPECT_EQ(gate.window().window[0].end_ns, std::numeric_limits<std::int64_t>::max() - 1);
}

TEST(CommandGateLimits, a_clamp_that_the_window_delays_stays_a_clamp) {
  GateHarness gate({make_craft(1, Frame::body, {0.5, 0.5, 0.5})});
  for (std::uint64_t n = 1; n <= 17; ++n) {
    const auto start = static_cast<std::int64_t>(n) * 400'000;
    gate.receive(command(kAlice, n, start, n == 17 ? 50 * kMs : start + 400'000));
  }
  gate.beat();
  const auto verdicts = gate.beat();
  ASSERT_EQ(verdicts.size(), 1U);
  EXPECT_EQ(verdicts[0].verdict, Verdict::clamped);
  EXPECT_EQ(verdicts[0].start_ns, 10 * kMs);
}

TEST(CommandGateLimits, refuses_for_want_of_capacity_who_finds_no_memory_and_recovers) {
  constexpr int kActuators = 1000;
  constexpr std::uint64_t kCommanders = 16;
  GateHarness gate({make_craft(kActuators)});
  std::uint64_t accepted = 0, without = 0;
  CommandRecord last_refused;
  for (std::uint64_t commander = 1; commander <= kCommanders; ++commander) {
    for (std::uint32_t actuator = 0; actuator < kActuators; ++actuator) {
      const auto start = static_cast<std::int64_t>(100 + commander) * kMs;
      CommandRecord c = command({commander, 9}, 1, start, start + kMs);
      c.actuator = actuator;
      const VerdictRecord answer = gate.ask(c).at(0);
      if (answer.verdict == Verdict::accepted) {
        ++accepted;
      } else {
        ASSERT_EQ(answer.reason, Reason::capacity);
        ++without;
        last_refused = c;
      }
    }
  }
  EXPECT_GT(accepted, 3 * kActuators) << "room for some commanders on every actuator at once";
  EXPECT_GT(without, 0U) << "memory without bound";
  EXPECT_EQ(gate.ask(last_refused).at(0).reason, Reason::capacity);
  std::uint64_t applied = 0;
  for (const VerdictRecord& v : gate.run_until(200 * kMs)) {
    applied += v.verdict == Verdict::applied ? 1 : 0;
  }
  EXPECT_EQ(applied, accepted);
  last_refused.end_ns = 500 * kMs;
  gate.receive(last_refused);
  EXPECT_EQ(gate.beat().at(0).verdict, Verdict::applied_late);
}

TEST(CommandGateLimits, hears_one_commander_after_another_without_end) {
  GateHarness gate;
  for (std::uint64_t n = 1; n <= 40'000; ++n) {
    gate.receive(command({n, n * n}, 1, gate.now_ns(), gate.now_ns() + 1));
    const auto verdicts = gate.beat();
    ASSERT_EQ(verdicts.size(), 1U) << n;
    ASSERT_EQ(verdicts[0].verdict, Verdict::applied) << n;
  }
}

TEST(CommandGateLimits, a_flood_of_strangers_does_not_make_it_forget_who_waits) {
  GateHarness gate({make_craft(1)}, 10 * kMs);
  // Each of these waits, so the memory of its stream may not be given away.
  std::vector<CommandRecord> busy;
  for (std::uint64_t n = 1; n <= CommandGate::kMaxWaiting; ++n) {
    const auto start = static_cast<std::int64_t>(1000 * n) * kMs;
    busy.push_back(command({77, n}, 5, start, start + 10 * kMs));
    gate.receive(busy.back());
  }
  gate.take();
  for (std::uint64_t n = 0; n < 50'000; ++n) {  // a flood of strangers
    gate.receive(command({n, n * n + 1}, 1, 10, 5));
    gate.take();
  }
  for (const CommandRecord& c : busy) {
    EXPECT_EQ(gate.ask(c).at(0).verdict, Verdict::accepted) << c.commander.low;
  }
}

}  // namespace
}  // namespace adstar::runtime
