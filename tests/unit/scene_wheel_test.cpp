// [[spacecraft.wheel]]: what is read, and what is refused, word for word.

#include <gtest/gtest.h>

#include "adstar/bodies/gyrostat.hpp"
#include "scene_text.hpp"

namespace adstar::scene {
namespace {

const std::string kWheel = "name = \"wheel1\"\naxis_body = [0, 0, 2]\nspin_inertia_kg_m2 = 0.02\n";
const std::string kMotor = "max_torque_n_m = 0.2\nmax_speed_rad_s = 600\n";

/// `lines` begin at line 10.
std::string in_wheel(const std::string& lines) {
  return in_spacecraft("[[spacecraft.wheel]]\n" + kWheel + lines);
}
Spacecraft parsed(const std::string& lines, const std::string& motion = "") {
  return parse(in_spacecraft(motion + "[[spacecraft.wheel]]\n" + kWheel + lines), "scene.toml")
      .spacecraft.front();
}

TEST(SceneWheel, has_its_axis_at_length_one_and_no_motor_unless_named) {
  const NamedWheel wheel = parsed("").wheels.at(0);
  EXPECT_EQ(wheel.name, "wheel1");
  EXPECT_EQ(wheel.at_start.wheel.axis_B, (Vec3<double>{0, 0, 1}));
  EXPECT_EQ(wheel.at_start.wheel.max_torque_n_m, 0);
  EXPECT_EQ(wheel.at_start.wheel.viscous_n_m_s_rad, 0);
  EXPECT_EQ(wheel.at_start.h.value, 0);
  EXPECT_TRUE(parsed("").actuators.empty());
}

TEST(SceneWheel, starts_at_its_speed_relative_to_the_body) {
  const Spacecraft craft =
      parsed("speed_rad_s = 100\n", "angular_velocity_body_rad_s = [0.1, 0.2, 0.3]\n");
  EXPECT_NEAR(craft.wheels[0].at_start.h.value, 0.02 * 100.3, 1e-15);
  // H_I = J_B omega_B + a J Omega at the unit attitude.
  EXPECT_NEAR(craft.initial.H_I.value().z, 1.66 * 0.3 + 2, 1e-15);
  EXPECT_NEAR(craft.initial.H_I.value().x, 0.09144, 1e-15);
}

TEST(SceneWheel, counts_a_given_momentum_as_the_total) {
  const Spacecraft craft =
      parsed("speed_rad_s = 100\n", "angular_momentum_inertial_n_m_s = [0, 0, 2]\n");
  EXPECT_EQ(craft.initial.H_I.value(), (Vec3<double>{0, 0, 2}));
  EXPECT_NEAR(craft.wheels[0].at_start.speed({0, 0, 0}), 100, 1e-12) << "the body stands still";
}

TEST(SceneWheel, that_is_commanded_is_an_actuator_of_its_name) {
  const Spacecraft craft = parsed(kMotor + "commanded = true\n");
  ASSERT_EQ(craft.actuators.size(), 1U);
  EXPECT_EQ(craft.actuators[0].name, "wheel1");
  EXPECT_EQ(craft.actuators[0].kind, ActuatorKind::wheel);
  EXPECT_EQ(craft.actuators[0].index, 0U);
  EXPECT_EQ(craft.actuators[0].limit.x, 0.2);
  EXPECT_EQ(craft.actuators[0].max_speed_rad_s, 600);
}

TEST(SceneWheel, motor_follows_the_scene_and_has_a_gain_of_full_torque_at_a_twentieth) {
  const SpinningWheel<double> held = parsed(kMotor + "hold_speed_rad_s = -50\n").wheels[0].at_start;
  EXPECT_TRUE(held.motor.standing.of_speed);
  EXPECT_EQ(held.motor.standing.value, -50);
  EXPECT_NEAR(held.wheel.speed_gain_n_m_s_rad, 0.2 / 30, 1e-17);
  const SpinningWheel<double> pushed =
      parsed(kMotor + "motor_torque_n_m = 0.1\n").wheels[0].at_start;
  EXPECT_FALSE(pushed.motor.standing.of_speed);
  EXPECT_EQ(pushed.motor.standing.value, 0.1);
  EXPECT_EQ(parsed("max_torque_n_m = 0.2\nmax_momentum_n_m_s = 12\n")
                .wheels[0]
                .at_start.wheel.max_speed_rad_s,
            600);
}

TEST(SceneWheel, at_constant_speed_has_neither_motor_nor_bearing) {
  const SpinningWheel<double> rotor = parsed("constant_speed = true\nspeed_rad_s = 10\n",
                                             "angular_velocity_body_rad_s = [0.1, 0.2, 0.3]\n")
                                          .wheels[0]
                                          .at_start;
  EXPECT_TRUE(rotor.wheel.constant_speed);
  EXPECT_NEAR(rotor.h.value, 0.2, 1e-16) << "J Omega alone";
  EXPECT_EQ(refusal(in_wheel("constant_speed = true\nmax_torque_n_m = 1\n")),
            "scene.toml:11:1: spacecraft[0].wheel[0].max_torque_n_m: got an unknown key, "
            "expected one of name, axis_body, spin_inertia_kg_m2, speed_rad_s, constant_speed; try "
            "removing it");
}

TEST(SceneWheel, publishes_its_state_at_ten_hertz_unless_told_otherwise) {
  EXPECT_EQ(parse(in_wheel(""), "scene.toml").telemetry.wheel_every, 10U);
  EXPECT_EQ(parse(in_spacecraft(""), "scene.toml").telemetry.wheel_every, 0U);
  EXPECT_EQ(parse(in_wheel("[telemetry]\nwheel_hz = 50\n"), "scene.toml").telemetry.wheel_every,
            2U);
}

TEST(SceneWheel, refuses_what_no_wheel_has) {
  const std::string at = "scene.toml:10:";
  EXPECT_EQ(refusal(in_wheel("max_torque_n_m = 0.2\n")),
            "scene.toml:6:1: spacecraft[0].wheel[0].max_speed_rad_s: got nothing, expected the "
            "speed at which the motor gives no more torque; try max_speed_rad_s = 600.0");
  EXPECT_EQ(refusal(in_wheel("commanded = true\n")),
            "scene.toml:10:13: spacecraft[0].wheel[0].commanded: got a motor's key without a "
            "motor, expected max_torque_n_m beside it; try max_torque_n_m = 0.1");
  EXPECT_EQ(refusal(in_wheel("max_speed_rad_s = 600\n")),
            "scene.toml:10:19: spacecraft[0].wheel[0].max_speed_rad_s: got a motor's key without a "
            "motor, expected max_torque_n_m beside it; try max_torque_n_m = 0.1");
  EXPECT_EQ(refusal(in_wheel(kMotor + "speed_rad_s = 601\n")),
            "scene.toml:12:15: spacecraft[0].wheel[0].speed_rad_s: got 601, expected no more than "
            "max_speed_rad_s = 600; try 600");
  EXPECT_EQ(refusal(in_wheel(kMotor + "motor_torque_n_m = 0.3\n")),
            "scene.toml:12:20: spacecraft[0].wheel[0].motor_torque_n_m: got 0.3, expected no more "
            "than max_torque_n_m = 0.2; try 0.2");
  EXPECT_EQ(refusal(in_wheel(kMotor + "hold_speed_rad_s = -601\n")),
            "scene.toml:12:20: spacecraft[0].wheel[0].hold_speed_rad_s: got -601, expected no more "
            "than max_speed_rad_s = 600; try -600");
  EXPECT_NE(refusal(in_wheel(kMotor + "max_momentum_n_m_s = 3\n")).find("removing one of the two"),
            std::string::npos);
  EXPECT_NE(refusal(in_wheel("viscous_friction_n_m_s_rad = -1e-3\n")).find("takes energy"),
            std::string::npos);
  EXPECT_EQ(refusal(in_spacecraft("[[spacecraft.wheel]]\nname = \"w\"\naxis_body = [0, 0, 0]\n"
                                  "spin_inertia_kg_m2 = 0.02\n")),
            "scene.toml:8:13: spacecraft[0].wheel[0].axis_body: got [0, 0, 0], expected a "
            "direction, not all zeros; try [1.0, 0.0, 0.0]");
}

TEST(SceneWheel, refuses_a_second_one_of_the_name_and_an_actuators) {
  EXPECT_NE(refusal(in_wheel("[[spacecraft.wheel]]\n" + kWheel)).find("\"wheel1\" again"),
            std::string::npos);
  const std::string actuator =
      "[[spacecraft.torque]]\nmodel = \"commanded\"\nname = \"wheel1\"\n"
      "max_torque_n_m = [1, 1, 1]\n";
  EXPECT_NE(refusal(in_wheel(actuator)).find("try \"wheel2\""), std::string::npos);
}

TEST(SceneWheel, refuses_wheels_that_leave_no_body) {
  EXPECT_EQ(refusal(in_spacecraft("[[spacecraft.wheel]]\nname = \"w\"\naxis_body = [1, 0, 0]\n"
                                  "spin_inertia_kg_m2 = 0.9144\n")),
            "scene.toml:6:1: spacecraft[0].wheel: got wheels as heavy as the body about an axis, "
            "expected inertia_body_kg_m2 with the wheels in it, and something left beside them; "
            "try a smaller spin_inertia_kg_m2");
}

TEST(SceneWheel, refuses_a_scheme_that_carries_none) {
  const std::string scene = std::string(kSimulation) + "scheme = \"splitting_strang\"\n" +
                            kSpacecraft + "[[spacecraft.wheel]]\n" + kWheel;
  EXPECT_EQ(refusal(scene),
            "scene.toml:3:10: simulation.scheme: got \"splitting_strang\", which carries no "
            "wheels, expected a scheme that does, since \"sat1\" has some: coadjoint_* in double, "
            "projected_*, quaternion_rk4; try \"coadjoint_rk4\"");
}

}  // namespace
}  // namespace adstar::scene
