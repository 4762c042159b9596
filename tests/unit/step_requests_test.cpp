// Who may let the clock step, and what they are answered.
#include "service/runtime/step_requests.hpp"

#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/gate_harness.hpp"

namespace adstar::runtime {
namespace {

using test::kAlice;
using test::kBob;

constexpr ClockFace kStanding{7, 70, true, false};

class StepRequestsTest : public ::testing::Test {
 protected:
  void ask(const CommanderId& who, std::uint64_t sequence, std::uint64_t steps,
           const ClockFace& now = kStanding) {
    requests.receive({who, sequence, steps, 0}, now);
  }
  /// The only reply since the last look.
  StepReplyRecord reply() {
    const auto first = ring->pop();
    EXPECT_TRUE(first.has_value());
    EXPECT_FALSE(ring->pop().has_value());
    return first.value_or(StepReplyRecord{});
  }
  bool silent() { return ring->size() == 0; }

  std::unique_ptr<StepReplyRing> ring = std::make_unique<StepReplyRing>();
  StepRequests requests{*ring};
};

TEST_F(StepRequestsTest, allow_so_many_steps_and_answer_after_the_last) {
  ask(kAlice, 1, 3);
  EXPECT_EQ(requests.allowed(), 3U);
  requests.stepped({8, 80, false, false}, false);
  requests.stepped({9, 90, false, false}, false);
  EXPECT_TRUE(silent());
  requests.stepped({10, 100, true, false}, false);
  EXPECT_EQ(requests.allowed(), 0U);
  const StepReplyRecord done = reply();
  EXPECT_EQ(done.requester, kAlice);
  EXPECT_EQ(done.sequence, 1U);
  EXPECT_EQ(done.outcome, StepOutcome::done);
  EXPECT_EQ(done.step, 10U);
  EXPECT_EQ(done.time_ns, 100);
}

TEST_F(StepRequestsTest, a_repeat_gets_the_same_answer_and_steps_nothing) {
  ask(kAlice, 1, 1);
  ask(kAlice, 1, 1);
  EXPECT_EQ(reply().outcome, StepOutcome::accepted);
  EXPECT_EQ(requests.allowed(), 1U);
  requests.stepped({8, 80, true, false}, false);
  EXPECT_EQ(reply().step, 8U);
  ask(kAlice, 1, 5, {99, 990, true, false});
  const StepReplyRecord again = reply();
  EXPECT_EQ(again.outcome, StepOutcome::done);
  EXPECT_EQ(again.step, 8U) << "as it was answered then";
  EXPECT_EQ(requests.allowed(), 0U);
}

TEST_F(StepRequestsTest, an_older_sequence_number_is_refused) {
  ask(kAlice, 10, 0);
  EXPECT_EQ(reply().outcome, StepOutcome::done);
  ask(kAlice, 9, 1);
  const StepReplyRecord old = reply();
  EXPECT_EQ(old.outcome, StepOutcome::refused);
  EXPECT_EQ(old.refusal, StepRefusal::old_sequence);
  ask(kBob, 0, 1);
  EXPECT_EQ(reply().refusal, StepRefusal::old_sequence) << "numbers begin at 1";
  EXPECT_EQ(requests.allowed(), 0U);
}

TEST_F(StepRequestsTest, another_one_is_refused_while_the_first_is_under_way) {
  ask(kAlice, 1, 2);
  ask(kBob, 1, 1, {7, 70, false, false});
  EXPECT_EQ(reply().refusal, StepRefusal::busy);
  ask(kAlice, 2, 1, {7, 70, false, false});
  EXPECT_EQ(reply().refusal, StepRefusal::busy);
  EXPECT_EQ(requests.allowed(), 2U);
  requests.stepped({8, 80, false, false}, false);
  requests.stepped({9, 90, true, false}, false);
  EXPECT_EQ(reply().sequence, 1U);
  ask(kBob, 1, 1);
  EXPECT_EQ(reply().refusal, StepRefusal::busy)
      << "a late repeat of what was refused steps nothing";
  ask(kBob, 2, 1);
  EXPECT_EQ(requests.allowed(), 1U);
}

TEST_F(StepRequestsTest, no_steps_are_a_question_answered_at_any_time) {
  ask(kAlice, 1, 0, {41, 410, false, false});
  const StepReplyRecord where = reply();
  EXPECT_EQ(where.outcome, StepOutcome::done);
  EXPECT_EQ(where.step, 41U);
  ask(kBob, 1, 5);
  ask(kAlice, 2, 0, {42, 420, false, false});
  EXPECT_EQ(reply().step, 42U) << "while another's steps are taken";
}

TEST_F(StepRequestsTest, refuse_what_cannot_be_served) {
  ask(kAlice, 1, 1, {7, 70, false, false});
  EXPECT_EQ(reply().refusal, StepRefusal::not_standing);
  ask(kAlice, 2, 1, {7, 70, true, true});
  EXPECT_EQ(reply().refusal, StepRefusal::halted);
  ask(kAlice, 3, StepRequests::kMostSteps + 1);
  EXPECT_EQ(reply().refusal, StepRefusal::too_many_steps);
  EXPECT_EQ(requests.allowed(), 0U);
  ask(kAlice, 4, StepRequests::kMostSteps);
  EXPECT_EQ(requests.allowed(), StepRequests::kMostSteps);
}

TEST_F(StepRequestsTest, say_when_the_run_ends_before_all_steps_are_taken) {
  ask(kAlice, 1, 100);
  requests.stepped({8, 80, false, false}, true);
  EXPECT_EQ(reply().outcome, StepOutcome::ended);
  EXPECT_EQ(requests.allowed(), 0U);
}

TEST_F(StepRequestsTest, an_interruption_is_answered_once) {
  requests.interrupt(kStanding);
  EXPECT_TRUE(silent()) << "nothing was under way";
  ask(kAlice, 1, 100);
  requests.interrupt({8, 80, true, false});
  EXPECT_EQ(reply().outcome, StepOutcome::interrupted);
  requests.interrupt({8, 80, true, false});
  EXPECT_TRUE(silent());
}

TEST_F(StepRequestsTest, whoever_is_under_way_is_not_forgotten_in_a_flood_of_others) {
  ask(kAlice, 5, 1);
  for (std::uint64_t i = 0; i < 100; ++i) {
    ask({1, i}, 1, 0);
    ring->skip_all();
  }
  ask(kAlice, 5, 1);
  EXPECT_EQ(reply().outcome, StepOutcome::accepted);
  for (std::uint64_t i = 100; i < 200; ++i) {
    ask({1, i}, 1, 0);
    ring->skip_all();
  }
  requests.stepped({8, 80, true, false}, false);
  EXPECT_EQ(reply().outcome, StepOutcome::done);
  ask(kAlice, 5, 1);
  EXPECT_EQ(reply().outcome, StepOutcome::done);
  EXPECT_EQ(requests.allowed(), 0U) << "the same request must not step twice";
}

}  // namespace
}  // namespace adstar::runtime
