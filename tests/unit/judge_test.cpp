#include "service/runtime/judge.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "adstar/torques/frame.hpp"
#include "tests/support/random_motion.hpp"
#include "tests/support/wide.hpp"

namespace adstar::runtime {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr std::int64_t kMin = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t kMax = std::numeric_limits<std::int64_t>::max();
constexpr Vec3<double> kLimits{1, 2, 3};
constexpr std::int64_t kNow = 1'000;

/// Half a newton metre about x, from start to end.
CommandRecord from_to(std::int64_t start_ns, std::int64_t end_ns) {
  CommandRecord command;
  command.start_ns = start_ns;
  command.end_ns = end_ns;
  command.value = {0.5, 0, 0};
  return command;
}

CommandRecord for_duration(std::int64_t start_ns, std::int64_t duration_ns) {
  CommandRecord command = from_to(start_ns, 0);
  command.duration_ns = duration_ns;
  return command;
}

CommandRecord with_torque(double x, double y, double z) {
  CommandRecord command = from_to(2'000, 3'000);
  command.value = {x, y, z};
  return command;
}

Judgement judged(const CommandRecord& command, std::int64_t now_ns = kNow) {
  return judge(command, kLimits, now_ns);
}

void expect_refused(const CommandRecord& command, Reason reason) {
  const Judgement judgement = judged(command);
  EXPECT_EQ(judgement.verdict, Verdict::refused);
  EXPECT_EQ(judgement.reason, reason);
}

void expect_in_force(const Judgement& j, Verdict verdict, std::int64_t start, std::int64_t end) {
  EXPECT_EQ(j.verdict, verdict);
  EXPECT_EQ(j.reason, Reason::none);
  EXPECT_EQ(j.start_ns, start);
  EXPECT_EQ(j.end_ns, end);
}

TEST(Judge, lets_a_good_command_through_as_it_is) {
  const Judgement j = judged(with_torque(-1, 2, -3));
  expect_in_force(j, Verdict::applied, 2'000, 3'000);
  EXPECT_EQ(j.value, (std::array<double, 3>{-1, 2, -3}));
}

TEST(Judge, refuses_what_is_not_finite_on_any_axis) {
  for (const double bad : {kNan, kInf, -kInf}) {
    expect_refused(with_torque(bad, 0, 0), Reason::not_finite);
    expect_refused(with_torque(0, bad, 0), Reason::not_finite);
    expect_refused(with_torque(0, 0, bad), Reason::not_finite);
  }
}

TEST(Judge, hands_on_no_number_that_is_not_finite) {
  for (const double bad : {kNan, kInf, -kInf}) {
    for (const double x : judged(with_torque(bad, bad, bad)).value) {
      EXPECT_TRUE(std::isfinite(x));
    }
  }
}

TEST(Judge, refuses_an_end_that_is_not_after_the_start) {
  expect_refused(from_to(2'000, 2'000), Reason::bad_interval);
  expect_refused(from_to(2'000, 1'999), Reason::bad_interval);
  expect_refused(from_to(500, 400), Reason::bad_interval);
  expect_refused(from_to(kMax, kMin), Reason::bad_interval);
  expect_refused(from_to(kMax, kMax), Reason::bad_interval);
}

TEST(Judge, refuses_both_and_neither_of_end_and_duration) {
  CommandRecord both = from_to(2'000, 3'000);
  both.duration_ns = 1'000;
  expect_refused(both, Reason::bad_interval);
  expect_refused(from_to(2'000, 0), Reason::bad_interval);
  expect_refused(from_to(kStartAtNextBeat, 0), Reason::bad_interval);
}

TEST(Judge, refuses_a_negative_duration_and_one_past_the_end_of_time) {
  expect_refused(for_duration(2'000, -1), Reason::bad_interval);
  expect_refused(for_duration(2'000, kMin), Reason::bad_interval);
  expect_refused(for_duration(2'000, kMax), Reason::bad_interval);
  expect_refused(for_duration(2'000, kMax - 1'999), Reason::bad_interval);
  expect_refused(for_duration(kMax, 1), Reason::bad_interval);
  expect_in_force(judged(for_duration(2'000, kMax - 2'000)), Verdict::applied, 2'000, kMax);
}

TEST(Judge, counts_a_duration_from_the_effective_start) {
  expect_in_force(judged(for_duration(2'000, 50)), Verdict::applied, 2'000, 2'050);
  expect_in_force(judged(for_duration(kStartAtNextBeat, 50)), Verdict::applied, kNow, kNow + 50);
  expect_in_force(judged(for_duration(10, 50)), Verdict::applied_late, kNow, kNow + 50);
}

TEST(Judge, calls_a_start_in_the_past_late_and_gives_the_interval_in_force) {
  expect_in_force(judged(from_to(kNow - 1, kNow + 1)), Verdict::applied_late, kNow, kNow + 1);
  expect_in_force(judged(from_to(kNow, kNow + 1)), Verdict::applied, kNow, kNow + 1);
  expect_in_force(judged(from_to(kMin, kMax)), Verdict::applied_late, kNow, kMax);
}

TEST(Judge, calls_what_is_wholly_past_expired) {
  EXPECT_EQ(judged(from_to(10, kNow)).verdict, Verdict::expired);
  EXPECT_EQ(judged(from_to(10, kNow - 1)).verdict, Verdict::expired);
  EXPECT_EQ(judged(from_to(kMin, kMin + 1)).verdict, Verdict::expired);
  EXPECT_EQ(judged(from_to(-20, -10)).verdict, Verdict::expired);
  EXPECT_EQ(judged(from_to(kStartAtNextBeat, kNow)).verdict, Verdict::expired);
}

TEST(Judge, begins_at_the_coming_step_when_asked_for_the_next_beat) {
  expect_in_force(judged(from_to(kStartAtNextBeat, kNow + 9)), Verdict::applied, kNow, kNow + 9);
  expect_in_force(judged(from_to(kStartAtNextBeat, 9), 0), Verdict::applied, 0, 9);
  // The neighbours of the sentinel are ordinary times, long past.
  expect_in_force(judged(from_to(kStartAtNextBeat + 1, 2'000)), Verdict::applied_late, kNow, 2'000);
  expect_in_force(judged(from_to(kStartAtNextBeat - 1, 2'000)), Verdict::applied_late, kNow, 2'000);
}

TEST(Judge, survives_the_extremes_of_every_time) {
  for (const std::int64_t start : {kMin, kStartAtNextBeat, std::int64_t{-1}, std::int64_t{0},
                                   std::int64_t{1}, kMax - 1, kMax}) {
    for (const std::int64_t end :
         {kMin, kMin + 1, std::int64_t{-1}, std::int64_t{0}, std::int64_t{1}, kMax - 1, kMax}) {
      for (const std::int64_t duration :
           {kMin, std::int64_t{-1}, std::int64_t{0}, std::int64_t{1}, kMax - 1, kMax}) {
        for (const std::int64_t now : {std::int64_t{0}, std::int64_t{1}, kMax - 1, kMax}) {
          CommandRecord command = from_to(start, end);
          command.duration_ns = duration;
          const Judgement j = judged(command, now);
          if (j.verdict == Verdict::applied || j.verdict == Verdict::applied_late) {
            ASSERT_GE(j.start_ns, now);
            ASSERT_GT(j.end_ns, j.start_ns);
          }
        }
      }
    }
  }
}

TEST(Judge, refuses_torque_about_an_axis_without_authority) {
  const Vec3<double> limits{1, 0, 1};
  CommandRecord command = with_torque(0.1, 1e-300, 0);
  EXPECT_EQ(judge(command, limits, kNow).reason, Reason::no_authority);
  command.value = {0.1, -std::numeric_limits<double>::denorm_min(), 0};
  EXPECT_EQ(judge(command, limits, kNow).verdict, Verdict::refused);
  command.value = {0.1, -0.0, 0.2};
  EXPECT_EQ(judge(command, limits, kNow).verdict, Verdict::applied);
  command.value = {100, 1, 0};  // beyond one limit, nothing about the other: no clamp helps
  EXPECT_EQ(judge(command, limits, kNow).reason, Reason::no_authority);
}

TEST(Judge, looks_at_finite_then_interval_then_age_then_authority) {
  const Vec3<double> none{0, 0, 0};
  CommandRecord command = from_to(20, 10);
  command.value = {kNan, 100, 0};
  EXPECT_EQ(judge(command, none, kNow).reason, Reason::not_finite);
  command.value[0] = 0;
  EXPECT_EQ(judge(command, none, kNow).reason, Reason::bad_interval);
  command.end_ns = 30;
  EXPECT_EQ(judge(command, none, kNow).verdict, Verdict::expired);
  command.end_ns = 2'000;
  EXPECT_EQ(judge(command, none, kNow).reason, Reason::no_authority);
}

TEST(Judge, does_not_touch_a_torque_that_stands_exactly_at_its_limits) {
  const Judgement j = judged(with_torque(1, -2, 3));
  EXPECT_EQ(j.verdict, Verdict::applied);
  EXPECT_EQ(j.value, (std::array<double, 3>{1, -2, 3}));
  EXPECT_EQ(judged(with_torque(std::nextafter(1.0, 2.0), 0, 0)).verdict, Verdict::clamped);
}

TEST(Judge, clamps_the_whole_vector_and_says_so_even_when_late) {
  CommandRecord command = with_torque(2, -2, 1);
  Judgement j = judged(command);
  EXPECT_EQ(j.verdict, Verdict::clamped);
  EXPECT_EQ(j.value, (std::array<double, 3>{1, -1, 0.5}));
  command.start_ns = 10;
  j = judged(command);
  EXPECT_EQ(j.verdict, Verdict::clamped);
  EXPECT_EQ(j.start_ns, kNow);
}

TEST(Judge, clamp_keeps_the_direction_and_never_passes_a_limit_by_one_ulp) {
  test::Generator random(20260101);
  int clamped = 0;
  for (int n = 0; n < 300'000; ++n) {
    const Vec3<double> limits{test::log_uniform(random, 1e-6, 1e3),
                              test::log_uniform(random, 1e-6, 1e3),
                              test::log_uniform(random, 1e-6, 1e3)};
    const double size = test::log_uniform(random, 1e-9, n % 2 == 0 ? 1e6 : 1e307);
    const Vec3<double> asked = size * test::unit_vector(random);
    const Judgement j = judge(with_torque(asked.x, asked.y, asked.z), limits, kNow);
    const Vec3<double> got{j.value[0], j.value[1], j.value[2]};
    ASSERT_LE(std::fabs(got.x), limits.x);
    ASSERT_LE(std::fabs(got.y), limits.y);
    ASSERT_LE(std::fabs(got.z), limits.z);
    if (j.verdict != Verdict::clamped) {
      ASSERT_EQ(j.verdict, Verdict::applied);
      ASSERT_EQ(got, asked);
      continue;
    }
    ++clamped;
    // Direction: the same ratio on every axis, within a few roundings; length: one axis at its
    // limit.
    const Vec3<double> u = (1 / size) * asked;
    const double ratio = norm(got) / norm(u);
    ASSERT_NEAR(norm(got - ratio * u) / norm(got), 0, 8 * test::kEpsilon);
    const double reached = std::max(
        {std::fabs(got.x) / limits.x, std::fabs(got.y) / limits.y, std::fabs(got.z) / limits.z});
    ASSERT_GE(reached, 1 - 4 * test::kEpsilon);
  }
  EXPECT_GT(clamped, 100'000);
}

TEST(Judge, clamps_the_largest_numbers_there_are_to_the_smallest_actuator) {
  constexpr double kHuge = std::numeric_limits<double>::max();
  for (const double limit : {1e3, 1.0, 1e-3, 1e-9, 1e-15}) {
    const Judgement j =
        judge(with_torque(kHuge, -kHuge / 2, kHuge / 4), {limit, limit, limit}, kNow);
    EXPECT_EQ(j.verdict, Verdict::clamped);
    EXPECT_EQ(j.value, (std::array<double, 3>{limit, -limit / 2, limit / 4}));
  }
}

}  // namespace
}  // namespace adstar::runtime
