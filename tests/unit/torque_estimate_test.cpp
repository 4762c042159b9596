// What a torque of the surroundings is worth for a spacecraft, and what adstar check says of it.

#include "service/report/torque_estimate.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "adstar/earth/dipole.hpp"
#include "scene_text.hpp"
#include "service/report/cost_report.hpp"

namespace adstar::report {
namespace {

using scene::in_spacecraft;

const std::string kOrbit = "[spacecraft.orbit]\nsemi_major_axis_m = 7e6\n";
const std::string kGravity = "[[spacecraft.torque]]\nmodel = \"gravity_gradient\"\n";

const TorqueEstimate& of(const std::vector<TorqueEstimate>& all, std::string_view model) {
  return *std::find_if(all.begin(), all.end(),
                       [&](const TorqueEstimate& each) { return each.model == model; });
}

scene::Scene read(const std::string& spacecraft, const std::string& simulation = "") {
  return scene::parse(scene::kSimulation + simulation + scene::kSpacecraft + spacecraft,
                      "scene.toml");
}

TEST(TorqueEstimate, is_none_without_an_orbit) {
  const scene::Scene scene = read("");
  for (const TorqueEstimate& each : estimates_of(scene.spacecraft[0], 100)) {
    EXPECT_FALSE(each.torque_n_m) << each.model;
    EXPECT_FALSE(each.modelled);
  }
}

TEST(TorqueEstimate, of_gravity_is_its_largest_torque_and_turns_by_half_its_acceleration) {
  const scene::Scene scene = read(kOrbit);
  const auto all = estimates_of(scene.spacecraft[0], 10);
  const TorqueEstimate& gravity = of(all, "gravity_gradient");
  const double expected = 1.5 * 3.986004418e14 / 343e18 * (1.66 - 0.9144);
  EXPECT_NEAR(*gravity.torque_n_m / expected, 1, 1e-12);
  EXPECT_NEAR(gravity.turn_rad / (0.5 * expected / 0.9144 * 100), 1, 1e-12);
  EXPECT_FALSE(gravity.modelled);
  // And the one that is modelled says the same.
  const scene::Scene modelled = read(kOrbit + kGravity);
  const auto again = estimates_of(modelled.spacecraft[0], 10);
  EXPECT_TRUE(of(again, "gravity_gradient").modelled);
  EXPECT_NEAR(*of(again, "gravity_gradient").torque_n_m / expected, 1, 1e-12);
}

/// A body of 1 kg m² is a cube of 0.46 m and 29 kg: some 1e-6 N m of magnetism and of sunlight's order below.
TEST(TorqueEstimate, of_what_is_left_out_has_the_right_order) {
  const scene::Scene scene = read(kOrbit);
  const auto all = estimates_of(scene.spacecraft[0], 100);
  const double magnetic = *of(all, "residual_dipole").torque_n_m;
  EXPECT_GT(magnetic, 1e-6);
  EXPECT_LT(magnetic, 1e-5);
  const double light = *of(all, "solar_pressure").torque_n_m;
  EXPECT_GT(light, 1e-8);
  EXPECT_LT(light, 1e-6);
  const double air = *of(all, "aerodynamic").torque_n_m;  // 622 km
  EXPECT_GT(air, 1e-9);
  EXPECT_LT(air, 1e-6);
}

TEST(TorqueEstimate, counts_every_torque_of_a_kind) {
  const std::string dipole =
      "[[spacecraft.torque]]\nmodel = \"residual_dipole\"\ndipole_body_a_m2 = [0, 0, 0.1]\n";
  const auto torque = [&](const std::string& torques) {
    const scene::Scene scene = read(kOrbit + torques, "epoch_utc = 2026-01-01T00:00:00Z\n");
    return *of(estimates_of(scene.spacecraft[0], 10), "residual_dipole").torque_n_m;
  };
  EXPECT_NEAR(torque(dipole + dipole) / torque(dipole), 2, 1e-12);
}

/// A point of 5 kg on a boom of 5 m along z: 5 · 10/15 · 5² = 83 kg m² across it, and the hub's own 1.66 about it.
TEST(TorqueEstimate, of_linked_bodies_is_that_of_the_whole) {
  const auto boom = [](const std::string& more) {
    return read("mass_kg = 10\n" + kOrbit + "[[spacecraft.body]]\nname = \"tip\"\nmass_kg = 5\n" +
                    "inertia_body_kg_m2 = [0.01, 0.01, 0.01]\n" + more +
                    "[[spacecraft.joint]]\nname = \"boom\"\nkind = \"fixed\"\nfrom = \"hub\"\n" +
                    "to = \"tip\"\npoint_from_body_m = [0, 0, 5]\npoint_to_body_m = [0, 0, 0]\n",
                "epoch_utc = 2026-01-01T00:00:00Z\n")
        .spacecraft[0];
  };
  const std::string gravity = "[[spacecraft.torque]]\nmodel = \"gravity_gradient\"\n";
  const std::string light = "[[spacecraft.torque]]\nmodel = \"solar_pressure\"\n";
  scene::Spacecraft craft = boom(
      "facet = [ { area_m2 = 1.0, normal_body = [0, 0, 1], "
      "centre_body_m = [0, 0, 0] } ]\n" +
      gravity + light);
  const auto modelled = estimates_of(craft, 10);
  const TorqueEstimate gradient = of(modelled, "gravity_gradient");
  // 1.5 · 3.986e14 / 7e6³ · 83: to the inertia of hub and tip.
  EXPECT_NEAR(*gradient.torque_n_m / (1.5 * 3.986004418e14 / 343e18 * 83.33), 1, 0.05);
  const auto left_out = estimates_of(boom(""), 10);
  EXPECT_EQ(of(left_out, "gravity_gradient").torque_n_m, gradient.torque_n_m);
  // The push on the tip, whose plate has no arm about the tip itself, by 3.3 m.
  const double push = 1.034 * kSolarPressure_N_m2;
  const TorqueEstimate pushed = of(modelled, "solar_pressure");
  EXPECT_NEAR(*pushed.torque_n_m / (push * 5.0 * 10 / 15), 1, 0.01);
  EXPECT_NEAR(pushed.turn_rad / (0.5 * *pushed.torque_n_m / 1.67 * 100), 1, 1e-3);
  // Guessed of the masses: 3e-3 A m² a kg of 15, in the field at 7e6 m.
  EXPECT_NEAR(
      *of(left_out, "residual_dipole").torque_n_m / (3e-3 * 15 * DipoleField<double>{}.bound(7e6)),
      1, 1e-9);
}

/// Two bodies of 1e-3 kg m² 50 km apart: of the least moment of the whole nothing is left in the difference of large numbers.
TEST(TorqueEstimate, of_a_slender_whole_turns_it_by_no_less_than_nothing) {
  const scene::Scene scene =
      read("mass_kg = 10\n" + kOrbit + "[[spacecraft.body]]\nname = \"tip\"\nmass_kg = 5\n" +
           "inertia_body_kg_m2 = [1e-7, 1e-7, 1e-7]\n[[spacecraft.joint]]\nname = \"boom\"\n" +
           "kind = \"fixed\"\nfrom = \"hub\"\nto = \"tip\"\npoint_from_body_m = [30e3, 40e3, 5]\n" +
           "point_to_body_m = [0, 0, 0]\n" + kGravity);
  EXPECT_EQ(of(estimates_of(scene.spacecraft[0], 1e4), "gravity_gradient").turn_rad, M_PI);
}

TEST(CostReport, advises_nobody_to_leave_out_what_may_turn_a_joint) {
  const auto report_of = [](const std::string& kind) {
    return cost_report(
        read("mass_kg = 1000\n" + kOrbit + "[[spacecraft.body]]\nname = \"flap\"\nmass_kg = 1\n" +
                 "inertia_body_kg_m2 = [0.05, 0.05, 0.05]\nfacet = [ { area_m2 = 1.0, " +
                 "normal_body = [0, 0, 1], centre_body_m = [0, 0, 0] } ]\n[[spacecraft.joint]]\n" +
                 "name = \"hinge\"\nkind = \"" + kind + "\"\nfrom = \"hub\"\nto = \"flap\"\n" +
                 "point_from_body_m = [1, 0, 0]\npoint_to_body_m = [-1, 0, 0]\n" +
                 (kind == "fixed" ? "" : "axis_body = [0, 1, 0]\n") +
                 "[[spacecraft.torque]]\nmodel = \"solar_pressure\"\n",
             "epoch_utc = 2026-01-01T00:00:00Z\nduration = \"10s\"\naccuracy_rad = 0.1\n"));
  };
  const std::string held = report_of("fixed"), hinged = report_of("revolute");
  EXPECT_NE(held.find("; leave it out"), std::string::npos) << held;
  EXPECT_EQ(hinged.find("leave it out"), std::string::npos) << hinged;
  EXPECT_NE(hinged.find("turns the whole by at most"), std::string::npos) << hinged;
  EXPECT_NE(hinged.find("a joint perhaps by more"), std::string::npos) << hinged;
}

TEST(TorqueEstimate, knows_no_air_no_field_and_no_sun_about_another_body) {
  const scene::Scene moon =
      read("[spacecraft.orbit]\nsemi_major_axis_m = 2e6\ngravity_m3_s2 = 4.9e12\n");
  for (const TorqueEstimate& each : estimates_of(moon.spacecraft[0], 100)) {
    EXPECT_EQ(each.torque_n_m.has_value(), std::string(each.model) == "gravity_gradient");
  }
  EXPECT_NE(cost_report(moon).find("not estimable about another body than the Earth"),
            std::string::npos);
}

TEST(TorqueEstimate, without_a_duration_is_over_one_revolution) {
  const scene::Scene scene = read(kOrbit + "eccentricity = 0.01\n");
  EXPECT_NEAR(horizon_of(scene.simulation, scene.spacecraft[0]),
              2 * M_PI * std::sqrt(343e18 / 3.986004418e14), 1e-9);
}

TEST(CostReport, tells_spacecraft_apart_by_what_it_says_and_counts_the_rest) {
  std::string crafts;
  for (int i = 1; i <= 7; ++i) {
    crafts += scene::kSpacecraft;
    crafts.replace(crafts.rfind("\"sat1\""), 6, "\"cube" + std::to_string(i) + "\"");
    crafts += "[spacecraft.orbit]\nsemi_major_axis_m = " + std::to_string(i + 6) + "e6\n";
  }
  const std::string text = cost_report(scene::parse(scene::kSimulation + crafts, "scene.toml"));
  EXPECT_NE(text.find("'cube5', over"), std::string::npos) << text;
  EXPECT_EQ(text.find("'cube6', over"), std::string::npos) << text;
  EXPECT_NE(text.find("  2 more kinds of spacecraft are not shown\n"), std::string::npos) << text;
}

TEST(CostReport, warns_of_what_is_not_worth_it_and_of_what_is_missing) {
  const std::string coarse =
      cost_report(read(kOrbit + kGravity, "duration = \"10s\"\naccuracy_rad = 0.01\n"));
  EXPECT_NE(coarse.find("WARNING, below the 1e-02 rad asked for; leave it out"), std::string::npos)
      << coarse;
  EXPECT_EQ(coarse.find("name it"), std::string::npos) << coarse;
  const std::string fine = cost_report(read(kOrbit, "duration = \"1h\"\naccuracy_rad = 1e-6\n"));
  EXPECT_NE(fine.find("WARNING, above the 1e-06 rad asked for; name it"), std::string::npos);
  EXPECT_EQ(fine.find("leave it out"), std::string::npos) << fine;
  EXPECT_NE(cost_report(read("", "accuracy_rad = 1e-6\n")).find("not estimable without an orbit"),
            std::string::npos);
}

TEST(CostReport, measures_each_model_beside_the_rigid_body) {
  const std::string text = cost_report(read(kOrbit + kGravity));
  EXPECT_NE(text.find("rigid body"), std::string::npos);
  EXPECT_NE(text.find("gravity_gradient"), std::string::npos);
  EXPECT_NE(text.find(" ns\n"), std::string::npos);
}

}  // namespace
}  // namespace adstar::report
