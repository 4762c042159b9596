#include <algorithm>
#include <array>
#include <cmath>

#include "tests/cli/client.hpp"

namespace adstar::testing {
namespace {

namespace fs = std::filesystem;

using Attitude = std::array<double, 4>;

Attitude attitude_in(const std::string& row, std::size_t first) {
  const auto fields = fields_of(row);
  Attitude q{};
  for (std::size_t i = 0; i < 4; ++i) {
    q[i] = std::stod(fields.at(first + i));
  }
  return q;
}

/// The rotation between two attitudes; from the vector part, which keeps small angles.
double angle_between(const Attitude& a, const Attitude& b) {
  const double w = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
  const double x = a[0] * b[1] - a[1] * b[0] - a[2] * b[3] + a[3] * b[2];
  const double y = a[0] * b[2] - a[2] * b[0] - a[3] * b[1] + a[1] * b[3];
  const double z = a[0] * b[3] - a[3] * b[0] - a[1] * b[2] + a[2] * b[1];
  return 2 * std::atan2(std::sqrt(x * x + y * y + z * z), std::fabs(w));
}

Attitude end_of(const std::string& scene, const std::string& step) {
  const Outcome outcome = client(
      {"propagate", "configs/scenes/" + scene + ".toml", "--duration", "100s", "--step", step});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  return attitude_in(lines_of(outcome.out).back(), 3);
}

Attitude reference_of(const std::string& scene) {
  const fs::path file = fs::path(ADSTAR_SOURCE_DIR) / "tests/reference/reference.csv";
  for (const std::string& line : lines_of(read_text(file))) {
    if (line.starts_with(scene + ",")) {
      return attitude_in(line, 2);
    }
  }
  ADD_FAILURE() << scene << " is not in " << file;
  return {};
}

class PaperCase : public ::testing::TestWithParam<const char*> {};

TEST_P(PaperCase, ends_within_1e_9_rad_of_the_reference) {
  EXPECT_LT(angle_between(end_of(GetParam(), "10ms"), reference_of(GetParam())), 1e-9);
}

TEST_P(PaperCase, converges_with_order_four) {
  const Attitude truth = reference_of(GetParam());
  const double order = std::log2(angle_between(end_of(GetParam(), "12.5ms"), truth) /
                                 angle_between(end_of(GetParam(), "6.25ms"), truth));
  EXPECT_NEAR(order, 4, 0.15);
}

TEST_P(PaperCase, prints_golden_rows) {
  const Outcome outcome = client(
      {"propagate", std::string("configs/scenes/") + GetParam() + ".toml", "--every", "25s"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.err, "");
  expect_golden(std::string("propagate_") + GetParam(), outcome.out);
}

INSTANTIATE_TEST_SUITE_P(Both, PaperCase, ::testing::Values("paper_free", "paper_forced"),
                         [](const auto& the) { return std::string(the.param); });

TEST(Propagate, without_every_prints_the_initial_state_and_the_end) {
  const auto lines =
      lines_of(client({"propagate", "configs/scenes/paper_free.toml", "--duration", "20ms"}).out);
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[1].find("paper_free,0,0,1,0,0,0,"), 0U) << lines[1];
  EXPECT_EQ(lines[2].find("paper_free,2,0.02,"), 0U) << lines[2];
}

TEST(Propagate, rows_are_time_major_and_the_end_is_there_once) {
  const auto lines = lines_of(
      client({"propagate", "tests/cli/scenes/mixed.toml", "--duration", "100ms", "--every", "40ms"})
          .out);
  std::vector<std::string> heads;
  for (const std::string& line : lines) {
    const auto fields = fields_of(line);
    EXPECT_EQ(fields.size(), 18U);
    heads.push_back(fields[0] + " " + fields[1] + " " + fields[2]);
  }
  const std::vector<std::string> expected{"spacecraft step time_s",
                                          "spinner 0 0",
                                          "sat0 0 0",
                                          "sat1 0 0",
                                          "sat2 0 0",
                                          "spinner 2 0.04",
                                          "sat0 2 0.04",
                                          "sat1 2 0.04",
                                          "sat2 2 0.04",
                                          "spinner 4 0.08",
                                          "sat0 4 0.08",
                                          "sat1 4 0.08",
                                          "sat2 4 0.08",
                                          "spinner 5 0.1",
                                          "sat0 5 0.1",
                                          "sat1 5 0.1",
                                          "sat2 5 0.1"};
  EXPECT_EQ(heads, expected);
}

TEST(Propagate, says_once_that_commanded_actuators_rest) {
  const Outcome outcome =
      client({"propagate", "tests/cli/scenes/mixed.toml", "--duration", "20ms"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(
      outcome.err,
      "adstar propagate: nobody commands 'body' of 'sat0' and 5 more here; to command it, run "
      "adstard, and `adstar torque`, `wheel`, `dipole`, `fire` or `joint`\n");
}

TEST(Propagate, warns_of_spacecraft_that_no_sub_step_could_follow) {
  const Outcome outcome = client({"propagate", "tests/cli/scenes/too_fast.toml"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(lines_of(outcome.out).size(), 5U);
  EXPECT_EQ(
      outcome.err,
      "adstar propagate: 1 of 2 spacecraft (top) turned further in 1s than 2 sub-steps of "
      "0.7 rad reach, first in the step to 1 s: their rows are not to be trusted; take a shorter "
      "--step, or raise simulation.substep_limit\n");
}

TEST(Propagate, step_and_scheme_override_the_scene) {
  const std::string scene = "configs/scenes/paper_free.toml";
  const auto fine = lines_of(client({"propagate", scene, "--step", "5ms"}).out).back();
  const auto other =
      lines_of(client({"propagate", scene, "--scheme", "coadjoint_midpoint2"}).out).back();
  const auto own = lines_of(client({"propagate", scene}).out).back();
  EXPECT_EQ(fine.find("paper_free,20000,100,"), 0U) << fine;
  EXPECT_EQ(own.find("paper_free,10000,100,"), 0U) << own;
  EXPECT_NE(other, own);
}

TEST(Propagate, threads_change_no_digit) {
  const std::vector<std::string> one{"propagate", "configs/scenes/fleet.toml", "--duration", "1s"};
  std::vector<std::string> three = one;
  three.insert(three.end(), {"--threads", "3"});
  const Outcome alone = client(one), together = client(three);
  EXPECT_EQ(together.code, 0) << together.err;
  EXPECT_GT(alone.out.size(), 1'000'000U);
  EXPECT_TRUE(together.out == alone.out);
}

TEST(Propagate, numbers_read_back_as_the_same_doubles) {
  const auto lines =
      lines_of(client({"propagate", "configs/scenes/paper_forced.toml", "--every", "10s"}).out);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const auto fields = fields_of(lines[i]);
    for (std::size_t k = 3; k < fields.size(); ++k) {
      char again[40];
      std::snprintf(again, sizeof again, "%.17g", std::stod(fields[k]));
      EXPECT_EQ(fields[k], again);
    }
  }
}

TEST(Propagate, output_file_holds_what_stdout_would_and_nothing_else_is_left) {
  const Scratch scratch;
  const std::string scene = "configs/scenes/profile_table.toml";
  const Outcome to_file =
      client({"propagate", scene, "--every", "1s", "--output", (scratch / "run.csv").string()});
  EXPECT_EQ(to_file.code, 0) << to_file.err;
  EXPECT_EQ(to_file.out, "");
  EXPECT_EQ(read_text(scratch / "run.csv"), client({"propagate", scene, "--every", "1s"}).out);
  EXPECT_EQ(std::distance(fs::directory_iterator(scratch.path()), {}), 1);
}

TEST(Propagate, output_into_a_missing_directory_fails_before_the_run) {
  const Outcome outcome =
      client({"propagate", "configs/scenes/paper_free.toml", "--output", "/nonexistent/run.csv"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcome.err,
            "adstar propagate: cannot write '/nonexistent/run.csv': No such file or directory; "
            "choose a directory that you may write to\n");
}

TEST(Propagate, a_full_disk_is_an_error) {
  const Outcome outcome =
      client({"propagate", "configs/scenes/paper_free.toml", "--output", "/dev/full"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("No space left on device"), std::string::npos) << outcome.err;
}

TEST(Propagate, a_reader_that_goes_early_is_no_error) {
  const Outcome outcome = shell(
      "set -o pipefail; $ADSTAR propagate configs/scenes/paper_free.toml --every 10ms | head -n 2 "
      ">/dev/null; echo ${PIPESTATUS[0]}");
  EXPECT_EQ(outcome.out, "0\n");
  EXPECT_EQ(outcome.err, "");
}

TEST(Propagate, an_interrupted_run_leaves_no_file_behind) {
  const Scratch scratch;
  Process process(client_argv({"propagate", "configs/scenes/paper_free.toml", "--duration",
                               "10000000s", "--output", (scratch / "run.csv").string()}),
                  {ADSTAR_SOURCE_DIR, {}});
  // The handler is in place before the temporary file is.
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (fs::is_empty(scratch.path()) && std::chrono::steady_clock::now() < until) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  process.send(SIGINT);
  EXPECT_EQ(process.wait(std::chrono::seconds(20)), 1);
  EXPECT_NE(process.err().find("interrupted at "), std::string::npos) << process.err();
  EXPECT_TRUE(fs::is_empty(scratch.path()));
}

}  // namespace
}  // namespace adstar::testing
