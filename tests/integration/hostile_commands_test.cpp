// Too many commands, too long ones, and listeners that do not listen: the daemon keeps its steps,
// its memory and its log, and counts what it could not take.

#include <random>

#include <gtest/gtest.h>

#include "tests/integration/process_account.hpp"
#include "tests/integration/untouched.hpp"
#include "tests/support/process.hpp"

namespace adstar {
namespace {

using testing::Daemon;
using testing::GroundStation;
using testing::resident_kb;

constexpr std::int64_t kStep_ns = 10'000'000;
constexpr std::uint64_t kMegabyte_kb = 1024;

/// Each from a commander of its own, as fast as it goes.
void flood(GroundStation& ground, int commands) {
  std::mt19937_64 random(7);
  for (int i = 0; i < commands; ++i) {
    adstar_TorqueCommand c = ground.command("sat1", {0.01, -0.02, 0.005});
    c.commander = {random(), random()};
    c.sequence_number = 1 + random() % 3;
    c.duration_ns = kStep_ns;
    ground.write(c);
  }
}

TEST(HostileCommands, a_flood_from_random_commanders_costs_no_step_and_bounded_memory) {
  const auto corner = testing::private_corner();
  Daemon daemon(testing::scene_with_free_body(corner, {}));
  GroundStation ground(corner);
  ASSERT_TRUE(ground.until([&] { return ground.momentum.contains("free1"); })) << daemon.log();
  const std::uint64_t daemon_kb = resident_kb(daemon.pid());
  const std::uint64_t step_before = ground.momentum["free1"].step;
  flood(ground, 20'000);
  // A commander of good will still gets through: it repeats until it is answered.
  auto command = ground.command("sat1", {0.01, 0, 0});
  command.priority = 5;
  command.duration_ns = kStep_ns;
  // Repetitions that come in one beat are answered "accepted" before it begins.
  ASSERT_TRUE(ground.send(command).has_value()) << daemon.log();
  const auto answer = ground.final_answer(command.sequence_number);
  ASSERT_TRUE(answer.has_value()) << daemon.log();
  EXPECT_EQ(answer->verdict, adstar_VERDICT_APPLIED);
  ASSERT_TRUE(ground.until([&] { return ground.momentum["free1"].step > step_before + 100; }));
  EXPECT_LT(resident_kb(daemon.pid()), daemon_kb + 64 * kMegabyte_kb);
  EXPECT_LT(resident_kb(daemon.bridge()), 512 * kMegabyte_kb);
  EXPECT_LT(daemon.log().size(), 200'000U);
  testing::stop_and_expect_untouched(daemon, ground, kStep_ns);
  EXPECT_EQ(ground.status->bridge_restarts, 0U);
}

TEST(HostileCommands, what_does_not_fit_the_ring_is_counted_and_told) {
  const auto corner = testing::private_corner();
  // A tick a second takes 256 commands a second: the ring of 4096 is full at once.
  Daemon daemon(testing::scene_with_free_body(corner, {.step = "1s", .telemetry_hz = 1}));
  GroundStation ground(corner);
  ASSERT_TRUE(ground.until([&] { return ground.momentum.contains("free1"); })) << daemon.log();
  flood(ground, 10'000);
  EXPECT_TRUE(ground.until([&] { return ground.status && ground.status->commands_lost > 0; }))
      << daemon.log();
  EXPECT_NE(daemon.log().find("commands lost"), std::string::npos) << daemon.log();
  EXPECT_EQ(daemon.stop(), 0) << daemon.log();
}

TEST(HostileCommands, strings_longer_than_the_type_allows_are_dropped_at_the_door) {
  const auto corner = testing::private_corner();
  Daemon daemon(testing::scene_with_free_body(corner, {}));
  GroundStation ground(corner);
  ASSERT_TRUE(ground.until([&] { return ground.momentum.contains("free1"); })) << daemon.log();
  for (const char* length : {"64", "5000", "1000000"}) {
    const testing::Outcome sent = testing::run(
        {ADSTAR_WILD_COMMANDER, std::to_string(corner.domain), corner.partition, length, "50"});
    ASSERT_EQ(sent.code, 0) << sent.err;
  }
  auto command = ground.command("sat1", {0.01, 0, 0});
  command.duration_ns = kStep_ns;
  const auto answer = ground.send(command);
  ASSERT_TRUE(answer.has_value()) << daemon.log();
  EXPECT_EQ(answer->verdict, adstar_VERDICT_APPLIED);
  EXPECT_LT(resident_kb(daemon.bridge()), 512 * kMegabyte_kb);
  EXPECT_LT(daemon.log().size(), 200'000U);
  testing::stop_and_expect_untouched(daemon, ground, kStep_ns);
}

TEST(HostileCommands, a_reliable_reader_that_stands_still_holds_nobody_up) {
  const auto corner = testing::private_corner();
  Daemon daemon(testing::scene_with_free_body(corner, {.step = "1ms", .telemetry_hz = 1000}));
  GroundStation ground(corner);
  ASSERT_TRUE(ground.until([&] { return ground.momentum.contains("free1"); })) << daemon.log();
  testing::Process monitor({ADSTAR_CLI, "monitor", "--format", "csv", "--domain",
                            std::to_string(corner.domain), "--partition", corner.partition});
  ASSERT_TRUE(ground.until([&] { return !monitor.out().empty(); })) << monitor.err();
  const std::uint64_t bridge_kb = resident_kb(daemon.bridge());
  monitor.send(SIGSTOP);
  const std::uint64_t heard = ground.momentum_samples;
  const std::uint64_t step = ground.momentum["free1"].step;
  ASSERT_TRUE(ground.until([&] {
    return ground.momentum_samples > heard + 2000 && ground.momentum["free1"].step > step + 4000;
  })) << daemon.log();
  EXPECT_LT(resident_kb(daemon.bridge()), bridge_kb + 64 * kMegabyte_kb);
  monitor.send(SIGCONT);
  testing::stop_and_expect_untouched(daemon, ground, 1'000'000);
  EXPECT_EQ(ground.status->bridge_restarts, 0U);
}

}  // namespace
}  // namespace adstar
