#include "service/runtime/gate.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "tests/support/gate_harness.hpp"

namespace adstar::runtime {
namespace {

using test::GateHarness;
using test::kAlice;
using test::kBob;
using test::kCarol;
using test::kMs;
using test::make_craft;

/// Sequence n of that commander: n tenths of a newton metre about x, so that torques tell commands
/// apart.
CommandRecord command(const CommanderId& commander, std::uint64_t sequence, std::int64_t start_ns,
                      std::int64_t end_ns, std::int32_t priority = 0) {
  CommandRecord record;
  record.commander = commander;
  record.sequence = sequence;
  record.priority = priority;
  record.start_ns = start_ns;
  record.end_ns = end_ns;
  record.torque_n_m = {0.1 * static_cast<double>(sequence), 0, 0};
  return record;
}

Verdict only(const std::vector<VerdictRecord>& verdicts) {
  EXPECT_EQ(verdicts.size(), 1U);
  return verdicts.empty() ? Verdict::refused : verdicts.front().verdict;
}

/// The verdicts on one command, in the order they were given.
std::vector<Verdict> story(const std::vector<VerdictRecord>& verdicts, const CommanderId& commander,
                           std::uint64_t sequence) {
  std::vector<Verdict> result;
  for (const VerdictRecord& v : verdicts) {
    if (v.commander == commander && v.sequence == sequence) {
      result.push_back(v.verdict);
    }
  }
  return result;
}

using Verdicts = std::vector<Verdict>;

struct Interval {
  std::int64_t start_ns, end_ns;
  double x;
  friend bool operator==(const Interval&, const Interval&) = default;
};

std::vector<Interval> in_window(const GateHarness& gate, std::size_t torque = 0) {
  std::vector<Interval> result;
  const Commanded<double>& commanded = gate.window(0, torque);
  for (std::size_t i = 0; i < commanded.intervals; ++i) {
    const auto& w = commanded.window[i];
    result.push_back({w.start_ns, w.end_ns, w.torque_n_m.x});
  }
  return result;
}

using Window = std::vector<Interval>;

// ---- the life of one command
// ---------------------------------------------------------------------

TEST(CommandGate, applies_what_is_due_in_this_step_and_names_the_step) {
  GateHarness gate;
  gate.run_until(50 * kMs);
  EXPECT_TRUE(gate.ask(command(kAlice, 1, 53 * kMs, 54 * kMs)).empty());
  const auto verdicts = gate.beat();
  ASSERT_EQ(verdicts.size(), 1U);
  const VerdictRecord& v = verdicts.front();
  EXPECT_EQ(v.verdict, Verdict::applied);
  EXPECT_EQ(v.commander, kAlice);
  EXPECT_EQ(v.sequence, 1U);
  EXPECT_EQ(v.step, 5U);
  EXPECT_EQ(v.time_ns, 50 * kMs);
  EXPECT_EQ(v.start_ns, 53 * kMs);
  EXPECT_EQ(v.end_ns, 54 * kMs);
  EXPECT_EQ(v.torque_n_m, (std::array<double, 3>{0.1, 0, 0}));
  EXPECT_EQ(in_window(gate), (Window{{53 * kMs, 54 * kMs, 0.1}}));
}

TEST(CommandGate, accepts_what_waits_and_applies_it_in_the_step_that_holds_its_start) {
  GateHarness gate;
  EXPECT_EQ(only(gate.ask(command(kAlice, 1, 35 * kMs, 90 * kMs))), Verdict::accepted);
  EXPECT_TRUE(gate.run_until(30 * kMs).empty());
  const auto verdicts = gate.beat();
  ASSERT_EQ(only(verdicts), Verdict::applied);
  EXPECT_EQ(verdicts.front().step, 3U);
  EXPECT_TRUE(gate.run_until(200 * kMs).empty());
}

TEST(CommandGate, treats_a_start_at_the_end_of_this_step_as_the_next_steps) {
  GateHarness gate;
  EXPECT_EQ(only(gate.ask(command(kAlice, 1, 10 * kMs, 20 * kMs))), Verdict::accepted);
  EXPECT_TRUE(gate.beat().empty());
  EXPECT_TRUE(in_window(gate).empty());
  EXPECT_EQ(only(gate.beat()), Verdict::applied);
  EXPECT_EQ(in_window(gate), (Window{{10 * kMs, 20 * kMs, 0.1}}));
  gate.beat();
  EXPECT_TRUE(in_window(gate).empty());
}

TEST(CommandGate, applies_late_from_the_next_beat_and_expires_what_is_wholly_past) {
  GateHarness gate;
  gate.run_until(50 * kMs);
  EXPECT_EQ(only(gate.ask(command(kAlice, 1, 10 * kMs, 50 * kMs))), Verdict::expired);
  EXPECT_TRUE(gate.ask(command(kAlice, 2, 10 * kMs, 50 * kMs + 1)).empty());
  const auto verdicts = gate.beat();
  ASSERT_EQ(only(verdicts), Verdict::applied_late);
  EXPECT_EQ(verdicts.front().start_ns, 50 * kMs);
  EXPECT_EQ(verdicts.front().end_ns, 50 * kMs + 1);
  EXPECT_EQ(in_window(gate), (Window{{50 * kMs, 50 * kMs + 1, 0.2}}));
}

TEST(CommandGate, reports_a_clamp_with_what_is_applied) {
  GateHarness gate({make_craft(1, Frame::body, {0.25, 1, 1})});
  gate.ask(command(kAlice, 5, 0, 20 * kMs));
  const auto verdicts = gate.beat();
  ASSERT_EQ(only(verdicts), Verdict::clamped);
  EXPECT_EQ(verdicts.front().torque_n_m[0], 0.25);
  EXPECT_EQ(in_window(gate), (Window{{0, 20 * kMs, 0.25}}));
}

TEST(CommandGate, runs_the_command_of_a_silent_commander_to_the_end_of_its_validity) {
  GateHarness gate;
  gate.ask(command(kAlice, 1, kStartAtNextBeat, 95 * kMs));
  gate.run_until(90 * kMs);
  EXPECT_EQ(in_window(gate).size(), 1U);
  gate.beat();
  EXPECT_EQ(in_window(gate), (Window{{0, 95 * kMs, 0.1}}));
  gate.beat();
  EXPECT_TRUE(in_window(gate).empty());
}

// ---- identity
// ------------------------------------------------------------------------------------

TEST(CommandGate, answers_a_repeat_as_before_and_changes_nothing) {
  GateHarness gate;
  const CommandRecord first = command(kAlice, 7, 0, 100 * kMs);
  gate.receive(first);
  const VerdictRecord answer = gate.beat().at(0);
  for (int n = 0; n < 5; ++n) {
    const auto again = gate.ask(first);
    ASSERT_EQ(again.size(), 1U);
    EXPECT_EQ(again[0], answer);
    EXPECT_TRUE(gate.beat().empty());
    EXPECT_EQ(in_window(gate), (Window{{0, 100 * kMs, 0.7000000000000001}}));
  }
  EXPECT_EQ(gate.counters().refused, 0U);
}

TEST(CommandGate, answers_a_repeat_of_what_waits_as_accepted_and_still_ends_it_once) {
  GateHarness gate;
  const CommandRecord first = command(kAlice, 1, 55 * kMs, 60 * kMs);
  const auto answer = gate.ask(first);
  ASSERT_EQ(only(answer), Verdict::accepted);
  gate.beat();
  EXPECT_EQ(only(gate.ask(first)), Verdict::accepted);
  const auto rest = gate.run_until(200 * kMs);
  EXPECT_EQ(story(rest, kAlice, 1), (Verdicts{Verdict::applied}));
}

TEST(CommandGate, holds_to_the_first_content_of_a_sequence_number) {
  GateHarness gate;
  gate.receive(command(kAlice, 1, 0, 100 * kMs));
  gate.beat();
  CommandRecord other = command(kAlice, 1, 0, 500 * kMs, 9);
  other.torque_n_m = {5, 5, 5};
  EXPECT_EQ(gate.ask(other).at(0).torque_n_m[0], 0.1);
  gate.beat();
  EXPECT_EQ(in_window(gate), (Window{{0, 100 * kMs, 0.1}}));
}

TEST(CommandGate, repeats_every_kind_of_final_verdict) {
  GateHarness gate({make_craft(1, Frame::body, {0.25, 0, 1})});
  gate.run_until(50 * kMs);
  CommandRecord nan = command(kAlice, 1, 60 * kMs, 70 * kMs);
  nan.torque_n_m[0] = std::numeric_limits<double>::quiet_NaN();
  CommandRecord no_authority = command(kAlice, 4, 60 * kMs, 70 * kMs);
  no_authority.torque_n_m[1] = 1;
  const std::vector<CommandRecord> commands{nan, command(kAlice, 2, 70 * kMs, 60 * kMs),
                                            command(kAlice, 3, 10 * kMs, 20 * kMs), no_authority,
                                            command(kAlice, 5, 0, 90 * kMs)};
  std::vector<VerdictRecord> answers;
  for (const CommandRecord& c : commands) {
    gate.receive(c);
  }
  answers = gate.beat();
  ASSERT_EQ(answers.size(), commands.size());
  EXPECT_EQ(answers[0].reason, Reason::not_finite);
  EXPECT_EQ(answers[1].reason, Reason::bad_interval);
  EXPECT_EQ(answers[2].verdict, Verdict::expired);
  EXPECT_EQ(answers[3].reason, Reason::no_authority);
  EXPECT_EQ(answers[4].verdict, Verdict::clamped);
  gate.beat();
  for (std::size_t i = 0; i < commands.size(); ++i) {
    const auto again = gate.ask(commands[i]);
    ASSERT_EQ(again.size(), 1U);
    EXPECT_EQ(again[0], answers[i]);
  }
}

TEST(CommandGate, refuses_a_sequence_that_is_forgotten_or_was_passed_over_as_old) {
  GateHarness gate;
  for (std::uint64_t n = 2; n <= 60; n += 2) {
    gate.receive(command(kAlice, n, gate.now_ns(), gate.now_ns() + 100 * kMs));
    gate.beat();
  }
  for (const std::uint64_t sequence : {0U, 1U, 2U, 59U}) {
    const auto verdicts = gate.ask(command(kAlice, sequence, gate.now_ns(), 1000 * kMs));
    ASSERT_EQ(only(verdicts), Verdict::refused) << sequence;
    EXPECT_EQ(verdicts.front().reason, Reason::old_sequence) << sequence;
  }
  EXPECT_EQ(only(gate.ask(command(kAlice, 60, 0, 1))), Verdict::applied);
  EXPECT_TRUE(gate.beat().empty());
  EXPECT_EQ(in_window(gate).at(0).x, 6.0);
}

TEST(CommandGate, hears_no_sequence_number_zero) {
  GateHarness gate;
  EXPECT_EQ(gate.ask(command(kAlice, 0, 0, 100 * kMs)).at(0).reason, Reason::old_sequence);
  gate.beat();
  EXPECT_TRUE(in_window(gate).empty());
}

TEST(CommandGate, counts_sequences_by_commander_by_actuator_and_by_spacecraft) {
  GateHarness gate({make_craft(2), make_craft(1)});
  CommandRecord c = command(kAlice, 5, 0, 100 * kMs);
  gate.receive(c);
  c.sequence = 1;
  c.actuator = 1;
  gate.receive(c);
  c.spacecraft = 1;
  c.actuator = 0;
  gate.receive(c);
  const auto verdicts = gate.beat();
  ASSERT_EQ(verdicts.size(), 3U);
  for (const VerdictRecord& v : verdicts) {
    EXPECT_EQ(v.verdict, Verdict::applied);
  }
  EXPECT_EQ(gate.window(0, 0).intervals, 1U);
  EXPECT_EQ(gate.window(0, 1).intervals, 1U);
  EXPECT_EQ(gate.window(1, 0).intervals, 1U);
}

TEST(CommandGate, keeps_commanders_apart_whose_numbers_interleave) {
  GateHarness gate;
  const CommanderId alike{1, 1};  // differs from Alice in the high word alone
  gate.receive(command(kAlice, 10, 0, 100 * kMs));
  gate.receive(command(kBob, 3, 10 * kMs, 100 * kMs));
  gate.receive(command(alike, 1, 20 * kMs, 100 * kMs));
  gate.receive(command(kAlice, 11, 30 * kMs, 100 * kMs));
  gate.receive(command(kBob, 4, 40 * kMs, 100 * kMs));
  const auto verdicts = gate.run_until(100 * kMs);
  EXPECT_EQ(story(verdicts, kAlice, 10), (Verdicts{Verdict::applied}));
  for (const auto& [who, sequence] :
       {std::pair{kBob, 3U}, {alike, 1U}, {kAlice, 11U}, {kBob, 4U}}) {
    EXPECT_EQ(story(verdicts, who, sequence), (Verdicts{Verdict::accepted, Verdict::applied}));
  }
}

// ---- schedule
// ------------------------------------------------------------------------------------

TEST(CommandGate, a_newer_command_overrides_from_its_own_start) {
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

TEST(CommandGate, a_newer_command_supersedes_what_would_begin_after_it) {
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

TEST(CommandGate, says_at_which_step_a_command_was_superseded) {
  GateHarness gate;
  gate.receive(command(kAlice, 1, 90 * kMs, 95 * kMs));
  gate.run_until(40 * kMs);
  const auto verdicts = gate.ask(command(kAlice, 2, 80 * kMs, 85 * kMs));
  ASSERT_EQ(story(verdicts, kAlice, 1), (Verdicts{Verdict::superseded}));
  EXPECT_EQ(verdicts[0].step, 4U);
  EXPECT_EQ(verdicts[0].time_ns, 40 * kMs);
}

TEST(CommandGate, a_newer_command_cuts_one_that_waits_and_begins_earlier) {
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

TEST(CommandGate, two_commands_for_the_same_beat_leave_the_newer_in_force) {
  GateHarness gate;
  gate.receive(command(kAlice, 1, kStartAtNextBeat, 100 * kMs));
  gate.receive(command(kAlice, 2, kStartAtNextBeat, 100 * kMs));
  const auto verdicts = gate.beat();
  EXPECT_EQ(story(verdicts, kAlice, 1), (Verdicts{Verdict::superseded}));
  EXPECT_EQ(story(verdicts, kAlice, 2), (Verdicts{Verdict::applied}));
  EXPECT_EQ(in_window(gate), (Window{{0, 100 * kMs, 0.2}}));
}

TEST(CommandGate, flies_a_profile_of_consecutive_commands_to_the_nanosecond) {
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

TEST(CommandGate, lets_64_wait_on_an_actuator_and_refuses_the_65th) {
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

TEST(CommandGate, an_override_is_heard_although_64_wait) {
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

// ---- arbitration
// ---------------------------------------------------------------------------------

TEST(CommandGate, a_higher_priority_that_waits_holds_the_actuator) {
  GateHarness gate;
  gate.receive(command(kBob, 1, 80 * kMs, 90 * kMs, 5));
  gate.take();
  EXPECT_EQ(only(gate.ask(command(kAlice, 1, 0, 20 * kMs, 4))), Verdict::outranked);
  EXPECT_EQ(only(gate.ask(command(kAlice, 2, 100 * kMs, 120 * kMs, 4))), Verdict::outranked);
  EXPECT_EQ(gate.counters().refused, 2U);
  gate.beat();
  EXPECT_TRUE(in_window(gate).empty());
}

TEST(CommandGate, outranks_what_waits_below_and_lets_what_is_in_force_run_to_the_higher_start) {
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

TEST(CommandGate, outranks_a_lower_one_that_waits_for_an_earlier_start) {
  GateHarness gate;
  gate.receive(command(kAlice, 1, 40 * kMs, 45 * kMs));
  gate.take();
  const auto verdicts = gate.ask(command(kBob, 1, 80 * kMs, 90 * kMs, 1));
  EXPECT_EQ(story(verdicts, kAlice, 1), (Verdicts{Verdict::outranked}));
}

TEST(CommandGate, hears_the_newest_among_equals) {
  GateHarness gate;
  gate.receive(command(kAlice, 50, 0, 100 * kMs, 3));
  gate.beat();
  gate.receive(command(kBob, 1, 15 * kMs, 100 * kMs, 3));
  gate.beat();
  EXPECT_EQ(in_window(gate), (Window{{0, 15 * kMs, 5.0}, {15 * kMs, 100 * kMs, 0.1}}));
}

TEST(CommandGate, a_commander_may_not_undercut_its_own_higher_command) {
  GateHarness gate;
  gate.receive(command(kAlice, 1, 0, 100 * kMs, 3));
  gate.beat();
  EXPECT_EQ(only(gate.ask(command(kAlice, 2, 20 * kMs, 30 * kMs, 2))), Verdict::outranked);
}

TEST(CommandGate, orders_the_whole_range_of_priorities) {
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

TEST(CommandGate, hears_the_next_in_rank_at_the_very_beat_at_which_the_higher_has_ended) {
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

TEST(CommandGate, does_not_let_a_rank_on_one_actuator_hold_another) {
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
