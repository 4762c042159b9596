// A beat that touches the heap may wait for a lock or a page: none may.
#include <atomic>
#include <memory>

#include <gtest/gtest.h>

#include "service/runtime/tick.hpp"
#include "tests/support/count_allocations.hpp"
#include "tests/support/linked_craft.hpp"
#include "tests/support/tick_scene.hpp"

namespace adstar::runtime {
namespace {

using test::allocation_count;
using test::kMs;

TEST(TickHeap, is_not_touched_by_a_run_with_commands_telemetry_and_snapshots) {
  scene::Scene scene = test::tick_scene(5'000);
  scene.spacecraft[1] = test::with_wheels(scene.spacecraft[1]);
  scene.telemetry = {1, 1, 1, {0, 1}, 1};
  MappedSegment segment = MappedSegment::create(2);
  Tick tick(scene, segment);
  for (std::uint64_t n = 1; n <= 4000; ++n) {
    CommandRecord command;
    command.commander = {n % 37, n % 11};
    command.sequence = n;
    command.spacecraft = n % 50 == 0 ? 77 : static_cast<std::uint32_t>(n % 2);
    command.actuator = command.spacecraft == 1 ? static_cast<std::uint32_t>(n / 2 % 2) : 0;
    command.quantity =
        command.actuator == 1 && n % 5 == 0 ? Quantity::wheel_speed : Quantity::torque;
    command.priority = static_cast<std::int32_t>(n % 3);
    command.start_ns = static_cast<std::int64_t>(n % 400) * 3 * kMs;
    command.duration_ns = static_cast<std::int64_t>(n % 17) * kMs;
    command.value = {n % 9 == 0 ? 1e3 : 1.0, 0, 0};
    ASSERT_TRUE(segment->commands.push(command));
  }
  segment->bridge_sleeps = 1;
  const std::atomic<bool> stop{false};
  const std::uint64_t before = allocation_count();
  tick.run(stop);
  EXPECT_EQ(allocation_count() - before, 0U);
  EXPECT_EQ(tick.report().commands_received.load(), 4000U);
  EXPECT_GT(test::verdicts_of(segment).size(), 2000U);
}

TEST(TickHeap, is_not_touched_by_coils_thrusters_orbits_and_linked_bodies_nor_by_digests) {
  scene::Scene scene = test::tick_scene(1'000);
  scene.spacecraft = {test::in_space(test::make_craft(0)), test::linked_craft()};
  scene.telemetry.attitude_every = scene.telemetry.momentum_every = 1;
  scene.telemetry.linked_every = scene.telemetry.pointing_every = 3;
  scene.telemetry.watched = {0, 1};
  scene.run.hashes_every_step = true;
  MappedSegment segment = MappedSegment::create(2);
  const auto hot = std::make_unique<HotJournal>();
  JournalWriter journal(*hot, 1);
  Tick tick(scene, segment);
  tick.record_in(&journal);
  for (std::uint64_t n = 1; n <= 900; ++n) {
    CommandRecord command;
    command.sequence = n;
    command.spacecraft = n % 3 == 0 ? 1 : 0;
    command.actuator = n % 3 == 1 ? 1 : 0;
    command.quantity = n % 3 == 0   ? Quantity::torque
                       : n % 3 == 1 ? Quantity::thrust
                                    : Quantity::dipole;
    command.start_ns = static_cast<std::int64_t>(n) * 11 * kMs;
    command.duration_ns = static_cast<std::int64_t>(n % 17 + 1) * kMs;
    command.value = {n % 3 == 1 ? 1.0 : 0.3, 0, 0};
    ASSERT_TRUE(segment->commands.push(command));
  }
  const std::atomic<bool> stop{false};
  const std::uint64_t before = allocation_count();
  tick.run(stop);
  EXPECT_EQ(allocation_count() - before, 0U);
  EXPECT_EQ(tick.report().unresolved_spacecraft.load(), 0U);
  EXPECT_GT(segment->joints.size(), 600U);
  EXPECT_GT(segment->pointing.size(), 300U);
}

TEST(TickHeap, is_not_touched_under_the_clock) {
  scene::Scene scene = test::tick_scene(20);
  scene.simulation.step_ns = kMs;
  scene.simulation.duration_ns = 20 * kMs;
  scene.simulation.pace = scene::Pace::clock;
  MappedSegment segment = MappedSegment::create(2);
  Tick tick(scene, segment);
  const std::atomic<bool> stop{false};
  const std::uint64_t before = allocation_count();
  tick.run(stop);
  EXPECT_EQ(allocation_count() - before, 0U);
}

TEST(TickHeap, is_not_touched_by_those_who_hold_the_clock) {
  scene::Scene scene = test::tick_scene(500);
  scene.simulation.pace = scene::Pace::lockstep;
  scene.service.run_control = true;
  scene.spacecraft[0].target = scene::PointingTarget{};
  MappedSegment segment = MappedSegment::create(2);
  Tick tick(scene, segment);
  std::uint64_t sequence = 0;
  for (const ControlAction action :
       {ControlAction::set_state, ControlAction::set_inertia, ControlAction::set_target,
        ControlAction::reset, ControlAction::pause}) {
    ControlRecord record;
    record.sequence = ++sequence;
    record.action = action;
    record.attitude = {1, 0, 0, 0.5};
    record.omega_B_rad_s = {0.1, 0.2, 0.3};
    record.inertia_body_kg_m2 = {1.5, 2.0, 1.25, 0.1, -0.05, 0.2};
    ASSERT_TRUE(segment->controls.push(record));
  }
  ASSERT_TRUE(segment->step_requests.push({{}, 1, 500, 0}));
  const std::atomic<bool> stop{false};
  const std::uint64_t before = allocation_count();
  tick.run(stop);
  EXPECT_EQ(allocation_count() - before, 0U);
  EXPECT_EQ(tick.report().step.load(), 500U);
  EXPECT_EQ(tick.report().run.load(), 1U);
  while (const auto answer = segment->control_answers.pop()) {
    EXPECT_EQ(answer->refusal, ControlRefusal::none) << static_cast<int>(answer->action);
  }
}

}  // namespace
}  // namespace adstar::runtime
