#include "adstar/torques/thruster.hpp"

#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/random_motion.hpp"

namespace adstar {
namespace {

using V = Vec3<double>;

constexpr std::int64_t kFirst = std::numeric_limits<std::int64_t>::min();

Thruster<double> commanded(const std::vector<OnInterval>& intervals, std::int64_t minimum_on_ns) {
  Thruster<double> thruster;
  thruster.torque_n_m = {0, 0.5, 0};
  thruster.minimum_on_ns = minimum_on_ns;
  for (const OnInterval& interval : intervals) {
    thruster.window.at(thruster.intervals++) = interval;
  }
  return thruster;
}

Thruster<double> scheduled(const std::vector<OnInterval>& intervals, std::int64_t minimum_on_ns) {
  Thruster<double> thruster;
  thruster.torque_n_m = {0, 0.5, 0};
  thruster.schedule = make_on_schedule(intervals, minimum_on_ns);
  return thruster;
}

std::vector<std::int64_t> edges_of(const Thruster<double>& thruster) {
  std::vector<std::int64_t> edges;
  for (std::int64_t t = thruster.next_edge_after(kFirst); t != kNever;
       t = thruster.next_edge_after(t)) {
    edges.push_back(t);
  }
  return edges;
}

TEST(Thruster, is_on_from_the_first_nanosecond_to_the_last) {
  for (const auto& thruster :
       {commanded({{100, 250}, {400, 401}}, 0), scheduled({{100, 250}, {400, 401}}, 0)}) {
    EXPECT_EQ(thruster.ramp_from(99).start, V{});
    EXPECT_EQ(thruster.ramp_from(100).start, (V{0, 0.5, 0}));
    EXPECT_EQ(thruster.ramp_from(249).start, (V{0, 0.5, 0}));
    EXPECT_EQ(thruster.ramp_from(250).start, V{});
    EXPECT_TRUE(thruster.is_on(400));
    EXPECT_FALSE(thruster.is_on(401));
    EXPECT_EQ(edges_of(thruster), (std::vector<std::int64_t>{100, 250, 400, 401}));
    EXPECT_EQ(thruster.ramp_from(100).slope, V{});
  }
}

TEST(Thruster, stays_on_for_its_least_time) {
  for (const auto& thruster :
       {commanded({{100, 101}, {400, 900}}, 50), scheduled({{100, 101}, {400, 900}}, 50)}) {
    EXPECT_TRUE(thruster.is_on(149));
    EXPECT_FALSE(thruster.is_on(150));
    EXPECT_EQ(edges_of(thruster), (std::vector<std::int64_t>{100, 150, 400, 900}));
  }
}

TEST(Thruster, runs_on_where_the_lengthened_time_reaches_the_next_one) {
  for (const auto& thruster :
       {commanded({{100, 110}, {130, 200}}, 50), scheduled({{130, 200}, {100, 110}}, 50)}) {
    for (std::int64_t t = 100; t < 200; ++t) {
      EXPECT_TRUE(thruster.is_on(t)) << t;
    }
    EXPECT_FALSE(thruster.is_on(200));
    EXPECT_EQ(edges_of(thruster).back(), 200);
  }
  EXPECT_EQ(*make_on_schedule({{130, 200}, {100, 110}}, 50), (std::vector<OnInterval>{{100, 200}}));
}

TEST(Thruster, takes_no_notice_of_empty_times) {
  for (const auto& thruster :
       {commanded({{100, 100}, {300, 200}}, 50), scheduled({{100, 100}, {300, 200}}, 50)}) {
    EXPECT_FALSE(thruster.is_on(100));
    EXPECT_FALSE(thruster.is_on(300));
    EXPECT_EQ(thruster.next_edge_after(kFirst), kNever);
  }
  EXPECT_EQ(Thruster<double>{}.next_edge_after(0), kNever);
  EXPECT_EQ(scheduled({}, 50).next_edge_after(0), kNever);
}

TEST(Thruster, scheduled_is_the_thruster_commanded_so) {
  test::Generator random(1);
  for (int i = 0; i < 200; ++i) {
    std::vector<OnInterval> intervals;
    std::int64_t t = 0;
    for (int k = 0; k < 10; ++k) {
      const auto draw = [&] { return static_cast<std::int64_t>(test::uniform(random, 1, 60)); };
      t += draw();
      intervals.push_back({t, t + draw()});
      t = intervals.back().end_ns;
    }
    const auto minimum = static_cast<std::int64_t>(test::uniform(random, 0, 50));
    const auto a = commanded(intervals, minimum), b = scheduled(intervals, minimum);
    for (std::int64_t at = -5; at < t + 80; ++at) {
      ASSERT_EQ(a.is_on(at), b.is_on(at)) << i << " " << at;
      // An edge is missed by neither: between them it stays on or off.
      ASSERT_TRUE(a.is_on(at) == a.is_on(at + 1) || a.next_edge_after(at) == at + 1);
      ASSERT_TRUE(b.is_on(at) == b.is_on(at + 1) || b.next_edge_after(at) == at + 1);
    }
  }
}

TEST(Thruster, commanded_for_ever_goes_on_for_ever) {
  EXPECT_EQ(off_at({kNever - 10, kNever - 5}, 1000), kNever);
  EXPECT_EQ(off_at({5, kNever}, 1000), kNever);
  EXPECT_EQ(off_at({-5, 0}, 10), 5);
  EXPECT_TRUE(commanded({{5, kNever}}, 10).is_on(kNever - 1));
}

}  // namespace
}  // namespace adstar
