// Good scenes become the right structs.

#include <unistd.h>

#include <gtest/gtest.h>

#include "adstar/bodies/rigid_body.hpp"
#include "adstar/integrators/all.hpp"
#include "scene_text.hpp"

namespace adstar::scene {
namespace {

constexpr const char* kDocumented = R"(
[simulation]
step = "10ms"
scheme = "coadjoint_rk4"

[[spacecraft]]
name = "sat1"
inertia_body_kg_m2 = [0.9144, 1.098, 1.66]        # principal moments, or the full 3x3 tensor
attitude_body_to_inertial = { w = 1.0, x = 0.0, y = 0.0, z = 0.0 }
angular_velocity_body_rad_s = [0.45549, 0.82623, 0.03476]

[[spacecraft.torque]]
model = "harmonic"                                # amplitude * sin(angular_frequency * t + phase), per axis
frame = "body"
amplitude_n_m = [0.02, 0.015, 0.0]
angular_frequency_rad_s = [0.5, 0.3, 0.0]
phase_rad = [0.0, 1.5707963267948966, 0.0]

[[spacecraft.torque]]
model = "constant"
frame = "body"
torque_n_m = [0.0, 0.0, 0.01]

[[spacecraft.torque]]
model = "commanded"                               # an actuator: what TorqueCommand moves
name = "body"
frame = "body"
max_torque_n_m = [1.0, 1.0, 1.0]
)";

TEST(SceneLoader, reads_the_documented_scene) {
  const Scene scene = parse(kDocumented, "scene.toml");
  EXPECT_EQ(scene.simulation.step_ns, 10'000'000);
  EXPECT_EQ(scene.simulation.scheme, "coadjoint_rk4");
  ASSERT_EQ(scene.spacecraft.size(), 1U);
  const Spacecraft& sat = scene.spacecraft[0];
  EXPECT_EQ(sat.name, "sat1");
  EXPECT_EQ(sat.inertia_body_kg_m2,
            Eigen::Matrix3d(Eigen::Vector3d(0.9144, 1.098, 1.66).asDiagonal()));
  EXPECT_EQ(sat.initial.q_IB, (Quat<double>{1.0, 0.0, 0.0, 0.0}));
  const Vec3<double> H_I = sat.initial.H_I.value();
  EXPECT_EQ(H_I, (Vec3<double>{0.9144 * 0.45549, 1.098 * 0.82623, 1.66 * 0.03476}));

  ASSERT_EQ(sat.torques.size(), 3U);
  const auto& harmonic = std::get<Harmonic<double>>(sat.torques[0]);
  EXPECT_EQ(harmonic.frame, Frame::body);
  EXPECT_EQ(harmonic.amplitude_n_m, (Vec3<double>{0.02, 0.015, 0.0}));
  EXPECT_EQ(harmonic.angular_frequency_rad_s, (Vec3<double>{0.5, 0.3, 0.0}));
  EXPECT_EQ(harmonic.phase_rad, (Vec3<double>{0.0, 1.5707963267948966, 0.0}));
  EXPECT_EQ(std::get<Constant<double>>(sat.torques[1]).torque_n_m, (Vec3<double>{0.0, 0.0, 0.01}));
  EXPECT_EQ(std::get<Commanded<double>>(sat.torques[2]).intervals, 0U);
  ASSERT_EQ(sat.actuators.size(), 1U);
  EXPECT_EQ(sat.actuators[0].name, "body");
  EXPECT_EQ(sat.actuators[0].index, 2U);
  EXPECT_EQ(sat.actuators[0].limit, (Vec3<double>{1.0, 1.0, 1.0}));
}

TEST(SceneLoader, reads_a_damping) {
  const Scene one = parse(
      in_torque("model = \"damping\"\ncoefficient_body_n_m_s_rad = [1e-3, 0, 2e-3]"), "scene.toml");
  const auto& torques = one.spacecraft.at(0).torques;
  ASSERT_EQ(torques.size(), 1U);
  EXPECT_EQ(std::get<Damping<double>>(torques[0]).coefficient_n_m_s_rad,
            (Vec3<double>{1e-3, 0, 2e-3}));
}

TEST(SceneLoader, has_the_documented_defaults) {
  const Scene scene = parse(in_spacecraft(""), "scene.toml");
  EXPECT_EQ(scene.simulation.scheme, "coadjoint_rk4");
  EXPECT_EQ(scene.simulation.duration_ns, std::nullopt);
  EXPECT_EQ(scene.simulation.pace, Pace::clock);
  EXPECT_EQ(scene.simulation.rate, 1.0);
  EXPECT_EQ(scene.simulation.epoch, std::nullopt);
  EXPECT_EQ(scene.simulation.accuracy_rad, std::nullopt);
  EXPECT_EQ(scene.simulation.limits.substep_angle_rad, StepLimits{}.substep_angle_rad);
  EXPECT_EQ(scene.simulation.limits.substeps, StepLimits{}.substeps);
  EXPECT_EQ(scene.simulation.limits.edges, StepLimits{}.edges);
  EXPECT_EQ(scene.spacecraft.at(0).initial.q_IB, Quat<double>{});
  EXPECT_EQ(scene.spacecraft[0].initial.H_I.value(), Vec3<double>{});
  EXPECT_EQ(scene.telemetry.attitude_every, 10U);
  EXPECT_EQ(scene.telemetry.momentum_every, 10U);
  EXPECT_EQ(scene.telemetry.fleet_every, 0U);
  EXPECT_EQ(scene.telemetry.watched, std::vector<std::uint32_t>{0});
  char host[256] = {};
  ASSERT_EQ(gethostname(host, sizeof host - 1), 0);
  EXPECT_EQ(scene.service.name.size(), std::min<std::size_t>(63, std::string(host).size()));
  EXPECT_EQ(scene.service.priority, 80);
  EXPECT_EQ(scene.service.cpu, std::nullopt);
  EXPECT_EQ(scene.dds.domain, 0U);
  EXPECT_EQ(scene.dds.partition, "");
  EXPECT_EQ(scene.dds.interface, "lo");
  EXPECT_EQ(scene.log.level, "info");
  EXPECT_EQ(scene.log.file, "");
}

TEST(SceneLoader, reads_every_key_of_the_simulation) {
  const Scene scene = parse(in_simulation("scheme = \"coadjoint_midpoint2\"\n"
                                          "duration = \"1min\"\npace = \"clock\"\nrate = 2\n"
                                          "epoch_utc = 2026-01-01T12:30:00.25Z\n"
                                          "accuracy_rad = 1e-6\nsubstep_angle_limit_rad = 3\n"
                                          "substep_limit = 100000\nedge_limit = 1"),
                            "scene.toml");
  EXPECT_EQ(scene.simulation.scheme, "coadjoint_midpoint2");
  EXPECT_EQ(scene.simulation.duration_ns, 60'000'000'000);
  EXPECT_EQ(scene.simulation.rate, 2.0);
  EXPECT_EQ(scene.simulation.epoch, "2026-01-01T12:30:00.25 UTC");
  EXPECT_EQ(scene.simulation.accuracy_rad, 1e-6);
  EXPECT_EQ(scene.simulation.limits.substep_angle_rad, 3.0);
  EXPECT_EQ(scene.simulation.limits.substeps, 100'000);
  EXPECT_EQ(scene.simulation.limits.edges, 1);
  EXPECT_EQ(parse(in_simulation("pace = \"free\""), "").simulation.pace, Pace::free);
  const Scene held = parse(in_simulation("pace = \"lockstep\""), "");
  EXPECT_EQ(held.simulation.pace, Pace::lockstep);
  EXPECT_EQ(held.simulation.lockstep_timeout_ns, 10'000'000'000);
  EXPECT_FALSE(held.service.run_control) << "off unless the scene allows it";
  EXPECT_EQ(parse(in_simulation("pace = \"lockstep\"\nlockstep_timeout = \"off\""), "")
                .simulation.lockstep_timeout_ns,
            std::nullopt);
  EXPECT_EQ(parse(in_simulation("duration = \"endless\""), "").simulation.duration_ns,
            std::nullopt);
}

TEST(SceneLoader, reads_whose_periods_the_beats_fall_on) {
  const auto simulation = [](const std::string& more) {
    return "[simulation]\nstep = \"1ms\"\n" + more + "\n" + kSpacecraft;
  };
  const auto reference = [&](const std::string& more) {
    return parse(simulation(more), "scene.toml").simulation.phase_reference;
  };
  EXPECT_EQ(reference(""), PhaseReference::none);
  EXPECT_EQ(reference("phase_reference = \"realtime\""), PhaseReference::realtime);
  EXPECT_EQ(reference("phase_reference = \"tai\""), PhaseReference::tai);
  EXPECT_EQ(
      refusal(simulation("rate = 2.0\nphase_reference = \"tai\"")),
      "scene.toml:4:19: simulation.phase_reference: got \"tai\", expected phase_reference only "
      "beside pace = \"clock\" and rate = 1.0; try removing it");
}

TEST(SceneLoader, knows_every_scheme_of_the_core) {
  for (const std::string_view name : scheme_names()) {
    EXPECT_EQ(parse(in_simulation("scheme = \"" + std::string(name) + '"'), "").simulation.scheme,
              name);
  }
}

TEST(SceneLoader, reads_epochs_in_both_scales) {
  const auto epoch = [](const std::string& line) {
    return parse(in_simulation(line), "").simulation.epoch.value_or("none");
  };
  EXPECT_EQ(epoch("epoch_tai = 2026-01-01T00:00:37"), "2026-01-01T00:00:37 TAI");
  EXPECT_EQ(epoch("epoch_tai = \"2026-01-01 00:00:37\""), "2026-01-01T00:00:37 TAI");
  EXPECT_EQ(epoch("epoch_utc = \"2016-12-31T23:59:60Z\""), "2016-12-31T23:59:60 UTC");
  EXPECT_EQ(epoch("epoch_utc = \"2024-02-29T00:00:00+00:00\""), "2024-02-29T00:00:00 UTC");
}

TEST(SceneLoader, reads_service_dds_log_and_telemetry) {
  const Scene scene =
      parse(std::string(kSimulation) + kSpacecraft +
                "[[spacecraft]]\nname = \"sat2\"\ninertia_body_kg_m2 = [1, 1, 1]\n"
                "[telemetry]\nattitude_hz = 33.3333333333\nmomentum_hz = 0\n"
                "fleet_hz = 0.5\nspacecraft = [\"sat2\"]\n"
                "[service]\nname = \"lab\"\npriority = 0\ncpu = 0\nrun_control = true\n"
                "[dds]\ndomain = 230\npartition = \"a\"\ninterface = \"eth0\"\n"
                "[log]\nlevel = \"warn\"\nfile = \"adstar.log\"\n",
            "scene.toml");
  EXPECT_EQ(scene.telemetry.attitude_every, 3U);
  EXPECT_EQ(scene.telemetry.momentum_every, 0U);
  EXPECT_EQ(scene.telemetry.fleet_every, 200U);
  EXPECT_EQ(scene.telemetry.watched, std::vector<std::uint32_t>{1});
  EXPECT_EQ(scene.service.name, "lab");
  EXPECT_EQ(scene.service.priority, 0);
  EXPECT_EQ(scene.service.cpu, 0);
  EXPECT_TRUE(scene.service.run_control);
  EXPECT_EQ(scene.dds.domain, 230U);
  EXPECT_EQ(scene.dds.partition, "a");
  EXPECT_EQ(scene.dds.interface, "eth0");
  EXPECT_EQ(scene.log.level, "warn");
  EXPECT_EQ(scene.log.file, "adstar.log");
}

TEST(SceneLoader, fits_default_rates_to_any_step) {
  const auto attitude_every = [](const std::string& step) {
    return parse("[simulation]\nstep = \"" + step + "\"\n" + kSpacecraft, "")
        .telemetry.attitude_every;
  };
  EXPECT_EQ(attitude_every("1ms"), 100U);
  EXPECT_EQ(attitude_every("30ms"), 3U);
  EXPECT_EQ(attitude_every("10s"), 1U);
  EXPECT_EQ(attitude_every("1ns"), 100'000'000U);
}

TEST(SceneLoader, takes_the_momentum_in_either_frame) {
  const std::string attitude = "attitude_body_to_inertial = { w = 3, x = 0, y = 0, z = 4 }\n";
  const Quat<double> q_IB = normalised(Quat<double>{3.0, 0.0, 0.0, 4.0});
  const auto H_I = [&](const std::string& line) {
    const Spacecraft sat = parse(in_spacecraft(attitude + line), "").spacecraft.at(0);
    EXPECT_EQ(sat.initial.q_IB, q_IB);
    return sat.initial.H_I.value();
  };
  const Vec3<double> v{1.0, 2.0, 3.0};
  EXPECT_EQ(H_I("angular_momentum_inertial_n_m_s = [1, 2, 3]"), v);
  EXPECT_EQ(H_I("angular_momentum_body_n_m_s = [1, 2, 3]"), rotate(q_IB, v));
  const RigidBody<double> body(Eigen::Vector3d(0.9144, 1.098, 1.66).asDiagonal());
  EXPECT_EQ(H_I("angular_velocity_body_rad_s = [1, 2, 3]"), rotate(q_IB, body.momentum(v)));
}

TEST(SceneLoader, reads_a_full_tensor_and_evens_out_round_off) {
  const Scene scene =
      parse(as_spacecraft("name = \"sat1\"\n"
                          "inertia_body_kg_m2 = [[2, 0.1, 0], [0.10000000000000002, 2.5, 0.2], "
                          "[0, 0.2, 3]]"),
            "scene.toml");
  const Eigen::Matrix3d J = scene.spacecraft.at(0).inertia_body_kg_m2;
  EXPECT_EQ(J, Eigen::Matrix3d(J.transpose()));
  EXPECT_DOUBLE_EQ(J(0, 1), 0.1);
  EXPECT_EQ(J(2, 1), 0.2);
  EXPECT_EQ(J(2, 2), 3.0);
}

TEST(SceneLoader, allows_a_flat_disc) {
  EXPECT_EQ(refusal(as_spacecraft("name = \"a\"\ninertia_body_kg_m2 = [0.1, 0.2, 0.3]")), "");
  EXPECT_EQ(refusal(as_spacecraft("name = \"a\"\ninertia_body_kg_m2 = [1, 1, 2.000000000001]")),
            "");
  // The disc diag(1, 1, 2) turned by 45 degrees about x.
  EXPECT_EQ(
      refusal(as_spacecraft("name = \"a\"\n"
                            "inertia_body_kg_m2 = [[1, 0, 0], [0, 1.5, 0.5], [0, 0.5, 1.5]]")),
      "");
}

TEST(SceneLoader, normalises_attitudes_of_any_size) {
  for (const char* scale : {"5e-324", "1e-300", "1e300"}) {
    const Scene scene =
        parse(in_spacecraft(std::string("attitude_body_to_inertial = { w = 0, x = ") + scale +
                            ", y = 0, z = 0 }"),
              "scene.toml");
    EXPECT_EQ(scene.spacecraft.at(0).initial.q_IB, (Quat<double>{0.0, 1.0, 0.0, 0.0})) << scale;
  }
}

TEST(SceneLoader, watches_the_first_64_by_default) {
  const Scene scene =
      parse(as_spacecraft("name = \"s{}\"\ncount = 70\ninertia_body_kg_m2 = [1, 1, 1]"), "");
  ASSERT_EQ(scene.telemetry.watched.size(), 64U);
  EXPECT_EQ(scene.telemetry.watched.back(), 63U);
  EXPECT_EQ(scene.telemetry.fleet_every, 100U);
}

TEST(SceneLoader, loads_every_scene_that_is_shipped) {
  std::size_t scenes = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(ADSTAR_SOURCE_DIR "/configs/scenes")) {
    if (entry.path().extension() == ".toml") {
      ++scenes;
      EXPECT_NO_THROW(load(entry.path())) << entry.path();
    }
  }
  EXPECT_GE(scenes, 5U);
}

}  // namespace
}  // namespace adstar::scene
