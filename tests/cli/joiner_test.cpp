#include "service/samples/joiner.hpp"

#include <algorithm>
#include <map>

#include <gtest/gtest.h>

#include "service/dds/convert.hpp"

namespace adstar::samples {
namespace {

using report::kAttitude, report::kColumns, report::kMomentumBody, report::kWork, report::Row;

adstar_AttitudeState attitude(std::uint64_t step, const char* name = "sat1") {
  adstar_AttitudeState sample{};
  dds::set_text(sample.spacecraft, name);
  sample.step = step;
  sample.time_ns = static_cast<std::int64_t>(step) * 1'000'000;
  sample.attitude_body_to_inertial = {1, 2, 3, 4};
  sample.angular_velocity_body_rad_s = {5, 6, 7};
  return sample;
}

adstar_MomentumState momentum(std::uint64_t step, const char* name = "sat1") {
  adstar_MomentumState sample{};
  dds::set_text(sample.spacecraft, name);
  sample.step = step;
  sample.time_ns = static_cast<std::int64_t>(step) * 1'000'000;
  sample.momentum_inertial_n_m_s = {8, 9, 10};
  sample.momentum_body_n_m_s = {11, 12, 13};
  sample.rotational_energy_j = 14;
  sample.work_j = 15;
  return sample;
}

/// "sat1@3:both sat1@4:attitude"
std::string described(const std::vector<Row>& rows) {
  std::string text;
  for (const Row& row : rows) {
    const bool has_attitude = row.values[kAttitude].has_value();
    const bool has_momentum = row.values[kMomentumBody].has_value();
    text += (text.empty() ? "" : " ") + row.spacecraft + "@" + std::to_string(row.step) + ":" +
            (has_attitude && has_momentum ? "both"
             : has_attitude               ? "attitude"
                                          : "momentum");
  }
  return text;
}

TEST(Joiner, puts_every_value_into_its_column) {
  Joiner joiner;
  joiner.add(attitude(3));
  joiner.add(momentum(3));
  const auto rows = joiner.end_round();
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].time_ns, 3'000'000);
  for (std::size_t i = 0; i < kColumns.size(); ++i) {
    EXPECT_EQ(rows[0].values[i], static_cast<double>(i + 1)) << kColumns[i];
  }
}

TEST(Joiner, a_half_waits_for_the_other) {
  Joiner joiner;
  joiner.add(attitude(3));
  EXPECT_EQ(described(joiner.end_round()), "");
  joiner.add(momentum(3));
  EXPECT_EQ(described(joiner.end_round()), "sat1@3:both");
}

TEST(Joiner, the_order_of_the_topics_within_a_round_does_not_matter) {
  Joiner joiner;
  joiner.add(attitude(3));
  joiner.add(attitude(4));
  joiner.add(momentum(3));
  joiner.add(momentum(4));
  EXPECT_EQ(described(joiner.end_round()), "sat1@3:both sat1@4:both");
}

TEST(Joiner, a_half_goes_alone_when_a_later_step_has_come) {
  Joiner joiner;
  joiner.add(attitude(3));
  joiner.end_round();
  joiner.add(attitude(4));
  EXPECT_EQ(described(joiner.end_round()), "sat1@3:attitude");
  joiner.add(momentum(4));
  EXPECT_EQ(described(joiner.end_round()), "sat1@4:both");
}

TEST(Joiner, a_half_that_comes_after_its_row_went_is_dropped) {
  Joiner joiner;
  joiner.add(attitude(3));
  joiner.add(attitude(4));
  EXPECT_EQ(described(joiner.end_round()), "sat1@3:attitude");
  joiner.add(momentum(3));
  EXPECT_EQ(described(joiner.end_round()), "");
  EXPECT_EQ(described(joiner.rest()), "sat1@4:attitude");
}

TEST(Joiner, a_half_that_was_put_aside_is_not_that_of_a_new_run_once_that_one_speaks) {
  Joiner joiner;
  joiner.add(attitude(5));
  joiner.add(attitude(6));
  EXPECT_EQ(described(joiner.end_round()), "sat1@5:attitude");
  joiner.add(momentum(5));
  joiner.end_round();
  joiner.add(attitude(5));
  adstar_MomentumState of_the_new_run = momentum(5);
  of_the_new_run.momentum_body_n_m_s.x = 77;
  joiner.add(of_the_new_run);
  const std::vector<Row> rows = joiner.end_round();
  ASSERT_EQ(described(rows), "sat1@5:both");
  EXPECT_EQ(rows[0].values[kMomentumBody], 77);
}

/// As many lines as there may be, the oldest with a half that waits: it goes, and is remembered beside the one put aside.
TEST(Joiner, a_half_that_was_put_aside_survives_that_others_are) {
  Joiner joiner;
  joiner.add(attitude(0));
  joiner.add(attitude(1));
  EXPECT_EQ(described(joiner.end_round()), "sat1@0:attitude");
  joiner.add(momentum(0));
  for (const std::uint64_t step : {10U, 9U, 8U, 7U, 0U}) {
    joiner.add(attitude(step));
  }
  EXPECT_NE(described(joiner.rest()).find("sat1@0:both"), std::string::npos);
}

TEST(Joiner, spacecraft_do_not_wait_for_each_other) {
  Joiner joiner;
  joiner.add(attitude(3, "sat1"));
  joiner.add(attitude(4, "sat2"));
  joiner.add(momentum(4, "sat2"));
  EXPECT_EQ(described(joiner.end_round()), "sat2@4:both");
}

TEST(Joiner, a_daemon_that_begins_anew_is_heard_from_its_first_step) {
  Joiner joiner;
  joiner.add(attitude(900));
  joiner.add(momentum(900));
  joiner.add(attitude(1000));
  EXPECT_EQ(described(joiner.end_round()), "sat1@900:both");
  joiner.add(attitude(0));
  joiner.add(momentum(0));
  EXPECT_EQ(described(joiner.end_round()), "sat1@0:both");
  EXPECT_EQ(described(joiner.rest()), "sat1@1000:attitude");
}

TEST(Joiner, a_sample_long_past_takes_no_other_half_away) {
  for (const auto patience : {Joiner::Patience::rounds, Joiner::Patience::both_topics}) {
    Joiner joiner(patience);
    joiner.add(attitude(1000));
    joiner.end_round();
    joiner.add(attitude(5));
    joiner.add(attitude(6));
    joiner.add(momentum(5));
    EXPECT_EQ(described(joiner.end_round()), "sat1@5:both");
    joiner.add(momentum(6));
    joiner.add(momentum(1000));
    EXPECT_EQ(described(joiner.end_round()), "sat1@1000:both sat1@6:both");
    joiner.add(attitude(1001));
    joiner.add(momentum(1001));
    EXPECT_EQ(described(joiner.end_round()), "sat1@1001:both");
    EXPECT_EQ(described(joiner.rest()), "");
  }
}

TEST(Joiner, a_half_of_an_ended_run_is_not_joined_with_one_of_the_next) {
  for (const auto patience : {Joiner::Patience::rounds, Joiner::Patience::both_topics}) {
    Joiner joiner(patience);
    joiner.add(attitude(69));
    joiner.add(momentum(69));
    joiner.add(attitude(70));
    EXPECT_EQ(described(joiner.end_round()), "sat1@69:both");
    std::vector<Row> rows;
    for (std::uint64_t step = 0; step < 80; ++step) {
      joiner.add(momentum(step));
      joiner.add(attitude(step));
      for (Row& row : joiner.end_round()) {
        rows.push_back(std::move(row));
      }
    }
    ASSERT_EQ(rows.size(), 81U);
    std::uint64_t step = 0;
    for (const Row& row : rows) {
      if (described({row}) != "sat1@70:attitude") {
        EXPECT_EQ(described({row}), "sat1@" + std::to_string(step++) + ":both");
      }
    }
    EXPECT_EQ(step, 80U);
  }
}

TEST(Joiner, each_who_speaks_at_once_is_joined_with_itself) {
  Joiner joiner;
  for (const std::uint64_t step : {0U, 1U}) {
    for (const std::uint64_t from : {1000U, 700U, 400U, 100U}) {
      joiner.add(attitude(from + step));
    }
    for (const std::uint64_t from : {1000U, 700U, 400U, 100U}) {
      joiner.add(momentum(from + step));
    }
    EXPECT_EQ(described(joiner.end_round()),
              step == 0 ? "sat1@1000:both sat1@700:both sat1@400:both sat1@100:both"
                        : "sat1@1001:both sat1@701:both sat1@401:both sat1@101:both");
  }
}

TEST(Joiner, what_waits_is_given_out_when_more_speak_at_once_than_it_keeps_apart) {
  Joiner joiner(Joiner::Patience::both_topics);
  for (const std::uint64_t from : {1000U, 700U, 400U, 100U}) {
    joiner.add(attitude(from));
  }
  EXPECT_EQ(described(joiner.end_round()), "");
  joiner.add(attitude(10));
  EXPECT_EQ(described(joiner.end_round()), "sat1@1000:attitude");
}

TEST(Joiner, with_patience_waits_for_halves_that_stand_far_apart) {
  Joiner joiner(Joiner::Patience::both_topics);
  joiner.add(attitude(1));
  joiner.add(attitude(2));
  joiner.add(attitude(3));
  EXPECT_EQ(described(joiner.end_round()), "");
  joiner.add(momentum(1));
  joiner.add(momentum(3));
  EXPECT_EQ(described(joiner.end_round()), "sat1@1:both sat1@2:attitude sat1@3:both");
  joiner.add(attitude(4));
  EXPECT_EQ(described(joiner.end_round()), "");
  EXPECT_EQ(described(joiner.rest()), "sat1@4:attitude");
}

/// Halves of a stream, said in turn: attitude and momentum of each step, but for those said apart.
class Stream {
 public:
  Stream(Joiner::Patience patience, std::uint64_t steps_a_round)
      : joiner_(patience), steps_a_round_(steps_a_round) {}

  template <class Sample>
  void say(const Sample& sample) {
    joiner_.add(sample);
  }
  void fly(std::uint64_t first, std::uint64_t last) {
    for (std::uint64_t step = first; step <= last; ++step) {
      say(momentum(step));
      say(attitude(step));
      if (step % steps_a_round_ == 0) {
        keep(joiner_.end_round());
      }
    }
  }
  /// All rows of the end, by step: which halves each had.
  const std::multimap<std::uint64_t, std::string>& end() {
    keep(joiner_.rest());
    return rows_;
  }

 private:
  void keep(const std::vector<Row>& rows) {
    for (const Row& row : rows) {
      rows_.emplace(row.step, described({row}));
    }
  }

  Joiner joiner_;
  std::uint64_t steps_a_round_;
  std::multimap<std::uint64_t, std::string> rows_;
};

std::vector<Stream> streams() {
  std::vector<Stream> streams;
  for (const std::uint64_t steps_a_round : {1U, 512U}) {
    streams.emplace_back(Joiner::Patience::rounds, steps_a_round);
    streams.emplace_back(Joiner::Patience::both_topics, steps_a_round);
  }
  return streams;
}

TEST(Joiner, the_halves_of_a_step_are_one_row_though_one_of_them_comes_late_and_out_of_order) {
  for (const std::uint64_t last : {13U, 14U, 40U, 100U, 5000U}) {
    for (const bool momentum_is_late : {true, false}) {
      for (Stream& stream : streams()) {
        stream.fly(1, 9);
        for (const std::uint64_t step : {10U, 11U, 12U}) {
          momentum_is_late ? stream.say(attitude(step)) : stream.say(momentum(step));
        }
        stream.fly(13, last);
        for (const std::uint64_t step : {11U, 10U, 12U}) {
          momentum_is_late ? stream.say(momentum(step)) : stream.say(attitude(step));
        }
        stream.fly(last + 1, last + 100);
        const auto& rows = stream.end();
        EXPECT_EQ(rows.size(), last + 100) << last;
        for (std::uint64_t step = 1; step <= last + 100; ++step) {
          ASSERT_EQ(rows.count(step), 1U) << step;
          EXPECT_TRUE((step >= 10 && step <= 12) || rows.find(step)->second.ends_with("both"))
              << rows.find(step)->second;
        }
      }
    }
  }
}

TEST(Joiner, a_late_half_that_another_line_would_take_tears_none_of_its_rows) {
  for (Stream& stream : streams()) {
    stream.say(attitude(1000));
    stream.fly(1, 80);
    stream.say(momentum(1000));
    stream.fly(81, 200);
    const auto& rows = stream.end();
    EXPECT_EQ(rows.size(), 201U);
    for (std::uint64_t step = 1; step <= 200; ++step) {
      ASSERT_EQ(rows.count(step), 1U) << step;
      EXPECT_TRUE(rows.find(step)->second.ends_with("both")) << rows.find(step)->second;
    }
    EXPECT_EQ(rows.count(1000), 1U);
  }
}

TEST(Joiner, a_run_that_begins_anew_has_both_halves_of_a_step_of_which_the_one_before_had_one) {
  for (const bool momentum_first : {true, false}) {
    for (Stream& stream : streams()) {
      stream.say(attitude(0));
      stream.fly(1, 600);
      if (momentum_first) {
        stream.say(momentum(0));
        stream.say(attitude(0));
      } else {
        stream.say(attitude(0));
        stream.say(momentum(0));
      }
      stream.fly(1, 100);
      const auto& rows = stream.end();
      EXPECT_EQ(rows.size(), 702U);
      const auto [first, second] = rows.equal_range(0);
      EXPECT_EQ(
          std::count_if(first, second, [](const auto& row) { return row.second == "sat1@0:both"; }),
          1);
      for (std::uint64_t step = 1; step <= 100; ++step) {
        EXPECT_EQ(rows.count(step), 2U) << step;
      }
    }
  }
}

TEST(Joiner, fleet_samples_speak_only_for_spacecraft_without_topics_of_their_own) {
  Joiner joiner;
  adstar_FleetState fleet{};
  fleet.step = 5;
  adstar_FleetMember member{};
  member.attitude_body_to_inertial = {0, 0, 0, 1};  // half a turn about z
  member.momentum_inertial_n_m_s = {1, 2, 3};
  joiner.add(attitude(5, "sat1"));
  joiner.add("sat1", fleet, member);
  joiner.add("sat2", fleet, member);
  joiner.add("sat2", fleet, member);
  const auto rows = joiner.end_round();
  ASSERT_EQ(described(rows), "sat2@5:both");
  EXPECT_EQ(rows[0].values[kMomentumBody], -1.0);
  EXPECT_EQ(rows[0].values[kMomentumBody + 1], -2.0);
  EXPECT_EQ(rows[0].values[kMomentumBody + 2], 3.0);
  EXPECT_FALSE(rows[0].values[kWork].has_value());
}

}  // namespace
}  // namespace adstar::samples
