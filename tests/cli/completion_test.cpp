// The script is sourced by a real bash, and asked as the shell would ask it.

#include "tests/cli/client.hpp"

namespace adstar::testing {
namespace {

std::string completed(const std::string& words) {
  return shell("source <($ADSTAR completion bash); compopt() { :; }; COMP_WORDS=(" + words +
               "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _adstar; echo \"${COMPREPLY[*]}\"")
      .out;
}

TEST(Completion, is_a_script_that_bash_accepts) {
  const Outcome outcome = shell("$ADSTAR completion bash | bash -n");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const Outcome script = client({"completion", "bash"});
  EXPECT_EQ(script.code, 0);
  expect_golden("completion_bash", script.out);
}

TEST(Completion, offers_verbs_first) {
  EXPECT_EQ(completed("adstar ''"),
            "propagate check trade reproduce torque wheel dipole fire joint monitor list timing "
            "dashboard replay step pause resume reset set-state set-inertia set-target record "
            "export plot "
            "completion --help -h --version\n");
  EXPECT_EQ(completed("adstar pro"), "propagate\n");
}

TEST(Completion, offers_the_options_of_the_verb) {
  EXPECT_EQ(completed("adstar propagate --d"), "--duration\n");
  EXPECT_EQ(completed("adstar torque --p"), "--profile --priority --partition\n");
}

TEST(Completion, offers_schemes_and_formats) {
  EXPECT_EQ(completed("adstar propagate --scheme coadjoint_m"),
            "coadjoint_midpoint2 coadjoint_midpoint2_float\n");
  EXPECT_EQ(completed("adstar propagate --scheme free"), "free_exact\n");
  EXPECT_EQ(completed("adstar monitor --format j"), "json\n");
}

TEST(Completion, offers_scene_files_for_scenes) {
  EXPECT_EQ(completed("adstar check configs/scenes/paper"),
            "configs/scenes/paper_forced.toml configs/scenes/paper_free.toml\n");
  EXPECT_EQ(completed("adstar check configs/scenes/slew"), "\n");
}

TEST(Completion, offers_nothing_where_a_free_value_is_due) {
  EXPECT_EQ(completed("adstar propagate --duration ''"), "\n");
}

}  // namespace
}  // namespace adstar::testing
