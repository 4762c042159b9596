// What a service manager is told of a daemon, and that a tick which hangs is not vouched for.

#include "service/adstard/supervisor.hpp"

#include <gtest/gtest.h>

#include "tests/support/notify_socket.hpp"

namespace adstar::adstard {
namespace {

constexpr std::int64_t kMs = 1'000'000;

class Managed : public testing::Test {
 protected:
  Managed() {
    setenv("NOTIFY_SOCKET", manager_.path().c_str(), 1);
    setenv("WATCHDOG_USEC", "400000", 1);
  }
  ~Managed() override {
    unsetenv("NOTIFY_SOCKET");
    unsetenv("WATCHDOG_USEC");
    unsetenv("WATCHDOG_PID");
  }
  test::NotifySocket manager_;
};

TEST_F(Managed, says_when_it_is_ready_and_when_it_ends) {
  Supervisor supervisor(0);
  supervisor.ready("'fly' flies 3 spacecraft");
  EXPECT_EQ(manager_.next(1000), "READY=1\nSTATUS='fly' flies 3 spacecraft");
  supervisor.tell("'fly' has taken over");
  EXPECT_EQ(manager_.next(1000), "STATUS='fly' has taken over");
  supervisor.stopping();
  EXPECT_EQ(manager_.next(1000), "STOPPING=1");
}

/// How often it is said that the tick lives while `look` is done every millisecond.
template <class Look>
int fed(test::NotifySocket& manager, std::int64_t begin_ms, std::int64_t end_ms, const Look& look) {
  int count = 0;
  for (std::int64_t ms = begin_ms; ms <= end_ms; ++ms) {
    look(ms);
    while (!manager.next(0).empty()) {  // the socket holds few
      ++count;
    }
  }
  return count;
}

TEST_F(Managed, vouches_for_a_tick_that_turns_twice_within_the_time_of_the_watchdog) {
  Supervisor supervisor(0);
  EXPECT_EQ(
      fed(manager_, 1, 1000,
          [&](std::int64_t ms) { supervisor.look(static_cast<std::uint64_t>(ms), ms * kMs); }),
      5);
}

/// Of a tick that stands at `turns`.
int fed_standing(Supervisor& supervisor, test::NotifySocket& manager, std::uint64_t turns,
                 std::int64_t begin_ms, std::int64_t end_ms) {
  return fed(manager, begin_ms, end_ms, [&](std::int64_t ms) { supervisor.look(turns, ms * kMs); });
}

TEST_F(Managed, does_not_vouch_for_a_tick_that_hangs) {
  Supervisor supervisor(0);
  EXPECT_EQ(fed_standing(supervisor, manager_, 7, 1, 201), 2) << "within half the watchdog's time";
  EXPECT_EQ(fed_standing(supervisor, manager_, 7, 202, 2000), 0);
  EXPECT_EQ(fed_standing(supervisor, manager_, 8, 2001, 2001), 1) << "it turns again";
}

TEST_F(Managed, vouches_for_a_tick_that_sleeps_to_a_beat_far_away) {
  Supervisor supervisor(10'000 * kMs);
  EXPECT_EQ(fed_standing(supervisor, manager_, 7, 1, 10'000), 50);
  EXPECT_EQ(fed_standing(supervisor, manager_, 7, 10'202, 20'000), 0) << "and no further";
}

TEST_F(Managed, vouches_for_a_daemon_that_has_no_tick_yet) {
  Supervisor supervisor(0);
  EXPECT_EQ(fed(manager_, 1, 1000, [&](std::int64_t ms) { supervisor.look(ms * kMs); }), 5);
}

TEST_F(Managed, feeds_nobody_elses_watchdog) {
  setenv("WATCHDOG_PID", "1", 1);
  Supervisor supervisor(0);
  supervisor.look(1, kMs);
  EXPECT_EQ(manager_.next(0), "");
}

TEST(Unmanaged, says_nothing_and_does_not_mind) {
  Supervisor supervisor(0);
  supervisor.ready("alone");
  supervisor.look(1, kMs);
  supervisor.stopping();
}

}  // namespace
}  // namespace adstar::adstard
