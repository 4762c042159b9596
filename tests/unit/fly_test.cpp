// A flight to the end of its plan: when its listener is asked.
#include "service/propagation/fly.hpp"

#include <algorithm>
#include <chrono>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/gate_harness.hpp"

namespace adstar::propagation {
namespace {

using test::kMs;
using test::make_craft;

Plan plan_of(std::uint64_t steps, std::uint64_t every) {
  return {10 * kMs, steps, every, "coadjoint_rk4"};
}

runtime::Fleet fleet_of_one() {
  return runtime::Fleet({make_craft(0)}, "coadjoint_rk4", StepLimits{});
}

TEST(Flight, is_looked_after_at_each_step_when_steps_are_slow) {
  runtime::Fleet fleet = fleet_of_one();
  std::vector<std::uint64_t> looks;
  fly(fleet, plan_of(8, 1),
      {[](std::uint64_t, std::int64_t) {
         std::this_thread::sleep_for(std::chrono::milliseconds(15));  // what a heavy step costs
       },
       [&](std::uint64_t done, std::int64_t time_ns) {
         looks.push_back(done);
         EXPECT_EQ(time_ns, static_cast<std::int64_t>(done) * 10 * kMs);
       }});
  EXPECT_EQ(looks, (std::vector<std::uint64_t>{1, 2, 3, 4, 5, 6, 7, 8}));
}

TEST(Flight, is_looked_after_seldom_when_steps_are_quick_but_often_enough_for_what_may_come) {
  runtime::Fleet fleet = fleet_of_one();
  constexpr std::uint64_t kSteps = 100'000;
  std::uint64_t looks = 0, last = 0, longest = 0;
  fly(fleet, plan_of(kSteps, 0),
      {[](std::uint64_t, std::int64_t) {},
       [&](std::uint64_t done, std::int64_t) {
         ++looks;
         longest = std::max(longest, done - last);
         last = done;
       }});
  EXPECT_LT(looks, kSteps / 10);
  EXPECT_LE(longest, 4096U);
}

TEST(Flight, ends_with_what_a_look_throws) {
  runtime::Fleet fleet = fleet_of_one();
  std::uint64_t rows = 0;
  EXPECT_THROW(fly(fleet, plan_of(1'000'000, 0),
                   {[&](std::uint64_t, std::int64_t) { ++rows; },
                    [](std::uint64_t, std::int64_t) { throw 3; }}),
               int);
  EXPECT_EQ(rows, 1U);
}

}  // namespace
}  // namespace adstar::propagation
