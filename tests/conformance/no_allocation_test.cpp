// A step that touches the heap may wait for a lock or a page: none may.
#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/compiled_schemes.hpp"
#include "tests/support/count_allocations.hpp"
#include "tests/support/schemes.hpp"

namespace adstar {
namespace {

using test::allocation_count;
using V = Vec3<double>;

/// Where the compiler cannot see that the memory is not used, and leave it out.
void* volatile seen = nullptr;

TEST(AllocationCount, sees_every_way_to_the_heap) {
  const auto grows = [](auto&& action) {
    const std::uint64_t before = allocation_count();
    action();
    return allocation_count() > before;
  };
  const auto freed = [](void* memory) {
    seen = memory;
    std::free(memory);
  };
  EXPECT_TRUE(grows([] {
    const std::vector<double> v(10'000, 1.0);
    seen = const_cast<double*>(v.data());
  }));
  EXPECT_TRUE(grows([] { seen = std::make_unique<State<double>>().get(); }));
  EXPECT_TRUE(grows([&] { freed(std::malloc(123)); }));
  EXPECT_TRUE(grows([&] { freed(std::calloc(12, 34)); }));
  EXPECT_TRUE(grows([&] { freed(std::realloc(std::malloc(10), 5000)); }));
  EXPECT_TRUE(grows([&] { freed(std::aligned_alloc(64, 128)); }));
  EXPECT_FALSE(grows([] {}));
}

template <class Scheme>
class StepsOf : public testing::Test {
 public:
  BodyOf<Scheme, double> body{
      RigidBody<double>(Eigen::Matrix3d(Eigen::Vector3d(0.9144, 1.098, 1.66).asDiagonal()))};

  std::uint64_t allocations(const std::vector<Torque<double>>& torques, const V& omega_B,
                            double scale = 1) {
    State<double> state = make_state(Quat<double>{}, scale * body.momentum(omega_B));
    const std::uint64_t before = allocation_count();
    for (std::int64_t n = 0; n < 200; ++n) {
      test::Compiled<Scheme>::advance(body, state, torques, n * 10'000'000, 10'000'000);
    }
    return allocation_count() - before;
  }
};
TYPED_TEST_SUITE(StepsOf, test::ForcedSchemeTypes);

std::vector<Torque<double>> every_torque() {
  Commanded<double> commanded;
  commanded.window[0] = {15'000'000, 123'456'789, {0.1, 0.2, 0.3}};
  commanded.window[1] = {200'000'001, 500'000'000, {-0.1, 0.2, -0.3}};
  commanded.intervals = 2;
  std::vector<Torque<double>> torques;
  for (const Frame frame : {Frame::body, Frame::inertial}) {
    commanded.frame = frame;
    torques.emplace_back(commanded);
    torques.emplace_back(Constant<double>{frame, {0.01, 0.02, 0.03}});
    torques.emplace_back(Harmonic<double>{frame, {0.01, 0.02, 0.03}, {1, 2, 3}, {0, 0, 0}});
    torques.emplace_back(Table<double>{frame,
                                       Interpolation::linear,
                                       AfterEnd::hold,
                                       {3'333'333, 44'444'444},
                                       {{0.1, 0, 0}, {0, 0.1, 0}}});
  }
  return torques;
}

TYPED_TEST(StepsOf, a_damped_body_in_orbit_need_no_heap) {
  std::vector<Torque<double>> torques = every_torque();
  torques.emplace_back(Damping<double>{{0.1, 0.2, 0.3}});
  GravityGradient<double> gravity;
  gravity.orbit = make_orbit<double>({7e6, 0.1, 0.5, 0, 0, 0});
  gravity.act_on(RigidBody<double>(Eigen::Matrix3d(Eigen::Vector3d(1, 2, 2.5).asDiagonal())));
  torques.emplace_back(gravity);
  EXPECT_EQ(this->allocations(torques, {0.4, 0.8, 0.1}), 0u);
  torques.emplace_back(Damping<double>{{1e5, 1e5, 1e5}});
  EXPECT_EQ(this->allocations(torques, {0.4, 0.8, 0.1}), 0u) << "too stiff";
}

TYPED_TEST(StepsOf, a_free_body_need_no_heap) {
  EXPECT_EQ(this->allocations({}, {0.4, 0.8, 0.1}), 0u);
}

TYPED_TEST(StepsOf, a_body_under_every_torque_need_no_heap) {
  EXPECT_EQ(this->allocations(every_torque(), {0.4, 0.8, 0.1}), 0u);
}

TYPED_TEST(StepsOf, a_fast_body_that_is_sub_stepped_need_no_heap) {
  EXPECT_EQ(this->allocations(every_torque(), {400, 800, 100}), 0u);
}

TYPED_TEST(StepsOf, a_ruined_state_need_no_heap) {
  EXPECT_EQ(this->allocations(every_torque(), {1, 2, 3}, std::numeric_limits<double>::quiet_NaN()),
            0u);
  EXPECT_EQ(this->allocations(every_torque(), {1, 2, 3}, 1e300), 0u);
}

}  // namespace
}  // namespace adstar
