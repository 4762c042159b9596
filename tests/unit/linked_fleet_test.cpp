// A vehicle of linked bodies in a fleet: what is seen of it, its motors at the gate, its state saved and set back.

#include <cmath>

#include <gtest/gtest.h>

#include "adstar/orbit/orbital_frame.hpp"
#include "service/report/numbers.hpp"
#include "service/report/scene_report.hpp"
#include "service/runtime/fleet_snapshot.hpp"
#include "service/runtime/linked_stepper.hpp"
#include "tests/support/gate_harness.hpp"
#include "tests/support/linked_craft.hpp"

namespace adstar::runtime {
namespace {

using test::GateHarness;
using test::kMs;

using test::kLinkedScene;

std::vector<scene::Spacecraft> craft(const std::string& more = "") {
  return scene::parse(kLinkedScene + more, "scene.toml").spacecraft;
}

CommandRecord push(std::uint64_t sequence, double torque, std::int64_t start_ns,
                   std::int64_t end_ns) {
  CommandRecord record;
  record.commander = test::kAlice;
  record.sequence = sequence;
  record.start_ns = start_ns;
  record.end_ns = end_ns;
  record.value = {torque, 0, 0};
  return record;
}

TEST(LinkedFleet, keeps_the_momentum_of_the_whole_while_springs_swing_and_dampers_brake) {
  Fleet fleet(craft(), "coadjoint_rk4", StepLimits{});
  const Vehicle& vehicle = fleet.vehicles()[0];
  const Vec3<double> H_0 = vehicle.state.H_I.value();
  const double E_0 = energy_of(vehicle);
  for (std::int64_t n = 0; n < 2000; ++n) {
    ASSERT_EQ(fleet.step(n * 10 * kMs, 10 * kMs), 0U) << n;
  }
  EXPECT_LT(norm(vehicle.state.H_I.value() - H_0), 1e-14 * norm(H_0));
  EXPECT_LT(momentum_residual_relative(vehicle), 1e-14);
  const TelemetryRecord told = sample(vehicle);
  EXPECT_LT(told.work_j, -1e-3) << "the damper took energy";
  EXPECT_LT(std::fabs(told.energy_residual_j), 1e-7 * E_0);
  EXPECT_GT(std::fabs(vehicle.linked->state.coordinates[0][0] - 0.4), 0.05) << "it swings";
}

TEST(LinkedFleet, a_command_on_a_motor_turns_the_joint_and_is_clamped_to_it) {
  GateHarness gate(craft());
  gate.receive(push(1, 7, kStartAtNextBeat, 3'000 * kMs));
  const auto verdict = gate.beat();
  ASSERT_EQ(verdict.size(), 1U);
  EXPECT_EQ(verdict[0].verdict, Verdict::clamped);
  EXPECT_EQ(verdict[0].value[0], 0.5);
  Fleet still(craft(), "coadjoint_rk4", StepLimits{});
  for (std::int64_t n = 0; n < 50; ++n) {
    still.step(n * 10 * kMs, 10 * kMs);
  }
  gate.run_until(500 * kMs);
  const auto angle = [](const Fleet& f) { return f.vehicles()[0].linked->state.coordinates[0][0]; };
  EXPECT_GT(angle(gate.fleet()), angle(still) + 0.01);
  // An internal torque: the momentum of the whole does not hear of it.
  EXPECT_LT(
      norm(gate.fleet().vehicles()[0].state.H_I.value() - still.vehicles()[0].state.H_I.value()),
      1e-14);
}

TEST(LinkedFleet, a_torque_on_a_body_gives_the_whole_its_impulse) {
  Fleet fleet(craft("[[spacecraft.torque]]\nmodel = \"constant\"\nframe = \"inertial\"\n"
                    "torque_n_m = [0.01, 0.02, -0.03]\nbody = \"boom\"\n"),
              "coadjoint_rk4", StepLimits{});
  const Vehicle& vehicle = fleet.vehicles()[0];
  const Vec3<double> H_0 = vehicle.state.H_I.value();
  for (std::int64_t n = 0; n < 100; ++n) {
    fleet.step(n * 10 * kMs, 10 * kMs);
  }
  const Vec3<double> gained = vehicle.state.H_I.value() - H_0;
  EXPECT_LT(norm(gained - Vec3<double>{0.01, 0.02, -0.03}), 1e-14);
  EXPECT_LT(momentum_residual_relative(vehicle), 1e-14);
}

TEST(LinkedFleet, goes_on_from_a_saved_state_with_the_same_bits) {
  GateHarness gate(craft());
  gate.receive(push(1, 0.3, 15 * kMs, 18 * kMs));
  gate.run_until(200 * kMs);
  Fleet other(craft(), "coadjoint_rk4", StepLimits{});
  const FleetState saved = state_of(gate.fleet());
  ASSERT_TRUE(restore(other, saved));
  for (std::int64_t n = 20; n < 60; ++n) {
    gate.beat();
    other.step(n * 10 * kMs, 10 * kMs);
  }
  EXPECT_EQ(state_of(gate.fleet()).memory, state_of(other).memory);
  EXPECT_EQ(gate.fleet().vehicles()[0].state, other.vehicles()[0].state);
}

TEST(LinkedFleet, a_reset_brings_the_start_back) {
  Fleet fleet(craft(), "coadjoint_rk4", StepLimits{});
  fleet.keep_start();
  const FleetState start = state_of(fleet);
  for (std::int64_t n = 0; n < 30; ++n) {
    fleet.step(n * 10 * kMs, 10 * kMs);
  }
  ASSERT_TRUE(fleet.reset());
  EXPECT_EQ(state_of(fleet).memory, start.memory);
  EXPECT_EQ(fleet.vehicles()[0].linked->state.work.value, 0);
}

TEST(LinkedFleet, a_reset_takes_what_was_commanded_from_its_motors) {
  GateHarness gate(craft());
  gate.fleet().keep_start();
  gate.receive(push(1, 0.4, kStartAtNextBeat, 3'000 * kMs));
  gate.run_until(100 * kMs);
  ASSERT_TRUE(gate.fleet().reset());
  Fleet fresh(craft(), "coadjoint_rk4", StepLimits{});
  for (std::int64_t n = 0; n < 30; ++n) {
    gate.fleet().step(n * 10 * kMs, 10 * kMs);
    fresh.step(n * 10 * kMs, 10 * kMs);
  }
  EXPECT_EQ(state_of(gate.fleet()).memory, state_of(fresh).memory);
}

TEST(LinkedFleet, a_hinge_that_begins_wound_up_to_where_its_spring_rests_stays_there) {
  std::string text = kLinkedScene;
  text.replace(text.find("coordinate = 0.4"), 16, "coordinate = 15.0\nrest = 15.0");
  text.erase(text.find("angular_velocity_body_rad_s"),
             text.find('\n', text.find("angular_velocity_body_rad_s")) -
                 text.find("angular_velocity_body_rad_s"));
  text.erase(text.find("rate = [0.1, 0.0, 0.3]"));
  Fleet fleet(scene::parse(text, "scene.toml").spacecraft, "coadjoint_rk4", StepLimits{});
  Vehicle& vehicle = fleet.vehicles()[0];
  EXPECT_NEAR(vehicle.linked->state.coordinates[0][0], 15, 1e-14);
  EXPECT_LT(energy_of(vehicle), 1e-25);
  for (std::int64_t n = 0; n < 100; ++n) {
    fleet.step(n * 10 * kMs, 10 * kMs);
  }
  EXPECT_NEAR(vehicle.linked->state.coordinates[0][0], 15, 1e-12);
}

TEST(LinkedFleet, a_damping_on_a_body_is_stepped_in_parts_that_it_is_stable_in) {
  scene::Spacecraft resting = test::resting_linked_craft();
  const auto parts_under = [&](double coefficient_n_m_s_rad, Vehicle& vehicle) {
    vehicle.torques = {Damping<double>{{0, coefficient_n_m_s_rad, 0}}};
    vehicle.linked->first_torque = {0, 0, 1, 1};  // of the panel
    bool edges_left = false;
    return multibody::advance<Rk4>(*vehicle.linked,
                                   std::span<const Torque<double>>(vehicle.torques), 0, 100 * kMs,
                                   {}, 64, edges_left);
  };
  Fleet fleet({resting}, "coadjoint_rk4", StepLimits{});
  // h c/J_min by decay_limit(4): 0.1 s · 50 N m s/rad / 0.2 kg m² / 0.5; the hinge's damper adds to it.
  const auto fits = parts_under(50, fleet.vehicles()[0]);
  EXPECT_GE(fits.parts, 50);
  EXPECT_LT(fits.parts, 64);
  EXPECT_TRUE(fits.resolved());
  const auto too_stiff = parts_under(3e4, fleet.vehicles()[0]);
  EXPECT_TRUE(too_stiff.unresolved_stiffness);
  EXPECT_EQ(too_stiff.parts, 64);
}

/// Two bodies on a fixed joint are one body of their common inertia, in the gravity of a point mass too.
TEST(LinkedFleet, two_bodies_held_together_fly_an_orbit_as_one) {
  const std::string orbit =
      "[[spacecraft.torque]]\nmodel = \"gravity_gradient\"\n"
      "[spacecraft.orbit]\nsemi_major_axis_m = 7e6\neccentricity = 0.01\n";
  const std::string head =
      "[simulation]\nstep = \"1s\"\n[[spacecraft]]\nname = \"s\"\n"
      "angular_velocity_body_rad_s = [1e-3, 2e-3, -1e-3]\n";
  const scene::Scene two =
      scene::parse(head + "mass_kg = 30\ninertia_body_kg_m2 = [9, 11, 16]\n" + orbit +
                       "[[spacecraft.body]]\nname = \"tip\"\nmass_kg = 10\n"
                       "inertia_body_kg_m2 = [0.3, 0.2, 0.1]\n"
                       "[[spacecraft.joint]]\nname = \"boom\"\nkind = \"fixed\"\nfrom = \"hub\"\n"
                       "to = \"tip\"\npoint_from_body_m = [4, 0, 0]\n"
                       "point_to_body_m = [0, 0, 0]\n",
                   "two.toml");
  // Steiner: 30·10/40 kg at 4 m along x.
  const scene::Scene one =
      scene::parse(head + "inertia_body_kg_m2 = [9.3, 131.2, 136.1]\n" + orbit, "one.toml");
  Fleet linked(two.spacecraft, "coadjoint_rk4", StepLimits{});
  Fleet single(one.spacecraft, "coadjoint_rk4", StepLimits{});
  for (std::int64_t n = 0; n < 2000; ++n) {
    ASSERT_EQ(linked.step(n * 1'000 * kMs, 1'000 * kMs), 0U);
    single.step(n * 1'000 * kMs, 1'000 * kMs);
  }
  const Quat<double> a = linked.vehicles()[0].state.q_IB, b = single.vehicles()[0].state.q_IB;
  EXPECT_LT(norm(Vec3<double>{a.x - b.x, a.y - b.y, a.z - b.z}), 1e-9);
  const Vec3<double> H = single.vehicles()[0].state.H_I.value();
  EXPECT_LT(norm(linked.vehicles()[0].state.H_I.value() - H), 1e-9 * norm(H));
  EXPECT_GT(norm(H - one.spacecraft[0].initial.H_I.value()), 0.1 * norm(H)) << "gravity turns it";
}

constexpr const char* kLowOrbit =
    "[spacecraft.orbit]\nsemi_major_axis_m = 6.65e6\ninclination_rad = 0.9\n";
constexpr const char* kTwoOutsides =
    "mass_kg = 30\ninertia_body_kg_m2 = [9, 11, 16]\n"
    "box = { size_m = [1.0, 0.5, 0.3], specular_reflectivity = 0.3 }\n"
    "[[spacecraft.body]]\nname = \"tip\"\nmass_kg = 10\ninertia_body_kg_m2 = [0.3, 0.2, 0.1]\n"
    "facet = [ { area_m2 = 2.0, normal_body = [0, 0, 1], centre_body_m = [0, 0, 0.05] },\n"
    "          { area_m2 = 2.0, normal_body = [0, 0.6, -0.8], centre_body_m = [0, 0.2, 0] } ]\n";
constexpr const char* kPushed =
    "[[spacecraft.torque]]\nmodel = \"aerodynamic\"\n"
    "[[spacecraft.torque]]\nmodel = \"solar_pressure\"\n";

std::string pushed_head(const std::string& step) {
  return "[simulation]\nstep = \"" + step +
         "\"\nepoch_utc = 2026-03-20T00:00:00Z\n[[spacecraft]]\nname = \"s\"\n"
         "angular_velocity_body_rad_s = [1e-2, 2e-2, -1e-2]\n";
}

/// Each is pushed by its own outside; held together they are a body whose plates all are.
TEST(LinkedFleet, two_bodies_held_together_are_turned_by_air_and_sunlight_as_one) {
  const scene::Scene two = scene::parse(
      pushed_head("100ms") + kTwoOutsides +
          "[[spacecraft.joint]]\nname = \"boom\"\nkind = \"fixed\"\nfrom = \"hub\"\nto = \"tip\"\n"
          "point_from_body_m = [4, 0, 0]\npoint_to_body_m = [0, 0, 0]\n" +
          kLowOrbit + kPushed,
      "two.toml");
  // The common centre of mass is 1 m from the hub's; Steiner as above.
  const scene::Scene one = scene::parse(
      pushed_head("100ms") +
          "inertia_body_kg_m2 = [9.3, 131.2, 136.1]\n"
          "box = { size_m = [1.0, 0.5, 0.3], centre_body_m = [-1, 0, 0], "
          "specular_reflectivity = 0.3 }\n"
          "facet = [ { area_m2 = 2.0, normal_body = [0, 0, 1], centre_body_m = [3, 0, 0.05] },\n"
          "          { area_m2 = 2.0, normal_body = [0, 0.6, -0.8], centre_body_m = [3, 0.2, 0] } "
          "]\n" +
          kLowOrbit + kPushed,
      "one.toml");
  Fleet linked(two.spacecraft, "coadjoint_rk4", StepLimits{});
  Fleet single(one.spacecraft, "coadjoint_rk4", StepLimits{});
  for (std::int64_t n = 0; n < 6000; ++n) {
    ASSERT_EQ(linked.step(n * 100 * kMs, 100 * kMs), 0U);
    single.step(n * 100 * kMs, 100 * kMs);
  }
  const Vec3<double> H = single.vehicles()[0].state.H_I.value();
  const double turned = norm(H - one.spacecraft[0].initial.H_I.value());
  EXPECT_GT(turned, 0.01 * norm(H)) << "air and sunlight turn it";
  EXPECT_LT(norm(linked.vehicles()[0].state.H_I.value() - H), 1e-6 * turned);
  const Quat<double> a = linked.vehicles()[0].state.q_IB, b = single.vehicles()[0].state.q_IB;
  EXPECT_LT(norm(Vec3<double>{a.x - b.x, a.y - b.y, a.z - b.z}), 1e-8);
}

TEST(LinkedFleet, what_pushes_is_reported_with_its_force_body_by_body_and_of_many_once) {
  const auto reported = [](const std::string& count) {
    return report::scene_report(scene::parse(
        pushed_head("1s") + kTwoOutsides +
            "[[spacecraft.joint]]\nname = \"a\"\nkind = \"fixed\"\nfrom = \"hub\"\nto = \"tip\"\n"
            "point_from_body_m = [4, 0, 0]\npoint_to_body_m = [0, 0, 0]\n"
            "[[spacecraft.chain]]\nname = \"link{}\"\ncount = " +
            count +
            "\nfrom = \"tip\"\nmass_kg = 1\ninertia_body_kg_m2 = [0.1, 0.1, 0.1]\n"
            "box = { size_m = [1, 1, 1] }\nkind = \"fixed\"\npoint_from_body_m = [1, 0, 0]\n"
            "point_to_body_m = [0, 0, 0]\n" +
            kLowOrbit + "[[spacecraft.torque]]\nmodel = \"solar_pressure\"\n",
        "many.toml"));
  };
  // 4.54e-6 N/m² at 1 au, 3.4 % more at the least distance, on 4 m² of black plates.
  EXPECT_NE(reported("2").find(", on 'tip' with at most 1.87"), std::string::npos) << reported("2");
  EXPECT_NE(reported("2").find(", on 'link1' with at most 2.8"), std::string::npos);
  const std::string many = reported("9");
  EXPECT_NE(many.find(" and 10 others, each by its own outside"), std::string::npos) << many;
  EXPECT_EQ(many.find(", on 'link"), std::string::npos);
}

TEST(LinkedFleet, what_pushes_leaves_the_common_centre_of_mass_where_it_is) {
  const scene::Scene scene = scene::parse(
      pushed_head("500ms") + kTwoOutsides +
          "[[spacecraft.joint]]\nname = \"hinge\"\nkind = \"revolute\"\nfrom = \"hub\"\n"
          "to = \"tip\"\npoint_from_body_m = [4, 0, 0]\npoint_to_body_m = [-0.5, 0, 0]\n"
          "axis_body = [0, 1, 0]\n" +
          kLowOrbit + kPushed,
      "hinge.toml");
  Fleet fleet(scene.spacecraft, "coadjoint_rk4", StepLimits{});
  for (std::int64_t n = 0; n < 2000; ++n) {
    fleet.step(n * 500 * kMs, 500 * kMs);
  }
  const auto& flight = *fleet.vehicles()[0].linked;
  EXPECT_LT(norm(multibody::centre_of_mass(flight.assembly, flight.state)), 1e-8)
      << "an error of the scheme; what air pushes would be tens of metres off";
  EXPECT_LT(norm(multibody::total_momentum(flight.assembly, flight.state).p_I.value()), 1e-14);
  EXPECT_LT(momentum_residual_relative(fleet.vehicles()[0]), 1e-13);
  EXPECT_GT(std::fabs(flight.state.coordinates[0][0]), 1e-3) << "the wind bends it";
  const TelemetryRecord told = sample(fleet.vehicles()[0]);
  EXPECT_LT(std::fabs(told.energy_residual_j), 1e-6 * std::fabs(told.work_j))
      << "what they did is the work of their pushes";
}

/// Each of them alone, and both of them with the tide: what a push has in common is taken off, what the tide has is none.
TEST(LinkedFleet, what_pushes_stands_beside_the_tide) {
  const auto flown = [](const std::string& torques) {
    Fleet fleet(
        scene::parse(pushed_head("500ms") + kTwoOutsides +
                         "[[spacecraft.joint]]\nname = \"hinge\"\nkind = \"revolute\"\nfrom = "
                         "\"hub\"\nto = \"tip\"\npoint_from_body_m = [4, 0, 0]\n"
                         "point_to_body_m = [-0.5, 0, 0]\naxis_body = [0, 1, 0]\n" +
                         kLowOrbit + torques,
                     "hinge.toml")
            .spacecraft,
        "coadjoint_rk4", StepLimits{});
    for (std::int64_t n = 0; n < 20; ++n) {
      fleet.step(n * 500 * kMs, 500 * kMs);
    }
    const Vehicle& vehicle = fleet.vehicles()[0];
    return vehicle.state.H_I.value() - vehicle.H_0;
  };
  const std::string tide = "[[spacecraft.torque]]\nmodel = \"gravity_gradient\"\n";
  const Vec3<double> pushed = flown(kPushed), pulled = flown(tide), both = flown(kPushed + tide);
  EXPECT_GT(norm(pushed), 1e-4);
  EXPECT_GT(norm(pulled), 1e-4);
  EXPECT_LT(norm(both - (pushed + pulled)), 1e-3 * norm(both)) << "in ten seconds they add up";
}

/// A parallelogram of four bars that folds flat: there its loads are not unique, and that is said.
TEST(LinkedFleet, says_when_a_loop_goes_through_a_dead_point) {
  const auto bar = [](const std::string& name, double length) {
    return "[[spacecraft.body]]\nname = \"" + name +
           "\"\nmass_kg = 1\ninertia_body_kg_m2 = [0.01, 0.1, 0.1]\n[[spacecraft.joint]]\nname = "
           "\"j" +
           name + "\"\nkind = \"revolute\"\naxis_body = [0, 0, 1]\nto = \"" + name +
           "\"\npoint_to_body_m = [" + std::to_string(-length / 2) + ", 0, 0]\n";
  };
  const scene::Scene scene = scene::parse(
      "[simulation]\nstep = \"10ms\"\n[[spacecraft]]\nname = \"s\"\nmass_kg = 1000\n"
      "inertia_body_kg_m2 = [1000, 1000, 1000]\n" +
          bar("left", 1) + "from = \"hub\"\npoint_from_body_m = [-1, 0, 0]\ncoordinate = 0.05\n" +
          "rate = -1.0\n" + bar("right", 1) +
          "from = \"hub\"\npoint_from_body_m = [1, 0, 0]\ncoordinate = 0.05\nrate = -1.0\n" +
          bar("coupler", 2) +
          "from = \"left\"\npoint_from_body_m = [0.5, 0, 0]\ncoordinate = -0.05\nrate = 1.0\n" +
          "[[spacecraft.joint]]\nname = \"closes\"\nkind = \"revolute\"\naxis_body = [0, 0, 1]\n"
          "from = \"coupler\"\nto = \"right\"\npoint_from_body_m = [1, 0, 0]\n"
          "point_to_body_m = [0.5, 0, 0]\n",
      "bars.toml");
  Fleet fleet(scene.spacecraft, "coadjoint_rk4", StepLimits{});
  std::uint32_t seen = 0;
  for (std::int64_t n = 0; n < 20; ++n) {
    fleet.step(n * 10 * kMs, 10 * kMs);
    seen |= fleet.vehicles()[0].flags;
  }
  EXPECT_NE(seen & kFlagJointOpen, 0U) << seen;
}

TEST(LinkedFleet, is_reported_with_the_rate_of_its_hub_and_the_turn_of_its_fastest_body) {
  const scene::Scene scene = scene::parse(kLinkedScene, "scene.toml");
  const std::string text = report::scene_report(scene);
  EXPECT_NE(text.find("at t = 0  |omega| 0.229129 rad/s"), std::string::npos) << text;
  double fastest = 0;
  for (const auto& body : scene.spacecraft[0].linked->bodies) {
    fastest = std::max(fastest, norm(body.omega_B));
  }
  EXPECT_GT(fastest, 0.3);
  EXPECT_NE(text.find("|omega| h at most " + report::short_number(0.01 * fastest)),
            std::string::npos)
      << text;
}

/// As if the scene had said so: hinge wound, panel swinging, all of it.
TEST(LinkedFleet, is_put_into_the_motion_that_a_scene_would_give_its_hub) {
  for (const std::string formulation : {"se3", "direct_product"}) {
    const auto flies = [&](const std::string& attitude, const std::string& rate) {
      std::string text = kLinkedScene;
      const std::string old = "angular_velocity_body_rad_s = [0.1, -0.05, 0.2]\n";
      text.replace(text.find(old), old.size(),
                   "formulation = \"" + formulation + "\"\nattitude_body_to_inertial = " +
                       attitude + "\nangular_velocity_body_rad_s = " + rate + "\n");
      return Fleet(scene::parse(text, "scene.toml").spacecraft, "coadjoint_rk4", StepLimits{});
    };
    Fleet put = flies("{ w = 1.0, x = 0.0, y = 0.0, z = 0.0 }", "[0.1, -0.05, 0.2]");
    ASSERT_TRUE(put.set_motion(0, {0.5, -1, 0.2, 0.8}, {-0.3, 0.1, 0.02}));
    Fleet asked = flies("{ w = 0.5, x = -1.0, y = 0.2, z = 0.8 }", "[-0.3, 0.1, 0.02]");
    const auto expect_alike = [&](double within) {
      const auto &a = *put.vehicles()[0].linked, &b = *asked.vehicles()[0].linked;
      for (std::size_t i = 0; i < a.state.bodies.size(); ++i) {
        const auto x = multibody::motion_of(a.assembly, a.state, i);
        const auto y = multibody::motion_of(b.assembly, b.state, i);
        EXPECT_LT(norm(x.x_I - y.x_I), within) << i;
        EXPECT_LT(norm(x.v_I - y.v_I), within) << i;
        EXPECT_LT(norm(x.omega_I - y.omega_I), within) << i;
        EXPECT_LT(norm(rotation_vector(x.q_IB, y.q_IB)), within) << i;
      }
    };
    expect_alike(1e-13);
    const Vehicle& vehicle = put.vehicles()[0];
    EXPECT_EQ(vehicle.state.q_IB, normalised(Quat<double>{0.5, -1, 0.2, 0.8}));
    EXPECT_EQ(momentum_residual_relative(vehicle), 0.0);
    EXPECT_EQ(sample(vehicle).energy_residual_j, 0.0);
    for (std::int64_t n = 0; n < 300; ++n) {
      EXPECT_EQ(put.step(n * 10 * kMs, 10 * kMs), 0U);
      asked.step(n * 10 * kMs, 10 * kMs);
    }
    expect_alike(1e-12);
    EXPECT_LT(momentum_residual_relative(vehicle), formulation == "se3" ? 1e-13 : 1e-10);
  }
}

TEST(LinkedFleet, a_motion_beyond_the_range_of_double_or_another_body_is_refused) {
  Fleet fleet(craft(), "coadjoint_rk4", StepLimits{});
  const auto before = fleet.vehicles()[0].linked->state;
  EXPECT_FALSE(fleet.set_motion(0, {}, {0, 0, 1e200}));
  EXPECT_FALSE(fleet.set_motion(0, {}, {0, 0, 2.8e153}));
  EXPECT_EQ(fleet.vehicles()[0].linked->state, before);
  EXPECT_FALSE(fleet.can_have_body(0, fleet.vehicles()[0].body));
}

/// The load of a joint at rest under a torque on the panel alone: the hinge passes on what the hub needs to turn with it.
TEST(LinkedFleet, a_joint_tells_what_it_carries) {
  std::string text = kLinkedScene;
  text.replace(text.find("kind = \"revolute\""), 17, "kind = \"fixed\"   ");
  for (const char* const key :
       {"axis_body = [1, 0, 0]\n", "coordinate = 0.4\n", "stiffness = 3.0\n", "damping = 0.1\n",
        "max_motor_torque = 0.5\n", "commanded = true\n", "rate = [0.1, 0.0, 0.3]\n",
        "angular_velocity_body_rad_s = [0.1, -0.05, 0.2]\n"}) {
    text.erase(text.find(key), std::string(key).size());
  }
  text +=
      "[[spacecraft.torque]]\nmodel = \"constant\"\nframe = \"body\"\ntorque_n_m = [1, 0, 0]\n"
      "body = \"panel\"\n";
  Fleet fleet(scene::parse(text, "scene.toml").spacecraft, "coadjoint_rk4", StepLimits{});
  Vehicle& vehicle = fleet.vehicles()[0];
  observe(vehicle, 0);
  const JointRecord fixed = sample_joint(vehicle, 0);
  EXPECT_EQ(fixed.coordinates, 0U);
  // The panel's own equation: torque + couple + lever × force = J omega'; its centre accelerates by the force.
  const auto& acceleration = vehicle.linked->work.accelerations[1];
  const Vec3<double> force{fixed.force_I_n[0], fixed.force_I_n[1], fixed.force_I_n[2]};
  const Vec3<double> couple{fixed.couple_I_n_m[0], fixed.couple_I_n_m[1], fixed.couple_I_n_m[2]};
  const Vec3<double> lever{0, -1, 0};
  const Vec3<double> moment = Vec3<double>{1, 0, 0} + couple + cross(lever, force);
  EXPECT_NEAR(moment.x, 0.5 * acceleration[0], 1e-14);
  EXPECT_NEAR(force.z, 5 * acceleration[5], 1e-14);
  EXPECT_GT(acceleration[0], 0.01);
}

}  // namespace
}  // namespace adstar::runtime
