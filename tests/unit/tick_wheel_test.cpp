// What a tick tells of wheels.
#include <atomic>

#include <gtest/gtest.h>

#include "service/runtime/tick.hpp"
#include "tests/support/tick_scene.hpp"

namespace adstar::runtime {
namespace {

using test::kMs;
using test::tick_scene;

const std::atomic<bool> kGoOn{false};

TEST(Tick, publishes_the_wheels_of_who_is_watched_at_their_own_rate) {
  scene::Scene scene = tick_scene(100);
  scene.spacecraft = {test::with_wheels(scene.spacecraft[0]),
                      test::with_wheels(scene.spacecraft[1])};
  scene.telemetry.wheel_every = 50;
  MappedSegment segment = MappedSegment::create(2);
  Tick tick(scene, segment);
  tick.run(kGoOn);
  std::uint64_t count = 0;
  WheelRecord last;
  while (const auto record = segment->wheels.pop()) {
    EXPECT_EQ(record->spacecraft, 1U) << "only who is watched";
    EXPECT_EQ(record->wheel, count % 2);
    EXPECT_EQ(record->step, count / 2 * 50);
    EXPECT_EQ(record->time_ns, static_cast<std::int64_t>(record->step) * 10 * kMs);
    last = *record;
    ++count;
  }
  EXPECT_EQ(count, 6U) << "two wheels at steps 0, 50 and 100";
  const Vehicle& vehicle = tick.fleet().vehicles()[1];
  EXPECT_EQ(last.speed_rad_s, vehicle.wheels->spinning[1].speed(angular_velocity_of(vehicle)));
  EXPECT_EQ(last.momentum_n_m_s, vehicle.wheels->spinning[1].h.value);
}

TEST(Tick, tells_of_a_held_speed_before_its_first_step) {
  scene::Scene scene = tick_scene(1);
  scene.spacecraft[1] = test::with_wheels(scene.spacecraft[1]);
  scene.telemetry.wheel_every = 1;
  MappedSegment segment = MappedSegment::create(2);
  Tick tick(scene, segment);
  tick.run(kGoOn);
  segment->wheels.pop();
  const auto held = segment->wheels.pop();  // "w1": 10 rad/s below what it holds
  ASSERT_TRUE(held.has_value());
  EXPECT_EQ(held->step, 0U);
  EXPECT_NEAR(held->motor_torque_n_m, 0.1, 1e-12);
}

}  // namespace
}  // namespace adstar::runtime
