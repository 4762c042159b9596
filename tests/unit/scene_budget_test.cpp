// [budget]: what a beat may take, and what is refused.
#include <gtest/gtest.h>

#include "scene_text.hpp"

namespace adstar::scene {
namespace {

std::string with_budget(const std::string& keys, const std::string& simulation = "step = \"1ms\"") {
  return "[simulation]\n" + simulation + "\n[budget]\n" + keys + "\n" + kSpacecraft;
}

TEST(SceneBudget, is_none_unless_it_is_named) {
  const Budget budget = parse(with_budget(""), "scene.toml").budget;
  EXPECT_EQ(budget.wake_up_ns, 0);
  EXPECT_EQ(budget.step_ns, 0);
  EXPECT_EQ(budget.on_overrun, Overrun::skip);
  EXPECT_TRUE(budget.refuse_at_start);
}

TEST(SceneBudget, is_read_part_by_part) {
  const Budget budget =
      parse(with_budget("wake_up = \"300us\"\ncommands = \"50us\"\nstep = \"500us\"\nhand_over = "
                        "\"100us\"\non_overrun = \"catch_up\"\ncatch_up_beats = 7\nadmission = "
                        "\"warn\""),
            "scene.toml")
          .budget;
  EXPECT_EQ(budget.wake_up_ns, 300'000);
  EXPECT_EQ(budget.commands_ns, 50'000);
  EXPECT_EQ(budget.step_ns, 500'000);
  EXPECT_EQ(budget.hand_over_ns, 100'000);
  EXPECT_EQ(budget.on_overrun, Overrun::catch_up);
  EXPECT_EQ(budget.catch_up_beats, 7);
  EXPECT_FALSE(budget.refuse_at_start);
}

TEST(SceneBudget, refuses_more_work_than_a_beat_holds) {
  EXPECT_EQ(refusal(with_budget("step = \"900us\"\nhand_over = \"200us\"")),
            "scene.toml:4:8: budget.step: got 1.1ms for commands, step and hand_over together, "
            "expected at most a beat, 1ms; try \"500us\"");
  EXPECT_NE(refusal(with_budget("step = \"900us\"", "step = \"1ms\"\nrate = 2.0"))
                .find("at most a beat, 500us"),
            std::string::npos)
      << "twice real time, half the beat";
  EXPECT_EQ(parse(with_budget("step = \"2ms\"", "step = \"1ms\"\npace = \"free\""), "scene.toml")
                .budget.step_ns,
            2'000'000);
}

TEST(SceneBudget, refuses_what_it_does_not_know) {
  EXPECT_EQ(
      refusal(with_budget("on_overrun = \"stop\"")),
      "scene.toml:4:14: budget.on_overrun: got \"stop\", expected one of skip, catch_up, halt; "
      "try \"skip\"");
  EXPECT_EQ(refusal(with_budget("catch_up_beats = 5")),
            "scene.toml:4:18: budget.catch_up_beats: got 5, expected no bound beside on_overrun = "
            "\"skip\" or \"halt\"; try removing it, or on_overrun = \"catch_up\"");
  EXPECT_NE(refusal(with_budget("steps = \"5us\"")).find("try step"), std::string::npos);
}

}  // namespace
}  // namespace adstar::scene
