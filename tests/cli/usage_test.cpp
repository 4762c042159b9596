// Every wrong command line: its words and its exit code.

#include <filesystem>
#include <fstream>

#include "tests/cli/client.hpp"

namespace adstar::testing {
namespace {

const char* const kFree = "configs/scenes/paper_free.toml";
const char* const kDemo = "configs/scenes/demo.toml";

struct Wrong {
  std::vector<std::string> arguments;
};

TEST(Usage, every_wrong_command_line_is_refused_in_golden_words) {
  const std::vector<Wrong> all{
      {{}},
      {{"--durtion"}},
      {{"propagat", kFree}},
      {{"frobnicate"}},
      {{"propagate"}},
      {{"propagate", kFree, "--durtion", "5s"}},
      {{"propagate", kFree, "extra"}},
      {{"propagate", kFree, "--duration"}},
      {{"propagate", kFree, "--duration", "5"}},
      {{"propagate", kFree, "--duration", "soon"}},
      {{"propagate", kFree, "--duration", "0s"}},
      {{"propagate", kFree, "--duration", "-5s"}},
      {{"propagate", kFree, "--duration", "5.005s"}},
      {{"propagate", kFree, "--duration", "3ms"}},
      {{"propagate", kFree, "--step", "30ms"}},
      {{"propagate", kFree, "--step", "0.5ns"}},
      {{"propagate", kFree, "--every", "15ms"}},
      {{"propagate", kFree, "--scheme", "coadjoint_rk"}},
      {{"propagate", kFree, "--scheme", "euler"}},
      {{"propagate", kDemo}},
      {{"propagate", "configs/scenes/paper_fre.toml"}},
      {{"check"}},
      {{"check", "configs/scenes/dem.toml"}},
      {{"torque"}},
      {{"torque", "sat1"}},
      {{"torque", "sat 1", "--torque-n-m", "0", "0", "1", "--for", "1s"}},
      {{"torque", "sat1", "--torque-n-m", "0", "0"}},
      {{"torque", "sat1", "--torque-n-m", "0", "0", "x", "--for", "1s"}},
      {{"torque", "sat1", "--torque-n-m", "0", "0", "1"}},
      {{"torque", "sat1", "--torque-n-m", "0", "0", "1", "--for", "1s", "--until", "2s"}},
      {{"torque", "sat1", "--torque-n-m", "0", "0", "1", "--profile", "p.csv"}},
      {{"torque", "sat1", "--profile", "tests/cli/scenes/none.csv"}},
      {{"torque", "sat1", "--profile", "tests/cli/scenes/wrong.csv"}},
      {{"torque", "sat1", "--profile", "tests/cli/scenes/one_row.csv"}},
      {{"torque", "sat1", "--profile", "tests/cli/scenes/good.csv", "--for", "1s"}},
      {{"torque", "sat1", "--torque-n-m", "0", "0", "1", "--for", "1s", "--priority", "high"}},
      {{"monitor", "--format", "xml"}},
      {{"monitor", "--samples", "0"}},
      {{"monitor", "--domain", "231"}},
      {{"list", "sat1"}},
      {{"completion"}},
      {{"completion", "zsh"}}};
  std::string said;
  for (const Wrong& wrong : all) {
    const Outcome outcome = client(wrong.arguments);
    said += "$ adstar";
    for (const std::string& argument : wrong.arguments) {
      said += argument.find(' ') == std::string::npos ? " " + argument : " '" + argument + "'";
    }
    said += "\n" + outcome.err + "=> " + std::to_string(outcome.code) + "\n\n";
    EXPECT_EQ(outcome.code, 2) << said;
    EXPECT_EQ(outcome.out, "") << said;
  }
  expect_golden("usage_errors", said);
}

TEST(Usage, an_interface_that_is_not_there_is_named_with_those_that_are) {
  const Outcome outcome = client({"list", "--interface", "nosuch0"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcome.err.find("adstar list: "), 0U) << outcome.err;
  EXPECT_NE(outcome.err.find("nosuch0"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("lo"), std::string::npos) << outcome.err;
}

/// A script must not take it for one whose bits were found the same.
TEST(Replay, of_a_run_that_left_nothing_to_compare_with_ends_with_a_code_of_its_own) {
  const Scratch home;
  std::filesystem::copy_file(std::filesystem::path(ADSTAR_SOURCE_DIR) / kFree, home / "scene.toml");
  std::ofstream(home / "run.json") << R"({"run": "1", "scene_file": "scene.toml", "service": "",
    "duration": "", "standby": false, "memory": "/dev/shm/adstar-none"})";
  const Outcome replay = client({"replay", home.path().string()});
  EXPECT_EQ(replay.code, 4) << replay.err;
  EXPECT_NE(replay.out.find("nothing to compare with"), std::string::npos) << replay.out;
}

}  // namespace
}  // namespace adstar::testing
