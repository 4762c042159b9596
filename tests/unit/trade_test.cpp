// The parts of `adstar trade`: which steps, which truth, what a point says, which is the cheapest.
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "adstar/integrators/all.hpp"
#include "service/plot/plot.hpp"
#include "service/plot/ticks.hpp"
#include "service/scene/scene.hpp"
#include "service/trade/campaign.hpp"
#include "service/trade/front.hpp"
#include "service/trade/grid.hpp"
#include "service/trade/stability_map.hpp"
#include "service/trade/truth.hpp"

namespace adstar::trade {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
const Progress kGoOn = [](double) { return true; };

scene::Scene scene_of(const std::string& file) {
  return scene::load(std::string(ADSTAR_SOURCE_DIR) + "/configs/scenes/" + file);
}

/// The end of a case of tests/reference/reference.csv.
Quat<Wide> reference(const std::string& name) {
  std::ifstream file(ADSTAR_SOURCE_DIR "/tests/reference/reference.csv");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with(name + ",")) {
      std::stringstream cells(line);
      std::string cell;
      std::getline(cells, cell, ',');
      std::getline(cells, cell, ',');
      Quat<Wide> q;
      for (Wide* part : {&q.w, &q.x, &q.y, &q.z}) {
        std::getline(cells, cell, ',');
        *part = std::stold(cell);
      }
      return q;
    }
  }
  ADD_FAILURE() << name << " is not in reference.csv";
  return {};
}

TEST(Truth, is_the_independent_reference_of_the_papers_body_free_and_forced) {
  for (const std::string name : {"paper_free", "paper_forced"}) {
    const Truth truth = find_truth(scene_of(name + ".toml").spacecraft,
                                   {50 * kSecond, 100 * kSecond}, 1e-14, kGoOn);
    ASSERT_EQ(truth.spacecraft.size(), 1U);
    // The reference begins at the decimal inertia and rate, the library at their doubles.
    EXPECT_LT(static_cast<double>(angle_between(truth.spacecraft[0][1].q_IB, reference(name))),
              1e-13)
        << name;
    EXPECT_LE(truth.uncertainty_rad, 1e-14) << name;
  }
}

TEST(Truth, ends_when_it_is_told_to) {
  EXPECT_THROW(find_truth(scene_of("paper_forced.toml").spacecraft, {100 * kSecond}, 1e-14,
                          [](double) { return false; }),
               Interrupted);
}

TEST(Grid, looks_at_ten_instants_that_end_with_the_horizon) {
  const auto instants = instants_of(100 * kSecond);
  ASSERT_EQ(instants.size(), 10U);
  EXPECT_EQ(instants.front(), 10 * kSecond);
  EXPECT_EQ(instants.back(), 100 * kSecond);
  EXPECT_EQ(instants_of(7).size(), 7U) << "seven nanoseconds have no ten parts";
  EXPECT_EQ(instants_of(11).size(), 1U) << "and eleven only one";
}

TEST(Grid, tries_steps_of_round_digits_that_fit_the_instants_and_the_turn) {
  const auto spacecraft = scene_of("paper_free.toml").spacecraft;
  const auto instants = instants_of(100 * kSecond);
  const auto steps = steps_of(spacecraft, instants);
  const double fastest = fastest_rad_s(spacecraft);
  EXPECT_GT(fastest, std::sqrt(0.45549 * 0.45549 + 0.82623 * 0.82623) - 1e-12);
  ASSERT_GT(steps.size(), 10U);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    EXPECT_EQ(instants.front() % steps[i], 0);
    EXPECT_LE(fastest * static_cast<double>(steps[i]) * 1e-9, 6);
    EXPECT_GE(fastest * static_cast<double>(steps[i]) * 1e-9, 3e-3);
    EXPECT_TRUE(i == 0 || steps[i] < steps[i - 1]);
  }
}

TEST(Grid, finds_a_step_for_a_body_at_rest) {
  auto spacecraft = scene_of("paper_free.toml").spacecraft;
  spacecraft[0].initial = make_state(Quat<double>{}, Vec3<double>{});
  EXPECT_EQ(steps_of(spacecraft, {10 * kSecond}).size(), 1U);
}

Measured point(const char* scheme, double cost, double error, bool resolved = true) {
  Measured m{scheme, 4, kSecond, {error, 0, 0, resolved}, {cost, cost, cost, {}}, false};
  return m;
}

TEST(Front, holds_what_nothing_beats_in_cost_and_error_at_once) {
  std::vector<Measured> points{point("cheap", 1, 1e-2), point("worse", 2, 1e-1),
                               point("good", 3, 1e-6), point("dear", 4, 1e-6),
                               point("silent", 0.5, 1e-9, false)};
  mark_front(points);
  const bool expected[] = {true, false, true, false, false};
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(points[i].on_front, expected[i]) << points[i].scheme;
  }
}

TEST(Front, never_holds_an_error_that_is_no_number) {
  std::vector<Measured> points{point("lost", 1, std::numeric_limits<double>::quiet_NaN())};
  mark_front(points);
  EXPECT_FALSE(points[0].on_front);
  EXPECT_FALSE(cheapest(points, 1, {}));
}

TEST(Cheapest, holds_the_accuracy_within_the_budget_of_a_step) {
  std::vector<Measured> points{point("cheap", 1, 1e-2), point("good", 3, 1e-6),
                               point("best", 9, 1e-12)};
  EXPECT_EQ(cheapest(points, 1e-3, {}), 1U);
  EXPECT_EQ(cheapest(points, 1e-8, {}), 2U);
  EXPECT_FALSE(cheapest(points, 1e-13, {}));
  points[1].step_ns = 2 * kSecond;  // six microseconds a step
  EXPECT_EQ(points[1].step_cost_us(), 6);
  EXPECT_FALSE(cheapest(points, 1e-3, 5.0));
  EXPECT_EQ(cheapest(points, 1e-3, 6.0), 1U);
}

TEST(Trade, measures_errors_that_fall_with_the_order_of_the_scheme) {
  const scene::Scene scene = scene_of("paper_forced.toml");
  Campaign campaign;
  campaign.horizon_ns = 10 * kSecond;
  campaign.schemes = {"coadjoint_midpoint2", "coadjoint_rk4"};
  campaign.steps_ns = {50'000'000, 25'000'000};
  campaign.effort = {1, 0, 1000};
  const Trade trade = run(scene, campaign, kGoOn);
  ASSERT_EQ(trade.points.size(), 4U);
  for (std::size_t i = 0; i < 4; i += 2) {
    const Measured &coarse = trade.points[i], &fine = trade.points[i + 1];
    EXPECT_NEAR(std::log2(coarse.errors.attitude_rad / fine.errors.attitude_rad), coarse.order,
                0.3);
    EXPECT_TRUE(fine.errors.resolved);
    EXPECT_GT(fine.cost.median_us, 0);
    EXPECT_LE(fine.cost.least_us, fine.cost.median_us);
    EXPECT_GE(fine.cost.most_us, fine.cost.median_us);
  }
}

TEST(Trade, offers_no_free_only_scheme_to_a_scene_with_torque) {
  const auto free = usable_schemes(scene_of("paper_free.toml"));
  const auto forced = usable_schemes(scene_of("paper_forced.toml"));
  EXPECT_LT(forced.size(), free.size());
  for (const std::string& name : forced) {
    EXPECT_FALSE(claims_of(name).free_only) << name;
  }
}

TEST(Standing, of_a_step_is_by_its_error_unless_it_was_reported) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(judge(1e-15, 1e-6, false), Standing::exact);
  EXPECT_EQ(judge(1e-8, 1e-4, false), Standing::accurate);
  EXPECT_EQ(judge(1e-2, 1.0, false), Standing::bounded);
  EXPECT_EQ(judge(0.2, 1.0, false), Standing::wrong);
  EXPECT_EQ(judge(0.2, 1e6, false), Standing::wrong) << "a large turn is no licence";
  EXPECT_EQ(judge(nan, 1.0, false), Standing::wrong);
  EXPECT_EQ(judge(nan, 1.0, true), Standing::reported);
  EXPECT_EQ(judge(0.0, 1.0, true), Standing::reported);
}

std::vector<std::string> all_schemes() {
  std::vector<std::string> schemes;
  for (const std::string_view name : scheme_names()) {
    schemes.emplace_back(name);
  }
  return schemes;
}

void expect_nobody_wrong_in_silence(const Extremity& extremity) {
  const StabilityMap map = map_stability(all_schemes(), {extremity}, kGoOn);
  ASSERT_EQ(map.charts.size(), 1U);
  ASSERT_EQ(map.charts[0].cells.size(), extremity.columns.size() * map.schemes.size());
  for (const MapCell& cell : map.charts[0].cells) {
    EXPECT_NE(cell.worst(), Standing::wrong) << cell.scheme << " at " << cell.column << ": "
                                             << cell.worst_rad << " rad, " << cell.worst_case;
    int spoke = 0;
    for (const int count : cell.detectors) {
      spoke += count;
    }
    EXPECT_GE(spoke, cell.reported()) << "every report names what spoke";
  }
  EXPECT_LT(map.uncertainty_rad, 1e-9);
}

TEST(StabilityMap, finds_nobody_wrong_in_silence_up_to_twenty_radians_a_step) {
  expect_nobody_wrong_in_silence(extremes_by_turn({1e-9, 1e-3, 0.1, 1, 5, 20}, Detail::thin));
}

TEST(StabilityMap, finds_nobody_wrong_in_silence_under_torques_of_any_size) {
  expect_nobody_wrong_in_silence(
      extremes_by_torque({1e-12, 1e-9, 1e-6, 1e-3, 1, 1e3, 1e6}, Detail::thin));
}

TEST(StabilityMap, finds_nobody_wrong_in_silence_at_rest_nor_at_the_ends_of_the_range_nor_damped) {
  expect_nobody_wrong_in_silence(peculiar_extremes(Detail::thin));
}

TEST(StabilityMap, sees_the_closed_form_at_round_off_and_a_coarse_step_above_it) {
  const StabilityMap map = map_stability({"free_exact", "coadjoint_midpoint2"},
                                         {extremes_by_turn({0.03}, Detail::thin)}, kGoOn);
  const std::vector<MapCell>& cells = map.charts[0].cells;
  EXPECT_EQ(cells[0].worst(), Standing::exact);
  EXPECT_GT(cells[1].worst_rad, 1e-7);
  EXPECT_NE(cells[1].worst_case, "");
  EXPECT_NE(table(map).find("coadjoint_midpoint2"), std::string::npos);
  EXPECT_NE(picture(map).find("wrong in silence"), std::string::npos);
}

TEST(StabilityMap, says_which_detector_spoke) {
  const StabilityMap map =
      map_stability({"coadjoint_rk4"},
                    {extremes_by_turn({20}, Detail::thin), peculiar_extremes(Detail::thin)}, kGoOn);
  const auto spoke = [&](const std::string& column, Detector detector) {
    for (const Chart& chart : map.charts) {
      for (const MapCell& cell : chart.cells) {
        if (cell.column == column) {
          return cell.detectors[static_cast<std::size_t>(detector)];
        }
      }
    }
    ADD_FAILURE() << "no column " << column;
    return 0;
  };
  EXPECT_GT(spoke("20", Detector::light_axis), 0) << "a needle";
  EXPECT_GT(spoke("20", Detector::separatrix), 0);
  EXPECT_GT(spoke("1e+150", Detector::turn), 0);
  EXPECT_GT(spoke("hc/J 1000", Detector::damping), 0);
  EXPECT_GT(spoke("200 edges", Detector::edges), 0);
  EXPECT_NE(json(map).find("\"edges\": 6"), std::string::npos);
}

TEST(Ticks, rule_an_axis_evenly_or_by_decades) {
  using plot::Scale;
  const plot::Ruling even = plot::rule(Scale::linear, {0.3, 9.7}, 10);
  EXPECT_EQ(even.range.least, 0);
  EXPECT_EQ(even.range.most, 10);
  EXPECT_EQ(even.ticks.size(), 11U);
  EXPECT_EQ(even.ticks[3].label, "3");
  const plot::Ruling decades = plot::rule(Scale::log, {2e-6, 3e-2}, 9);
  EXPECT_EQ(decades.ticks.front().label, "10⁻⁶");
  EXPECT_EQ(decades.ticks.back().label, "10⁻¹");
  const plot::Ruling flat = plot::rule(Scale::linear, {5, 5}, 10);
  EXPECT_LT(flat.range.least, 5);
  EXPECT_GT(flat.range.most, 5);
}

TEST(Plot, leaves_out_what_it_cannot_show_and_escapes_what_it_writes) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::string text =
      plot::svg("a < b", {{"p & q",
                           {"x", plot::Scale::log},
                           {"y", plot::Scale::log},
                           {{"s", {{1, 1}, {2, nan}, {-1, 2}, {3, 0}, {10, 10}}, true}},
                           0}});
  EXPECT_NE(text.find("a &lt; b"), std::string::npos);
  EXPECT_NE(text.find("p &amp; q"), std::string::npos);
  EXPECT_EQ(text.find("nan"), std::string::npos);
  EXPECT_EQ(text.find("inf"), std::string::npos);
  const auto count = [&](const std::string& what) {
    int n = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) {
      ++n;
    }
    return n;
  };
  EXPECT_EQ(count("<circle"), 3) << "two points and the legend";
}

}  // namespace
}  // namespace adstar::trade
