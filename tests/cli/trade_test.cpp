// adstar trade and adstar reproduce, as a user runs them. Costs differ from run to run; what they
// say about accuracy does not.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include <nlohmann/json.hpp>

#include "tests/cli/client.hpp"

namespace adstar::testing {
namespace {

const std::vector<std::string> kFew = {
    "trade",     "configs/scenes/paper_forced.toml",  "--horizon", "10s",
    "--schemes", "coadjoint_rk4,coadjoint_fehlberg8", "--steps",   "100ms,500ms"};

std::vector<std::string> few_and(std::vector<std::string> more) {
  more.insert(more.begin(), kFew.begin(), kFew.end());
  return more;
}

TEST(TradeVerb, says_for_machines_what_every_point_costs_and_holds) {
  const Outcome outcome = client(few_and({"--format", "json"}));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto trade = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(trade["horizon_s"], 10.0);
  EXPECT_LE(trade["reference_uncertainty_rad"], 1e-14);
  ASSERT_EQ(trade["points"].size(), 4U);
  std::map<std::string, double> error;
  for (const auto& point : trade["points"]) {
    EXPECT_GT(point["cost_us_per_simulated_s"]["median"], 0);
    EXPECT_TRUE(point["resolved"]);
    error[point["scheme"].get<std::string>() + point["step_s"].dump()] =
        point["attitude_error_rad"];
  }
  EXPECT_LT(error["coadjoint_rk40.1"], error["coadjoint_rk40.5"]);
  EXPECT_LT(error["coadjoint_fehlberg80.5"], error["coadjoint_rk40.1"]);
  EXPECT_LT(error["coadjoint_fehlberg80.1"], 1e-13);
}

TEST(TradeVerb, answers_with_two_lines_that_a_scene_takes) {
  const Outcome outcome = client(few_and({"--accuracy", "1e-6rad"}));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::size_t at = outcome.out.find("\nstep = \"");
  ASSERT_NE(at, std::string::npos) << outcome.out;
  const std::string lines = outcome.out.substr(at + 1);
  const std::filesystem::path file = std::filesystem::temp_directory_path() /
                                     ("adstar_trade_" + std::to_string(getpid()) + ".toml");
  std::ofstream(file) << "[simulation]\n"
                      << lines
                      << "[[spacecraft]]\nname = \"a\"\ninertia_body_kg_m2 = [1.0, 1.1, 1.2]\n"
                         "angular_velocity_body_rad_s = [0.1, 0.0, 0.0]\n";
  const Outcome check = client({"check", file.string()});
  EXPECT_EQ(check.code, 0) << check.err;
  std::filesystem::remove(file);
}

TEST(TradeVerb, says_so_when_nothing_tried_is_good_enough) {
  const Outcome outcome = client(few_and({"--accuracy", "1e-19"}));
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("no scheme and step tried holds 1e-19 rad"), std::string::npos)
      << outcome.err;
}

TEST(TradeVerb, draws_what_it_measured) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() /
                                     ("adstar_trade_" + std::to_string(getpid()) + ".svg");
  const Outcome outcome = client(few_and({"--svg", file.string()}));
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const std::string svg = read_text(file);
  EXPECT_TRUE(svg.starts_with("<svg"));
  EXPECT_NE(svg.find("coadjoint_fehlberg8"), std::string::npos);
  std::filesystem::remove(file);
}

TEST(TradeVerb, refuses_what_it_cannot_do_and_says_what_it_could) {
  std::string said;
  const std::vector<std::vector<std::string>> wrong = {
      {"trade", "configs/scenes/paper_forced.toml", "--accuracy", "tight"},
      {"trade", "configs/scenes/paper_forced.toml", "--accuracy", "-1rad"},
      {"trade", "configs/scenes/paper_forced.toml", "--budget", "50us"},
      {"trade", "configs/scenes/paper_forced.toml", "--steps", "3s"},
      {"trade", "configs/scenes/paper_forced.toml", "--steps", "soon"},
      {"trade", "configs/scenes/paper_forced.toml", "--schemes", "coadjoint_rk5"},
      {"trade", "configs/scenes/paper_forced.toml", "--schemes", "free_exact"},
      {"propagate", "configs/scenes/paper_forced.toml", "--duration", "1s", "--scheme",
       "free_exact"},
      {"check", "tests/cli/scenes/free_only.toml"},
      {"trade"},
      {"trade", "--map", "--schemes", "coadjoint_rk5"},
      {"reproduce", "papers"},
      {"reproduce", "paper", "--step", "3s", "--duration", "10s"}};
  for (const auto& arguments : wrong) {
    const Outcome outcome = client(arguments);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    said += outcome.err;
  }
  expect_golden("trade_errors", said);
}

/// Columns of a CSV by name.
std::map<std::string, std::vector<double>> columns_of(const std::filesystem::path& file) {
  const std::vector<std::string> lines = lines_of(read_text(file));
  const std::vector<std::string> names = fields_of(lines.at(0));
  std::map<std::string, std::vector<double>> columns;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::vector<std::string> fields = fields_of(lines[i]);
    for (std::size_t j = 0; j < names.size(); ++j) {
      columns[names[j]].push_back(std::stod(fields.at(j)));
    }
  }
  return columns;
}

double largest(const std::vector<double>& values) {
  double most = 0;
  for (const double value : values) {
    most = std::fmax(most, std::fabs(value));
  }
  return most;
}

class PaperAt : public ::testing::TestWithParam<const char*> {};

TEST_P(PaperAt, this_step_shows_what_its_figures_claim) {
  const std::filesystem::path directory =
      std::filesystem::temp_directory_path() /
      (std::string("adstar_paper_") + GetParam() + "_" + std::to_string(getpid()));
  const Outcome outcome =
      client({"reproduce", "paper", "--step", GetParam(), "--output", directory.string()});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  auto turning = columns_of(directory / "figure_1.csv");
  EXPECT_NEAR(turning["omega_body_y_rad_s"][0], 0.82623, 1e-12);
  EXPECT_LT(
      *std::min_element(turning["omega_body_y_rad_s"].begin(), turning["omega_body_y_rad_s"].end()),
      -0.8)
      << "the paper's body tumbles: omega_y changes its sign";
  auto group = columns_of(directory / "figure_2.csv");
  for (const char* column :
       {"r_rt_x_minus_1", "r_rt_y_minus_1", "r_rt_z_minus_1", "det_r_minus_1"}) {
    EXPECT_LT(largest(group[column]), 1e-14) << column;
  }
  auto drift = columns_of(directory / "figure_3.csv");
  for (const std::string axis : {"x", "y", "z"}) {
    const auto of = [&](const std::string& scheme) {
      return largest(drift[scheme + "_momentum_drift_inertial_" + axis + "_n_m_s"]);
    };
    EXPECT_EQ(of("coadjoint_rk4"), 0) << axis;
    EXPECT_GT(of("rkmk4"), of("coadjoint_rk4")) << axis;
    EXPECT_GT(of("lie_newmark"), of("rkmk4")) << axis;
  }
  for (const char* figure : {"figure_1.svg", "figure_2.svg", "figure_3.svg"}) {
    EXPECT_TRUE(read_text(directory / figure).starts_with("<svg")) << figure;
  }
  std::filesystem::remove_all(directory);
}

INSTANTIATE_TEST_SUITE_P(EveryStepTried, PaperAt,
                         ::testing::Values("5ms", "10ms", "50ms", "100ms", "250ms", "1s"),
                         [](const auto& the) { return "h_" + std::string(the.param); });

}  // namespace
}  // namespace adstar::testing
