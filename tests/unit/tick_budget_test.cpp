// Budgets of the parts of a beat, and what follows when the beat cannot be kept.
#include <atomic>
#include <chrono>
#include <csignal>
#include <ctime>
#include <pthread.h>
#include <thread>

#include <gtest/gtest.h>

#include "service/runtime/tick.hpp"
#include "tests/support/processor_time.hpp"
#include "tests/support/tick_scene.hpp"

namespace adstar::runtime {
namespace {

using test::kAlice;
using test::kMs;
using test::tick_scene;
using test::verdicts_of;

const std::atomic<bool> kGoOn{false};

/// A clock that nobody can keep: a beat is due every nanosecond.
scene::Scene hopeless(std::int64_t steps, scene::Overrun policy) {
  scene::Scene scene = tick_scene(steps);
  scene.simulation.step_ns = kMs;
  scene.simulation.duration_ns = steps * kMs;
  scene.simulation.pace = scene::Pace::clock;
  scene.simulation.rate = 1e6;
  scene.budget.on_overrun = policy;
  return scene;
}

std::uint64_t count(const std::atomic<std::uint64_t>& counter) { return counter.load(); }

TEST(TickBudget, accounts_for_every_part_of_every_beat) {
  MappedSegment segment = MappedSegment::create(2);
  Tick tick(tick_scene(100), segment);
  tick.run(kGoOn);
  const TickReport& report = tick.report();
  for (const Phase phase : {Phase::commands, Phase::step, Phase::hand_over}) {
    EXPECT_EQ(report.phase(phase).quantiles().count, 100U);
  }
  const std::int64_t parts = report.phase(Phase::commands).quantiles().max_ns +
                             report.phase(Phase::step).quantiles().max_ns +
                             report.phase(Phase::hand_over).quantiles().max_ns;
  EXPECT_LE(report.tick_body.quantiles().max_ns, parts) << "the parts are the whole";
  EXPECT_GT(count(report.most_telemetry), 0U);
}

TEST(TickBudget, counts_what_is_over_it_and_goes_on) {
  scene::Scene scene = tick_scene(20);
  scene.simulation.pace = scene::Pace::clock;
  scene.simulation.step_ns = kMs;
  scene.simulation.duration_ns = 20 * kMs;
  scene.budget.step_ns = 1;
  MappedSegment segment = MappedSegment::create(2);
  Tick tick(scene, segment);
  tick.run(kGoOn);
  EXPECT_EQ(count(tick.report().over_budget[static_cast<std::size_t>(Phase::step)]), 20U);
  EXPECT_EQ(count(tick.report().over_budget[static_cast<std::size_t>(Phase::commands)]), 0U);
  EXPECT_EQ(count(tick.report().step), 20U);
  EXPECT_EQ(tick.report().halted.load(), 0U);
}

TEST(TickBudget, judges_nothing_when_no_clock_paces_it) {
  scene::Scene scene = tick_scene(20);
  scene.budget.step_ns = 1;
  scene.budget.on_overrun = scene::Overrun::halt;
  MappedSegment segment = MappedSegment::create(2);
  Tick tick(scene, segment);
  tick.run(kGoOn);
  EXPECT_EQ(count(tick.report().step), 20U);
}

TEST(Overrun, skip_takes_every_step_and_lets_simulation_time_fall_behind) {
  MappedSegment segment = MappedSegment::create(2);
  Tick tick(hopeless(100, scene::Overrun::skip), segment);
  tick.run(kGoOn);
  const TickReport& report = tick.report();
  EXPECT_EQ(count(report.step), 100U);
  EXPECT_GT(count(report.missed_beats), 0U);
  EXPECT_EQ(count(report.caught_up_beats), 0U);
  EXPECT_EQ(report.behind_ns.load(), static_cast<std::int64_t>(count(report.missed_beats)));
  EXPECT_EQ(count(report.late_beats), count(report.late_after_work) +
                                          count(report.late_after_loss) +
                                          count(report.late_after_sleep));
  EXPECT_GT(count(report.late_after_work), 0U);
}

/// A signal's handler that sleeps: the beat that it falls into takes longer than its period, and works no more than ever.
TEST(Overrun, of_a_processor_that_was_taken_away_is_no_work_of_ours) {
  struct sigaction sleeps {};
  sleeps.sa_handler = [](int) {
    const timespec pause{0, 50'000'000};
    nanosleep(&pause, nullptr);
  };
  struct sigaction before {};
  ASSERT_EQ(sigaction(SIGUSR1, &sleeps, &before), 0);
  scene::Scene scene = tick_scene(60);
  scene.simulation.pace = scene::Pace::clock;
  scene.simulation.step_ns = 20 * kMs;
  scene.simulation.duration_ns = 60 * 20 * kMs;
  // In so many parts that a beat works for about 8 of its 20 ms.
  scene.simulation.limits.substep_angle_rad = 1e-300;
  scene.simulation.limits.substeps = 1000;
  scene.simulation.limits.substeps =
      static_cast<std::int64_t>(10e6 * static_cast<double>(scene.simulation.limits.substeps) /
                                test::ns_of_the_processor(scene));
  MappedSegment segment = MappedSegment::create(2);
  Tick tick(scene, segment);
  std::atomic<bool> ended{false};
  std::thread flight([&] {
    tick.run(kGoOn);
    ended = true;
  });
  while (!ended) {
    pthread_kill(flight.native_handle(), SIGUSR1);
    std::this_thread::sleep_for(std::chrono::milliseconds(71));
  }
  flight.join();
  sigaction(SIGUSR1, &before, nullptr);
  const TickReport& report = tick.report();
  EXPECT_GT(count(report.late_after_loss), 0U);
  EXPECT_EQ(count(report.late_after_work), 0U);
  EXPECT_EQ(count(report.late_beats),
            count(report.late_after_loss) + count(report.late_after_sleep));
}

TEST(Overrun, catch_up_works_beats_off_and_misses_only_those_beyond_its_bound) {
  scene::Scene scene = hopeless(100, scene::Overrun::catch_up);
  scene.budget.catch_up_beats = 1'000'000'000;
  MappedSegment segment = MappedSegment::create(2);
  Tick patient(scene, segment);
  patient.run(kGoOn);
  EXPECT_EQ(count(patient.report().missed_beats), 0U);
  EXPECT_EQ(count(patient.report().caught_up_beats), count(patient.report().late_beats));
  EXPECT_GT(patient.report().behind_ns.load(), 0);

  scene.budget.catch_up_beats = 1;
  MappedSegment other = MappedSegment::create(2);
  Tick hasty(scene, other);
  hasty.run(kGoOn);
  EXPECT_GT(count(hasty.report().missed_beats), 0U);
  EXPECT_EQ(count(hasty.report().step), 100U) << "no step is lost";
}

TEST(Overrun, gives_the_same_motion_whatever_the_policy) {
  MappedSegment first = MappedSegment::create(2), second = MappedSegment::create(2);
  Tick skipping(hopeless(100, scene::Overrun::skip), first);
  Tick catching(hopeless(100, scene::Overrun::catch_up), second);
  skipping.run(kGoOn);
  catching.run(kGoOn);
  EXPECT_EQ(skipping.fleet().vehicles()[0].state, catching.fleet().vehicles()[0].state);
  EXPECT_EQ(skipping.fleet().vehicles()[1].state, catching.fleet().vehicles()[1].state);
}

TEST(Overrun, halt_stops_the_clock_serves_snapshots_and_refuses_commands) {
  MappedSegment segment = MappedSegment::create(2);
  Tick tick(hopeless(1000, scene::Overrun::halt), segment);
  std::atomic<bool> stop{false};
  std::thread runner([&] { tick.run(stop); });
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  const auto wait_for = [&](const auto& condition) {
    while (!condition() && std::chrono::steady_clock::now() < until) {
      std::this_thread::yield();
    }
    return condition();
  };
  EXPECT_TRUE(wait_for([&] { return tick.report().halted.load() != 0; }));
  CommandRecord command;
  command.commander = kAlice;
  command.sequence = 1;
  command.duration_ns = kMs;
  command.value = {0.1, 0, 0};
  segment->commands.push(command);
  segment->snapshot_requested = 1;
  EXPECT_TRUE(wait_for([&] { return segment->verdicts.size() > 0; }));
  EXPECT_TRUE(wait_for([&] { return segment->snapshot_requested.load() == 0; }));
  const std::uint64_t stood_at = count(tick.report().step);
  stop = true;
  runner.join();
  EXPECT_LT(stood_at, 3U);
  EXPECT_EQ(count(tick.report().step), stood_at);
  EXPECT_EQ(tick.report().halted.load(), 1 + static_cast<std::uint32_t>(Phase::wake_up));
  EXPECT_GT(tick.report().halted_ns.load(), 0);
  const auto verdicts = verdicts_of(segment);
  ASSERT_EQ(verdicts.size(), 1U);
  EXPECT_EQ(verdicts[0].verdict, Verdict::refused);
  EXPECT_EQ(verdicts[0].reason, Reason::halted);
  EXPECT_EQ(count(tick.report().commands_refused), 1U);
}

}  // namespace
}  // namespace adstar::runtime
