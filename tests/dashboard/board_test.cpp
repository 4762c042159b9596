#include "service/dashboard/server/board.hpp"

#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "service/dashboard/server/frame_json.hpp"
#include "service/dashboard/server/metrics_text.hpp"
#include "service/dashboard/server/pulse.hpp"
#include "service/dds/convert.hpp"

namespace adstar::dashboard {
namespace {

using dds::set_text;
using Json = nlohmann::json;

const Clock::time_point kNow = Clock::now();

adstar_AttitudeState attitude(const char* spacecraft, std::uint64_t step = 7) {
  adstar_AttitudeState sample{};
  set_text(sample.spacecraft, spacecraft);
  set_text(sample.service, "fly");
  sample.step = step;
  sample.time_ns = 2'400'000'000;
  sample.attitude_body_to_inertial = {0.5, 0.5, -0.5, 0.5};
  sample.angular_velocity_body_rad_s = {0.1, 1.0 / 3, -0.3};
  return sample;
}

adstar_MomentumState momentum(const char* spacecraft) {
  adstar_MomentumState sample{};
  set_text(sample.spacecraft, spacecraft);
  set_text(sample.service, "fly");
  sample.step = 7;
  sample.momentum_inertial_n_m_s = {1, 2, 3};
  sample.momentum_body_n_m_s = {3, 2, 1};
  sample.energy_residual_j = 1e-17;
  sample.momentum_residual_inertial_n_m_s = {0, 3, 4};
  return sample;
}

adstar_ServiceStatus status(std::uint64_t step) {
  adstar_ServiceStatus sample{};
  set_text(sample.service, "fly");
  set_text(sample.pace, "clock");
  sample.step = step;
  sample.time_ns = 1'500'000'000;
  sample.worst_momentum_residual_relative = 2e-17;
  return sample;
}

adstar_CommandStatus verdict(std::uint64_t sequence, adstar_Verdict decided) {
  adstar_CommandStatus sample{};
  set_text(sample.spacecraft, "sat1");
  set_text(sample.actuator, "body");
  set_text(sample.service, "fly");
  sample.sequence_number = sequence;
  sample.verdict = decided;
  return sample;
}

/// A roster of two, and their fleet sample.
Board with_fleet() {
  Board board;
  char actuator[] = "body";
  char* actuators[] = {actuator};
  adstar_RosterEntry entries[2]{};
  set_text(entries[0].name, "cube0");
  set_text(entries[1].name, "cube1");
  entries[1].actuators._buffer = actuators;
  entries[1].actuators._length = 1;
  adstar_ServiceRoster roster{};
  set_text(roster.service, "fly");
  roster.instance_low = 1;
  roster.spacecraft._buffer = entries;
  roster.spacecraft._length = 2;
  board.learn(roster);
  adstar_FleetMember members[2]{};
  members[1].attitude_body_to_inertial = {0, 1, 0, 0};  // half a turn about x
  members[1].momentum_inertial_n_m_s = {1, 2, 3};
  members[1].flags = adstar_FLAG_UNRESOLVED_ANGLE;
  adstar_FleetState fleet{};
  set_text(fleet.service, "fly");
  fleet.step = 10;
  fleet.members._buffer = members;
  fleet.members._length = 2;
  board.learn(fleet, kNow);
  return board;
}

Json frame_of(const Board& board, std::string_view watched = {}, std::uint64_t after = 0) {
  return Json::parse(frame_json(board, watched, after, kNow));
}

TEST(Frame, has_both_halves_of_a_spacecraft_with_every_digit) {
  Board board;
  board.learn(attitude("sat1"), kNow);
  board.learn(momentum("sat1"), kNow);
  const Json frame = frame_of(board);
  EXPECT_EQ(frame["watched"], "sat1");
  const Json& sat = frame["spacecraft"];
  EXPECT_EQ(sat["q_IB"], Json({0.5, 0.5, -0.5, 0.5}));
  EXPECT_EQ(sat["omega_B_rad_s"][1].get<double>(), 1.0 / 3);
  EXPECT_EQ(sat["H_I_n_m_s"], Json({1.0, 2.0, 3.0}));
  EXPECT_EQ(sat["energy_residual_j"].get<double>(), 1e-17);
}

TEST(Frame, says_null_of_what_was_not_heard) {
  Board board;
  EXPECT_TRUE(frame_of(board)["spacecraft"].is_null());
  board.learn(attitude("sat1"), kNow);
  EXPECT_TRUE(frame_of(board)["spacecraft"]["H_I_n_m_s"][0].is_null());
  EXPECT_TRUE(frame_of(board, "sat2")["spacecraft"].is_null());
}

TEST(Frame, finds_a_member_of_a_fleet_and_turns_its_momentum_into_the_body) {
  const Json frame = frame_of(with_fleet(), "cube1");
  EXPECT_EQ(frame["spacecraft"]["Pi_B_n_m_s"], Json({1.0, -2.0, -3.0}));
  EXPECT_EQ(frame["actuators"], Json({"body"}));
}

TEST(Frame, carries_no_control_character_off_the_bus) {
  Board board;
  board.learn(attitude("a\x1b[31m\"</script>"), kNow);
  const std::string text = frame_json(board, "", 0, kNow);
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
  EXPECT_EQ(Json::parse(text)["watched"], "a?[31m\"</script>");
}

TEST(Frame, survives_a_name_that_is_no_utf8) {
  Board board;
  board.learn(attitude("sat\xff"), kNow);
  EXPECT_TRUE(Json::accept(frame_json(board, "", 0, kNow)));
  EXPECT_TRUE(Json::accept(fleet_json(board)));
}

TEST(Frame, tells_each_verdict_once_to_whoever_counts) {
  Board board;
  board.learn(verdict(1, adstar_VERDICT_ACCEPTED));
  board.learn(verdict(1, adstar_VERDICT_APPLIED));
  board.learn(verdict(1, adstar_VERDICT_APPLIED));
  EXPECT_EQ(frame_of(board)["verdicts"].size(), 2U);
  const Json later = frame_of(board, "", 1)["verdicts"];
  ASSERT_EQ(later.size(), 1U);
  EXPECT_EQ(later[0]["verdict"], "applied");
}

TEST(Board, keeps_the_last_verdicts_only) {
  Board board;
  for (std::uint64_t i = 1; i <= 2 * Board::kMostVerdicts; ++i) {
    board.learn(verdict(i, adstar_VERDICT_APPLIED));
  }
  EXPECT_EQ(board.verdicts().size(), Board::kMostVerdicts);
  EXPECT_EQ(board.verdict_counts().at("fly")[adstar_VERDICT_APPLIED], 2 * Board::kMostVerdicts);
}

TEST(Board, forgets_a_roster_unless_another_process_took_its_name) {
  Board board = with_fleet();
  board.forget_roster("fly", 0, 2);
  EXPECT_NE(board.member("cube1"), nullptr);
  board.forget_roster("fly", 0, 1);
  EXPECT_EQ(board.member("cube1"), nullptr);
}

TEST(Fleet, lists_every_member_in_columns_of_one_length) {
  const Json fleet = Json::parse(fleet_json(with_fleet()));
  EXPECT_EQ(fleet["spacecraft"], 2);
  EXPECT_EQ(fleet["name"], Json({"cube0", "cube1"}));
  EXPECT_EQ(fleet["flags"], Json({0, 1}));
  for (const auto& [key, column] : fleet.items()) {
    EXPECT_TRUE(key == "spacecraft" || column.size() == 2) << key;
  }
}

TEST(Metrics, count_what_the_daemon_counts) {
  Board board;
  board.learn(status(1500), kNow);
  adstar_StepTiming timing{};
  set_text(timing.service, "fly");
  timing.late_after_work = 2;
  timing.late_after_loss = 1;
  timing.late_after_sleep = 3;
  timing.wake_up_lateness.took = {10, 1000, 2000, 3000, 4000};
  timing.wake_up_lateness.sum_ns = 12'000;
  timing.wake_up_lateness.quarter_octaves[2] = 7;
  timing.wake_up_lateness.quarter_octaves[5] = 2;
  timing.wake_up_lateness.quarter_octaves[89] = 1;
  board.learn(timing, kNow);
  board.learn(momentum("sat1"), kNow);
  board.learn(verdict(1, adstar_VERDICT_CLAMPED));
  const std::string text = metrics_text(board, kNow);
  for (const char* line :
       {"adstar_up{service=\"fly\"} 1\n", "# TYPE adstar_steps_total counter\n",
        "adstar_steps_total{service=\"fly\"} 1500\n",
        "adstar_late_beats_total{service=\"fly\",cause=\"work\"} 2\n",
        "adstar_late_beats_total{service=\"fly\",cause=\"loss\"} 1\n",
        "adstar_late_beats_total{service=\"fly\",cause=\"sleep\"} 3\n",
        "adstar_phase_seconds{service=\"fly\",phase=\"wake_up\",quantile=\"0.99\"} 2e-06\n",
        "# TYPE adstar_phase_duration_seconds histogram\n",
        "_duration_seconds_bucket{service=\"fly\",phase=\"wake_up\",le=\"3.04e-07\"} 0\n",
        "_duration_seconds_bucket{service=\"fly\",phase=\"wake_up\",le=\"3.6e-07\"} 7\n",
        "_duration_seconds_bucket{service=\"fly\",phase=\"wake_up\",le=\"5.12e-07\"} 7\n",
        "_duration_seconds_bucket{service=\"fly\",phase=\"wake_up\",le=\"6.08e-07\"} 9\n",
        "_duration_seconds_bucket{service=\"fly\",phase=\"wake_up\",le=\"1.073741824\"} 9\n",
        "_duration_seconds_bucket{service=\"fly\",phase=\"wake_up\",le=\"+Inf\"} 10\n",
        "_duration_seconds_sum{service=\"fly\",phase=\"wake_up\"} 1.2e-05\n",
        "_duration_seconds_count{service=\"fly\",phase=\"wake_up\"} 10\n",
        "adstar_verdicts_total{service=\"fly\",verdict=\"clamped\"} 1\n",
        "adstar_momentum_residual_newton_metre_seconds{service=\"fly\",spacecraft=\"sat1\"} 5\n"}) {
    EXPECT_NE(text.find(line), std::string::npos) << line << "\nis not in\n" << text;
  }
}

TEST(Metrics, say_when_a_daemon_has_fallen_silent) {
  Board board;
  board.learn(status(1), kNow);
  const std::string text = metrics_text(board, kNow + std::chrono::seconds(4));
  EXPECT_NE(text.find("adstar_up{service=\"fly\"} 0\n"), std::string::npos);
}

TEST(Metrics, miss_a_daemon_that_went_without_a_word) {
  const std::string up = "adstar_up{service=\"fly\"} ";
  const auto has = [&](const Board& board, Clock::time_point now, const char* value) {
    return metrics_text(board, now).find(up + value + "\n") != std::string::npos;
  };
  Board board;
  board.learn(status(1), kNow);
  board.forget_service("fly", kNow);
  EXPECT_TRUE(has(board, kNow, "0")) << metrics_text(board, kNow);
  EXPECT_TRUE(has(board, kNow + std::chrono::seconds(599), "0"));
  EXPECT_FALSE(has(board, kNow + std::chrono::seconds(600), "0"));
  board.learn(status(1), kNow + std::chrono::seconds(1));
  EXPECT_TRUE(has(board, kNow + std::chrono::seconds(1), "1"));
  EXPECT_FALSE(has(board, kNow + std::chrono::seconds(1), "0"));
}

TEST(Metrics, do_not_miss_a_daemon_that_said_that_it_ends) {
  Board board;
  adstar_ServiceStatus last = status(1);
  last.state = adstar_SERVICE_STOPPED;
  board.learn(last, kNow);
  board.forget_service("fly", kNow);
  EXPECT_EQ(metrics_text(board, kNow).find("adstar_up"), std::string::npos);
}

TEST(Metrics, do_not_bring_a_daemon_back_for_a_timing_that_comes_late) {
  Board board;
  adstar_ServiceStatus last = status(1);
  last.state = adstar_SERVICE_STOPPED;
  adstar_StepTiming timing{};
  set_text(timing.service, "fly");
  board.learn(last, kNow);
  board.forget_service("fly", kNow);
  board.learn(timing, kNow);
  EXPECT_EQ(metrics_text(board, kNow).find("service=\"fly\""), std::string::npos)
      << metrics_text(board, kNow);
}

TEST(Metrics, escape_what_would_end_a_label) {
  Board board;
  adstar_ServiceStatus sample = status(1);
  set_text(sample.service, "a\"b\\c\nd");
  board.learn(sample, kNow);
  EXPECT_NE(metrics_text(board, kNow).find("{service=\"a\\\"b\\\\c?d\"}"), std::string::npos);
}

std::string complaint_about(const char* json) {
  try {
    pulse_of(json);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

TEST(Pulse, is_read_with_its_duration_in_nanoseconds) {
  const Pulse pulse = pulse_of(
      R"({"spacecraft": "sat1", "actuator": "body", "torque_n_m": [0, -1, 0.05], "duration_s": 0.3})");
  EXPECT_EQ(pulse.target.spacecraft, "sat1");
  EXPECT_EQ(pulse.target.actuator, "body");
  EXPECT_EQ(pulse.order.torque_n_m, (std::array<double, 3>{0, -1, 0.05}));
  EXPECT_EQ(pulse.order.duration_ns, 300'000'000);
  EXPECT_EQ(pulse.order.start_ns, runtime::kStartAtNextBeat);
}

TEST(Pulse, that_is_wrong_is_told_where) {
  const auto expect_about = [](const char* key, const char* json) {
    EXPECT_EQ(complaint_about(json).rfind(key, 0), 0U) << json << ": " << complaint_about(json);
  };
  expect_about("expected an object", "");
  expect_about("expected an object", "[1]");
  expect_about("spacecraft", R"({"actuator": "body", "torque_n_m": [0,0,1], "duration_s": 1})");
  expect_about("spacecraft",
               R"({"spacecraft": "", "actuator": "b", "torque_n_m": [0,0,1], "duration_s": 1})");
  expect_about("torque_n_m",
               R"({"spacecraft": "a", "actuator": "b", "torque_n_m": [0,0], "duration_s": 1})");
  expect_about("torque_n_m",
               R"({"spacecraft": "a", "actuator": "b", "torque_n_m": [0,0,"1"], "duration_s": 1})");
  expect_about("duration_s",
               R"({"spacecraft": "a", "actuator": "b", "torque_n_m": [0,0,1], "duration_s": -1})");
  expect_about("duration_s", R"({"spacecraft": "a", "actuator": "b", "torque_n_m": [0,0,1]})");
  expect_about(
      "force",
      R"({"spacecraft": "a", "actuator": "b", "torque_n_m": [0,0,1], "duration_s": 1, "force": 1})");
}

}  // namespace
}  // namespace adstar::dashboard
