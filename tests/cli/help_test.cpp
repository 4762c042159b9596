#include <algorithm>

#include "tests/cli/client.hpp"

namespace adstar::testing {
namespace {

class HelpOf : public ::testing::TestWithParam<const char*> {};

TEST_P(HelpOf, the_verb_is_golden_and_has_an_example) {
  const Outcome outcome = client({GetParam(), "--help"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_NE(outcome.out.find("Example:\n  "), std::string::npos);
  expect_golden(std::string("help_") + GetParam(), outcome.out);
}

INSTANTIATE_TEST_SUITE_P(AllVerbs, HelpOf,
                         ::testing::Values("propagate", "check", "trade", "reproduce", "torque",
                                           "wheel", "dipole", "fire", "joint", "monitor", "list",
                                           "timing", "dashboard", "step", "pause", "resume",
                                           "reset", "set-state", "set-inertia", "set-target",
                                           "record", "export", "plot", "completion"),
                         [](const auto& the) {
                           std::string name = the.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(Help, of_the_program_is_golden) {
  const Outcome outcome = client({"--help"});
  EXPECT_EQ(outcome.code, 0);
  expect_golden("help", outcome.out);
}

TEST(Help, the_version_is_one_line) {
  const Outcome outcome = client({"--version"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out, "adstar " ADSTAR_VERSION "\n");
}

}  // namespace
}  // namespace adstar::testing
