// adstard under a service manager: it says when it flies, lives while its clock stands too, and says that it ends.

#include <gtest/gtest.h>

#include "tests/integration/daemon_harness.hpp"
#include "tests/support/notify_socket.hpp"
#include "tests/support/process.hpp"

namespace adstar {
namespace {

TEST(Supervised, tells_its_manager_that_it_is_ready_alive_and_ending) {
  const auto corner = testing::private_corner();
  const testing::TemporaryDirectory home;
  for (const std::string pace : {"clock", "lockstep"}) {
    std::string scene = testing::paper_scene(corner, {.rate = 1});
    scene.replace(scene.find("pace = \"clock\"\nrate = 1.000000"), 30, "pace = \"" + pace + "\"");
    test::NotifySocket manager;
    testing::Process daemon({ADSTARD, home.write("scene.toml", scene).string()},
                            {{}, {"NOTIFY_SOCKET=" + manager.path(), "WATCHDOG_USEC=200000"}});
    EXPECT_EQ(manager.next(30'000).rfind("READY=1\nSTATUS='fly' flies 1 spacecraft", 0), 0U)
        << daemon.err();
    for (int i = 0; i < 3; ++i) {
      EXPECT_EQ(manager.next(10'000), "WATCHDOG=1") << pace;
    }
    kill(daemon.pid(), SIGINT);
    std::string said = manager.next(10'000);
    while (said == "WATCHDOG=1") {
      said = manager.next(10'000);
    }
    EXPECT_EQ(said, "STOPPING=1");
    EXPECT_EQ(daemon.wait(std::chrono::seconds(20)), 0) << daemon.err();
  }
}

}  // namespace
}  // namespace adstar
