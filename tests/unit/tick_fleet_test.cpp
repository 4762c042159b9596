// The state of the fleet that the tick leaves for the bridge: whole, of one step, and in parts where it is large.

#include <atomic>
#include <chrono>
#include <map>
#include <thread>

#include <gtest/gtest.h>

#include "service/runtime/tick.hpp"
#include "tests/support/tick_scene.hpp"

namespace adstar::runtime {
namespace {

using test::fleet_of;
using test::kMs;
using test::tick_scene;

const std::atomic<bool> kGoOn{false};

TEST(Tick, leaves_the_whole_fleet_in_its_slot) {
  MappedSegment segment = MappedSegment::create(2);
  Tick tick(tick_scene(100), segment);
  tick.run(kGoOn);
  const auto snapshot = fleet_of(segment);
  EXPECT_EQ(snapshot.count, 5U);  // steps 0, 25, 50, 75, 100
  EXPECT_EQ(snapshot.header.step, 100U);
  EXPECT_EQ(snapshot.header.time_ns, 1000 * kMs);
  EXPECT_EQ(snapshot.header.members, 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const TelemetryRecord wanted = sample(tick.fleet().vehicles()[i]);
    EXPECT_EQ(snapshot.members[i].q_IB, wanted.q_IB);
    EXPECT_EQ(snapshot.members[i].omega_B_rad_s, wanted.omega_B_rad_s);
    EXPECT_EQ(snapshot.members[i].H_I_n_m_s, wanted.H_I_n_m_s);
    EXPECT_EQ(snapshot.members[i].rotational_energy_j, wanted.rotational_energy_j);
    EXPECT_EQ(snapshot.members[i].energy_residual_j, wanted.energy_residual_j);
    EXPECT_EQ(snapshot.members[i].flags, 0U);
  }
}

TEST(Tick, hands_a_large_fleet_over_in_parts_all_of_one_step) {
  constexpr std::size_t kMany = 1000, kParts = 7;  // of 16 kB
  scene::Scene scene = tick_scene(0);
  scene.simulation.pace = scene::Pace::clock;
  scene.simulation.step_ns = kMs;
  scene.simulation.duration_ns = 44 * kMs;
  scene.spacecraft.assign(kMany, scene.spacecraft[0]);
  scene.telemetry = {};
  scene.telemetry.fleet_every = 20;
  MappedSegment segment = MappedSegment::create(kMany);
  Tick tick(scene, segment);
  std::atomic<bool> ended{false};
  std::map<std::uint64_t, std::uint64_t>
      seen_at;  // the step of the run, when one of the fleet was first seen
  std::thread reader([&] {
    while (!ended) {
      if (const auto snapshot = fleet_of(segment); snapshot.count > 0) {
        seen_at.try_emplace(snapshot.header.step, tick.report().step.load());
      }
    }
  });
  tick.run(kGoOn);
  ended = true;
  reader.join();
  if (seen_at.contains(20)) {  // unless this machine kept the reader away for 17 beats
    EXPECT_GE(seen_at[20], 20 + kParts);
  }
  const auto expect_at = [&](std::int64_t step) {
    const auto snapshot = fleet_of(segment);
    EXPECT_EQ(snapshot.header.step, static_cast<std::uint64_t>(step));
    Fleet fleet(scene.spacecraft, "coadjoint_rk4", StepLimits{});
    for (std::int64_t n = 0; n < step; ++n) {
      fleet.step(n * kMs, kMs);
    }
    for (const std::size_t i : {std::size_t{0}, kMany / 2, kMany - 1}) {
      EXPECT_EQ(snapshot.members[i].q_IB, sample(fleet.vehicles()[i]).q_IB) << i;
    }
    return snapshot.count;
  };
  EXPECT_EQ(expect_at(40), 3U) << "of which but some parts were there at the end of the run";
  tick.publish_final(1000);
  EXPECT_EQ(expect_at(44), 4U);
}

TEST(Tick, hands_over_what_it_has_begun_before_it_stands_still) {
  scene::Scene scene = tick_scene(0);
  scene.simulation.pace = scene::Pace::clock;
  scene.simulation.step_ns = kMs;
  scene.spacecraft.assign(1000, scene.spacecraft[0]);
  scene.telemetry = {};
  scene.telemetry.fleet_every = 1'000'000;
  scene.budget.step_ns = 1;  // no step is done in that
  scene.budget.on_overrun = scene::Overrun::halt;
  MappedSegment segment = MappedSegment::create(1000);
  segment->snapshot_requested = 1;
  Tick tick(scene, segment);
  std::atomic<bool> stop{false};
  std::thread running([&] { tick.run(stop); });
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (fleet_of(segment).count < 2 && std::chrono::steady_clock::now() < deadline) {
    std::this_thread::yield();
  }
  EXPECT_EQ(fleet_of(segment).count, 2U);
  EXPECT_EQ(fleet_of(segment).header.step, 1U);
  stop = true;
  running.join();
  EXPECT_EQ(fleet_of(segment).count, 2U);
}

}  // namespace
}  // namespace adstar::runtime
