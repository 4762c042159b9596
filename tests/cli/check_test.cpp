#include <regex>

#include "tests/cli/client.hpp"

namespace adstar::testing {
namespace {

class CheckOf : public ::testing::TestWithParam<const char*> {};

TEST_P(CheckOf, a_good_scene_says_what_is_modelled_and_what_is_left_out) {
  const std::string name = GetParam();
  const std::string directory = name == "mixed" || name == "too_fast" ? "tests/cli/scenes/"  //
                                                                      : "configs/scenes/";
  const Outcome outcome = client({"check", directory + name + ".toml"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.err, "");
  // What it measures is another number every time.
  expect_golden("check_" + name,
                std::regex_replace(outcome.out, std::regex(R"( +[+-]?\d+ ns\n)"), " # ns\n"));
}

INSTANTIATE_TEST_SUITE_P(AllScenes, CheckOf,
                         ::testing::Values("demo", "fleet", "lockstep", "paper_free",
                                           "paper_forced", "damped", "profile_table", "mixed",
                                           "too_fast", "wheels", "space", "ros2"),
                         [](const auto& the) { return std::string(the.param); });

TEST(Check, a_wrong_scene_is_refused_with_all_its_faults_at_once) {
  const Outcome outcome = client({"check", "tests/cli/scenes/wrong.toml"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.out, "");
  expect_golden("check_wrong", outcome.err);
}

}  // namespace
}  // namespace adstar::testing
