// Wheels over real DDS: commanded, told of, and never a digit of the total momentum lost; kill -9 included.

#include <cmath>

#include <gtest/gtest.h>

#include "tests/integration/daemon_harness.hpp"
#include "tests/support/process.hpp"

namespace adstar {
namespace {

using testing::Daemon;
using testing::GroundStation;
using testing::TemporaryDirectory;

std::string wheel_scene(const dds::ParticipantOptions& where) {
  return testing::paper_scene(where,
                              {.rate = 4,
                               .more = "[[spacecraft.wheel]]\nname = \"wheel1\"\n"
                                       "axis_body = [0, 0, 1]\nspin_inertia_kg_m2 = 0.02\n"
                                       "max_torque_n_m = 0.2\nmax_speed_rad_s = 600\n"
                                       "commanded = true\n"
                                       "[[spacecraft.wheel]]\nname = \"ring\"\n"
                                       "axis_body = [1, 0, 0]\nspin_inertia_kg_m2 = 0.05\n"
                                       "viscous_friction_n_m_s_rad = 1e-3\nspeed_rad_s = 20\n"});
}

/// Listens to wheels beside everything else.
class WheelStation : public GroundStation {
 public:
  explicit WheelStation(const dds::ParticipantOptions& where)
      : GroundStation(where), where_(where), reader_(participant()) {}

  template <class Condition>
  bool until_wheels(Condition&& holds) {
    return until([&] {
      reader_.take([&](const adstar_WheelState& s, const dds_sample_info_t&) {
        wheels[std::string(dds::text_of(s.wheel))] = s;
      });
      return wheels.size() == 2 && holds();
    });
  }
  /// Exit code and what it printed.
  std::pair<int, std::string> command(std::vector<std::string> words) const {
    words.insert(words.begin(), {ADSTAR, "wheel"});
    words.insert(words.end(), {"--domain", std::to_string(where_.domain), "--partition",
                               where_.partition, "--interface", where_.interface});
    testing::Process process(words);
    const int code = process.wait(std::chrono::seconds(30));
    return {code, process.out() + process.err()};
  }
  std::array<double, 3> momentum_of_sat1() {
    const auto& H = momentum["sat1"].momentum_inertial_n_m_s;
    return {H.x, H.y, H.z};
  }

  std::map<std::string, adstar_WheelState> wheels;

 private:
  dds::ParticipantOptions where_;
  dds::Reader<adstar_WheelState> reader_;
};

TEST(Wheels, are_commanded_over_dds_and_leave_the_total_momentum_its_last_bit) {
  const auto corner = testing::private_corner();
  Daemon daemon(wheel_scene(corner));
  WheelStation ground(corner);
  ASSERT_TRUE(ground.until_wheels([&] { return ground.momentum.contains("sat1"); }))
      << daemon.log();
  const auto H = ground.momentum_of_sat1();

  const auto [code, out] =
      ground.command({"sat1", "wheel1", "--speed-rad-s", "5", "--for", "1000s"});
  EXPECT_EQ(code, 0) << out;
  EXPECT_NE(out.find("speed 5 rad/s"), std::string::npos) << out;
  ASSERT_TRUE(ground.until_wheels([&] {
    return std::fabs(ground.wheels["wheel1"].speed_rad_s - 5) < 0.01;
  })) << ground.wheels["wheel1"].speed_rad_s;

  const auto [clamped, told] =
      ground.command({"sat1", "wheel1", "--torque-n-m", "-3", "--for", "1000s"});
  EXPECT_EQ(clamped, 0) << told;
  EXPECT_NE(told.find("motor torque -0.2 N m instead of -3"), std::string::npos) << told;
  ASSERT_TRUE(ground.until_wheels([&] {
    const adstar_WheelState& wheel = ground.wheels["wheel1"];
    return wheel.motor_torque_n_m == -0.2 && wheel.speed_rad_s < -5;
  }));
  EXPECT_LT(ground.wheels["ring"].friction_torque_n_m, 0);

  ASSERT_TRUE(ground.until([&] { return ground.momentum["sat1"].step > 500; }));
  EXPECT_EQ(ground.momentum_of_sat1(), H);
  EXPECT_LT(std::fabs(ground.momentum["sat1"].energy_residual_j), 1e-6);
  EXPECT_EQ(daemon.stop(), 0) << daemon.log();
}

TEST(Wheels, take_no_torque_command_and_bodies_no_wheels) {
  const auto corner = testing::private_corner();
  Daemon daemon(wheel_scene(corner));
  WheelStation ground(corner);
  ASSERT_TRUE(ground.until([&] { return ground.momentum.contains("sat1"); })) << daemon.log();
  const auto [code, out] = ground.command({"sat1", "body", "--torque-n-m", "0.1", "--for", "1s"});
  EXPECT_EQ(code, 3);
  EXPECT_NE(out.find("unknown_actuator"), std::string::npos) << out;
  const auto [ring, said] = ground.command({"sat1", "ring", "--torque-n-m", "0.1", "--for", "1s"});
  EXPECT_EQ(ring, 3) << said;
  auto command = static_cast<GroundStation&>(ground).command("sat1", {0.1, 0, 0});
  dds::set_text(command.actuator, "wheel1");
  const auto answer = ground.send(command);
  ASSERT_TRUE(answer.has_value());
  EXPECT_EQ(answer->reason, adstar_REASON_UNKNOWN_ACTUATOR);
  EXPECT_EQ(daemon.stop(), 0);
}

TEST(Wheels, killed_with_their_daemon_go_on_with_the_bits_of_a_flight_without_a_kill) {
  const auto corner = testing::private_corner();
  const TemporaryDirectory home;
  const auto run = home.path() / "run";
  WheelStation ground(corner);
  auto daemon = std::make_unique<Daemon>(
      wheel_scene(corner) + "[run]\ncheckpoint_every = \"2s\"\nhistory = \"whole\"\n",
      std::vector<std::string>{"--run", run.string()});
  ASSERT_TRUE(ground.until_wheels([&] { return ground.momentum.contains("sat1"); }))
      << daemon->log();
  const auto H = ground.momentum_of_sat1();
  for (int kills = 0; kills < 2; ++kills) {
    const auto [code, out] = ground.command(
        {"sat1", "wheel1", "--torque-n-m", kills == 0 ? "0.05" : "-0.1", "--for", "1000s"});
    ASSERT_EQ(code, 0) << out;
    const std::uint64_t reached = ground.momentum["sat1"].step + 300;
    ASSERT_TRUE(ground.until([&] { return ground.momentum["sat1"].step > reached; }));
    daemon->signal(SIGKILL);
    ASSERT_EQ(daemon->exit_code(), -SIGKILL);
    daemon = Daemon::resuming(run);
    ASSERT_TRUE(ground.until([&] { return ground.momentum["sat1"].step > reached + 100; }))
        << daemon->log();
  }
  EXPECT_EQ(ground.momentum_of_sat1(), H);
  ASSERT_EQ(daemon->stop(), 0) << daemon->log();
  testing::Process replay({ADSTAR, "replay", run.string()});
  EXPECT_EQ(replay.wait(std::chrono::seconds(120)), 0) << replay.out() << replay.err();
  EXPECT_NE(replay.out().find("same bits"), std::string::npos) << replay.out();
}

}  // namespace
}  // namespace adstar
