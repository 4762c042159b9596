#include "service/runtime/tick.hpp"

#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <thread>

#include <gtest/gtest.h>

#include "tests/support/gate_harness.hpp"
#include "tests/support/tick_scene.hpp"

namespace adstar::runtime {
namespace {

using test::fleet_of;
using test::kAlice;
using test::kMs;
using test::telemetry_of;
using test::tick_scene;
using test::verdicts_of;

const std::atomic<bool> kGoOn{false};

CommandRecord command(std::uint64_t sequence, std::int64_t start_ns, std::int64_t duration_ns) {
  CommandRecord record;
  record.commander = kAlice;
  record.sequence = sequence;
  record.start_ns = start_ns;
  record.duration_ns = duration_ns;
  record.value = {0.25, 0, 0};
  return record;
}

// ---- steps and telemetry ----

TEST(Tick, takes_as_many_steps_as_the_duration_has) {
  MappedSegment segment = MappedSegment::create(2);
  Tick tick(tick_scene(100), segment);
  tick.run(kGoOn);
  EXPECT_EQ(tick.report().step.load(), 100U);
  EXPECT_EQ(tick.time_ns(), 1000 * kMs);
  EXPECT_EQ(tick.report().tick_body.quantiles().count, 100U);
  EXPECT_EQ(tick.report().phase(Phase::wake_up).quantiles().count, 0U) << "free: it never sleeps";

  Fleet fleet(tick_scene(0).spacecraft, "coadjoint_rk4", StepLimits{});
  for (std::int64_t n = 0; n < 100; ++n) {
    fleet.step(n * 10 * kMs, 10 * kMs);
  }
  EXPECT_EQ(tick.fleet().vehicles()[0].state, fleet.vehicles()[0].state);
  EXPECT_EQ(tick.fleet().vehicles()[1].state, fleet.vehicles()[1].state);
}

TEST(Tick, does_nothing_when_it_is_stopped_before_it_begins) {
  MappedSegment segment = MappedSegment::create(2);
  Tick tick(tick_scene(0), segment);
  const std::atomic<bool> stop{true};
  tick.run(stop);
  EXPECT_EQ(tick.report().step.load(), 0U);
}

TEST(Tick, publishes_the_start_and_then_each_topic_at_its_own_rate) {
  MappedSegment segment = MappedSegment::create(2);
  Tick tick(tick_scene(100), segment);
  tick.run(kGoOn);
  const auto records = telemetry_of(segment);
  std::map<std::uint64_t, std::uint32_t> wanted;  // step to topics: attitude / 10, momentum / 4
  for (std::uint64_t step = 0; step <= 100; ++step) {
    const std::uint32_t topics =
        (step % 10 == 0 ? kTopicAttitude : 0U) | (step % 4 == 0 ? kTopicMomentum : 0U);
    if (topics != 0) {
      wanted[step] = topics;
    }
  }
  ASSERT_EQ(records.size(), wanted.size());
  auto next = wanted.begin();
  for (const TelemetryRecord& record : records) {
    EXPECT_EQ(record.step, next->first);
    EXPECT_EQ(record.topics, next->second);
    EXPECT_EQ(record.time_ns, static_cast<std::int64_t>(record.step) * 10 * kMs);
    EXPECT_EQ(record.spacecraft, 1U) << "only who is watched";
    EXPECT_EQ(record.flags, 0U);
    ++next;
  }
  const TelemetryRecord last = sample(tick.fleet().vehicles()[1]);
  EXPECT_EQ(records.back().q_IB, last.q_IB);
  EXPECT_EQ(records.back().H_I_n_m_s, last.H_I_n_m_s);
  EXPECT_EQ(records.back().omega_B_rad_s, last.omega_B_rad_s);
  EXPECT_EQ(tick.report().telemetry_lost.load(), 0U);
}

TEST(Tick, says_nothing_on_a_topic_that_is_off) {
  scene::Scene scene = tick_scene(50);
  scene.telemetry.attitude_every = 0;
  scene.telemetry.fleet_every = 0;
  MappedSegment segment = MappedSegment::create(2);
  segment->snapshot_requested = 1;
  Tick tick(scene, segment);
  tick.run(kGoOn);
  tick.publish_final(1000);
  for (const TelemetryRecord& record : telemetry_of(segment)) {
    EXPECT_EQ(record.topics, kTopicMomentum) << record.step;
  }
  EXPECT_EQ(fleet_of(segment).count, 0U);
}

TEST(Tick, says_nothing_at_all_when_every_topic_is_off) {
  scene::Scene scene = tick_scene(50);
  scene.telemetry = {0, 0, 0, {0, 1}};
  MappedSegment segment = MappedSegment::create(2);
  segment->snapshot_requested = 1;
  Tick tick(scene, segment);
  tick.run(kGoOn);
  tick.publish_final(1000);
  EXPECT_TRUE(telemetry_of(segment).empty());
  EXPECT_EQ(fleet_of(segment).count, 0U);
}

TEST(Tick, publishes_everything_once_when_a_snapshot_is_asked_for) {
  scene::Scene scene = tick_scene(3);
  MappedSegment segment = MappedSegment::create(2);
  segment->snapshot_requested = 1;
  Tick tick(scene, segment);
  tick.run(kGoOn);
  const auto records = telemetry_of(segment);
  ASSERT_EQ(records.size(), 2U);  // the start, and the first beat; steps 2 and 3 are nobody's turn
  EXPECT_EQ(records[1].step, 1U);
  EXPECT_EQ(records[1].topics, kTopicAttitude | kTopicMomentum);
  EXPECT_EQ(fleet_of(segment).header.step, 1U);
  EXPECT_EQ(segment->snapshot_requested.load(), 0U);
}

TEST(Tick, marks_the_last_state_final_on_every_topic) {
  MappedSegment segment = MappedSegment::create(2);
  Tick tick(tick_scene(7), segment);
  tick.run(kGoOn);
  telemetry_of(segment);
  tick.publish_final(1000);
  const auto records = telemetry_of(segment);
  ASSERT_EQ(records.size(), 1U);
  EXPECT_EQ(records[0].step, 7U);
  EXPECT_EQ(records[0].flags, kFlagFinal);
  EXPECT_EQ(records[0].topics, kTopicAttitude | kTopicMomentum);
  const auto snapshot = fleet_of(segment);
  EXPECT_EQ(snapshot.header.step, 7U);
  EXPECT_EQ(snapshot.members[0].flags, kFlagFinal);
  EXPECT_EQ(snapshot.members[1].flags, kFlagFinal);
}

TEST(Tick, counts_telemetry_that_found_the_ring_full_and_goes_on) {
  scene::Scene scene = tick_scene(20'000);
  scene.telemetry = {1, 1, 0, {0}};
  MappedSegment segment = MappedSegment::create(2);
  Tick tick(scene, segment);
  tick.run(kGoOn);
  EXPECT_EQ(tick.report().step.load(), 20'000U);
  const std::uint64_t lost = 20'001 - decltype(SharedSegment::telemetry)::kCapacity;
  EXPECT_EQ(tick.report().telemetry_lost.load(), lost);
  tick.publish_final(5);
  EXPECT_EQ(tick.report().telemetry_lost.load(), lost + 1) << "patience has an end";
  EXPECT_EQ(telemetry_of(segment).front().step, 0U);
}

TEST(Tick, tells_how_many_and_who_could_not_be_resolved) {
  scene::Scene scene = tick_scene(5);
  scene.simulation.limits.substeps = 2;
  scene.spacecraft[1].initial = make_state(Quat<double>{}, Vec3<double>{0, 3000, 0});
  MappedSegment segment = MappedSegment::create(2);
  Tick tick(scene, segment);
  tick.run(kGoOn);
  EXPECT_EQ(tick.report().unresolved_spacecraft.load(), 1U);
  EXPECT_EQ(tick.report().first_unresolved.load(), 1U);
  EXPECT_EQ(fleet_of(segment).header.step, 0U);
  tick.publish_final(1000);
  EXPECT_EQ(fleet_of(segment).members[1].flags, kFlagFinal | kFlagUnresolvedAngle);
}

TEST(Tick, does_not_hide_a_ruined_momentum_behind_a_sound_one) {
  scene::Scene scene = tick_scene(4);
  scene.telemetry = {1, 1, 1, {0, 1}};
  scene.spacecraft[0].initial.H_I.add({std::numeric_limits<double>::quiet_NaN(), 0, 0});
  MappedSegment segment = MappedSegment::create(2);
  Tick tick(scene, segment);
  tick.run(kGoOn);
  EXPECT_TRUE(std::isnan(tick.report().worst_momentum_residual_relative.load()));
}

TEST(Tick, ends_where_63_bits_of_nanoseconds_do) {
  scene::Scene scene = tick_scene(0);
  scene.simulation.step_ns = std::numeric_limits<std::int64_t>::max() / 3;
  scene.spacecraft = {test::make_craft(1)};
  scene.spacecraft[0].initial = make_state(Quat<double>{}, Vec3<double>{});
  scene.telemetry = {1, 1, 0, {0}};
  MappedSegment segment = MappedSegment::create(1);
  segment->commands.push(command(1, kStartAtNextBeat, 1));
  Tick tick(scene, segment);
  tick.run(kGoOn);
  EXPECT_EQ(tick.report().step.load(), 3U);
  EXPECT_GT(tick.time_ns(), 0);
}

// ---- commands ----

TEST(Tick, applies_a_command_from_the_ring_and_answers_it) {
  MappedSegment segment = MappedSegment::create(2);
  ASSERT_TRUE(segment->commands.push(command(1, 123'456'789, 500 * kMs)));
  Tick tick(tick_scene(100), segment);
  tick.run(kGoOn);
  const auto verdicts = verdicts_of(segment);
  ASSERT_EQ(verdicts.size(), 2U);
  EXPECT_EQ(verdicts[0].verdict, Verdict::accepted);
  EXPECT_EQ(verdicts[0].step, 0U);
  EXPECT_EQ(verdicts[1].verdict, Verdict::applied);
  EXPECT_EQ(verdicts[1].step, 12U);
  EXPECT_EQ(verdicts[1].start_ns, 123'456'789);
  EXPECT_EQ(tick.report().commands_received.load(), 1U);
  const Vehicle& vehicle = tick.fleet().vehicles()[0];
  EXPECT_NEAR(vehicle.state.H_I.value().x - vehicle.H_0.x, 0.25 * 0.5, 1e-14);
  EXPECT_LT(tick.report().worst_momentum_residual_relative.load(), 1e-14);
}

TEST(Tick, begins_a_command_for_the_next_beat_in_the_step_that_follows) {
  MappedSegment segment = MappedSegment::create(2);
  segment->commands.push(command(1, kStartAtNextBeat, 30 * kMs));
  Tick tick(tick_scene(10), segment);
  tick.run(kGoOn);
  const auto verdicts = verdicts_of(segment);
  ASSERT_EQ(verdicts.size(), 1U);
  EXPECT_EQ(verdicts[0].verdict, Verdict::applied);
  EXPECT_EQ(verdicts[0].step, 0U);
  EXPECT_EQ(verdicts[0].end_ns, 30 * kMs);
}

TEST(Tick, spreads_a_flood_of_commands_over_beats_and_loses_none) {
  MappedSegment segment = MappedSegment::create(2);
  std::uint64_t sent = 0;
  while (segment->commands.push(command(sent + 1, kStartAtNextBeat, 1'000 * kMs))) {
    ++sent;
  }
  ASSERT_EQ(sent, decltype(SharedSegment::commands)::kCapacity);
  Tick tick(tick_scene(100), segment);
  tick.run(kGoOn);
  EXPECT_EQ(tick.report().commands_received.load(), sent);
  const auto verdicts = verdicts_of(segment);
  ASSERT_EQ(verdicts.size(), sent);
  EXPECT_GT(verdicts.back().step, 0U) << "one beat would have had to take them all";
}

TEST(Tick, survives_a_bridge_that_writes_nonsense_everywhere) {
  scene::Scene scene = tick_scene(200);
  MappedSegment segment = MappedSegment::create(2);
  Tick tick(scene, segment);
  // All that the bridge can reach: every ring, slot and flag, then the fleet words behind them.
  auto* const bytes = reinterpret_cast<unsigned char*>(&*segment);
  for (std::size_t i = 0; i < sizeof(SharedSegment); ++i) {
    bytes[i] = static_cast<unsigned char>(i * 2654435761U >> 13);
  }
  tick.run(kGoOn);
  tick.publish_final(5);
  EXPECT_EQ(tick.report().step.load(), 200U);

  MappedSegment clean = MappedSegment::create(2);
  Tick reference(scene, clean);
  reference.run(kGoOn);
  EXPECT_EQ(tick.fleet().vehicles()[1].H_0, reference.fleet().vehicles()[1].H_0);
}

/// Every step once, in blocks that follow each other, the last one short; without the key nothing.
TEST(Tick, leaves_a_digest_of_every_step_where_the_scene_asks_for_it) {
  for (const bool every_step : {true, false}) {
    scene::Scene scene = test::tick_scene(45);
    scene.run.hashes_every_step = every_step;
    MappedSegment segment = MappedSegment::create(2);
    const auto hot = std::make_unique<HotJournal>();
    JournalWriter journal(*hot, 1);
    Tick tick(scene, segment);
    tick.record_in(&journal);
    const std::atomic<bool> stop{false};
    tick.run(stop);
    std::uint64_t next = 1;
    Fleet again(scene.spacecraft, "coadjoint_rk4", StepLimits{});
    while (const auto record = hot->ring.pop()) {
      ASSERT_EQ(record->kind, JournalKind::step_digests);
      ASSERT_EQ(record->step, next);
      const auto block = payload_of<DigestBlock>(*record);
      for (std::uint64_t i = 0; i < block.count; ++i, ++next) {
        again.step(static_cast<std::int64_t>(next - 1) * 10 * kMs, 10 * kMs);
        ASSERT_EQ(block.digests[i], digest_of(again.vehicles())) << next;
      }
    }
    EXPECT_EQ(next, every_step ? 46U : 1U);
  }
}

TEST(Tick, may_be_commanded_from_another_thread_while_it_runs) {
  scene::Scene scene = tick_scene(0);
  scene.telemetry = {100, 100, 1000, {0, 1}};
  MappedSegment segment = MappedSegment::create(2);
  Tick tick(scene, segment);
  std::atomic<bool> stop{false};
  std::thread runner([&] { tick.run(stop); });
  constexpr std::uint64_t kCommands = 3000;
  std::atomic<bool> sent{false};
  std::thread producer([&] {
    for (std::uint64_t n = 1; n <= kCommands;) {
      if (segment->commands.push(command(n, kStartAtNextBeat, 5 * kMs))) {
        ++n;
      }
      if (n % 500 == 0) {
        segment->snapshot_requested.store(1, std::memory_order_relaxed);
      }
    }
    sent = true;
  });
  std::map<std::uint64_t, int> finals;
  std::uint64_t last_step = 0, snapshot_step = 0;
  std::size_t samples = 0;
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while ((!sent || finals.size() < kCommands) && std::chrono::steady_clock::now() < deadline) {
    for (const VerdictRecord& verdict : verdicts_of(segment)) {
      finals[verdict.sequence] += test::is_final(verdict.verdict) ? 1 : 0;
    }
    for (const TelemetryRecord& record : telemetry_of(segment)) {
      EXPECT_GE(record.step, last_step);
      last_step = record.step;
      ++samples;
    }
    const auto snapshot = fleet_of(segment);
    if (snapshot.count > 0) {
      EXPECT_GE(snapshot.header.step, snapshot_step);
      EXPECT_EQ(snapshot.header.members, 2U);
      snapshot_step = snapshot.header.step;
    }
    tick.report().tick_body.quantiles();
  }
  stop = true;
  runner.join();
  producer.join();
  EXPECT_EQ(finals.size(), kCommands);
  for (const auto& [sequence, count] : finals) {
    EXPECT_EQ(count, 1) << sequence;
  }
  EXPECT_GT(samples, 0U);
  EXPECT_EQ(tick.report().commands_received.load(), kCommands);
  EXPECT_EQ(tick.report().verdicts_lost.load(), 0U);
}

// ---- pace ----

TEST(Tick, under_the_clock_never_runs_ahead_of_it) {
  scene::Scene scene = tick_scene(20);
  scene.simulation.step_ns = 2 * kMs;
  scene.simulation.duration_ns = 40 * kMs;
  scene.simulation.pace = scene::Pace::clock;
  scene.simulation.rate = 0.5;
  MappedSegment segment = MappedSegment::create(2);
  Tick tick(scene, segment);
  const auto begun = std::chrono::steady_clock::now();
  tick.run(kGoOn);
  // The last of 20 beats is due 19 periods of 4 ms after the first.
  EXPECT_GE(std::chrono::steady_clock::now() - begun, std::chrono::milliseconds(76));
  EXPECT_EQ(tick.report().step.load(), 20U) << "a missed beat delays steps, it drops none";
  EXPECT_EQ(tick.report().phase(Phase::wake_up).quantiles().count, 20U);
}

TEST(Tick, brings_its_beats_onto_the_reference_clock) {
  scene::Scene scene = tick_scene(1'500);
  scene.simulation.step_ns = kMs;
  scene.simulation.pace = scene::Pace::clock;
  scene.simulation.phase_reference = scene::PhaseReference::realtime;
  scene.simulation.duration_ns = 1'500 * kMs;
  MappedSegment segment = MappedSegment::create(2);
  Tick tick(scene, segment);
  const std::atomic<bool> stop{false};
  tick.run(stop);
  // Half a period off at most, a microsecond a beat: there after 500 beats. What is left is how the system
  // slews CLOCK_REALTIME, and a clock that was read with an interruption in between.
  EXPECT_LT(std::abs(tick.report().phase_error_ns.load()), 100'000);
}

}  // namespace
}  // namespace adstar::runtime
