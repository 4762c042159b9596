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
  Supervisor supervisor;
  supervisor.ready("'fly' flies 3 spacecraft");
  EXPECT_EQ(manager_.next(1000), "READY=1\nSTATUS='fly' flies 3 spacecraft");
  supervisor.stopping();
  EXPECT_EQ(manager_.next(1000), "STOPPING=1");
}

TEST_F(Managed, vouches_for_a_tick_that_turns_twice_within_the_time_of_the_watchdog) {
  Supervisor supervisor;
  int fed = 0;
  for (std::int64_t ms = 1; ms <= 1000; ++ms) {
    supervisor.look(static_cast<std::uint64_t>(ms), ms * kMs);
  }
  while (!manager_.next(0).empty()) {
    ++fed;
  }
  EXPECT_EQ(fed, 5);
}

TEST_F(Managed, does_not_vouch_for_a_tick_that_hangs) {
  Supervisor supervisor;
  supervisor.look(7, kMs);
  EXPECT_EQ(manager_.next(0), "WATCHDOG=1");
  for (std::int64_t ms = 2; ms <= 2000; ++ms) {
    supervisor.look(7, ms * kMs);
  }
  EXPECT_EQ(manager_.next(0), "");
  supervisor.look(8, 2001 * kMs);
  EXPECT_EQ(manager_.next(0), "WATCHDOG=1") << "it turns again";
}

TEST_F(Managed, feeds_nobody_elses_watchdog) {
  setenv("WATCHDOG_PID", "1", 1);
  Supervisor supervisor;
  supervisor.look(1, kMs);
  EXPECT_EQ(manager_.next(0), "");
}

TEST(Unmanaged, says_nothing_and_does_not_mind) {
  Supervisor supervisor;
  supervisor.ready("alone");
  supervisor.look(1, kMs);
  supervisor.stopping();
}

}  // namespace
}  // namespace adstar::adstard
