#include "service/runtime/beat_clock.hpp"

#include <random>

#include <gtest/gtest.h>

namespace adstar::runtime {
namespace {

constexpr std::int64_t kBase = 123'456'789'012;
constexpr std::int64_t kMs = 1'000'000;

TEST(BeatClock, is_due_at_base_plus_n_periods_exactly_for_a_trillion_beats) {
  const BeatClock clock = make_beat_clock(kBase, kMs, 1.0);
  for (const std::uint64_t n : {0ULL, 1ULL, 2ULL, 999'983ULL, 1'000'000'000ULL, 1'000'000'007ULL,
                                999'999'999'999ULL, 1'000'000'000'000ULL}) {
    EXPECT_EQ(due_ns(clock, n), kBase + static_cast<std::int64_t>(n) * kMs) << n;
  }
}

TEST(BeatClock, spreads_a_period_that_is_no_whole_number_without_drift) {
  // 1 ms at three times real time: 333,333 1/3 ns, three beats a millisecond for ever.
  const BeatClock clock = make_beat_clock(0, kMs, 3.0);
  EXPECT_EQ(due_ns(clock, 1), 333'333);
  EXPECT_EQ(due_ns(clock, 2), 666'666);
  for (const std::uint64_t thousands : {1ULL, 77ULL, 999'999'999ULL, 300'000'000'000ULL}) {
    EXPECT_EQ(due_ns(clock, 3 * thousands), static_cast<std::int64_t>(thousands) * kMs);
  }
}

TEST(BeatClock, never_goes_back_and_never_strays_from_the_exact_period_by_a_nanosecond) {
  std::mt19937_64 random(5);
  for (const double rate : {1e-6, 0.1, 1.0, 1.5, 7.0, 999.0, 1e6}) {
    const std::int64_t step = 9'999'991;
    const BeatClock clock = make_beat_clock(kBase, step, rate);
    for (int i = 0; i < 10'000; ++i) {
      const std::uint64_t n = random() % 10'000;
      const long double exact = static_cast<long double>(n) * step / static_cast<long double>(rate);
      const auto due = static_cast<long double>(due_ns(clock, n) - kBase);
      ASSERT_LE(due, exact * (1 + 1e-9L));
      ASSERT_GE(due, exact * (1 - 1e-9L) - 1);
      ASSERT_GE(due_ns(clock, n + 1), due_ns(clock, n));
    }
  }
}

TEST(BeatClock, takes_the_rate_to_a_millionth_and_never_to_zero) {
  EXPECT_EQ(due_ns(make_beat_clock(0, kMs, 0.5), 4), 8 * kMs);
  EXPECT_EQ(due_ns(make_beat_clock(0, kMs, 0.1), 1), 10 * kMs);
  EXPECT_EQ(due_ns(make_beat_clock(0, kMs, 1e-6), 1), 1'000'000 * kMs);
  EXPECT_EQ(due_ns(make_beat_clock(0, kMs, 1e-9), 1), 1'000'000 * kMs);
}

TEST(BeatClock, holds_a_step_of_a_day) {
  constexpr std::int64_t kDay = 86'400'000 * kMs;
  EXPECT_EQ(due_ns(make_beat_clock(0, kDay, 1.0), 100), 100 * kDay);
  EXPECT_EQ(due_ns(make_beat_clock(0, kDay, 1e6), 10), 864 * kMs);
}

TEST(BeatClock, counts_whole_periods_of_lateness_and_no_less) {
  const auto missed = [](std::int64_t late_ns) {
    BeatClock clock = make_beat_clock(kBase, kMs, 1.0);
    return realign(clock, 5, kBase + 5 * kMs + late_ns);
  };
  EXPECT_EQ(missed(-kMs), 0U);
  EXPECT_EQ(missed(0), 0U);
  EXPECT_EQ(missed(kMs - 1), 0U);
  EXPECT_EQ(missed(kMs), 1U);
  EXPECT_EQ(missed(2 * kMs - 1), 1U);
  EXPECT_EQ(missed(1000 * kMs + 1), 1000U);
  EXPECT_EQ(missed(31'536'000'000 * kMs), 31'536'000'000U) << "a year asleep";
}

TEST(BeatClock, keeps_the_phase_of_the_grid_when_beats_are_missed) {
  BeatClock clock = make_beat_clock(kBase, kMs, 1.0);
  realign(clock, 5, kBase + 5 * kMs + 7 * kMs + 300'000);
  EXPECT_EQ(due_ns(clock, 6), kBase + 13 * kMs);
  EXPECT_EQ(realign(clock, 6, kBase + 13 * kMs + 1), 0U);
  EXPECT_EQ(due_ns(clock, 1'000'000), kBase + 1'000'007 * kMs);
}

TEST(BeatClock, leaves_the_grid_where_it_is_for_beats_that_may_be_caught_up) {
  BeatClock clock = make_beat_clock(kBase, kMs, 1.0);
  const std::int64_t now = kBase + 5 * kMs + 7 * kMs + 300'000;
  EXPECT_EQ(beats_behind(clock, 5, now), 7U);
  EXPECT_EQ(realign(clock, 5, now, 10), 0U);
  EXPECT_EQ(due_ns(clock, 12), kBase + 12 * kMs) << "seven beats later it is on time again";
  EXPECT_EQ(realign(clock, 5, now, 3), 4U) << "three may be caught up, four are missed";
  EXPECT_EQ(beats_behind(clock, 5, now), 3U);
}

TEST(BeatClock, keeps_the_phase_of_a_fractional_grid_through_a_million_misses) {
  BeatClock clock = make_beat_clock(0, kMs, 3.0);
  std::uint64_t missed = 0;
  for (std::uint64_t n = 0; n < 1'000'000; ++n) {
    missed += realign(clock, n, due_ns(clock, n) + 400'000);
  }
  EXPECT_EQ(missed, 1'000'000U);
  // Two periods a beat: beat 3 k stands at 2 k ms.
  EXPECT_EQ(due_ns(clock, 1'000'000 + 2'000'000),
            (1'000'000 + 1'000'000 + 2'000'000) / 3 * kMs + 333'333);
}

TEST(BeatClock, is_on_time_again_right_after_it_realigned) {
  std::mt19937_64 random(11);
  for (const double rate : {0.3, 1.0, 3.0, 17.0}) {
    BeatClock clock = make_beat_clock(kBase, 10 * kMs, rate);
    for (std::uint64_t n = 0; n < 10'000; ++n) {
      const std::int64_t now = due_ns(clock, n) + static_cast<std::int64_t>(random() % 100'000'000);
      realign(clock, n, now);
      ASSERT_EQ(realign(clock, n, now), 0U);
      ASSERT_LE(due_ns(clock, n), now);
      ASSERT_GE(due_ns(clock, n + 1), now - 1);
    }
  }
}

TEST(BeatPhase, is_the_distance_to_the_nearest_whole_period_of_the_reference) {
  const BeatClock clock = make_beat_clock(1'000 * kMs, kMs, 1.0);
  EXPECT_EQ(phase_error_ns(clock, 7, 0), 0);
  EXPECT_EQ(phase_error_ns(clock, 7, 300), 300);
  EXPECT_EQ(phase_error_ns(clock, 7, -300), -300);
  EXPECT_EQ(phase_error_ns(clock, 7, 1'795'000'000'123'456'789), 456'789);
  EXPECT_EQ(phase_error_ns(clock, 7, -2'000'000 * kMs - 1), -1);
}

TEST(BeatPhase, is_brought_to_zero_without_a_jump_and_stays_there) {
  for (const std::int64_t offset :
       {499'999LL, -499'999LL, 12'345LL, -1'795'000'000'000'400'000LL}) {
    BeatClock clock = make_beat_clock(kBase, kMs, 1.0);
    std::int64_t before = due_ns(clock, 0);
    for (std::uint64_t n = 1; n < 2'000; ++n) {
      steer(clock, phase_error_ns(clock, n, offset));
      ASSERT_LE(std::abs(due_ns(clock, n) - before - kMs), kMs / 1000) << "a jump at beat " << n;
      before = due_ns(clock, n);
    }
    EXPECT_LT(std::abs(phase_error_ns(clock, 2'000, offset)), 8) << offset;
  }
}

TEST(BeatPhase, follows_a_reference_that_runs_fast) {
  BeatClock clock = make_beat_clock(kBase, kMs, 1.0);
  for (std::uint64_t n = 1; n < 100'000; ++n) {
    const std::int64_t offset = 77 + static_cast<std::int64_t>(n) * 50;  // 50 ppm
    steer(clock, phase_error_ns(clock, n, offset));
    if (n > 5'000) {
      ASSERT_LT(std::abs(phase_error_ns(clock, n, offset)), 500) << n;
    }
  }
}

}  // namespace
}  // namespace adstar::runtime
