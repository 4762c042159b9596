// Whether a scene fits its beat is measured before it flies; and what the system grants the tick's thread.
#include "service/runtime/admission.hpp"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fcntl.h>
#include <memory>
#include <unistd.h>

#include <gtest/gtest.h>

#include "service/runtime/real_time.hpp"
#include "tests/support/linked_craft.hpp"
#include "tests/support/processor_time.hpp"
#include "tests/support/tick_scene.hpp"

namespace adstar::runtime {
namespace {

using test::kMs;
using test::ns_of_the_processor;
using test::tick_scene;

scene::Scene paced() {
  scene::Scene scene = tick_scene(0);
  scene.simulation.pace = scene::Pace::clock;
  return scene;
}

TEST(Admission, measures_the_step_at_its_dearest) {
  scene::Scene scene = paced();
  scene.simulation.limits.substeps = 1;
  EXPECT_EQ(measure_step(scene).steps, 2000U);
  const double cheap = std::min(ns_of_the_processor(scene), ns_of_the_processor(scene));
  scene.simulation.limits.substeps = 2000;
  EXPECT_GT(ns_of_the_processor(scene), 20 * cheap) << "two thousand parts cost more than one";
}

TEST(Admission, measures_wheels_with_their_motors_in_force) {
  scene::Scene scene = paced();
  scene.spacecraft = {test::with_wheels(test::make_craft(0))};
  scene.simulation.limits.substeps = 1;
  const double cheap = std::min(ns_of_the_processor(scene), ns_of_the_processor(scene));
  scene.simulation.limits.substeps = 2000;
  EXPECT_GT(ns_of_the_processor(scene), 20 * cheap);
}

TEST(Admission, measures_linked_bodies_that_rest_as_if_they_turned_and_every_attempt_of_a_step) {
  scene::Scene scene = paced();
  scene.spacecraft = {test::resting_linked_craft()};
  scene.simulation.limits.substeps = 1;
  const double cheap = std::min(ns_of_the_processor(scene), ns_of_the_processor(scene));
  scene.simulation.limits.substeps = 64;
  EXPECT_GT(ns_of_the_processor(scene), 50 * cheap) << "127 parts, where 64 cost 40 times as much";
}

TEST(Admission, lets_a_step_pass_that_fits_the_beat_or_its_budget) {
  scene::Scene scene = paced();  // a beat of 10 ms
  EXPECT_EQ(why_it_does_not_fit(scene, {10 * kMs, 2000}), "");
  scene.budget.step_ns = 5 * kMs;
  EXPECT_EQ(why_it_does_not_fit(scene, {5 * kMs, 2000}), "");
  scene.simulation.pace = scene::Pace::free;
  EXPECT_EQ(why_it_does_not_fit(scene, {50 * kMs, 2000}), "") << "nothing paces it";
}

TEST(Admission, says_what_it_needs_what_is_allowed_and_what_to_try) {
  scene::Scene scene = paced();
  scene.budget.step_ns = 5 * kMs;
  EXPECT_EQ(
      why_it_does_not_fit(scene, {8 * kMs, 2000}),
      "the step does not fit: it needs 8000 us of a beat of 10000 us (p99 of 2000 steps, every "
      "spacecraft in substep_limit = 64 parts), budget.step allows 5000 us; try "
      "simulation.substep_limit = 40, a longer step, fewer spacecraft, or budget.admission = "
      "\"warn\"");
  scene.budget.step_ns = 0;
  EXPECT_NE(why_it_does_not_fit(scene, {20 * kMs, 90}).find("the beat allows 10000 us"),
            std::string::npos);
}

TEST(ThreadAccount, counts_the_faults_of_pages_that_are_touched) {
  const int thread = static_cast<int>(gettid());
  const ThreadAccount before = account_of(thread);
  constexpr std::size_t kPages = 4096;
  const auto pages = std::make_unique<char[]>(kPages * 4096);  // zeroed, so touched
  const ThreadAccount after = account_of(thread);
  EXPECT_GE(after.minor_faults, before.minor_faults + 1);
  EXPECT_EQ(pages[kPages], 0);
}

TEST(ThreadAccount, of_nobody_is_nothing) {
  const ThreadAccount none = account_of(0x7fff'fff0);
  EXPECT_EQ(none.minor_faults, 0U);
  EXPECT_FALSE(none.fifo_scheduling);
  EXPECT_FALSE(none.cpu_pinned);
}

TEST(ShallowIdle, has_the_system_wake_its_processors_at_once) {
  const int device = open("/dev/cpu_dma_latency", O_RDWR | O_CLOEXEC);
  if (device < 0) {
    GTEST_SKIP() << "/dev/cpu_dma_latency: " << std::strerror(errno);
  }
  RealTime result;
  const ShallowIdle idle(result);
  EXPECT_TRUE(result.idle_is_shallow);
  EXPECT_TRUE(result.warnings.empty());
  std::int32_t latency_us = -1;
  EXPECT_EQ(read(device, &latency_us, sizeof latency_us), ssize_t{sizeof latency_us});
  EXPECT_EQ(latency_us, 0);
  close(device);
}

}  // namespace
}  // namespace adstar::runtime
