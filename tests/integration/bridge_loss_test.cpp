// adstar-bridge killed -9, again and again, in a 1 kHz run: the tick must not notice, the bus must
// recover.

#include <fstream>

#include <gtest/gtest.h>

#include "adstar/integrators/coadjoint.hpp"
#include "tests/integration/daemon_harness.hpp"

namespace adstar {
namespace {

using testing::Daemon;
using testing::GroundStation;

TEST(BridgeLoss, twenty_kills_lose_no_step_and_the_bus_is_back_within_two_seconds) {
  const auto corner = testing::private_corner();
  Daemon daemon(testing::paper_scene(corner, {.step = "1ms"}));
  GroundStation ground(corner);
  ASSERT_TRUE(ground.until([&] { return ground.momentum.contains("sat1"); })) << daemon.log();
  for (int kills = 0; kills < 20; ++kills) {
    const pid_t bridge = daemon.bridge();
    ASSERT_GT(bridge, 0) << daemon.log();
    ground.listen();
    const std::uint64_t before = ground.momentum_samples;
    ASSERT_EQ(kill(bridge, SIGKILL), 0);
    // Two seconds are the contract, not a guess at this machine's speed.
    ASSERT_TRUE(
        ground.until([&] { return ground.momentum_samples > before + 5; }, std::chrono::seconds(2)))
        << "no telemetry after kill " << kills << "\n"
        << daemon.log();
    auto command = ground.command("sat1", {0, 0, 0});
    command.duration_ns = 1'000'000;
    const auto answer = ground.send(command);
    ASSERT_TRUE(answer.has_value()) << "no answer after kill " << kills;
    EXPECT_EQ(answer->verdict, adstar_VERDICT_APPLIED);
  }
  ASSERT_EQ(daemon.stop(), 0) << daemon.log();
  ASSERT_TRUE(ground.until([&] {
    return ground.status && ground.status->state == adstar_SERVICE_STOPPED &&
           (ground.attitude["sat1"].flags & adstar_FLAG_FINAL) != 0;
  }));
  EXPECT_EQ(ground.status->bridge_restarts, 20U);

  // The state at the last step carries the bits of that many steps in a row: none was missing or
  // taken twice. (A zero torque takes the free step, but splits nothing here: its edges lie on the
  // beats.)
  const RigidBody<double> body(Eigen::Vector3d(0.9144, 1.098, 1.66).asDiagonal());
  auto state = make_state(Quat<double>{}, body.momentum({0.45549, 0.82623, 0.03476}));
  for (std::uint64_t i = 0; i < ground.attitude["sat1"].step; ++i) {
    CoadjointRk4::step(body, state, 1e-3, NoTorque{});
  }
  const auto& q = ground.attitude["sat1"].attitude_body_to_inertial;
  EXPECT_EQ((Quat<double>{q.w, q.x, q.y, q.z}), state.q_IB);
}

}  // namespace
}  // namespace adstar
