#include "service/runtime/histogram.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/random_motion.hpp"

namespace adstar::runtime {
namespace {

constexpr std::int64_t kMax = std::numeric_limits<std::int64_t>::max();

/// The smallest recorded value with at least that fraction at or below it.
std::int64_t exact_quantile(std::vector<std::int64_t> values, double fraction) {
  std::sort(values.begin(), values.end());
  const auto rank =
      static_cast<std::size_t>(std::ceil(fraction * static_cast<double>(values.size())));
  return values[std::max<std::size_t>(rank, 1) - 1];
}

void expect_close(std::int64_t got, std::int64_t exact) {
  EXPECT_GE(got, exact);
  EXPECT_LE(static_cast<double>(got), 1.032 * static_cast<double>(exact));
}

QuantilesRecord of(const std::vector<std::int64_t>& values) {
  const auto histogram = std::make_unique<Histogram>();
  for (const std::int64_t value : values) {
    histogram->record(value);
  }
  return histogram->quantiles();
}

TEST(Histogram, of_nothing_is_all_zero) {
  const QuantilesRecord none = of({});
  EXPECT_EQ(none.count, 0U);
  EXPECT_EQ(none.p50_ns, 0);
  EXPECT_EQ(none.p99_9_ns, 0);
  EXPECT_EQ(none.max_ns, 0);
}

TEST(Histogram, of_one_value_is_that_value) {
  for (const std::int64_t value : {std::int64_t{0}, std::int64_t{1}, std::int64_t{31},
                                   std::int64_t{32}, std::int64_t{12'345'678}, kMax}) {
    const QuantilesRecord one = of({value});
    EXPECT_EQ(one.count, 1U);
    EXPECT_EQ(one.p50_ns, value);
    EXPECT_EQ(one.p99_ns, value);
    EXPECT_EQ(one.p99_9_ns, value);
    EXPECT_EQ(one.max_ns, value);
  }
}

TEST(Histogram, counts_negative_times_as_zero) {
  const QuantilesRecord q = of({-5, std::numeric_limits<std::int64_t>::min(), -1, 7});
  EXPECT_EQ(q.count, 4U);
  EXPECT_EQ(q.p50_ns, 0);
  EXPECT_EQ(q.max_ns, 7);
}

TEST(Histogram, knows_small_times_exactly) {
  std::vector<std::int64_t> values;
  for (std::int64_t i = 0; i < 64; ++i) {
    values.push_back(i);
  }
  EXPECT_EQ(of(values).p50_ns, 31);
}

TEST(Histogram, takes_the_largest_times_there_are) {
  const QuantilesRecord q = of({kMax, kMax - 1, kMax / 2, 1});
  EXPECT_EQ(q.max_ns, kMax);
  EXPECT_EQ(q.p99_ns, kMax);
  expect_close(q.p50_ns, kMax / 2);
}

TEST(Histogram, knows_every_quantile_within_3_percent_over_nine_decades) {
  test::Generator random(321);
  for (int round = 0; round < 20; ++round) {
    std::vector<std::int64_t> values(5000);
    const double top = test::log_uniform(random, 100, 1e12);
    for (std::int64_t& value : values) {
      value = static_cast<std::int64_t>(test::log_uniform(random, 1, top));
    }
    const QuantilesRecord q = of(values);
    EXPECT_EQ(q.count, values.size());
    EXPECT_EQ(q.max_ns, *std::max_element(values.begin(), values.end()));
    expect_close(q.p50_ns, exact_quantile(values, 0.5));
    expect_close(q.p99_ns, exact_quantile(values, 0.99));
    expect_close(q.p99_9_ns, exact_quantile(values, 0.999));
  }
}

TEST(Histogram, every_single_bucket_border_stays_within_3_percent) {
  const auto check = [](std::int64_t value) {
    // Many at `value`, one far above, so that the maximum does not cap the answer.
    expect_close(of({value, value, value, kMax}).p50_ns, value);
  };
  for (int octave = 0; octave < 62; ++octave) {
    const std::int64_t power = std::int64_t{1} << octave;
    for (const std::int64_t value : {power - 1, power, power + 1, power + power / 32,
                                     power + power / 2 - 1, power + power / 2}) {
      check(value);
    }
  }
}

TEST(Histogram, finds_the_one_in_a_thousand) {
  std::vector<std::int64_t> values(9'990, 1'000);
  values.insert(values.end(), 10, 1'000'000);
  expect_close(of(values).p99_ns, 1'000);
  expect_close(of(values).p99_9_ns, 1'000);
  values.push_back(1'000'000);
  expect_close(of(values).p99_9_ns, 1'000'000);
}

TEST(Histogram, may_be_read_while_it_records) {
  const auto histogram = std::make_unique<Histogram>();
  constexpr std::int64_t kRecords = 200'000;
  std::thread writer([&] {
    for (std::int64_t n = 0; n < kRecords; ++n) {
      histogram->record(n % 1000);
    }
  });
  std::uint64_t before = 0;
  while (before < kRecords) {
    const QuantilesRecord q = histogram->quantiles();
    ASSERT_GE(q.count, before);
    ASSERT_LE(q.p50_ns, q.p99_ns);
    ASSERT_LE(q.max_ns, 999);
    before = q.count;
  }
  writer.join();
  expect_close(histogram->quantiles().p50_ns, 499);
}

TEST(Histogram, counts_quarters_of_octaves_at_their_edges_and_keeps_the_sum) {
  const auto histogram = std::make_unique<Histogram>();
  const std::int64_t top = std::int64_t{1} << 30;
  for (const std::int64_t ns :
       {std::int64_t{-5}, std::int64_t{0}, std::int64_t{255}, std::int64_t{256}, std::int64_t{303},
        std::int64_t{304}, std::int64_t{511}, std::int64_t{512}, top - 1, top, 8 * top}) {
    histogram->record(ns);
  }
  QuarterOctaveCounts expected{};
  expected[0] = 3;
  expected[1] = 2;
  expected[2] = 1;
  expected[4] = 1;
  expected[5] = 1;
  expected[88] = 1;
  expected[89] = 2;
  EXPECT_EQ(histogram->quarter_octaves(), expected);
  EXPECT_EQ(histogram->sum_ns(),
            static_cast<std::uint64_t>(255 + 256 + 303 + 304 + 511 + 512 - 1 + 10 * top));
}

TEST(Histogram, has_edges_a_fifth_apart_at_most_and_every_time_on_its_side_of_each) {
  EXPECT_EQ(quarter_octave_edge_ns(0), 256);
  EXPECT_EQ(quarter_octave_edge_ns(kQuarterOctaves - 2), std::int64_t{1} << 30);
  for (std::size_t i = 0; i + 1 < kQuarterOctaves; ++i) {
    const std::int64_t edge = quarter_octave_edge_ns(i);
    const auto histogram = std::make_unique<Histogram>();
    histogram->record(edge - 1);
    histogram->record(edge);
    EXPECT_EQ(histogram->quarter_octaves()[i], 1U) << edge;
    EXPECT_EQ(histogram->quarter_octaves()[i + 1], 1U) << edge;
    if (i > 0) {
      const std::int64_t before = quarter_octave_edge_ns(i - 1);
      EXPECT_GT(edge, before);
      EXPECT_LE(5 * edge, 6 * before);
    }
  }
}

}  // namespace
}  // namespace adstar::runtime
