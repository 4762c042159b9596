// [spacecraft.orbit] and what needs one: what is read, and what is refused, word for word.

#include <cmath>

#include <gtest/gtest.h>

#include "scene_text.hpp"
#include "service/report/scene_report.hpp"

namespace adstar::scene {
namespace {

const std::string kGravity = "[[spacecraft.torque]]\nmodel = \"gravity_gradient\"\n";

KeplerOrbit<double> orbit_of(const std::string& lines) {
  const Scene scene = parse(in_spacecraft("[spacecraft.orbit]\n" + lines), "scene.toml");
  return std::get<KeplerOrbit<double>>(*scene.spacecraft[0].orbit);
}

TEST(SceneOrbit, is_not_modelled_unless_named) {
  EXPECT_FALSE(parse(in_spacecraft(""), "scene.toml").spacecraft[0].orbit.has_value());
}

TEST(SceneOrbit, is_read_from_elements) {
  const KeplerOrbit<double> orbit = orbit_of(
      "semi_major_axis_m = 7e6\neccentricity = 0.1\ninclination_rad = 0.5\n"
      "right_ascension_rad = 1\nargument_of_periapsis_rad = 2\nmean_anomaly_rad = 3\n");
  EXPECT_EQ(orbit.semi_major_axis_m, 7e6);
  EXPECT_EQ(orbit.eccentricity, 0.1);
  EXPECT_EQ(orbit.mean_anomaly_rad, 3);
  EXPECT_NEAR(orbit.mean_motion_rad_s, std::sqrt(3.986004418e14 / 343e18), 1e-18);
  EXPECT_NEAR(cross(orbit.P, orbit.Q).z, std::cos(0.5), 1e-15);
}

TEST(SceneOrbit, is_the_same_from_the_position_and_velocity_of_those_elements) {
  const KeplerOrbit<double> orbit = orbit_of(
      "semi_major_axis_m = 7e6\neccentricity = 0.1\ninclination_rad = 0.5\n"
      "right_ascension_rad = 1\nargument_of_periapsis_rad = 2\nmean_anomaly_rad = 3\n");
  const auto at = [&](double t) {
    const OrbitPosition<double> p = position_at(orbit, t);
    return p.distance_m * p.direction_I;
  };
  const Vec3<double> r = at(0);
  // Analytic velocity on the ellipse.
  const double E = eccentric_anomaly(3.0, 0.1), n = orbit.mean_motion_rad_s;
  const double rate = n * 7e6 / (1 - 0.1 * std::cos(E));
  const Vec3<double> v =
      (-rate * std::sin(E)) * orbit.P + (rate * std::sqrt(1 - 0.01) * std::cos(E)) * orbit.Q;
  char text[400];
  std::snprintf(text, sizeof text,
                "position_inertial_m = [%.17g, %.17g, %.17g]\n"
                "velocity_inertial_m_s = [%.17g, %.17g, %.17g]\n",
                r.x, r.y, r.z, v.x, v.y, v.z);
  const KeplerOrbit<double> same = orbit_of(text);
  EXPECT_NEAR(same.semi_major_axis_m, 7e6, 1e-6);
  EXPECT_NEAR(same.eccentricity, 0.1, 1e-14);
  EXPECT_NEAR(std::remainder(same.mean_anomaly_rad - 3, 2 * M_PI), 0, 1e-12);
  EXPECT_LT(norm(same.P - orbit.P), 1e-13);
  EXPECT_LT(norm(same.Q - orbit.Q), 1e-13);
}

TEST(SceneOrbit, from_a_circular_motion_begins_where_the_spacecraft_is) {
  const double speed = std::sqrt(kEarthGravity_m3_s2 / 7e6);
  char text[200];
  std::snprintf(text, sizeof text,
                "position_inertial_m = [0, 7e6, 0]\nvelocity_inertial_m_s = [0, 0, %.17g]\n",
                speed);
  const KeplerOrbit<double> orbit = orbit_of(text);
  EXPECT_LT(orbit.eccentricity, 1e-12);
  EXPECT_LT(norm(position_at(orbit, 0.0).direction_I - Vec3<double>{0, 1, 0}), 1e-12);
}

TEST(SceneOrbit, gives_gravity_its_body_and_its_ellipse) {
  const Spacecraft craft =
      parse(in_spacecraft("[spacecraft.orbit]\nsemi_major_axis_m = 7e6\n" + kGravity), "scene.toml")
          .spacecraft[0];
  const auto& gravity = std::get<GravityGradient<double>>(craft.torques.at(0));
  EXPECT_EQ(std::get<KeplerOrbit<double>>(gravity.orbit).semi_major_axis_m, 7e6);
  EXPECT_EQ(gravity.inertia_B.zz, 1.66);
  EXPECT_NEAR(gravity.spread_kg_m2, 1.66 - 0.9144, 1e-15);
}

TEST(SceneOrbit, refuses_what_is_no_ellipse) {
  EXPECT_EQ(refusal(in_spacecraft("[spacecraft.orbit]\neccentricity = 1.2\n"
                                  "semi_major_axis_m = 7e6\n")),
            "scene.toml:7:16: spacecraft[0].orbit.eccentricity: got 1.2, expected an eccentricity "
            "from 0 to 0.99; try 0.99");
  EXPECT_EQ(refusal(in_spacecraft("[spacecraft.orbit]\ninclination_rad = 1\n")),
            "scene.toml:6:1: spacecraft[0].orbit.semi_major_axis_m: got nothing, expected a "
            "semi-major axis above 0 m, or position_inertial_m and velocity_inertial_m_s; try "
            "semi_major_axis_m = 6.9e6");
  EXPECT_NE(refusal(in_spacecraft("[spacecraft.orbit]\nposition_inertial_m = [7e6, 0, 0]\n"
                                  "velocity_inertial_m_s = [0, 12000, 0]\n"))
                .find("a velocity below escape"),
            std::string::npos);
  EXPECT_NE(refusal(in_spacecraft("[spacecraft.orbit]\nposition_inertial_m = [7e6, 0, 0]\n"
                                  "velocity_inertial_m_s = [7000, 100, 0]\n"))
                .find("an ellipse of eccentricity 0.99"),
            std::string::npos);
  EXPECT_NE(refusal(in_spacecraft("[spacecraft.orbit]\nposition_inertial_m = [7e6, 0, 0]\n"))
                .find("velocity_inertial_m_s: got nothing"),
            std::string::npos);
}

TEST(SceneOrbit, that_begins_inside_the_earth_is_taken_for_kilometres) {
  EXPECT_EQ(refusal(in_spacecraft("[spacecraft.orbit]\nsemi_major_axis_m = 7000\n")),
            "scene.toml:6:1: spacecraft[0].orbit: got an orbit that begins 7000 m from the Earth's "
            "centre, expected one that begins above its surface, 6.357e6 m from the centre at the "
            "poles; try lengths in metres, or gravity_m3_s2 of another body");
  EXPECT_EQ(refusal(in_spacecraft(
                "[spacecraft.orbit]\nsemi_major_axis_m = 2e6\ngravity_m3_s2 = 4.9e12\n")),
            "")
      << "the Moon's";
}

TEST(SceneOrbit, that_leads_into_the_earth_later_is_warned_of) {
  const auto report = [](const std::string& lines) {
    return report::scene_report(parse(
        in_spacecraft("[spacecraft.orbit]\nsemi_major_axis_m = 7e6\n" + lines), "scene.toml"));
  };
  const std::string rocket = report("eccentricity = 0.1\nmean_anomaly_rad = 3\n");
  EXPECT_NE(rocket.find("WARNING   its orbit comes within 6.3e+06 m of the centre"),
            std::string::npos)
      << rocket;
  EXPECT_EQ(report("eccentricity = 0.01\n").find("WARNING"), std::string::npos);
}

TEST(SceneOrbit, is_asked_for_by_gravity) {
  EXPECT_EQ(refusal(in_spacecraft(kGravity)),
            "scene.toml:6:1: spacecraft[0].torque[0].model: got \"gravity_gradient\", expected an "
            "orbit of the spacecraft beside it; try [spacecraft.orbit] with semi_major_axis_m = "
            "6.9e6");
}

TEST(SceneOrbit, lets_no_free_scheme_feel_gravity) {
  EXPECT_NE(refusal(std::string(kSimulation) + "scheme = \"free_exact\"\n" + kSpacecraft +
                    "[spacecraft.orbit]\nsemi_major_axis_m = 7e6\n" + kGravity)
                .find("which knows no torque"),
            std::string::npos);
}

}  // namespace
}  // namespace adstar::scene
