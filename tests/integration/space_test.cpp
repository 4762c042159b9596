// Coils, a thruster and a hinge over real DDS: commanded, told of, killed with their daemon, the same bits after.

#include <cmath>

#include <gtest/gtest.h>

#include "tests/integration/daemon_harness.hpp"
#include "tests/support/process.hpp"

namespace adstar {
namespace {

using testing::Daemon;
using testing::GroundStation;
using testing::TemporaryDirectory;

std::string space_scene(const dds::ParticipantOptions& where) {
  return fmt::format(R"([simulation]
step = "10ms"
pace = "clock"
rate = 4
substep_limit = 8
epoch_utc = 2026-01-01T00:00:00Z
[[spacecraft]]
name = "sat1"
inertia_body_kg_m2 = [0.9144, 1.098, 1.66]
[spacecraft.orbit]
model = "j2"
semi_major_axis_m = 6.9e6
inclination_rad = 1.2
[spacecraft.pointing]
frame = "inertial"
[[spacecraft.torque]]
model = "magnetorquer"
max_dipole_a_m2 = [50.0, 50.0, 50.0]
lag_s = 0.2
[[spacecraft.torque]]
model = "thruster"
name = "jet"
torque_body_n_m = [0.0, 0.0, 0.1]
min_on_time = "500ms"
[[spacecraft]]
name = "sat2"
mass_kg = 100.0
inertia_body_kg_m2 = [9.0, 11.0, 16.0]
[[spacecraft.body]]
name = "panel"
mass_kg = 5.0
inertia_body_kg_m2 = [0.5, 0.2, 0.6]
[[spacecraft.joint]]
name = "hinge"
kind = "revolute"
from = "hub"
to = "panel"
point_from_body_m = [0.0, 0.5, 0.0]
point_to_body_m = [0.0, -1.0, 0.0]
axis_body = [1.0, 0.0, 0.0]
damping = 0.05
max_motor_torque = 0.5
commanded = true
[budget]
admission = "warn"
[run]
checkpoint_every = "2s"
history = "whole"
hashes = "step"
[telemetry]
attitude_hz = 50
momentum_hz = 50
pointing_hz = 10
[service]
name = "fly"
[dds]
domain = {}
partition = "{}"
interface = "{}"
)",
                     where.domain, where.partition, where.interface);
}

class SpaceStation : public GroundStation {
 public:
  explicit SpaceStation(const dds::ParticipantOptions& where)
      : GroundStation(where),
        where_(where),
        pointing_reader_(participant()),
        body_reader_(participant()),
        joint_reader_(participant()) {}

  template <class Condition>
  bool until_told(Condition&& holds) {
    return until([&] {
      pointing_reader_.take(
          [&](const adstar_PointingState& s, const dds_sample_info_t&) { pointing = s; });
      body_reader_.take([&](const adstar_BodyState& s, const dds_sample_info_t&) {
        bodies[std::string(dds::text_of(s.body))] = s;
      });
      joint_reader_.take([&](const adstar_JointState& s, const dds_sample_info_t&) { hinge = s; });
      return pointing && hinge && bodies.size() == 2 && holds();
    });
  }
  /// Exit code and what it printed.
  std::pair<int, std::string> command(std::vector<std::string> words) const {
    words.insert(words.begin(), ADSTAR);
    words.insert(words.end(), {"--domain", std::to_string(where_.domain), "--partition",
                               where_.partition, "--interface", where_.interface});
    testing::Process process(words);
    const int code = process.wait(std::chrono::seconds(30));
    return {code, process.out() + process.err()};
  }

  std::optional<adstar_PointingState> pointing;
  std::optional<adstar_JointState> hinge;
  std::map<std::string, adstar_BodyState> bodies;

 private:
  dds::ParticipantOptions where_;
  dds::Reader<adstar_PointingState> pointing_reader_;
  dds::Reader<adstar_BodyState> body_reader_;
  dds::Reader<adstar_JointState> joint_reader_;
};

TEST(Space, actuators_of_every_kind_are_commanded_and_the_state_is_told) {
  const auto corner = testing::private_corner();
  Daemon daemon(space_scene(corner));
  SpaceStation ground(corner);
  ASSERT_TRUE(ground.until_told([] { return true; })) << daemon.log();
  EXPECT_EQ(ground.pointing->flags & 3U, adstar_POINTING_ORBIT | adstar_POINTING_TARGET);
  const auto& r = ground.pointing->position_inertial_m;
  EXPECT_NEAR(std::sqrt(r.x * r.x + r.y * r.y + r.z * r.z), 6.9e6, 1);
  EXPECT_EQ(ground.pointing->pointing_error_rad, 0) << "at rest, where it should be";
  EXPECT_EQ(ground.hinge->coordinates, 1U);

  const auto [fired, on] = ground.command({"fire", "sat1", "jet", "--for", "100ms"});
  EXPECT_EQ(fired, 0) << on;
  EXPECT_NE(on.find("on"), std::string::npos) << on;
  // A whole half second of 0.1 N m, though asked for a fifth of it.
  ASSERT_TRUE(ground.until_told([&] {
    return std::fabs(ground.momentum["sat1"].momentum_body_n_m_s.z - 0.05) < 1e-9;
  })) << ground.momentum["sat1"].momentum_body_n_m_s.z;
  ASSERT_TRUE(ground.until_told([&] { return ground.pointing->pointing_error_rad > 0.01; }));

  const auto [clamped, told] =
      ground.command({"dipole", "sat1", "coils", "--dipole-a-m2", "60", "0", "0", "--for", "900s"});
  EXPECT_EQ(clamped, 0) << told;
  EXPECT_NE(told.find("dipole [50, 0, 0] A m^2 instead of [60, 0, 0]"), std::string::npos) << told;
  ASSERT_TRUE(ground.until_told([&] {
    const auto& H = ground.momentum["sat1"].momentum_inertial_n_m_s;
    return std::fabs(H.x) + std::fabs(H.y) > 1e-4;  // 50 A m² in some 3e-5 T
  }));

  const auto [pushed, said] =
      ground.command({"joint", "sat2", "hinge", "--torque-n-m", "0.3", "--for", "900s"});
  EXPECT_EQ(pushed, 0) << said;
  ASSERT_TRUE(ground.until_told([&] { return ground.hinge->coordinate[0] > 0.2; }));
  EXPECT_EQ(ground.hinge->motor_torque[0], 0.3);
  EXPECT_GT(ground.bodies["panel"].angular_velocity_body_rad_s.x, 0);
  EXPECT_LT(ground.bodies["hub"].angular_velocity_body_rad_s.x, 0) << "the other way";
  const auto& H = ground.momentum["sat2"].momentum_inertial_n_m_s;
  EXPECT_LT(std::fabs(H.x) + std::fabs(H.y) + std::fabs(H.z), 1e-14) << "internal, all of it";

  const auto [wrong, refused] = ground.command(
      {"torque", "sat1", "--actuator", "coils", "--torque-n-m", "1", "0", "0", "--for", "1s"});
  EXPECT_EQ(wrong, 3);
  EXPECT_NE(refused.find("unknown_actuator"), std::string::npos) << refused;
  EXPECT_EQ(daemon.stop(), 0) << daemon.log();
}

TEST(Space, killed_with_its_daemon_goes_on_with_the_bits_of_a_flight_without_a_kill) {
  const auto corner = testing::private_corner();
  const TemporaryDirectory home;
  const auto run = home.path() / "run";
  SpaceStation ground(corner);
  auto daemon = std::make_unique<Daemon>(space_scene(corner),
                                         std::vector<std::string>{"--run", run.string()});
  ASSERT_TRUE(ground.until_told([] { return true; })) << daemon->log();
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"dipole", "sat1", "coils", "--dipole-a-m2", "9", "-30", "4"},
        std::vector<std::string>{"joint", "sat2", "hinge", "--torque-n-m", "0.2"}}) {
    std::vector<std::string> asked = words;
    asked.insert(asked.end(), {"--for", "5s"});
    const auto [code, out] = ground.command(asked);
    ASSERT_EQ(code, 0) << out;
  }
  const std::uint64_t reached = ground.momentum["sat1"].step + 300;
  ASSERT_TRUE(ground.until([&] { return ground.momentum["sat1"].step > reached; }));
  daemon->signal(SIGKILL);
  ASSERT_EQ(daemon->exit_code(), -SIGKILL);
  daemon = Daemon::resuming(run);
  ASSERT_TRUE(ground.until([&] { return ground.momentum["sat1"].step > reached + 500; }))
      << daemon->log();
  ASSERT_EQ(daemon->stop(), 0) << daemon->log();
  testing::Process replay({ADSTAR, "replay", run.string()});
  EXPECT_EQ(replay.wait(std::chrono::seconds(120)), 0) << replay.out() << replay.err();
  EXPECT_NE(replay.out().find("same bits"), std::string::npos) << replay.out();
}

}  // namespace
}  // namespace adstar
