// The space around in a scene: [earth], the outside, the models and actuators there; what is read, and what is refused.

#include <cmath>

#include <gtest/gtest.h>

#include "scene_text.hpp"
#include "service/report/scene_report.hpp"
#include "service/runtime/fleet.hpp"
#include "service/scene/time_scales.hpp"

namespace adstar::scene {
namespace {

const std::string kEpoch = "epoch_utc = 2026-01-01T00:00:00Z\n";
const std::string kOrbit = "[spacecraft.orbit]\nsemi_major_axis_m = 7e6\n";
const std::string kBox = "[spacecraft.box]\nsize_m = [1, 1, 2]\n";

std::string scene_of(const std::string& spacecraft, const std::string& simulation = kEpoch,
                     const std::string& sections = "") {
  return std::string(kSimulation) + simulation + sections + kSpacecraft + spacecraft;
}
std::string model(const std::string& name, const std::string& lines = "") {
  return "[[spacecraft.torque]]\nmodel = \"" + name + "\"\n" + lines;
}
Spacecraft read(const std::string& text) { return parse(text, "scene.toml").spacecraft[0]; }

TEST(SceneSpace, names_every_model_of_it_together) {
  const Spacecraft craft = read(scene_of(
      kOrbit + kBox + model("gravity_gradient") +
      model("residual_dipole", "dipole_body_a_m2 = [0, 0, 0.1]\n") + model("aerodynamic") +
      model("solar_pressure") +
      model("magnetorquer", "max_dipole_a_m2 = [1, 2, 3]\nlag_s = 0.1\ndipole_step_a_m2 = 0.5\n") +
      model("thruster",
            "name = \"jet\"\ntorque_body_n_m = [0.1, 0, 0]\nmin_on_time = \"20ms\"\n")));
  ASSERT_EQ(craft.torques.size(), 6U);
  EXPECT_EQ(std::get<Aerodynamic<double>>(craft.torques[2]).facets->size(), 6U);
  const auto& coils = *std::get<Magnetorquer<double>>(craft.torques[4]).coils;
  EXPECT_EQ(coils.limit_A_m2, (Vec3<double>{1, 2, 3}));
  EXPECT_EQ(coils.lag_s, 0.1);
  EXPECT_EQ(coils.step_A_m2, (Vec3<double>{0.5, 0.5, 0.5}));
  ASSERT_EQ(craft.actuators.size(), 2U);
  EXPECT_EQ(craft.actuators[0].name, "coils");
  EXPECT_EQ(craft.actuators[0].kind, ActuatorKind::magnetorquer);
  EXPECT_EQ(craft.actuators[0].index, 4U);
  EXPECT_EQ(craft.actuators[1].kind, ActuatorKind::thruster);
  EXPECT_EQ(craft.actuators[1].least_on_ns, 20'000'000);
}

/// Three bodies, of which the hub and the last have an outside.
std::string linked_scene(const std::string& torques, const std::string& of_facet = "") {
  const std::string body = "mass_kg = 5\ninertia_body_kg_m2 = [0.5, 0.2, 0.6]\n";
  const std::string joint =
      "kind = \"fixed\"\npoint_from_body_m = [1, 0, 0]\npoint_to_body_m = [0, 0, 0]\n";
  return scene_of("mass_kg = 100\n" + kOrbit + kBox + "[[spacecraft.body]]\nname = \"bare\"\n" +
                  body + "[[spacecraft.joint]]\nname = \"a\"\nfrom = \"hub\"\nto = \"bare\"\n" +
                  joint + "[[spacecraft.chain]]\nname = \"link{}\"\ncount = 1\nfrom = \"bare\"\n" +
                  body + joint + "facet = [ { area_m2 = 3, normal_body = [0, 1, 0], " +
                  "centre_body_m = [0, 0, 0]" + of_facet + " } ]\n" + torques);
}

TEST(SceneSpace, what_pushes_goes_to_the_linked_body_that_it_names_or_to_each_that_has_an_outside) {
  const Spacecraft all = read(linked_scene(model("aerodynamic", "density_factor = 2.0\n")));
  ASSERT_EQ(all.torques.size(), 2U);
  EXPECT_EQ(all.first_torque, (std::vector<std::size_t>{0, 1, 1, 2}));
  EXPECT_EQ(std::get<Aerodynamic<double>>(all.torques[0]).facets->size(), 6U);
  const auto& link = std::get<Aerodynamic<double>>(all.torques[1]);
  ASSERT_EQ(link.facets->size(), 1U);
  EXPECT_EQ(link.facets->at(0).area_m2, 3);
  EXPECT_EQ(link.density_factor, 2);
  const Spacecraft one = read(linked_scene(model("solar_pressure", "body = \"link0\"\n")));
  ASSERT_EQ(one.torques.size(), 1U);
  EXPECT_EQ(one.first_torque, (std::vector<std::size_t>{0, 0, 0, 1}));
  EXPECT_EQ(std::get<SolarPressure<double>>(one.torques[0]).facets->size(), 1U);
  EXPECT_NE(
      refusal(linked_scene(model("aerodynamic", "body = \"bare\"\n")))
          .find("an outside of the body that it acts on; try box = { size_m = [1.0, 1.0, 2.0] } "
                "in that body's own block"),
      std::string::npos);
  EXPECT_NE(refusal(linked_scene(model("aerodynamic") +
                                 model("aerodynamic", "body = \"link0\"\ndensity_factor = 2.0\n")))
                .find("\"aerodynamic\" again on \"link0\""),
            std::string::npos);
  EXPECT_EQ(read(linked_scene(model("aerodynamic", "body = \"hub\"\n") +
                              model("aerodynamic", "body = \"link0\"\n") + model("solar_pressure")))
                .torques.size(),
            4U);
  EXPECT_NE(refusal(scene_of(kOrbit + model("gravity_gradient") + model("gravity_gradient")))
                .find("\"gravity_gradient\" again, expected one of them"),
            std::string::npos);
  const std::string twice = refusal(linked_scene(model("aerodynamic", "density_factor = 0\n")));
  EXPECT_EQ(twice.find("density_factor"), twice.rfind("density_factor")) << "said once: " << twice;
  EXPECT_EQ(twice.find("again"), std::string::npos) << "one block is no repetition: " << twice;
  const std::string astray = refusal(linked_scene(model("aerodynamic", "body = \"lnik0\"\n")));
  EXPECT_NE(astray.find("lnik0"), std::string::npos) << astray;
  EXPECT_EQ(astray.find("an outside"), std::string::npos) << "that body has one: " << astray;
}

/// Each pushed body has its own air: three times as dense for the link, or the link three times as rough.
TEST(SceneSpace, what_one_linked_body_feels_is_not_what_another_does) {
  const auto flown = [](const std::string& torques, const std::string& more) {
    const Spacecraft craft = read(linked_scene(torques, more));
    runtime::Fleet fleet({craft}, "coadjoint_rk4", StepLimits{});
    for (std::int64_t n = 0; n < 100; ++n) {
      fleet.step(n * 1'000'000'000, 1'000'000'000);
    }
    return fleet.vehicles()[0].state.H_I.value();
  };
  const std::string hub = model("aerodynamic", "body = \"hub\"\n");
  const std::string link = model("aerodynamic", "body = \"link0\"\n");
  const Vec3<double> denser = flown(hub + link + "density_factor = 3.0\n", "");
  const Vec3<double> rougher = flown(hub + link, ", drag_coefficient = 6.6");
  const Vec3<double> alike = flown(hub + link, "");
  EXPECT_LT(norm(denser - rougher), 1e-9 * norm(denser - alike));
  EXPECT_GT(norm(denser - alike), 0);
}

TEST(SceneSpace, a_thruster_with_a_schedule_is_nobodys_to_command) {
  const Spacecraft craft = read(in_spacecraft(model(
      "thruster", "torque_body_n_m = [0.1, 0, 0]\non = [[\"0s\", \"1s\"], [\"3s\", \"4s\"]]\n")));
  EXPECT_TRUE(craft.actuators.empty());
  const auto& thruster = std::get<Thruster<double>>(craft.torques[0]);
  ASSERT_TRUE(thruster.schedule);
  EXPECT_EQ(thruster.schedule->at(1), (OnInterval{3'000'000'000, 4'000'000'000}));
  EXPECT_NE(refusal(in_spacecraft(model(
                        "thruster", "torque_body_n_m = [0.1, 0, 0]\non = [[\"2s\", \"1s\"]]\n")))
                .find("an end after its beginning"),
            std::string::npos);
  EXPECT_NE(refusal(in_spacecraft(model("thruster",
                                        "name = \"jet\"\ntorque_body_n_m = [1, 0, 0]\non = []\n")))
                .find("a schedule beside a name"),
            std::string::npos);
}

/// Greenwich sidereal time at the epoch by the classic series of 1982 (Vallado, 4th ed., eq. 3-47) agrees with the Earth
/// rotation angle turned by precession to some arc seconds.
TEST(SceneSpace, the_earth_stands_where_its_sidereal_time_says) {
  const TaiDate date = *tai_date("2026-01-01T00:00:00", Clock::utc);
  const EarthRotation<double> earth = earth_rotation(date, 0);
  const double T = (2461041.5 - 2451545.0) / 36525;
  double gmst_s = 67310.54841 + (876600.0 * 3600 + 8640184.812866) * T + 0.093104 * T * T;
  gmst_s = std::fmod(gmst_s, 86400);
  const double gmst = gmst_s / 240 * M_PI / 180;
  // The equinox of date lies 1.2812 s a year west along the equator of where J2000's x axis is.
  const EarthFrame<double> frame = earth.at(0);
  const Vec3<double> greenwich = frame.x;
  const double right_ascension = std::atan2(greenwich.y, greenwich.x);
  const double general_precession = 4612.156534 * T / 3600 * M_PI / 180;  // in right ascension
  EXPECT_NEAR(std::remainder(right_ascension - (gmst - general_precession), 2 * M_PI), 0, 1e-4);
  EXPECT_NEAR(norm(earth.Q_x), 1, 1e-15);
  EXPECT_NEAR(dot(earth.Q_x, earth.Q_z), 0, 1e-15);
  EXPECT_NEAR(earth.Q_z.x, 2004.191903 * T / 3600 * M_PI / 180, 5e-5);  // the pole's precession
}

TEST(SceneSpace, dates_of_four_scales_are_one_instant) {
  const TaiDate utc = *tai_date("2017-01-01T00:00:00Z", Clock::utc);
  const auto ns = [&](const char* text, Clock clock) {
    return *nanoseconds_from(utc, *tai_date(text, clock));
  };
  EXPECT_EQ(ns("2017-01-01T00:00:37", Clock::tai), 0);
  EXPECT_EQ(ns("2017-01-01T00:01:09.184", Clock::tt), 0);
  EXPECT_EQ(ns("2017-01-01T00:00:18", Clock::gps), 0);
  EXPECT_EQ(ns("2016-366T23:59:60.5", Clock::utc), -500'000'000) << "within the leap second";
  EXPECT_EQ(ns("2016-12-31T23:59:59.25", Clock::utc), -1'750'000'000);
  EXPECT_EQ(ns("2018-01-01T00:00:00", Clock::utc), 365 * 86'400'000'000'000);
  for (const char* const wrong :
       {"2017-13-01T00:00:00", "2017-366T00:00:00", "2017-01-01 00:00:00", "2017-01-01T00:00",
        "2017-01-01T00:00:00.", "2016-12-31T23:59:61", "2017-06-30T23:59:60", ""}) {
    EXPECT_FALSE(tai_date(wrong, Clock::utc)) << wrong;
  }
}

TEST(SceneSpace, a_model_says_what_it_lacks) {
  const std::string dipole = model("residual_dipole", "dipole_body_a_m2 = [0, 0, 0.1]\n");
  EXPECT_NE(refusal(scene_of(dipole)).find("an orbit of the spacecraft beside it"),
            std::string::npos);
  EXPECT_NE(refusal(scene_of(kOrbit + dipole, "")).find("a date in [simulation]: the Earth turns"),
            std::string::npos);
  EXPECT_NE(refusal(scene_of(kOrbit + model("aerodynamic"))).find("an outside of the spacecraft"),
            std::string::npos);
  EXPECT_NE(refusal(scene_of(kOrbit + dipole, "epoch_utc = 1989-01-01T00:00:00Z\n"))
                .find("an epoch from 1990 to 2030"),
            std::string::npos);
  EXPECT_NE(refusal(scene_of("", "", "[earth]\nmagnetic_degree = 8\n"))
                .find("the date that [earth] is turned to"),
            std::string::npos);
  EXPECT_NE(refusal(scene_of(kOrbit + "[spacecraft.box]\nsize_m = [1, 0, 1]\n"))
                .find("3 lengths above 0 m"),
            std::string::npos);
  EXPECT_NE(refusal(scene_of("[spacecraft.pointing]\nframe = \"orbital\"\n"))
                .find("an orbit of the spacecraft beside it"),
            std::string::npos);
}

TEST(SceneSpace, an_epoch_within_a_leap_second_that_never_was_is_refused_once) {
  const std::string complaint =
      refusal(scene_of(kOrbit + model("residual_dipole", "dipole_body_a_m2 = [0, 0, 0.1]\n"),
                       "epoch_utc = \"2025-06-30T23:59:60Z\"\n"));
  EXPECT_NE(complaint.find("simulation.epoch_utc: got \"2025-06-30T23:59:60Z\""), std::string::npos)
      << complaint;
  EXPECT_EQ(complaint.find('\n'), std::string::npos) << "and nobody else asks for a date";
  EXPECT_EQ(refusal(scene_of("", "epoch_utc = \"2016-12-31T23:59:60Z\"\n")), "");
}

TEST(SceneSpace, the_earth_is_turned_by_ut1) {
  const std::string dipole = model("residual_dipole", "dipole_body_a_m2 = [0, 0, 0.1]\n");
  const auto angle = [&](const std::string& earth) {
    return std::get<ResidualDipole<double>>(
               read(scene_of(kOrbit + dipole, kEpoch, earth)).torques[0])
        .field->field.rotation.angle_rad;
  };
  const double late = angle("[earth]\nut1_minus_utc_s = 0.5\n") - angle("[earth]\n");
  EXPECT_NEAR(late, 0.5 * kEarthRotation_rad_s, 1e-12);
  EXPECT_NE(
      refusal(scene_of("", kEpoch, "[earth]\nut1_minus_utc_s = 37\n")).find("seconds from -1 to 1"),
      std::string::npos);
}

TEST(SceneSpace, the_field_is_of_harmonics_unless_a_dipole_is_asked_for) {
  const std::string dipole = model("residual_dipole", "dipole_body_a_m2 = [0, 0, 0.1]\n");
  const auto field = [&](const std::string& earth) {
    return std::get<ResidualDipole<double>>(
               read(scene_of(kOrbit + dipole, kEpoch, earth)).torques[0])
        .field->field;
  };
  EXPECT_TRUE(field("").harmonics);
  EXPECT_FALSE(field("[earth]\nmagnetic_field = \"dipole\"\n").harmonics);
  EXPECT_NE(
      refusal(scene_of("", kEpoch, "[earth]\nmagnetic_field = \"dipole\"\nmagnetic_degree = 3\n"))
          .find("no magnetic_degree beside magnetic_field"),
      std::string::npos);
}

TEST(SceneSpace, sunlight_is_cut_off_as_its_shadow_says) {
  const auto light = [](const std::string& box, const std::string& lines) {
    return std::get<SolarPressure<double>>(
        read(scene_of(kOrbit + kBox + box + model("solar_pressure", lines))).torques[0]);
  };
  EXPECT_EQ(light("", "").shadow, Shadow::cone);
  EXPECT_EQ(light("", "shadow = \"cylinder\"\n").shadow, Shadow::cylinder);
  EXPECT_EQ(light("", "shadow = \"none\"\n").shadow, Shadow::none);
  const auto mirror = light("specular_reflectivity = 0.75\ndiffuse_reflectivity = 0.25\n", "");
  EXPECT_EQ(mirror.facets->at(0).specular, 0.75);
  EXPECT_NE(refusal(scene_of(kOrbit + kBox +
                             "specular_reflectivity = 0.75\ndiffuse_reflectivity = 0.5\n"))
                .find("no more than what specular_reflectivity leaves of 1"),
            std::string::npos);
}

TEST(SceneSpace, an_orbit_that_j2_turns_is_the_same_from_a_position_and_a_velocity) {
  const auto orbit_of = [](const std::string& lines) {
    return std::get<SecularOrbit<double>>(
        *read(in_spacecraft("[spacecraft.orbit]\nmodel = \"j2\"\n" + lines)).orbit);
  };
  const SecularOrbit<double> orbit = orbit_of(
      "semi_major_axis_m = 7e6\neccentricity = 0.1\ninclination_rad = 1.7\n"
      "right_ascension_rad = -2\nargument_of_periapsis_rad = 2\nmean_anomaly_rad = 0.5\n");
  const OrbitMotion<double> at =
      motion_at(make_orbit<double>({7e6, 0.1, 1.7, -2, 2, 0.5, kEarthGravity_m3_s2}), 0.0);
  char text[400];
  std::snprintf(text, sizeof text,
                "position_inertial_m = [%.17g, %.17g, %.17g]\n"
                "velocity_inertial_m_s = [%.17g, %.17g, %.17g]\n",
                at.r_I.x, at.r_I.y, at.r_I.z, at.v_I.x, at.v_I.y, at.v_I.z);
  const SecularOrbit<double> same = orbit_of(text);
  EXPECT_NEAR(same.at_start.inclination_rad, 1.7, 1e-14);
  EXPECT_NEAR(same.at_start.right_ascension_rad, -2, 1e-14);
  EXPECT_NEAR(same.at_start.argument_of_periapsis_rad, 2, 1e-13);
  EXPECT_NEAR(same.node_rate_rad_s, orbit.node_rate_rad_s, 1e-20);
}

}  // namespace
}  // namespace adstar::scene
