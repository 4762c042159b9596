// The bridge killed, aborted, and stopped where it stands: the tick goes on, a new bridge comes, and
// nobody on the bus has to do anything.

#include <gtest/gtest.h>

#include "tests/integration/untouched.hpp"

namespace adstar {
namespace {

using testing::Daemon;
using testing::GroundStation;

constexpr std::int64_t kStep_ns = 1'000'000;

TEST(BridgeFaults, every_way_to_lose_a_bridge_costs_telemetry_only_and_a_new_one_comes) {
  const auto corner = testing::private_corner();
  Daemon daemon(testing::scene_with_free_body(corner, {.step = "1ms"}));
  GroundStation ground(corner);
  ASSERT_TRUE(ground.until([&] { return ground.momentum.contains("free1"); })) << daemon.log();
  std::uint32_t faults = 0;
  for (const int signal : {SIGKILL, SIGSTOP, SIGABRT, SIGSEGV, SIGSTOP, SIGTERM}) {
    const pid_t bridge = daemon.bridge();
    ASSERT_GT(bridge, 0) << daemon.log();
    const std::uint64_t step_before = ground.momentum["free1"].step;
    ASSERT_EQ(kill(bridge, signal), 0);
    ++faults;
    // A stopped one is there, and silent; the daemon has to find that out by itself.
    ASSERT_TRUE(ground.until([&] { return daemon.bridge() > 0 && daemon.bridge() != bridge; }))
        << strsignal(signal) << "\n"
        << daemon.log();
    const std::uint64_t heard = ground.momentum_samples;
    ASSERT_TRUE(ground.until([&] { return ground.momentum_samples > heard + 5; }))
        << "no telemetry after " << strsignal(signal) << "\n"
        << daemon.log();
    EXPECT_GT(ground.momentum["free1"].step, step_before);
    auto command = ground.command("sat1", {0.01, 0, 0});
    command.duration_ns = kStep_ns;
    const auto answer = ground.send(command);
    ASSERT_TRUE(answer.has_value()) << "no answer after " << strsignal(signal);
    EXPECT_EQ(answer->verdict, adstar_VERDICT_APPLIED);
  }
  const std::string log = daemon.log();
  EXPECT_NE(log.find("has done nothing for 3s"), std::string::npos) << log;
  testing::stop_and_expect_untouched(daemon, ground, kStep_ns);
  EXPECT_EQ(ground.status->bridge_restarts, faults);
}

TEST(BridgeFaults, telemetry_and_answers_that_a_stopped_bridge_did_not_take_are_counted) {
  const auto corner = testing::private_corner();
  // Fast enough to fill the ring of 16384 while the bridge stands still.
  Daemon daemon(testing::scene_with_free_body(
      corner,
      {.step = "100us", .telemetry_hz = 10'000, .more = "[budget]\nadmission = \"warn\"\n"}));
  GroundStation ground(corner);
  ASSERT_TRUE(ground.until([&] { return ground.momentum.contains("free1"); })) << daemon.log();
  const pid_t bridge = daemon.bridge();
  ASSERT_EQ(kill(bridge, SIGSTOP), 0);
  ASSERT_TRUE(ground.until([&] { return daemon.bridge() > 0 && daemon.bridge() != bridge; }));
  EXPECT_TRUE(ground.until([&] {
    return ground.status && ground.status->bridge_restarts == 1 &&
           ground.status->telemetry_lost > 0;
  })) << daemon.log();
  EXPECT_NE(daemon.log().find("telemetry samples lost"), std::string::npos) << daemon.log();
  EXPECT_EQ(daemon.stop(), 0) << daemon.log();
}

}  // namespace
}  // namespace adstar
