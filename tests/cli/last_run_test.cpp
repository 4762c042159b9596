#include "service/adstar/last_run.hpp"

#include <initializer_list>
#include <vector>

#include <gtest/gtest.h>

#include "service/dds/convert.hpp"

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

/// At 1 kHz, of these milliseconds.
Times at_1_khz(Times times) {
  for (std::int64_t& t : times) {
    t *= 1'000'000;
  }
  return times;
}

struct Taken {
  Times times;
  std::uint64_t before = 0, older = 0;
};

/// Each received a millisecond after the one before, from 0 on.
constexpr std::int64_t kApart_ns = 1'000'000;

Taken taken_of(const Times& times, const NewVoices& voices = {}, const char* service = "fly") {
  RunFinder finder(voices);
  std::int64_t received_ns = 0;
  for (const std::int64_t t : times) {
    finder.add({t, service, received_ns});
    received_ns += kApart_ns;
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

/// A process and its run say a status as a service, when so many samples were received.
struct Voice {
  const char* service;
  std::uint64_t instance;
  std::uint32_t run;
  std::int64_t after;
};

NewVoices voices_of(const std::vector<Voice>& said) {
  NewVoices voices;
  for (const Voice& voice : said) {
    adstar_ServiceStatus status{};
    dds::set_text(status.service, voice.service);
    status.instance_low = voice.instance;
    status.run = voice.run;
    voices.hear(status, voice.after * kApart_ns);
  }
  return voices;
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

TEST(LastRun, does_not_begin_with_the_last_words_of_a_primary_that_had_hung) {
  const Times flown = at_1_khz(rising(0, 30'000));
  const NewVoices voices = voices_of({{"fly", 1, 0, 0},
                                      {"fly.standby", 2, 0, 200},
                                      {"fly", 1, 0, 1000},
                                      {"fly", 2, 0, 2000},
                                      {"fly.standby", 3, 0, 30'000},
                                      {"fly", 1, 0, 30'001}});
  for (const Times& words : {Times{1330, 1331, 1332, 1332}, Times{1, 2}, Times{1330}}) {
    const Taken taken = taken_of(joined({flown, at_1_khz(words)}), voices);
    EXPECT_EQ(taken.times, flown);
    EXPECT_EQ(taken.before, 0U);
    EXPECT_EQ(taken.older, words.size());
  }
}

TEST(LastRun, begins_where_a_process_or_a_run_of_it_speaks_for_the_first_time) {
  const Times flown = at_1_khz(rising(0, 30'000));
  const Times anew = at_1_khz(rising(300, 700));  // the first were missed
  for (const Voice& begun : {Voice{"fly", 2, 0, 30'000}, Voice{"fly", 1, 1, 30'000},
                             Voice{"fly", 1, 1, 32'000}, Voice{"fly", 1, 1, 29'500}}) {
    const NewVoices voices = voices_of({{"fly", 1, 0, 0}, begun});
    EXPECT_EQ(taken_of(joined({flown, anew}), voices).times, anew) << begun.after;
    const Taken taken = taken_of(joined({flown, anew, at_1_khz({5, 6})}), voices);
    EXPECT_EQ(taken.times, anew) << "5 and 6 are a word of whoever";
  }
}

TEST(LastRun, does_not_begin_where_somebody_else_speaks_for_the_first_time) {
  const Times flown = at_1_khz(rising(0, 30'000));
  const Times words = at_1_khz({1, 2});
  for (const Voice& begun :
       {Voice{"other", 2, 0, 30'000}, Voice{"fly", 2, 0, 20'000}, Voice{"fly", 2, 0, 40'000}}) {
    const NewVoices voices = voices_of({{"fly", 1, 0, 0}, begun});
    EXPECT_EQ(taken_of(joined({flown, words}), voices).times, flown) << begun.after;
  }
  const NewVoices other =
      voices_of({{"fly", 1, 0, 0}, {"other", 2, 0, 0}, {"other", 3, 0, 30'000}});
  EXPECT_EQ(taken_of(joined({flown, words}), other, "other").times, words);
}

TEST(LastRun, does_not_begin_with_whoever_flew_when_the_recording_began) {
  const Times flown = at_1_khz(rising(9'000, 10'000));
  const NewVoices voices = voices_of({{"fly", 1, 0, 700}});
  EXPECT_EQ(taken_of(joined({flown, at_1_khz({1, 2})}), voices).times, flown);
}

TEST(LastRun, begins_with_whoever_is_the_first_that_was_heard_of_the_service_but_came_later) {
  const Times flown = at_1_khz(rising(9'000, 16'000));
  const Times anew = at_1_khz(rising(300, 700));
  for (const auto& said : {std::vector<Voice>{{"fly", 2, 0, 7'001}},  // the one before: never heard
                           std::vector<Voice>{{"other", 1, 0, 0}, {"fly", 2, 0, 7'001}}}) {
    const Taken taken = taken_of(joined({flown, anew}), voices_of(said));
    EXPECT_EQ(taken.times, anew);
    EXPECT_EQ(taken.before, flown.size());
  }
  const NewVoices anew_at_once = voices_of({{"fly", 1, 0, 0}, {"fly", 2, 0, 1'001}});
  EXPECT_EQ(taken_of(joined({at_1_khz(rising(9'000, 10'000)), anew}), anew_at_once).times, anew)
      << "the second was not there before";
}

TEST(LastRun, begins_at_about_zero_where_nobody_knows_who_speaks) {
  const Times flown = at_1_khz(rising(0, 30'000));
  const Times words = at_1_khz({1330, 1331, 1332, 1332});
  EXPECT_EQ(taken_of(joined({flown, words})).times, flown);
  EXPECT_EQ(taken_of(joined({flown, at_1_khz({990, 991})})).times, at_1_khz({990, 991}));
  const Times slow = at_1_khz({10'000, 20'000});  // 0.1 Hz
  EXPECT_EQ(taken_of(joined({at_1_khz({10'000, 20'000, 30'000}), slow})).times, slow);
}

TEST(LastRun, goes_no_further_than_it_was_found) {
  RunReader reader({0, 2, 1, 2});
  EXPECT_TRUE(reader.takes(1));
  EXPECT_TRUE(reader.takes(2));
  EXPECT_FALSE(reader.takes(3));
}

}  // namespace
}  // namespace adstar::cli
