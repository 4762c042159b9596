// What a standby makes of what it hears, without a bus and without a clock.
#include "service/bridge/pursuit.hpp"

#include <memory>

#include <gtest/gtest.h>

namespace adstar::bridge {
namespace {

using runtime::CommanderId;
using runtime::JournalKind;
using runtime::JournalRecord;
using Verdict = Pursuit::Verdict;

constexpr std::int64_t kMs = 1'000'000;
constexpr CommanderId kAnna{0, 10}, kBert{0, 20}, kCarl{0, 30};
const scene::Standby kStandby{5, 100 * kMs};  // lead 5 beats, lease 100 ms

JournalRecord record(std::uint64_t number, std::uint64_t step) {
  return {number, step, JournalKind::command, 0, {}};
}

class PursuitTest : public testing::Test {
 protected:
  void hear_beat(const Claim& claim, std::uint64_t step, std::uint64_t next_number,
                 std::uint64_t ended = 0) {
    pursuit_->hear_beat(claim, {step, next_number, now, ended});
  }
  void hand_over_state(std::uint64_t next_number) {
    pursuit_->hear_state(kAnna, run::Bytes(8), next_number);
    ASSERT_NE(pursuit_->state_to_hand_over(), nullptr);
    pursuit_->state_is_handed_over();
  }
  /// Bound to Anna at beat 100, with record 1 to come next.
  void follow_anna() {
    hear_beat({1, kAnna}, 100, 1);
    hand_over_state(1);
    link.following.store(1);
    ASSERT_EQ(go_on(), Verdict::follow);
  }
  void begin_anew() { pursuit_ = std::make_unique<Pursuit>(link, kStandby, now); }
  Verdict go_on(std::int64_t later_ms = 1) {
    now += later_ms * kMs;
    return pursuit_->go_on(now);
  }
  std::vector<std::uint64_t> pushed() {
    std::vector<std::uint64_t> numbers;
    while (const auto one = link.followed.pop()) {
      numbers.push_back(one->number);
    }
    return numbers;
  }

  std::unique_ptr<runtime::StandbyLink> link_ = std::make_unique<runtime::StandbyLink>();
  runtime::StandbyLink& link = *link_;
  std::int64_t now = 1'000'000 * kMs;
  std::unique_ptr<Pursuit> pursuit_ = std::make_unique<Pursuit>(link, kStandby, now);
};

TEST_F(PursuitTest, a_state_is_handed_over_once_nothing_is_missing_behind_it) {
  hear_beat({1, kAnna}, 100, 9);
  pursuit_->hear_state(kAnna, run::Bytes(8), 5);
  EXPECT_EQ(pursuit_->state_to_hand_over(), nullptr) << "records 5 to 8 are not here";
  pursuit_->hear_record(kAnna, record(6, 90));
  EXPECT_EQ(pursuit_->state_to_hand_over(), nullptr) << "record 5 is not here";
  pursuit_->hear_state(kAnna, run::Bytes(16), 6);
  ASSERT_NE(pursuit_->state_to_hand_over(), nullptr);
  EXPECT_EQ(pursuit_->state_to_hand_over()->size(), 16u);
  pursuit_->state_is_handed_over();
  EXPECT_EQ(pursuit_->state_to_hand_over(), nullptr);
  EXPECT_EQ(link.next_followed.load(), 6u);
}

TEST_F(PursuitTest, records_are_handed_over_in_order_and_once) {
  follow_anna();
  for (const std::uint64_t number : {1u, 2u, 2u, 1u, 3u}) {
    pursuit_->hear_record(kAnna, record(number, 100 + number));
  }
  pursuit_->hear_record(kBert, record(4, 104));
  EXPECT_EQ(go_on(), Verdict::follow);
  EXPECT_EQ(pushed(), (std::vector<std::uint64_t>{1, 2, 3}));
}

TEST_F(PursuitTest, it_takes_over_when_the_primary_is_gone) {
  follow_anna();
  pursuit_->hear_end(kBert);
  EXPECT_EQ(go_on(), Verdict::follow);
  pursuit_->hear_end(kAnna);
  EXPECT_EQ(go_on(), Verdict::take_over);
}

TEST_F(PursuitTest, a_primary_that_is_heard_again_is_not_gone) {
  follow_anna();
  pursuit_->hear_end(kAnna);
  hear_beat({1, kAnna}, 101, 1);
  EXPECT_EQ(go_on(), Verdict::follow);
}

TEST_F(PursuitTest, it_takes_over_at_once_from_one_that_ends_in_good_order) {
  follow_anna();
  hear_beat({1, kAnna}, 120, 1);
  const std::int64_t heard_ns = now;
  now += 50 * kMs;
  hear_beat({1, kAnna}, 120, 1, 1);
  EXPECT_EQ(go_on(), Verdict::take_over);
  runtime::StandbyBeatRecord beat;
  ASSERT_GT(link.primary_beat.read(beat), 0u);
  EXPECT_EQ(beat.received_ns, heard_ns)
      << "the phase is that of the last beat, not of the last words";
}

TEST_F(PursuitTest, a_primary_that_goes_before_its_state_is_here_is_waited_for_no_longer) {
  hear_beat({1, kAnna}, 100, 1);
  pursuit_->hear_end(kAnna);
  EXPECT_EQ(go_on(), Verdict::follow);
  hear_beat({1, kBert}, 7, 1);
  EXPECT_TRUE(pursuit_->follows(kBert));
}

TEST_F(PursuitTest, a_primary_that_goes_while_the_tick_takes_its_state_loses_no_command) {
  hear_beat({1, kAnna}, 100, 1);
  hand_over_state(1);
  pursuit_->hear_record(kAnna, record(1, 103));
  hear_beat({1, kAnna}, 101, 2);
  pursuit_->hear_end(kAnna);
  EXPECT_EQ(go_on(5'000), Verdict::follow) << "nobody follows yet";
  link.following.store(1);
  EXPECT_EQ(go_on(), Verdict::take_over);
  EXPECT_EQ(pushed(), std::vector<std::uint64_t>{1});
  runtime::StandbyBeatRecord beat;
  ASSERT_GT(link.primary_beat.read(beat), 0u);
  EXPECT_EQ(beat.step, 101u);
}

TEST_F(PursuitTest, nothing_is_taken_over_before_the_tick_has_all_that_came) {
  follow_anna();
  constexpr std::uint64_t kRoom = decltype(runtime::StandbyLink::followed)::kCapacity;
  for (std::uint64_t number = 1; number <= kRoom + 1; ++number) {
    pursuit_->hear_record(kAnna, record(number, 100));
  }
  pursuit_->hear_end(kAnna);
  EXPECT_EQ(go_on(), Verdict::follow);
  EXPECT_EQ(pushed().size(), kRoom);
  EXPECT_EQ(go_on(), Verdict::take_over);
  EXPECT_EQ(pushed(), std::vector<std::uint64_t>{kRoom + 1});
}

TEST_F(PursuitTest, track_is_lost_over_a_gap_between_records) {
  follow_anna();
  pursuit_->hear_record(kAnna, record(2, 105));
  EXPECT_EQ(go_on(), Verdict::lost_track);
  EXPECT_EQ(link.lost_track.load(), 1u);
  pursuit_->hear_end(kAnna);
  EXPECT_EQ(go_on(), Verdict::lost_track);
}

TEST_F(PursuitTest, track_is_lost_over_a_record_that_does_not_come) {
  follow_anna();
  hear_beat({1, kAnna}, 101, 2);
  EXPECT_EQ(go_on(), Verdict::follow);
  EXPECT_EQ(go_on(900), Verdict::follow) << "it may be sent again";
  EXPECT_EQ(go_on(200), Verdict::lost_track);
}

TEST_F(PursuitTest, a_record_that_came_late_is_no_loss) {
  follow_anna();
  hear_beat({1, kAnna}, 101, 2);
  EXPECT_EQ(go_on(900), Verdict::follow);
  pursuit_->hear_record(kAnna, record(1, 105));
  EXPECT_EQ(go_on(), Verdict::follow);
  EXPECT_EQ(go_on(2'000), Verdict::follow);
}

TEST_F(PursuitTest, a_command_that_the_primary_cannot_have_heard_yet_is_no_reason_to_hesitate) {
  follow_anna();
  hear_beat({1, kAnna}, 105,
            2);  // record 1 came at beat 100 at the earliest: heard at 105, not before
  EXPECT_EQ(go_on(), Verdict::follow);
  pursuit_->hear_end(kAnna);
  EXPECT_EQ(go_on(), Verdict::take_over);
}

TEST_F(PursuitTest, a_command_that_the_primary_may_have_obeyed_must_not_be_missing) {
  follow_anna();
  hear_beat({1, kAnna}, 106, 2);
  EXPECT_EQ(go_on(), Verdict::follow);
  pursuit_->hear_end(kAnna);
  EXPECT_EQ(go_on(), Verdict::lost_track);
}

TEST_F(PursuitTest, another_primary_has_another_state_and_is_not_followed_with_this_one) {
  follow_anna();
  hear_beat({1, kCarl}, 50, 1);  // does not go before Anna
  EXPECT_EQ(go_on(), Verdict::follow);
  hear_beat({2, kBert}, 130, 1);
  EXPECT_EQ(go_on(), Verdict::lost_track);
}

TEST_F(PursuitTest, before_it_has_a_state_it_turns_to_whoever_goes_before) {
  hear_beat({1, kAnna}, 100, 1);
  pursuit_->hear_state(kAnna, run::Bytes(8), 1);
  hear_beat({2, kBert}, 130, 3);
  EXPECT_TRUE(pursuit_->follows(kBert));
  EXPECT_EQ(pursuit_->state_to_hand_over(), nullptr) << "that was Anna's";
}

TEST_F(PursuitTest, begun_anew_it_goes_on_with_the_same_primary) {
  follow_anna();
  pursuit_->hear_record(kAnna, record(1, 101));
  ASSERT_EQ(go_on(), Verdict::follow);
  begin_anew();  // another bridge
  EXPECT_TRUE(pursuit_->follows(kAnna));
  pursuit_->hear_record(kAnna, record(1, 101));
  pursuit_->hear_record(kAnna, record(2, 102));
  hear_beat({1, kAnna}, 102, 3);
  EXPECT_EQ(go_on(2'000), Verdict::follow);
  EXPECT_EQ(pushed(), (std::vector<std::uint64_t>{1, 2}));
}

TEST_F(PursuitTest, begun_anew_it_takes_over_when_nothing_is_heard_for_long) {
  follow_anna();
  begin_anew();
  EXPECT_EQ(go_on(900), Verdict::follow);
  EXPECT_EQ(go_on(200), Verdict::take_over);
}

}  // namespace
}  // namespace adstar::bridge
