#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include "adstar/torques/all.hpp"
#include "tests/support/wide.hpp"

namespace adstar {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kFirst = std::numeric_limits<std::int64_t>::min();

using V = Vec3<double>;

/// What a ramp says of the torque `later_ns` after its beginning.
V value(const Ramp<double>& ramp, std::int64_t later_ns = 0) {
  return ramp.start + seconds<double>(later_ns) * ramp.slope;
}

void expect_near(const V& got, const V& expected, double tolerance) {
  EXPECT_NEAR(got.x, expected.x, tolerance);
  EXPECT_NEAR(got.y, expected.y, tolerance);
  EXPECT_NEAR(got.z, expected.z, tolerance);
}

TEST(Seconds, rounds_correctly) {
  EXPECT_EQ(seconds<double>(10'000'000), 0.01);
  EXPECT_EQ(seconds<double>(1), 1e-9);
  EXPECT_EQ(seconds<double>(123'456'789'012), 123.456789012);
  EXPECT_EQ(seconds<double>(-5 * kSecond), -5.0);
}

TEST(ConstantTorque, is_the_same_at_all_times_and_has_no_edge) {
  const Constant<double> torque{Frame::body, {1, -2, 3}};
  for (const std::int64_t t : {kFirst, std::int64_t{0}, kSecond, kNever - 1}) {
    EXPECT_EQ(torque.ramp_from(t).start, (V{1, -2, 3}));
    EXPECT_EQ(torque.ramp_from(t).slope, V{});
    EXPECT_EQ(torque.next_edge_after(t), kNever);
  }
}

TEST(HarmonicTorque, is_amplitude_times_the_sine_of_frequency_times_time_plus_phase) {
  const Harmonic<double> torque{
      Frame::body, {0.02, 0.015, 0}, {0.5, 0.3, 7}, {0, 1.5707963267948966, 1}};
  for (const double t : {-3.0, 0.0, 0.1, 12.5, 1e4}) {
    expect_near(torque.at(t), {0.02 * std::sin(0.5 * t), 0.015 * std::cos(0.3 * t), 0},
                0.02 * test::ulp(0.5 * t + 1.6));  // the argument's own rounding
  }
  EXPECT_EQ(torque.next_edge_after(0), kNever);
}

TEST(HarmonicTorque, never_exceeds_its_bound) {
  const Harmonic<double> torque{Frame::body, {0.3, -0.4, 1.2}, {1, 1.7, 2.3}, {0, 1, 2}};
  double largest = 0;
  for (int i = 0; i < 100'000; ++i) {
    largest = std::fmax(largest, norm(torque.at(0.01 * i)));
  }
  EXPECT_LE(largest, torque.bound());
  EXPECT_GE(largest, 0.95 * torque.bound());
}

TEST(HarmonicTorque, runs_in_113_bits) {
  using test::Quad;
  const Harmonic<Quad> torque{
      Frame::body, {Quad(1), Quad(2), Quad(0)}, {Quad(1), Quad(1), Quad(1)}, {}};
  const Quad t("0.7");
  EXPECT_EQ(torque.at(t).x, sin(t));
  EXPECT_EQ(torque.at(t).y, 2 * sin(t));
}

Table<double> table(Interpolation interpolation, AfterEnd after_end) {
  return {Frame::body,
          interpolation,
          after_end,
          {kSecond, 2 * kSecond, 4 * kSecond},
          {{1, 0, 0}, {3, 0, -1}, {5, 2, 1}}};
}

TEST(TableTorque, holds_each_value_until_the_next_knot) {
  const auto torque = table(Interpolation::hold, AfterEnd::zero);
  EXPECT_EQ(value(torque.ramp_from(kSecond)), (V{1, 0, 0}));
  EXPECT_EQ(value(torque.ramp_from(2 * kSecond - 1)), (V{1, 0, 0}));
  EXPECT_EQ(value(torque.ramp_from(2 * kSecond)), (V{3, 0, -1}));
  EXPECT_EQ(torque.ramp_from(3 * kSecond).slope, V{});
  EXPECT_EQ(value(torque.ramp_from(4 * kSecond - 1)), (V{3, 0, -1}));
}

TEST(TableTorque, joins_its_knots_by_lines) {
  const auto torque = table(Interpolation::linear, AfterEnd::zero);
  expect_near(value(torque.ramp_from(kSecond)), {1, 0, 0}, 1e-15);
  expect_near(value(torque.ramp_from(kSecond), kSecond / 4), {1.5, 0, -0.25}, 1e-15);
  expect_near(value(torque.ramp_from(kSecond + kSecond / 4)), {1.5, 0, -0.25}, 1e-15);
  expect_near(value(torque.ramp_from(kSecond + kSecond / 4), kSecond / 2), {2.5, 0, -0.75}, 1e-15);
  expect_near(value(torque.ramp_from(3 * kSecond)), {4, 1, 0}, 1e-15);
}

TEST(TableTorque, is_zero_before_its_first_knot) {
  for (const auto interpolation : {Interpolation::hold, Interpolation::linear}) {
    const auto torque = table(interpolation, AfterEnd::hold);
    for (const std::int64_t t : {kFirst, std::int64_t{0}, kSecond - 1}) {
      EXPECT_EQ(value(torque.ramp_from(t)), V{});
      EXPECT_EQ(torque.ramp_from(t).slope, V{});
    }
  }
}

TEST(TableTorque, after_its_last_knot_is_zero_or_the_last_value_as_asked) {
  for (const auto interpolation : {Interpolation::hold, Interpolation::linear}) {
    for (const std::int64_t t : {4 * kSecond, 4 * kSecond + 1, kNever - 1}) {
      EXPECT_EQ(value(table(interpolation, AfterEnd::zero).ramp_from(t)), V{});
      EXPECT_EQ(value(table(interpolation, AfterEnd::hold).ramp_from(t)), (V{5, 2, 1}));
      EXPECT_EQ(table(interpolation, AfterEnd::hold).ramp_from(t).slope, V{});
    }
  }
}

TEST(TableTorque, has_an_edge_at_every_knot_and_none_after) {
  for (const auto interpolation : {Interpolation::hold, Interpolation::linear}) {
    const auto torque = table(interpolation, AfterEnd::zero);
    EXPECT_EQ(torque.next_edge_after(kFirst), kSecond);
    EXPECT_EQ(torque.next_edge_after(0), kSecond);
    EXPECT_EQ(torque.next_edge_after(kSecond - 1), kSecond);
    EXPECT_EQ(torque.next_edge_after(kSecond), 2 * kSecond);
    EXPECT_EQ(torque.next_edge_after(2 * kSecond), 4 * kSecond);
    EXPECT_EQ(torque.next_edge_after(4 * kSecond), kNever);
  }
}

TEST(TableTorque, of_one_knot_is_a_step_or_nothing) {
  Table<double> torque{Frame::body, Interpolation::linear, AfterEnd::hold, {kSecond}, {{1, 2, 3}}};
  EXPECT_EQ(value(torque.ramp_from(kSecond)), (V{1, 2, 3}));
  torque.after_end = AfterEnd::zero;
  EXPECT_EQ(value(torque.ramp_from(kSecond)), V{});
}

TEST(TableTorque, with_no_knots_is_zero_without_edges) {
  const Table<double> torque;
  EXPECT_EQ(value(torque.ramp_from(0)), V{});
  EXPECT_EQ(torque.next_edge_after(0), kNever);
}

Commanded<double> two_pulses() {
  Commanded<double> torque;
  torque.window[0] = {100, 200, {1, 0, 0}};
  torque.window[1] = {300, 400, {0, 2, 0}};
  torque.intervals = 2;
  return torque;
}

TEST(CommandedTorque, acts_from_its_start_up_to_but_not_at_its_end) {
  const auto torque = two_pulses();
  EXPECT_EQ(value(torque.ramp_from(99)), V{});
  EXPECT_EQ(value(torque.ramp_from(100)), (V{1, 0, 0}));
  EXPECT_EQ(value(torque.ramp_from(199)), (V{1, 0, 0}));
  EXPECT_EQ(value(torque.ramp_from(200)), V{});
  EXPECT_EQ(value(torque.ramp_from(300)), (V{0, 2, 0}));
  EXPECT_EQ(value(torque.ramp_from(400)), V{});
}

TEST(CommandedTorque, has_an_edge_at_every_start_and_end) {
  const auto torque = two_pulses();
  EXPECT_EQ(torque.next_edge_after(0), 100);
  EXPECT_EQ(torque.next_edge_after(100), 200);
  EXPECT_EQ(torque.next_edge_after(150), 200);
  EXPECT_EQ(torque.next_edge_after(200), 300);
  EXPECT_EQ(torque.next_edge_after(399), 400);
  EXPECT_EQ(torque.next_edge_after(400), kNever);
}

TEST(CommandedTorque, passes_from_one_command_to_the_next_without_a_gap) {
  auto torque = two_pulses();
  torque.window[1].start_ns = 200;
  EXPECT_EQ(value(torque.ramp_from(199)), (V{1, 0, 0}));
  EXPECT_EQ(value(torque.ramp_from(200)), (V{0, 2, 0}));
  EXPECT_EQ(torque.next_edge_after(150), 200);
  EXPECT_EQ(torque.next_edge_after(200), 400);
}

TEST(CommandedTorque, sees_only_the_intervals_that_are_counted) {
  auto torque = two_pulses();
  torque.intervals = 1;
  EXPECT_EQ(value(torque.ramp_from(300)), V{});
  EXPECT_EQ(torque.next_edge_after(200), kNever);
  torque.intervals = Commanded<double>::kWindow;
  torque.window[15] = {500, 600, {0, 0, 3}};
  EXPECT_EQ(value(torque.ramp_from(500)), (V{0, 0, 3}));
}

TEST(CommandedTorque, does_nothing_without_a_command) {
  const Commanded<double> torque;
  EXPECT_EQ(value(torque.ramp_from(0)), V{});
  EXPECT_EQ(torque.next_edge_after(0), kNever);
}

}  // namespace
}  // namespace adstar
