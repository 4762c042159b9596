// Datagrams that no DDS sends, at every UDP port of the bridge: noise, headers with nonsense behind
// them, and its own announcements with bits turned over. The bridge may fall over some of them (the
// packaged Cyclone DDS does); the daemon may not, and a new bridge has to come.

#include <gtest/gtest.h>

#include "tests/integration/process_account.hpp"
#include "tests/integration/untouched.hpp"
#include "tests/support/datagrams.hpp"

namespace adstar {
namespace {

using testing::Daemon;
using testing::Datagram;
using testing::GroundStation;
using testing::LoopbackSocket;
using testing::resident_kb;

constexpr std::int64_t kStep_ns = 1'000'000;
constexpr std::uint64_t kMegabyte_kb = 1024;

TEST(HostileDatagrams, cost_no_step_and_bounded_memory_and_log_and_the_service_is_there_after) {
  const auto corner = testing::private_corner();
  Daemon daemon(testing::scene_with_free_body(corner, {.step = "1ms"}));
  {
    GroundStation ground(corner);
    ASSERT_TRUE(ground.until([&] { return ground.momentum.contains("free1"); })) << daemon.log();
  }
  const std::vector<Datagram> genuine = testing::announcements(corner.domain, 4);
  ASSERT_FALSE(genuine.empty()) << "the daemon announces itself";
  const std::uint64_t daemon_kb = resident_kb(daemon.pid());

  std::mt19937_64 random(20);
  LoopbackSocket socket;
  std::size_t sent = 0;
  for (int round = 0; round < 40; ++round) {
    // A bridge that fell has other ports.
    std::set<std::uint16_t> ports;
    ASSERT_TRUE(testing::eventually([&] {
      ports = testing::udp_ports_of(daemon.bridge());
      return !ports.empty();
    })) << daemon.log();
    for (int i = 0; i < 150; ++i) {
      for (const std::uint16_t port : ports) {
        socket.send(testing::hostile_datagram(genuine, random), port);
        ++sent;
      }
    }
  }
  EXPECT_GE(sent, 6000U);

  GroundStation ground(corner);
  ASSERT_TRUE(ground.until([&] { return ground.momentum.contains("free1") && ground.status; }))
      << daemon.log();
  const std::uint64_t heard = ground.momentum_samples;
  ASSERT_TRUE(ground.until([&] { return ground.momentum_samples > heard + 10; })) << daemon.log();
  auto command = ground.command("sat1", {0.01, 0, 0});
  command.duration_ns = kStep_ns;
  const auto answer = ground.send(command);
  ASSERT_TRUE(answer.has_value()) << daemon.log();
  EXPECT_LT(resident_kb(daemon.pid()), daemon_kb + 64 * kMegabyte_kb);
  EXPECT_LT(resident_kb(daemon.bridge()), 512 * kMegabyte_kb);
  EXPECT_LT(daemon.log().size(), 1'000'000U);
  RecordProperty("bridge_restarts", static_cast<int>(ground.status->bridge_restarts));
  testing::stop_and_expect_untouched(daemon, ground, kStep_ns);
}

TEST(HostileDatagrams, that_the_kernel_drops_because_nobody_reads_are_counted_and_told) {
  const auto corner = testing::private_corner();
  Daemon daemon(testing::scene_with_free_body(corner, {}));
  {
    GroundStation ground(corner);
    ASSERT_TRUE(ground.until([&] { return ground.momentum.contains("free1"); })) << daemon.log();
  }
  const pid_t bridge = daemon.bridge();
  const auto ports = testing::udp_ports_of(bridge);
  ASSERT_FALSE(ports.empty());
  ASSERT_EQ(kill(bridge, SIGSTOP), 0);
  LoopbackSocket socket;
  const Datagram large(60'000, 0);
  for (int i = 0; i < 500; ++i) {  // 30 MB: more than any socket keeps
    for (const std::uint16_t port : ports) {
      socket.send(large, port);
    }
  }
  ASSERT_EQ(kill(bridge, SIGCONT), 0);
  EXPECT_TRUE(testing::eventually([&] {
    return daemon.log().find("datagrams lost before they were read") != std::string::npos;
  })) << daemon.log();
  EXPECT_EQ(daemon.stop(), 0) << daemon.log();
}

}  // namespace
}  // namespace adstar
