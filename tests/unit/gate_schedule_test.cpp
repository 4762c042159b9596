// Who has the actuator when: overrides, what waits, priorities.

#include <limits>

#include <gtest/gtest.h>

#include "service/runtime/gate.hpp"
#include "tests/support/gate_talk.hpp"

namespace adstar::runtime {
namespace {

using test::command;
using test::GateHarness;
using test::in_window;
using test::kAlice;
using test::kBob;
using test::kCarol;
using test::kMs;
using test::make_craft;
using test::only;
using test::story;
using test::Verdicts;
using test::Window;

// ---- schedule ----

TEST(CommandSchedule, a_newer_command_overrides_from_its_own_start) {
  GateHarness gate;
  gate.receive(command(kAlice, 1, 0, 100 * kMs));
  gate.beat();
  EXPECT_EQ(only(gate.ask(command(kAlice, 2, 34 * kMs, 60 * kMs))), Verdict::accepted);
  gate.beat();
  EXPECT_EQ(in_window(gate), (Window{{0, 34 * kMs, 0.1}}));
  gate.run_until(40 * kMs);
  EXPECT_EQ(in_window(gate), (Window{{0, 34 * kMs, 0.1}, {34 * kMs, 60 * kMs, 0.2}}));
  gate.run_until(80 * kMs);
  EXPECT_TRUE(in_window(gate).empty()) << "what was cut does not come back";
}

TEST(CommandSchedule, a_newer_command_supersedes_what_would_begin_after_it) {
  GateHarness gate;
  gate.receive(command(kAlice, 1, 50 * kMs, 60 * kMs));
  gate.receive(command(kAlice, 2, 70 * kMs, 80 * kMs));
  gate.take();
  auto verdicts = gate.ask(command(kAlice, 3, 50 * kMs, 55 * kMs));
  EXPECT_EQ(story(verdicts, kAlice, 1), (Verdicts{Verdict::superseded}));
  EXPECT_EQ(story(verdicts, kAlice, 2), (Verdicts{Verdict::superseded}));
  EXPECT_EQ(story(verdicts, kAlice, 3), (Verdicts{Verdict::accepted}));
  verdicts = gate.run_until(100 * kMs);
  ASSERT_EQ(only(verdicts), Verdict::applied);
  EXPECT_EQ(verdicts.front().sequence, 3U);
}

TEST(CommandSchedule, says_at_which_step_a_command_was_superseded) {
  GateHarness gate;
  gate.receive(command(kAlice, 1, 90 * kMs, 95 * kMs));
  gate.run_until(40 * kMs);
  const auto verdicts = gate.ask(command(kAlice, 2, 80 * kMs, 85 * kMs));
  ASSERT_EQ(story(verdicts, kAlice, 1), (Verdicts{Verdict::superseded}));
  EXPECT_EQ(verdicts[0].step, 4U);
  EXPECT_EQ(verdicts[0].time_ns, 40 * kMs);
}

TEST(CommandSchedule, a_newer_command_cuts_one_that_waits_and_begins_earlier) {
  GateHarness gate;
  gate.receive(command(kAlice, 1, 30 * kMs, 90 * kMs));
  gate.receive(command(kAlice, 2, 60 * kMs, 70 * kMs));
  const auto verdicts = gate.run_until(200 * kMs);
  EXPECT_EQ(story(verdicts, kAlice, 1), (Verdicts{Verdict::accepted, Verdict::applied}));
  EXPECT_EQ(story(verdicts, kAlice, 2), (Verdicts{Verdict::accepted, Verdict::applied}));
  for (const VerdictRecord& v : verdicts) {
    if (v.sequence == 1 && v.verdict == Verdict::applied) {
      EXPECT_EQ(v.end_ns, 60 * kMs);
    }
  }
}

TEST(CommandSchedule, two_commands_for_the_same_beat_leave_the_newer_in_force) {
  GateHarness gate;
  gate.receive(command(kAlice, 1, kStartAtNextBeat, 100 * kMs));
  gate.receive(command(kAlice, 2, kStartAtNextBeat, 100 * kMs));
  const auto verdicts = gate.beat();
  EXPECT_EQ(story(verdicts, kAlice, 1), (Verdicts{Verdict::superseded}));
  EXPECT_EQ(story(verdicts, kAlice, 2), (Verdicts{Verdict::applied}));
  EXPECT_EQ(in_window(gate), (Window{{0, 100 * kMs, 0.2}}));
}

TEST(CommandSchedule, flies_a_profile_of_consecutive_commands_to_the_nanosecond) {
  GateHarness gate;
  constexpr std::int64_t kPiece = 7'300'001;
  for (std::int64_t i = 0; i < 40; ++i) {
    gate.receive(command(kAlice, static_cast<std::uint64_t>(i + 1), 5 * kMs + i * kPiece,
                         5 * kMs + (i + 1) * kPiece));
  }
  gate.take();
  while (gate.now_ns() < 400 * kMs) {
    const std::int64_t t = gate.now_ns();
    gate.beat();
    Window expected;
    for (std::int64_t i = 0; i < 40; ++i) {
      const std::int64_t start = 5 * kMs + i * kPiece, end = start + kPiece;
      if (end > t && start < t + 10 * kMs) {
        expected.push_back({start, end, 0.1 * static_cast<double>(i + 1)});
      }
    }
    ASSERT_EQ(in_window(gate), expected) << t;
  }
}

TEST(CommandSchedule, lets_64_wait_on_an_actuator_and_refuses_the_65th) {
  GateHarness gate({make_craft(2)});
  const auto nth = [](std::uint64_t n) {
    const auto start = static_cast<std::int64_t>(20 * n) * kMs;
    return command(kAlice, n, start, start + 10 * kMs);
  };
  gate.receive(command(kAlice, 1, 0, 15 * kMs));
  gate.beat();
  for (std::uint64_t n = 2; n < 2 + CommandGate::kMaxWaiting; ++n) {
    ASSERT_EQ(only(gate.ask(nth(n))), Verdict::accepted) << n;
  }
  const auto refused = gate.ask(nth(66));
  ASSERT_EQ(only(refused), Verdict::refused);
  EXPECT_EQ(refused[0].reason, Reason::schedule_full);
  EXPECT_EQ(gate.ask(nth(66)).at(0), refused[0]) << "a repeat is answered alike";

  CommandRecord neighbour = nth(66);
  neighbour.actuator = 1;
  EXPECT_EQ(only(gate.ask(neighbour)), Verdict::accepted) << "another actuator has room";
  gate.beat();
  gate.beat();  // 20 to 30 ms: the first of those that wait begins
  EXPECT_EQ(in_window(gate).size(), 0U);
  gate.run_until(50 * kMs);
  EXPECT_EQ(only(gate.ask(nth(67))), Verdict::accepted) << "one began, so one may come";
}

TEST(CommandSchedule, an_override_is_heard_although_64_wait) {
  GateHarness gate;
  for (std::uint64_t n = 1; n <= CommandGate::kMaxWaiting; ++n) {
    const auto start = static_cast<std::int64_t>(20 * n) * kMs;
    gate.receive(command(kAlice, n, start, start + 10 * kMs));
  }
  gate.take();
  gate.receive(command(kAlice, 100, kStartAtNextBeat, 50 * kMs));
  const auto verdicts = gate.beat();
  EXPECT_EQ(verdicts.size(), 1 + CommandGate::kMaxWaiting);
  EXPECT_EQ(story(verdicts, kAlice, 100), (Verdicts{Verdict::applied}));
  EXPECT_EQ(story(verdicts, kAlice, 64), (Verdicts{Verdict::superseded}));
}

// ---- arbitration ----

TEST(CommandSchedule, a_higher_priority_that_waits_holds_the_actuator) {
  GateHarness gate;
  gate.receive(command(kBob, 1, 80 * kMs, 90 * kMs, 5));
  gate.take();
  EXPECT_EQ(only(gate.ask(command(kAlice, 1, 0, 20 * kMs, 4))), Verdict::outranked);
  EXPECT_EQ(only(gate.ask(command(kAlice, 2, 100 * kMs, 120 * kMs, 4))), Verdict::outranked);
  EXPECT_EQ(gate.counters().refused, 2U);
  gate.beat();
  EXPECT_TRUE(in_window(gate).empty());
}

TEST(CommandSchedule, outranks_what_waits_below_and_lets_what_is_in_force_run_to_the_higher_start) {
  GateHarness gate;
  gate.receive(command(kAlice, 1, 0, 100 * kMs));
  gate.beat();
  gate.receive(command(kCarol, 1, 85 * kMs, 100 * kMs));
  gate.take();
  auto verdicts = gate.ask(command(kBob, 2, 55 * kMs, 75 * kMs, 1));
  EXPECT_EQ(story(verdicts, kCarol, 1), (Verdicts{Verdict::outranked}));
  EXPECT_EQ(story(verdicts, kBob, 2), (Verdicts{Verdict::accepted}));
  gate.run_until(60 * kMs);
  EXPECT_EQ(in_window(gate), (Window{{0, 55 * kMs, 0.1}, {55 * kMs, 75 * kMs, 0.2}}));
  gate.run_until(90 * kMs);
  EXPECT_TRUE(in_window(gate).empty());
}

TEST(CommandSchedule, outranks_a_lower_one_that_waits_for_an_earlier_start) {
  GateHarness gate;
  gate.receive(command(kAlice, 1, 40 * kMs, 45 * kMs));
  gate.take();
  const auto verdicts = gate.ask(command(kBob, 1, 80 * kMs, 90 * kMs, 1));
  EXPECT_EQ(story(verdicts, kAlice, 1), (Verdicts{Verdict::outranked}));
}

TEST(CommandSchedule, hears_the_newest_among_equals) {
  GateHarness gate;
  gate.receive(command(kAlice, 50, 0, 100 * kMs, 3));
  gate.beat();
  gate.receive(command(kBob, 1, 15 * kMs, 100 * kMs, 3));
  gate.beat();
  EXPECT_EQ(in_window(gate), (Window{{0, 15 * kMs, 5.0}, {15 * kMs, 100 * kMs, 0.1}}));
}

TEST(CommandSchedule, a_commander_may_not_undercut_its_own_higher_command) {
  GateHarness gate;
  gate.receive(command(kAlice, 1, 0, 100 * kMs, 3));
  gate.beat();
  EXPECT_EQ(only(gate.ask(command(kAlice, 2, 20 * kMs, 30 * kMs, 2))), Verdict::outranked);
}

TEST(CommandSchedule, orders_the_whole_range_of_priorities) {
  GateHarness gate;
  constexpr std::int32_t kLow = std::numeric_limits<std::int32_t>::min();
  constexpr std::int32_t kHigh = std::numeric_limits<std::int32_t>::max();
  gate.receive(command(kAlice, 1, 50 * kMs, 60 * kMs, kLow));
  gate.receive(command(kBob, 1, 50 * kMs, 60 * kMs, -1));
  gate.receive(command(kCarol, 1, 50 * kMs, 60 * kMs, kHigh));
  gate.receive(command(kBob, 2, 50 * kMs, 60 * kMs, 0));
  const auto verdicts = gate.run_until(100 * kMs);
  EXPECT_EQ(story(verdicts, kAlice, 1), (Verdicts{Verdict::accepted, Verdict::outranked}));
  EXPECT_EQ(story(verdicts, kBob, 1), (Verdicts{Verdict::accepted, Verdict::outranked}));
  EXPECT_EQ(story(verdicts, kBob, 2), (Verdicts{Verdict::outranked}));
  EXPECT_EQ(story(verdicts, kCarol, 1), (Verdicts{Verdict::accepted, Verdict::applied}));
}

TEST(CommandSchedule, hears_the_next_in_rank_at_the_very_beat_at_which_the_higher_has_ended) {
  for (const std::int64_t end : {25 * kMs, 30 * kMs}) {
    GateHarness gate;
    gate.receive(command(kBob, 1, 0, end, 5));
    gate.run_until(20 * kMs);
    EXPECT_EQ(only(gate.ask(command(kAlice, 1, kStartAtNextBeat, 90 * kMs))), Verdict::outranked);
    gate.beat();
    EXPECT_TRUE(gate.ask(command(kAlice, 2, kStartAtNextBeat, 90 * kMs)).empty()) << end;
    const auto verdicts = gate.beat();
    ASSERT_EQ(only(verdicts), Verdict::applied) << end;
    EXPECT_EQ(verdicts.front().start_ns, 30 * kMs);
  }
}

TEST(CommandSchedule, does_not_let_a_rank_on_one_actuator_hold_another) {
  GateHarness gate({make_craft(2), make_craft(1)});
  gate.receive(command(kBob, 1, 0, 100 * kMs, 5));
  CommandRecord c = command(kAlice, 1, 0, 100 * kMs);
  c.actuator = 1;
  gate.receive(c);
  c.spacecraft = 1;
  c.actuator = 0;
  gate.receive(c);
  EXPECT_EQ(story(gate.beat(), kAlice, 1), (Verdicts{Verdict::applied, Verdict::applied}));
}

}  // namespace
}  // namespace adstar::runtime
