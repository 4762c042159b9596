// A primary's tick and its standby's: commands that wait for the standby, a standby that goes no further
// than its primary, and that goes on with the bits which that one would have had.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <span>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "service/runtime/fleet_snapshot.hpp"
#include "service/runtime/tick.hpp"
#include "tests/support/tick_scene.hpp"

namespace adstar::runtime {
namespace {

using test::kAlice;
using test::kMs;
using test::telemetry_of;
using test::verdicts_of;

scene::Scene pair_scene(std::int64_t steps, std::uint64_t lead) {
  scene::Scene scene = test::tick_scene(steps);
  scene.spacecraft[1] = test::with_wheels(scene.spacecraft[1]);
  scene.standby = scene::Standby{lead, 100 * kMs};
  return scene;
}

CommandRecord command(std::uint64_t sequence, double torque) {
  CommandRecord record;
  record.commander = kAlice;
  record.sequence = sequence;
  record.spacecraft = static_cast<std::uint32_t>(sequence % 2);
  record.duration_ns = 35 * kMs;
  record.value = {torque, -torque, 0.5 * torque};
  if (sequence % 4 == 3) {  // the wheel of the second spacecraft
    record.actuator = 1;
    record.value = {torque, 0, 0};
  }
  return record;
}

template <class Condition>
bool wait_for(Condition&& holds) {
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!holds() && std::chrono::steady_clock::now() < until) {
    std::this_thread::yield();
  }
  return holds();
}

/// A tick on its own thread; in its destructor it is told to stop.
class Running {
 public:
  explicit Running(const scene::Scene& scene, bool standby = false,
                   JournalWriter* journal = nullptr)
      : tick(scene, segment) {
    tick.record_in(journal);
    if (standby) {
      tick.stand_by();
    }
    runner_ = std::thread([this] { tick.run(stop_); });
  }
  ~Running() { stop(); }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  void stop() {
    stop_ = true;
    join();
  }
  void join() {
    if (runner_.joinable()) {
      runner_.join();
    }
  }
  std::uint64_t step() const { return tick.report().step.load(); }

  /// What the bridge of a standby does.
  void hear(const JournalRecord& record) {
    segment->standby.followed.push(record);
    wake_tick(*segment);
  }
  void hear_beat(std::uint64_t step, std::uint64_t next_number, std::int64_t received_ns = 1) {
    segment->standby.primary_beat.write({step, next_number, received_ns, 0});
    wake_tick(*segment);
  }
  void take_over() {
    segment->standby.take_over.store(1);
    wake_tick(*segment);
  }

  MappedSegment segment = MappedSegment::create(2);
  Tick tick;

 private:
  std::atomic<bool> stop_{false};
  std::thread runner_;
};

std::int64_t monotonic_ns() {
  return std::chrono::steady_clock::now().time_since_epoch() / std::chrono::nanoseconds(1);
}

/// A flight that nobody interrupts: every record heard at its beat.
FleetState uninterrupted(const scene::Scene& scene, const std::vector<JournalRecord>& records,
                         std::uint64_t steps) {
  VerdictRing verdicts;
  Fleet fleet(scene.spacecraft, scene.simulation.scheme, scene.simulation.limits);
  CommandGate gate(scene.spacecraft, verdicts);
  for (std::uint64_t n = 0; n < steps; ++n) {
    const Beat beat{n, static_cast<std::int64_t>(n) * 10 * kMs, 10 * kMs};
    for (const JournalRecord& record : records) {
      if (record.step == n) {
        gate.receive(payload_of<CommandRecord>(record), beat);
      }
    }
    gate.begin_step(beat, fleet);
    fleet.step(beat.t_ns, beat.h_ns);
    verdicts.skip_all();
  }
  return state_of(fleet);
}

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return std::ranges::equal(std::as_bytes(std::span(a)), std::as_bytes(std::span(b)));
}
bool same_bits(const FleetState& a, const FleetState& b) {
  return same_bits(a.vehicles, b.vehicles) && same_bits(a.wheel_momenta, b.wheel_momenta);
}

TEST(Following, a_command_is_heard_a_lead_after_it_came_and_is_told_at_once) {
  scene::Scene scene = pair_scene(0, 3);
  scene.simulation.pace = scene::Pace::lockstep;
  Running primary(scene);
  primary.segment->commands.push(command(1, 0.1));
  wake_tick(*primary.segment);
  ASSERT_TRUE(wait_for([&] { return primary.segment->standby.relayed.size() == 1; }));
  EXPECT_EQ(primary.segment->standby.relayed.pop()->step, 3u);
  primary.segment->step_requests.push({kAlice, 1, 5, 0});
  wake_tick(*primary.segment);
  ASSERT_TRUE(wait_for([&] { return primary.step() == 5; }));
  primary.stop();
  const auto verdicts = verdicts_of(primary.segment);
  ASSERT_EQ(verdicts.size(), 1u);
  EXPECT_EQ(verdicts[0].verdict, Verdict::applied);
  EXPECT_EQ(verdicts[0].step, 3u);
  StandbyBeatRecord beat;
  ASSERT_GT(primary.segment->standby.beat.read(beat), 0u);
  EXPECT_EQ(beat.step, 5u);
  EXPECT_EQ(beat.next_number, 2u);
}

TEST(Following, what_cannot_be_told_is_refused) {
  scene::Scene scene = pair_scene(0, 3);
  scene.simulation.pace = scene::Pace::lockstep;
  Running primary(scene);
  constexpr std::uint64_t kRoom = decltype(StandbyLink::relayed)::kCapacity;
  for (std::uint64_t sequence = 1; sequence <= kRoom + 1; ++sequence) {
    bool pushed = false;
    ASSERT_TRUE(wait_for([&] {
      pushed = pushed || primary.segment->commands.push(command(sequence, 0.1));
      return pushed;
    }));
    wake_tick(*primary.segment);
  }
  ASSERT_TRUE(wait_for([&] { return primary.segment->verdicts.size() > 0; }));
  primary.stop();
  EXPECT_EQ(primary.segment->verdicts.pop()->reason, Reason::not_recorded);
}

TEST(Following, a_standby_goes_no_further_than_its_primary_and_says_nothing) {
  Running standby(pair_scene(0, 3), true);
  standby.hear_beat(40, 1);
  ASSERT_TRUE(wait_for([&] { return standby.step() == 40; }));
  standby.hear_beat(41, 1);
  ASSERT_TRUE(wait_for([&] { return standby.step() == 41; }));
  standby.stop();
  EXPECT_EQ(standby.step(), 41u);
  EXPECT_TRUE(telemetry_of(standby.segment).empty());
}

TEST(Following, a_standby_that_is_ended_leaves_the_digests_of_all_its_steps) {
  scene::Scene scene = pair_scene(0, 3);
  scene.run.hashes_every_step = true;
  const auto hot = std::make_unique<HotJournal>();
  JournalWriter journal(*hot, 1);
  Running standby(scene, true, &journal);
  constexpr std::uint64_t kSteps = 2 * DigestBlock::kMost + 3;
  standby.hear_beat(kSteps, 1);
  ASSERT_TRUE(wait_for([&] { return standby.step() == kSteps; }));
  standby.stop();
  std::uint64_t digests = 0;
  while (const auto record = hot->ring.pop()) {
    digests += digests_of(*record).count;
  }
  EXPECT_EQ(digests, kSteps);
}

TEST(Following, no_beat_is_computed_before_the_commands_that_it_counts_on_are_here) {
  Running standby(pair_scene(0, 3), true);
  standby.hear_beat(10, 1);
  ASSERT_TRUE(wait_for([&] { return standby.step() == 10; }));
  standby.hear_beat(20, 2);  // record 1 is on its way
  for (int look = 0; look < 1000; ++look) {
    std::this_thread::yield();
    ASSERT_EQ(standby.step(), 10u);
  }
  standby.hear(make_journal_record(JournalKind::command, 1, 15, 0, command(1, 0.1)));
  ASSERT_TRUE(wait_for([&] { return standby.step() == 20; }));
  standby.stop();
  const auto verdicts = verdicts_of(standby.segment);
  ASSERT_EQ(verdicts.size(), 1u);
  EXPECT_EQ(verdicts[0].step, 15u);
}

TEST(Following, it_goes_on_with_the_bits_that_its_primary_would_have_had) {
  const scene::Scene scene = pair_scene(600, 5);
  std::vector<JournalRecord> told;
  std::uint64_t reached = 0;
  StandbyBeatRecord last;
  {
    scene::Scene alone = scene;
    alone.simulation.pace = scene::Pace::lockstep;  // so that commands come at known beats
    Running primary(alone);
    for (std::uint64_t round = 1; round <= 60; ++round) {
      primary.segment->commands.push(command(round, 0.01 * static_cast<double>(round % 7)));
      primary.segment->step_requests.push({kAlice, round, 1 + round % 4, 0});
      const std::uint64_t wanted = reached + 1 + round % 4;
      wake_tick(*primary.segment);
      ASSERT_TRUE(wait_for([&] { return primary.step() == wanted; }));
      reached = wanted;
    }
    primary.stop();  // and is not heard of again
    while (const auto record = primary.segment->standby.relayed.pop()) {
      told.push_back(*record);
    }
    ASSERT_GT(primary.segment->standby.beat.read(last), 0u);
  }
  ASSERT_EQ(told.size(), 60u);
  EXPECT_EQ(last.step, reached);

  Running standby(scene, true);
  for (const JournalRecord& record : told) {
    standby.hear(record);
  }
  standby.hear_beat(last.step, last.next_number, monotonic_ns());
  ASSERT_TRUE(wait_for([&] { return standby.step() == reached; }));
  standby.take_over();
  standby.join();  // the scene's 600 steps
  EXPECT_EQ(standby.step(), 600u);
  EXPECT_TRUE(same_bits(state_of(standby.tick.fleet()), uninterrupted(scene, told, 600)));
}

TEST(Following, the_beats_of_the_silence_are_published_every_one) {
  scene::Scene scene = pair_scene(0, 3);
  scene.simulation.pace = scene::Pace::clock;
  scene.telemetry.momentum_every = 1;
  Running standby(scene, true);
  standby.hear_beat(100, 1, monotonic_ns() - 300 * kMs);  // 30 beats ago
  ASSERT_TRUE(wait_for([&] { return standby.step() == 100; }));
  standby.take_over();
  ASSERT_TRUE(wait_for([&] { return standby.step() > 131; }));
  standby.stop();
  EXPECT_GE(standby.tick.report().caught_up_beats.load(), 29u);
  EXPECT_EQ(standby.tick.report().missed_beats.load(), 0u);
  std::uint64_t next = 100;
  for (const TelemetryRecord& sample : telemetry_of(standby.segment)) {
    EXPECT_EQ(sample.step, next);
    ++next;
  }
  EXPECT_GT(next, 131u);
}

TEST(Following, a_backlog_longer_than_it_can_hold_is_worked_off) {
  Running standby(pair_scene(0, 3), true);
  constexpr std::uint64_t kRecords = 20'000;
  standby.hear_beat(kRecords + 10, kRecords + 1);  // all of them are counted on at once
  for (std::uint64_t number = 1; number <= kRecords; ++number) {
    const JournalRecord record =
        make_journal_record(JournalKind::command, number, number, 0, command(number, 0.01));
    bool pushed = false;
    ASSERT_TRUE(wait_for([&] {
      pushed = pushed || standby.segment->standby.followed.push(record);
      wake_tick(*standby.segment);
      standby.segment->verdicts.skip_all();
      return pushed;
    })) << number;
  }
  wake_tick(*standby.segment);
  EXPECT_TRUE(wait_for([&] { return standby.step() == kRecords + 10; })) << standby.step();
}

TEST(Following, a_primary_that_never_told_a_beat_is_taken_over_from_now_on) {
  scene::Scene scene = pair_scene(0, 3);
  scene.simulation.pace = scene::Pace::clock;
  Running standby(scene, true);
  standby.take_over();
  ASSERT_TRUE(wait_for([&] { return standby.step() >= 2; }));
  standby.stop();
  EXPECT_LT(standby.tick.report().caught_up_beats.load(), 100u)
      << "not those since the machine began";
}

TEST(Following, what_it_cannot_write_down_it_does_not_fly_on_without) {
  const auto hot = std::make_unique<HotJournal>();
  JournalWriter journal(*hot, 1);
  while (journal.has_room()) {
    journal.write(JournalKind::command, 0, 0, command(1, 0));
  }
  MappedSegment segment = MappedSegment::create(2);
  Tick tick(pair_scene(0, 3), segment);
  tick.record_in(&journal);
  tick.stand_by();
  segment->standby.followed.push(
      make_journal_record(JournalKind::command, journal.next_number(), 1, 0, command(1, 0.1)));
  segment->standby.take_over.store(1);
  std::atomic<bool> stop{false};
  std::thread runner([&] { tick.run(stop); });
  EXPECT_TRUE(wait_for([&] { return segment->standby.lost_track.load() != 0; }));
  stop = true;
  runner.join();
  EXPECT_EQ(tick.report().step.load(), 0u);
}

TEST(Following, a_machine_that_cannot_make_up_the_silence_is_left_to_its_policy) {
  scene::Scene scene = pair_scene(0, 3);
  scene.simulation.step_ns = 1'000;  // a microsecond: no beat is done so soon
  scene.simulation.pace = scene::Pace::clock;
  Running standby(scene, true);
  standby.hear_beat(10, 1, monotonic_ns() - kMs);
  ASSERT_TRUE(wait_for([&] { return standby.step() == 10; }));
  standby.take_over();
  EXPECT_TRUE(wait_for([&] { return standby.tick.report().missed_beats.load() > 0; }));
}

TEST(Following, it_ends_with_a_primary_that_reached_the_end_of_the_scene) {
  Running standby(pair_scene(50, 3), true);
  standby.hear_beat(50, 1);
  standby.join();
  EXPECT_EQ(standby.step(), 50u);
  EXPECT_TRUE(standby.tick.report().following.load() != 0);
}

}  // namespace
}  // namespace adstar::runtime
