#include "service/adstar/last_run.hpp"

#include <initializer_list>
#include <vector>

#include <gtest/gtest.h>

namespace adstar::cli {
namespace {

using Times = std::vector<std::int64_t>;

/// first, first + 1, ..., last.
Times rising(std::int64_t first, std::int64_t last) {
  Times times;
  for (std::int64_t t = first; t <= last; ++t) {
    times.push_back(t);
  }
  return times;
}

Times joined(std::initializer_list<Times> parts) {
  Times all;
  for (const Times& part : parts) {
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

struct Taken {
  Times times;
  std::uint64_t before = 0, older = 0;
};

Taken taken_of(const Times& times) {
  RunFinder finder;
  for (const std::int64_t t : times) {
    finder.add(t);
  }
  const RunSpan run = finder.last_run();
  RunReader reader(run);
  Taken taken;
  for (const std::int64_t t : times) {
    if (reader.takes(t)) {
      taken.times.push_back(t);
    }
  }
  EXPECT_EQ(run.end, times.size());
  EXPECT_EQ(taken.times.empty() ? 0 : taken.times.front(), run.first_ns);
  EXPECT_EQ(taken.times.empty() ? 0 : taken.times.back(), run.last_ns);
  taken.before = reader.before();
  taken.older = reader.older();
  return taken;
}

TEST(LastRun, is_all_of_one_run) {
  const Taken taken = taken_of(rising(3, 60));
  EXPECT_EQ(taken.times, rising(3, 60));
  EXPECT_EQ(taken.before, 0U);
  EXPECT_TRUE(taken_of({}).times.empty());
}

TEST(LastRun, begins_where_time_fell_back_and_went_on_from_there) {
  for (const std::int64_t last : {5, 60, 100}) {  // shorter than the first one, as long, longer
    const Taken taken = taken_of(joined({rising(1, 60), rising(2, last)}));
    EXPECT_EQ(taken.times, rising(2, last));
    EXPECT_EQ(taken.before, 60U);
    EXPECT_EQ(taken.older, 0U);
  }
}

TEST(LastRun, is_the_last_of_several) {
  const Taken taken = taken_of(joined({rising(1, 60), rising(1, 40), rising(1, 20)}));
  EXPECT_EQ(taken.times, rising(1, 20));
  EXPECT_EQ(taken.before, 100U);
}

TEST(LastRun, does_not_begin_with_what_a_daemon_says_that_had_stood_still) {
  for (const Times& late : {Times{1}, Times{40}, rising(1, 5), rising(50, 55)}) {
    const Taken taken = taken_of(joined({rising(1, 60), late, rising(61, 90)}));
    EXPECT_EQ(taken.times, rising(1, 90));
    EXPECT_EQ(taken.before, 0U);
    EXPECT_EQ(taken.older, late.size());
  }
  EXPECT_EQ(taken_of(joined({rising(1, 60), {1}})).times, rising(1, 60)) << "as the last word";
}

TEST(LastRun, does_not_begin_with_steps_that_are_repeated) {
  const Taken taken = taken_of(joined({rising(1, 60), rising(50, 90)}));
  EXPECT_EQ(taken.times, rising(1, 90));
  EXPECT_EQ(taken.older, 10U) << "the eleventh is not older";
  EXPECT_EQ(taken_of(joined({rising(1, 60), rising(50, 55)})).times, rising(1, 60));
}

TEST(LastRun, is_that_of_the_newer_one_of_two_who_fly_at_once) {
  Times times;
  for (std::int64_t t = 1; t <= 50; ++t) {
    times.push_back(t + 30);
    times.push_back(t);
  }
  EXPECT_EQ(taken_of(times).times, rising(31, 80));
}

TEST(LastRun, goes_no_further_than_it_was_found) {
  RunReader reader({0, 2, 1, 2});
  EXPECT_TRUE(reader.takes(1));
  EXPECT_TRUE(reader.takes(2));
  EXPECT_FALSE(reader.takes(3));
}

}  // namespace
}  // namespace adstar::cli
