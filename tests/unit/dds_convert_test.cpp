// Records to samples and back, names of fixed length, verdicts in words, and the log throttle.

#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "service/dds/convert.hpp"
#include "service/dds/rate_limit.hpp"
#include "service/dds/refusal_text.hpp"
#include "service/dds/topics.hpp"
#include "service/dds/verdict_text.hpp"

namespace adstar::dds {
namespace {

using runtime::Reason;
using runtime::Verdict;

TEST(DdsText, is_always_terminated_and_says_when_it_was_cut) {
  char text[4];
  EXPECT_TRUE(set_text(text, "abc"));
  EXPECT_EQ(text_of(text), "abc");
  EXPECT_FALSE(set_text(text, "abcd"));
  EXPECT_EQ(text_of(text), "abc");
  EXPECT_EQ(text[3], '\0');
  EXPECT_TRUE(set_text(text, ""));
  EXPECT_EQ(text_of(text), "");
  EXPECT_EQ(std::string(text, 4), std::string(4, '\0'));
}

TEST(DdsText, without_a_terminator_ends_with_its_array) {
  const char text[3] = {'a', 'b', 'c'};
  EXPECT_EQ(text_of(text), "abc");
}

TEST(DdsConvert, a_command_keeps_every_field_even_the_senseless_ones) {
  adstar_TorqueCommand sample{};
  sample.commander = {1, 2};
  sample.sequence_number = std::numeric_limits<std::uint64_t>::max();
  sample.priority = -4;
  sample.start_time_ns = std::numeric_limits<std::int64_t>::min();
  sample.end_time_ns = 5;
  sample.duration_ns = -6;
  sample.torque_n_m = {std::numeric_limits<double>::infinity(), std::nan(""), -0.0};
  const runtime::CommandRecord record = to_record(sample, 7, 8);
  EXPECT_EQ(record.commander, (runtime::CommanderId{1, 2}));
  EXPECT_EQ(record.sequence, std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(record.spacecraft, 7U);
  EXPECT_EQ(record.actuator, 8U);
  EXPECT_EQ(record.priority, -4);
  EXPECT_EQ(record.start_ns, std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(record.end_ns, 5);
  EXPECT_EQ(record.duration_ns, -6);
  EXPECT_TRUE(std::isinf(record.value[0]));
  EXPECT_TRUE(std::isnan(record.value[1]));
  EXPECT_TRUE(std::signbit(record.value[2]));
}

TEST(DdsConvert, a_verdict_becomes_a_status) {
  runtime::VerdictRecord record;
  record.commander = {1, 2};
  record.sequence = 3;
  record.priority = 4;
  record.verdict = Verdict::refused;
  record.reason = Reason::no_authority;
  record.step = 5;
  record.time_ns = 6;
  record.start_ns = 7;
  record.end_ns = 8;
  record.value = {9, 10, 11};
  const adstar_CommandStatus sample = to_sample(record, "sat1", "body", "fly");
  EXPECT_EQ(text_of(sample.spacecraft), "sat1");
  EXPECT_EQ(text_of(sample.actuator), "body");
  EXPECT_EQ(text_of(sample.service), "fly");
  EXPECT_EQ(sample.commander.high, 1U);
  EXPECT_EQ(sample.commander.low, 2U);
  EXPECT_EQ(sample.sequence_number, 3U);
  EXPECT_EQ(sample.priority, 4);
  EXPECT_EQ(sample.step, 5U);
  EXPECT_EQ(sample.time_ns, 6);
  EXPECT_EQ(sample.effective_start_time_ns, 7);
  EXPECT_EQ(sample.effective_end_time_ns, 8);
  EXPECT_EQ(sample.torque_applied_n_m.x, 9);
  EXPECT_EQ(sample.torque_applied_n_m.y, 10);
  EXPECT_EQ(sample.torque_applied_n_m.z, 11);
  EXPECT_EQ(verdict_of(sample), Verdict::refused);
  EXPECT_EQ(reason_of(sample), Reason::no_authority);
}

TEST(DdsConvert, the_verdict_on_a_wheels_speed_says_a_speed_and_no_torque) {
  runtime::VerdictRecord record;
  record.quantity = runtime::Quantity::wheel_speed;
  record.value = {250, 0, 0};
  const adstar_CommandStatus sample = to_sample(record, "sat1", "wheel1", "fly");
  EXPECT_EQ(sample.speed_applied_rad_s, 250);
  EXPECT_EQ(sample.torque_applied_n_m.x, 0);
}

TEST(DdsConvert, commands_of_a_wheel_become_records) {
  adstar_WheelTorqueCommand torque{};
  torque.commander = {1, 2};
  torque.sequence_number = 3;
  torque.priority = -4;
  torque.start_time_ns = 5;
  torque.end_time_ns = 6;
  torque.duration_ns = 7;
  torque.motor_torque_n_m = 0.25;
  const runtime::CommandRecord record = to_record(torque, 8, 9);
  EXPECT_EQ(record.commander, (runtime::CommanderId{1, 2}));
  EXPECT_EQ(record.sequence, 3U);
  EXPECT_EQ(record.priority, -4);
  EXPECT_EQ(record.start_ns, 5);
  EXPECT_EQ(record.end_ns, 6);
  EXPECT_EQ(record.duration_ns, 7);
  EXPECT_EQ(record.spacecraft, 8U);
  EXPECT_EQ(record.actuator, 9U);
  EXPECT_EQ(record.quantity, runtime::Quantity::torque);
  EXPECT_EQ(record.value, (std::array<double, 3>{0.25, 0, 0}));
  adstar_WheelSpeedCommand speed{};
  speed.sequence_number = 10;
  speed.speed_rad_s = -300;
  EXPECT_EQ(to_record(speed, 0, 0).sequence, 10U);
  EXPECT_EQ(to_record(speed, 0, 0).quantity, runtime::Quantity::wheel_speed);
  EXPECT_EQ(to_record(speed, 0, 0).value, (std::array<double, 3>{-300, 0, 0}));
}

TEST(DdsConvert, a_wheel_keeps_every_number_on_the_wire) {
  const runtime::WheelRecord record{1, 2, runtime::kWheelSpeedLimited, 0, 3, 4, 5.5, 6.5, 7.5, 8.5};
  const adstar_WheelState sample = to_sample(record, "sat1", "wheel1", "fly");
  EXPECT_EQ(text_of(sample.spacecraft), "sat1");
  EXPECT_EQ(text_of(sample.wheel), "wheel1");
  EXPECT_EQ(text_of(sample.service), "fly");
  EXPECT_EQ(sample.step, 3U);
  EXPECT_EQ(sample.time_ns, 4);
  EXPECT_EQ(sample.speed_rad_s, 5.5);
  EXPECT_EQ(sample.momentum_n_m_s, 6.5);
  EXPECT_EQ(sample.motor_torque_n_m, 7.5);
  EXPECT_EQ(sample.friction_torque_n_m, 8.5);
  EXPECT_EQ(sample.flags, adstar_WHEEL_SPEED_LIMITED);
}

TEST(DdsConvert, an_enumerator_of_a_newer_program_is_not_taken_for_one_of_ours) {
  adstar_CommandStatus sample{};
  const std::uint32_t eight = 8;
  const std::uint32_t eleven = 11;
  std::memcpy(&sample.verdict, &eight, sizeof eight);
  std::memcpy(&sample.reason, &eleven, sizeof eleven);
  EXPECT_FALSE(verdict_of(sample));
  EXPECT_FALSE(reason_of(sample));
}

TEST(DdsConvert, motion_goes_to_the_field_of_its_name) {
  runtime::TelemetryRecord record;
  record.step = 1;
  record.time_ns = 2;
  record.flags = runtime::kFlagFinal;
  record.q_IB = {0.1, 0.2, 0.3, 0.4};
  record.omega_B_rad_s = {1, 2, 3};
  record.H_I_n_m_s = {4, 5, 6};
  record.Pi_B_n_m_s = {7, 8, 9};
  record.rotational_energy_j = 10;
  record.work_j = 11;
  record.energy_residual_j = 12;
  record.momentum_residual_I_n_m_s = {13, 14, 15};
  const adstar_AttitudeState attitude = to_attitude(record, "sat1", "fly");
  EXPECT_EQ(text_of(attitude.spacecraft), "sat1");
  EXPECT_EQ(attitude.step, 1U);
  EXPECT_EQ(attitude.time_ns, 2);
  EXPECT_EQ(attitude.attitude_body_to_inertial.w, 0.1);
  EXPECT_EQ(attitude.attitude_body_to_inertial.z, 0.4);
  EXPECT_EQ(attitude.angular_velocity_body_rad_s.y, 2);
  EXPECT_EQ(attitude.flags, static_cast<std::uint32_t>(adstar_FLAG_FINAL));
  const adstar_MomentumState momentum = to_momentum(record, "sat1", "fly");
  EXPECT_EQ(text_of(momentum.service), "fly");
  EXPECT_EQ(momentum.momentum_inertial_n_m_s.x, 4);
  EXPECT_EQ(momentum.momentum_body_n_m_s.z, 9);
  EXPECT_EQ(momentum.rotational_energy_j, 10);
  EXPECT_EQ(momentum.work_j, 11);
  EXPECT_EQ(momentum.energy_residual_j, 12);
  EXPECT_EQ(momentum.momentum_residual_inertial_n_m_s.y, 14);
}

TEST(DdsConvert, counts_beyond_32_bits_stay_at_the_most) {
  runtime::StatusRecord record;
  record.state = static_cast<std::uint64_t>(runtime::RunState::stopped);
  record.unresolved_spacecraft = 1ULL << 40;
  record.commands_lost = 1ULL << 40;
  ServiceFacts facts;
  facts.service = "fly";
  facts.instance = {1, 2};
  const adstar_ServiceStatus sample = to_sample(record, facts);
  EXPECT_EQ(sample.state, adstar_SERVICE_STOPPED);
  EXPECT_EQ(sample.unresolved_spacecraft, std::numeric_limits<std::uint32_t>::max());
  EXPECT_EQ(sample.commands_lost, 1ULL << 40);
  EXPECT_EQ(sample.instance_low, 2U);
}

TEST(DdsConvert, timing_keeps_every_part_of_a_beat_apart) {
  runtime::TimingRecord record;
  for (std::size_t i = 0; i < runtime::kPhases; ++i) {
    const auto n = static_cast<std::int64_t>(i);
    record.phases[i] = {{i, 10 + n, 20 + n, 30 + n, 40 + n}, 50 + i, {}, 100 + n, 7 + i};
    record.phases[i].quarter_octaves[89] = 60 + i;
  }
  record.late_after_sleep = 3;
  record.late_after_loss = 33;
  record.behind_ns = -5;
  record.phase_disciplined = 1;
  record.phase_error_ns = -7;
  record.account = {1, 2, 4, 1ULL << 40, 6, 7};
  const adstar_StepTiming sample = to_sample(record, "fly");
  EXPECT_EQ(sample.wake_up_lateness.took.p50_ns, 10);
  EXPECT_EQ(sample.command_phase.took.p99_ns, 21);
  EXPECT_EQ(sample.step_phase.budget_ns, 102);
  EXPECT_EQ(sample.step_phase.sum_ns, 52U);
  EXPECT_EQ(sample.step_phase.quarter_octaves[89], 62U);
  EXPECT_EQ(sample.step_phase.quarter_octaves[0], 0U);
  EXPECT_EQ(sample.hand_over_phase.over_budget, 10U);
  EXPECT_EQ(sample.late_after_sleep, 3U);
  EXPECT_EQ(sample.late_after_loss, 33U);
  EXPECT_EQ(sample.behind_wall_ns, -5);
  EXPECT_TRUE(sample.phase_disciplined);
  EXPECT_EQ(sample.phase_error_ns, -7);
  EXPECT_EQ(sample.major_page_faults, 2U);
  EXPECT_EQ(sample.involuntary_switches, 4U);
  EXPECT_EQ(sample.most_commands_waiting, std::numeric_limits<std::uint32_t>::max());
  EXPECT_EQ(sample.most_telemetry_waiting, 7U);
}

TEST(VerdictText, has_a_word_for_each_and_a_sentence_for_each_reason) {
  std::set<std::string> words;
  for (std::uint32_t i = 0; i <= static_cast<std::uint32_t>(Verdict::refused); ++i) {
    words.insert(verdict_text(static_cast<Verdict>(i)));
  }
  EXPECT_EQ(words.size(), 8U);
  EXPECT_FALSE(words.contains("unknown verdict"));
  std::set<std::string> sentences;
  for (std::uint32_t i = 0; i <= static_cast<std::uint32_t>(Reason::not_recorded); ++i) {
    sentences.insert(reason_text(static_cast<Reason>(i)));
    EXPECT_STRNE(reason_name(static_cast<Reason>(i)), "unknown reason");
  }
  EXPECT_EQ(sentences.size(), 11U);
  EXPECT_FALSE(is_final(Verdict::accepted));
  EXPECT_TRUE(is_final(Verdict::applied));
}

TEST(RefusalText, has_a_name_and_a_sentence_for_each) {
  std::set<std::string> names, sentences;
  const auto last_step = static_cast<std::uint32_t>(runtime::StepRefusal::halted);
  for (std::uint32_t i = 0; i <= last_step; ++i) {
    names.insert(std::string("step ") + refusal_name(static_cast<runtime::StepRefusal>(i)));
    sentences.insert(std::string("step ") + refusal_text(static_cast<runtime::StepRefusal>(i)));
  }
  const auto last_control = static_cast<std::uint32_t>(runtime::ControlRefusal::unknown_action);
  for (std::uint32_t i = 0; i <= last_control; ++i) {
    names.insert(refusal_name(static_cast<runtime::ControlRefusal>(i)));
    sentences.insert(refusal_text(static_cast<runtime::ControlRefusal>(i)));
  }
  EXPECT_EQ(names.size(), 6U + 8U);
  EXPECT_EQ(sentences.size(), 6U + 8U);
  EXPECT_FALSE(names.contains("unknown refusal"));
  EXPECT_FALSE(names.contains("step unknown refusal"));
}

TEST(DdsConvert, requests_to_the_clock_keep_every_number) {
  adstar_StepRequest request{};
  request.requester = {1, 2};
  request.sequence_number = 3;
  request.steps = 4;
  const runtime::StepRequestRecord asked = to_record(request);
  EXPECT_EQ(asked.requester, (runtime::CommanderId{1, 2}));
  EXPECT_EQ(asked.sequence, 3U);
  EXPECT_EQ(asked.steps, 4U);
  const adstar_StepReply reply = to_sample(
      runtime::StepReplyRecord{
          {1, 2}, 3, runtime::StepOutcome::refused, runtime::StepRefusal::busy, 5, 6},
      "fly");
  EXPECT_EQ(text_of(reply.service), "fly");
  EXPECT_EQ(reply.requester.low, 2U);
  EXPECT_EQ(outcome_of(reply), runtime::StepOutcome::refused);
  EXPECT_EQ(refusal_of(reply), runtime::StepRefusal::busy);
  EXPECT_EQ(reply.step, 5U);
  EXPECT_EQ(reply.time_ns, 6);

  adstar_RunControl control{};
  control.commander = {7, 8};
  control.sequence_number = 9;
  control.action = adstar_CONTROL_SET_INERTIA;
  control.attitude_body_to_inertial = {0.1, 0.2, 0.3, 0.4};
  control.angular_velocity_body_rad_s = {1, 2, 3};
  control.inertia_body_kg_m2 = {11, 12, 13, 14, 15, 16};
  control.attitude_body_to_frame = {21, 22, 23, 24};
  const runtime::ControlRecord record = to_record(control);
  EXPECT_EQ(record.commander, (runtime::CommanderId{7, 8}));
  EXPECT_EQ(record.sequence, 9U);
  EXPECT_EQ(record.action, runtime::ControlAction::set_inertia);
  EXPECT_EQ(record.attitude, (std::array<double, 4>{0.1, 0.2, 0.3, 0.4}));
  EXPECT_EQ(record.omega_B_rad_s, (std::array<double, 3>{1, 2, 3}));
  EXPECT_EQ(record.inertia_body_kg_m2, (std::array<double, 6>{11, 12, 13, 14, 15, 16}));
  control.action = adstar_CONTROL_SET_TARGET;
  EXPECT_EQ(to_record(control).attitude, (std::array<double, 4>{21, 22, 23, 24}));
}

TEST(RateLimit, drops_the_rest_of_a_second_and_then_says_how_many) {
  RateLimit limit(2);
  const RateLimit::Clock::time_point start = RateLimit::Clock::now();
  EXPECT_EQ(limit.admit(start), 0U);
  EXPECT_EQ(limit.admit(start), 0U);
  EXPECT_FALSE(limit.admit(start + std::chrono::milliseconds(1)));
  EXPECT_FALSE(limit.admit(start + std::chrono::milliseconds(999)));
  EXPECT_EQ(limit.admit(start + std::chrono::milliseconds(1000)), 2U);
  EXPECT_EQ(limit.admit(start + std::chrono::milliseconds(1001)), 0U);
}

TEST(Topics, have_names_of_their_own) {
  std::set<std::string> names;
  std::apply([&](const auto&... topic) { (names.insert(topic.name), ...); }, kTopics);
  EXPECT_EQ(names.size(), std::tuple_size_v<std::remove_const_t<decltype(kTopics)>>);
}

}  // namespace
}  // namespace adstar::dds
