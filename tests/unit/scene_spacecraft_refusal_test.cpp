// What is refused of [[spacecraft]] blocks and their torques, word for word.

#include <gtest/gtest.h>

#include "scene_text.hpp"

namespace adstar::scene {
namespace {

std::string with_inertia(const std::string& inertia) {
  return refusal(as_spacecraft("name = \"sat1\"\ninertia_body_kg_m2 = " + inertia));
}

TEST(SceneLoader, refuses_names_that_no_topic_can_carry) {
  const std::string rule = ", expected 1 to 63 characters out of A-Z a-z 0-9 _ . -; try ";
  const auto named = [](const std::string& name) {
    return refusal(as_spacecraft("inertia_body_kg_m2 = [1, 1, 1]\nname = " + name));
  };
  const std::string at = "scene.toml:5:8: spacecraft[0].name: got ";
  EXPECT_EQ(named("\"\""), at + "\"\"" + rule + "\"sat1\"");
  EXPECT_EQ(named("\"sat 1\""), at + "\"sat 1\"" + rule + "\"sat_1\"");
  EXPECT_EQ(named("3"), at + "3" + rule + "\"sat1\"");
  EXPECT_EQ(named('"' + std::string(63, 'a') + '"'), "");
  EXPECT_EQ(named('"' + std::string(64, 'a') + '"'),
            at + '"' + std::string(64, 'a') + '"' + rule + '"' + std::string(63, 'a') + '"');
  EXPECT_EQ(refusal(as_spacecraft("inertia_body_kg_m2 = [1, 1, 1]")),
            "scene.toml:3:1: spacecraft[0].name: got nothing" + rule + "name = \"sat1\"");
}

TEST(SceneLoader, refuses_duplicate_spacecraft_and_names_a_free_one) {
  const std::string second = "[[spacecraft]]\nname = \"sat1\"\ninertia_body_kg_m2 = [1, 1, 1]\n";
  const std::string third = "[[spacecraft]]\nname = \"sat2\"\ninertia_body_kg_m2 = [1, 1, 1]\n";
  EXPECT_EQ(
      refusal(in_spacecraft(second + third)),
      "scene.toml:7:8: spacecraft[1].name: got \"sat1\" again (line 4 has it), expected a name "
      "of its own for each spacecraft; try \"sat3\"");
}

TEST(SceneLoader, refuses_duplicate_actuators_of_one_spacecraft) {
  const std::string actuator =
      "[[spacecraft.torque]]\nmodel = \"commanded\"\nmax_torque_n_m = [1, 1, 1]\n";
  EXPECT_EQ(
      refusal(in_spacecraft(actuator + actuator)),
      "scene.toml:9:1: spacecraft[0].torque[1].name: got \"body\" again, expected a name of its "
      "own for each actuator of a spacecraft; try \"body2\"");
  EXPECT_EQ(refusal(in_spacecraft(actuator + actuator + "name = \"wheels\"")), "");
}

TEST(SceneLoader, refuses_inertias_that_no_body_has) {
  const std::string at = "scene.toml:5:22: spacecraft[0].inertia_body_kg_m2: got ";
  const std::string definite =
      ", expected a positive definite tensor (every principal moment above zero); try moments "
      "about "
      "the centre of mass such as [0.9144, 1.098, 1.66]";
  const std::string triangle =
      ", expected a largest moment up to the sum of the other two (triangle inequality); try a "
      "largest moment of at most ";
  EXPECT_EQ(with_inertia("[1, 1, -1]"), at + "principal moments -1, 1, 1" + definite);
  EXPECT_EQ(with_inertia("[0, 1, 1]"), at + "principal moments 0, 1, 1" + definite);
  EXPECT_EQ(with_inertia("[[1, 2, 0], [2, 1, 0], [0, 0, 3]]"),
            at + "principal moments -1, 3, 3" + definite);
  EXPECT_EQ(with_inertia("[1, 1, 2.00000000001]"),
            at + "principal moments 1, 1, 2.00000000001" + triangle + "2");
  EXPECT_EQ(with_inertia("[3, 1, 1]"), at + "principal moments 1, 1, 3" + triangle + "2");
  EXPECT_EQ(with_inertia("[1e-200, 1e-200, 1e-200]"),
            at + "principal moments 1e-200, 1e-200, 1e-200, expected moments from 1e-120 to 1e+120 "
                 "kg m^2; try SI units");
  EXPECT_EQ(
      with_inertia("[[1, 0.1, 0], [0.2, 1, 0], [0, 0, 1]]"),
      at + "[0][1] = 0.1 but [1][0] = 0.2, expected a symmetric tensor; try the same value for "
           "both");
}

// A rod has no moment about its axis; turned, round-off must not make it one.
TEST(SceneLoader, refuses_a_singular_tensor_whatever_its_axes) {
  EXPECT_NE(with_inertia("[[0.5, 0.5, 0], [0.5, 0.5, 0], [0, 0, 1]]").find("positive definite"),
            std::string::npos);
  EXPECT_NE(with_inertia("[[0.64, 0.48, 0], [0.48, 0.36, 0], [0, 0, 1]]").find("positive definite"),
            std::string::npos);
}

TEST(SceneLoader, allows_asymmetry_of_round_off_only) {
  EXPECT_EQ(with_inertia("[[2, 0.1, 0], [0.1000000000001, 2, 0], [0, 0, 2]]"), "");
  EXPECT_NE(with_inertia("[[2, 0.1, 0], [0.10000000001, 2, 0], [0, 0, 2]]"), "");
}

TEST(SceneLoader, refuses_inertias_of_another_shape) {
  EXPECT_EQ(
      with_inertia("1.0"),
      "scene.toml:5:22: spacecraft[0].inertia_body_kg_m2: got 1, expected 3 principal moments, "
      "a 3x3 tensor or { min, max } in kg m^2; try [0.9144, 1.098, 1.66]");
  EXPECT_EQ(
      with_inertia("[1, 1, nan]"),
      "scene.toml:5:29: spacecraft[0].inertia_body_kg_m2[2]: got nan, expected a finite number; "
      "try 0.0");
  EXPECT_EQ(
      with_inertia("[[1, 0, 0], [0, 1], [0, 0, 1]]"),
      "scene.toml:5:34: spacecraft[0].inertia_body_kg_m2[1]: got [0, 1], expected an array of 3 "
      "numbers; try [0.9144, 1.098, 1.66]");
  EXPECT_EQ(refusal(as_spacecraft("name = \"a\"")),
            "scene.toml:3:1: spacecraft[0].inertia_body_kg_m2: got nothing, expected 3 principal "
            "moments or a 3x3 tensor in kg m^2; try inertia_body_kg_m2 = [0.9144, 1.098, 1.66]");
}

TEST(SceneLoader, refuses_attitudes_that_cannot_be_normalised) {
  const auto attitude = [](const std::string& q) {
    return refusal(in_spacecraft("attitude_body_to_inertial = " + q));
  };
  const std::string at = "scene.toml:6:29: spacecraft[0].attitude_body_to_inertial: got ";
  EXPECT_EQ(attitude("{ w = 0, x = 0.0, y = -0.0, z = 0 }"),
            at + "a quaternion of norm 0, expected one that can be normalised; try { w = 1.0, x = "
                 "0.0, y = 0.0, z = 0.0 }");
  EXPECT_EQ(
      attitude("{ w = inf, x = 0, y = 0, z = 0 }"),
      "scene.toml:6:35: spacecraft[0].attitude_body_to_inertial.w: got inf, expected a finite "
      "number; try 0.0");
  EXPECT_EQ(attitude("{ w = 1, x = 0, y = 0 }"),
            "scene.toml:6:29: spacecraft[0].attitude_body_to_inertial.z: got nothing, expected a "
            "finite number; try z = 0.0");
  EXPECT_EQ(attitude("[1, 0, 0, 0]"),
            at +
                "[1, 0, 0, 0], expected { w, x, y, z }, or \"uniform\" to draw one; try { w = 1.0, "
                "x = 0.0, y = 0.0, z = 0.0 }");
  EXPECT_EQ(
      attitude("\"random\""),
      at + "\"random\", expected { w, x, y, z }, or \"uniform\" to draw one; try \"uniform\"");
}

TEST(SceneLoader, refuses_two_initial_motions_and_one_beyond_double) {
  EXPECT_EQ(
      refusal(in_spacecraft("angular_velocity_body_rad_s = [1, 0, 0]\n"
                            "angular_momentum_body_n_m_s = [1, 0, 0]")),
      "scene.toml:7:31: spacecraft[0].angular_momentum_body_n_m_s: got a second initial motion "
      "beside angular_velocity_body_rad_s, expected an angular velocity or one angular "
      "momentum; try removing one of the two");
  EXPECT_EQ(refusal(in_spacecraft("angular_velocity_body_rad_s = [1e200, 0, 0]")),
            "scene.toml:6:31: spacecraft[0].angular_velocity_body_rad_s: got a rotation beyond the "
            "range of double, expected one whose energy and momentum are finite; try a smaller "
            "vector");
}

TEST(SceneLoader, refuses_torques_that_are_none) {
  const std::string at = "spacecraft[0].torque[0].";
  EXPECT_EQ(refusal(in_torque("model = \"harmnic\"")),
            "scene.toml:7:9: " + at +
                "model: got \"harmnic\", expected one of constant, harmonic, "
                "table, commanded, damping, gravity_gradient, residual_dipole, magnetorquer, "
                "aerodynamic, solar_pressure, thruster; try \"harmonic\"");
  EXPECT_EQ(refusal(in_torque("frame = \"body\"")),
            "scene.toml:6:1: " + at +
                "model: got nothing, expected one of constant, harmonic, table, "
                "commanded, damping, gravity_gradient, residual_dipole, magnetorquer, aerodynamic, "
                "solar_pressure, thruster; try model = \"constant\"");
  EXPECT_EQ(refusal(in_torque("model = \"constant\"\ntorque_n_m = [1, 2]")),
            "scene.toml:6:1: " + at +
                "frame: got nothing, expected one of body, inertial; try frame "
                "= \"body\"\n"
                "scene.toml:8:14: " +
                at +
                "torque_n_m: got [1, 2], expected an array of 3 numbers; try "
                "[0.0, 0.0, 0.01]");
  EXPECT_EQ(refusal(in_torque("model = \"harmonic\"\nframe = \"bdoy\"\namplitude_n_m = [1, 2, 3]")),
            "scene.toml:6:1: " + at +
                "angular_frequency_rad_s: got nothing, expected 3 numbers, or { "
                "min, max } in a fleet; try angular_frequency_rad_s = [0.5, 0.3, 0.0]\n"
                "scene.toml:8:9: " +
                at +
                "frame: got \"bdoy\", expected one of body, inertial; try "
                "\"body\"");
  EXPECT_EQ(refusal(in_torque("model = \"commanded\"\nmax_torque_n_m = [1, -2, 3]")),
            "scene.toml:8:22: " + at +
                "max_torque_n_m[1]: got -2, expected a limit of at least 0 N "
                "m; try 2");
  EXPECT_EQ(refusal(in_torque("model = \"damping\"\ncoefficient_body_n_m_s_rad = [0.1, -2, 0]")),
            "scene.toml:8:36: " + at +
                "coefficient_body_n_m_s_rad[1]: got -2, expected a damping, which takes energy: at "
                "least 0 N m s/rad; try 2");
  EXPECT_EQ(refusal(in_torque("model = \"damping\"\nframe = \"inertial\"")),
            "scene.toml:6:1: " + at +
                "coefficient_body_n_m_s_rad: got nothing, expected 3 numbers, or { min, max } in a "
                "fleet; try coefficient_body_n_m_s_rad = [1e-3, 1e-3, 1e-3]\n"
                "scene.toml:8:1: " +
                at +
                "frame: got an unknown key, expected one of model, coefficient_body_n_m_s_rad; try "
                "removing it");
}

}  // namespace
}  // namespace adstar::scene
