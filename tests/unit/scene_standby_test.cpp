// [standby]: the lead and the lease, and what cannot stand beside it.
#include <gtest/gtest.h>

#include "scene_text.hpp"

namespace adstar::scene {
namespace {

std::string with_standby(const std::string& keys, const std::string& more = "",
                         const std::string& simulation = "step = \"5ms\"") {
  return "[simulation]\n" + simulation + "\n[standby]\n" + keys + "\n" + more + kSpacecraft;
}

TEST(SceneStandby, is_for_those_who_name_it) {
  EXPECT_FALSE(parse(std::string("[simulation]\nstep = \"5ms\"\n") + kSpacecraft, "scene.toml")
                   .standby.has_value());
  const auto standby = parse(with_standby(""), "scene.toml").standby;
  ASSERT_TRUE(standby.has_value());
  EXPECT_EQ(standby->lead_steps, 4u);  // 20 ms
  EXPECT_EQ(standby->lease_ns, 100'000'000);
}

TEST(SceneStandby, counts_the_lead_in_steps) {
  const auto standby = parse(with_standby("lead = \"50ms\"\nlease = \"1s\""), "scene.toml").standby;
  EXPECT_EQ(standby->lead_steps, 10u);
  EXPECT_EQ(standby->lease_ns, 1'000'000'000);
  EXPECT_EQ(
      refusal(with_standby("lead = \"12ms\"")),
      "scene.toml:4:8: standby.lead: got \"12ms\", expected whole steps of 5ms, 2000 at most; "
      "try \"15ms\"");
}

TEST(SceneStandby, refuses_a_lease_that_a_healthy_primary_would_break) {
  EXPECT_EQ(refusal(with_standby("lease = \"5ms\"")),
            "scene.toml:4:9: standby.lease: got \"5ms\", expected 20ms at least: three beats, or a "
            "busy machine, are silent so long without being gone; try \"100ms\"");
  // A beat of 200 ms: the step, or a slow rate.
  for (const char* const simulation : {"step = \"200ms\"", "step = \"20ms\"\nrate = 0.1"}) {
    EXPECT_NE(refusal(with_standby("lease = \"500ms\"", "", simulation)).find("600ms at least"),
              std::string::npos);
    EXPECT_EQ(refusal(with_standby("lease = \"600ms\"", "", simulation)), "");
    EXPECT_EQ(parse(with_standby("", "", simulation), "scene.toml").standby->lease_ns,
              1'000'000'000);
  }
}

TEST(SceneStandby, refuses_what_a_standby_cannot_follow) {
  EXPECT_EQ(refusal(with_standby("", "", "step = \"5ms\"\npace = \"free\"")),
            "scene.toml:4:1: standby: got beside pace = \"free\", expected pace = \"clock\": only "
            "then a silence means something; try pace = \"clock\" in [simulation]");
  EXPECT_EQ(refusal(with_standby("", "[service]\nrun_control = true\n")),
            "scene.toml:3:1: standby: got beside run_control = true, expected commands alone to "
            "change a run that a standby follows; try run_control = false in [service]");
}

}  // namespace
}  // namespace adstar::scene
