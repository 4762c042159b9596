#include "service/runtime/gate.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "tests/support/gate_talk.hpp"

namespace adstar::runtime {
namespace {

using test::command;
using test::GateHarness;
using test::in_window;
using test::kAlice;
using test::kBob;
using test::kMs;
using test::make_craft;
using test::only;
using test::story;
using test::Verdicts;
using test::Window;

// ---- the life of one command ----

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
  EXPECT_EQ(v.value, (std::array<double, 3>{0.1, 0, 0}));
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
  EXPECT_EQ(verdicts.front().value[0], 0.25);
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

// ---- identity ----

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
  other.value = {5, 5, 5};
  EXPECT_EQ(gate.ask(other).at(0).value[0], 0.1);
  gate.beat();
  EXPECT_EQ(in_window(gate), (Window{{0, 100 * kMs, 0.1}}));
}

TEST(CommandGate, repeats_every_kind_of_final_verdict) {
  GateHarness gate({make_craft(1, Frame::body, {0.25, 0, 1})});
  gate.run_until(50 * kMs);
  CommandRecord nan = command(kAlice, 1, 60 * kMs, 70 * kMs);
  nan.value[0] = std::numeric_limits<double>::quiet_NaN();
  CommandRecord no_authority = command(kAlice, 4, 60 * kMs, 70 * kMs);
  no_authority.value[1] = 1;
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

}  // namespace
}  // namespace adstar::runtime
