// [[spacecraft.body]], joint and chain: what is read, how it is placed, and what is refused.

#include <cmath>

#include <gtest/gtest.h>

#include "scene_text.hpp"

namespace adstar::scene {
namespace {

const std::string kMass = "mass_kg = 100\n";
const std::string kPanel =
    "[[spacecraft.body]]\nname = \"panel\"\nmass_kg = 5\ninertia_body_kg_m2 = [0.5, 0.2, 0.6]\n";
const std::string kHinge =
    "[[spacecraft.joint]]\nname = \"hinge\"\nkind = \"revolute\"\nfrom = \"hub\"\nto = \"panel\"\n"
    "point_from_body_m = [0, 0.5, 0]\npoint_to_body_m = [0, -1, 0]\naxis_body = [1, 0, 0]\n";

Spacecraft read(const std::string& lines) {
  return parse(in_spacecraft(lines), "scene.toml").spacecraft[0];
}

TEST(SceneBodies, are_none_unless_named) {
  EXPECT_EQ(read("").linked, nullptr);
  EXPECT_EQ(read("body = []\njoint = []\n").linked, nullptr);
}

TEST(SceneBodies, are_placed_by_their_joints_about_the_common_centre_of_mass) {
  const Spacecraft craft = read("angular_velocity_body_rad_s = [0, 0, 0.1]\n" + kMass + kPanel +
                                kHinge + "coordinate = 1.5707963267948966\nrate = 0.2\n");
  ASSERT_NE(craft.linked, nullptr);
  const LinkedBodies& linked = *craft.linked;
  ASSERT_EQ(linked.bodies.size(), 2U);
  const auto& hub = linked.bodies[0];
  const auto& panel = linked.bodies[1];
  // A quarter turn about x: the panel's y axis is the hub's z.
  EXPECT_LT(norm(rotate(panel.q_IB, Vec3<double>{0, 1, 0}) - Vec3<double>{0, 0, 1}), 1e-15);
  EXPECT_LT(norm((panel.x_I - hub.x_I) - Vec3<double>{0, 0.5, 1}), 1e-15);
  EXPECT_LT(norm(hub.mass_kg * hub.x_I + panel.mass_kg * panel.x_I), 1e-13);
  EXPECT_LT(norm(hub.mass_kg * hub.v_I + panel.mass_kg * panel.v_I), 1e-13);
  EXPECT_NEAR(hub.omega_B.z, 0.1, 1e-15);
  const Vec3<double> of_panel = rotate(panel.q_IB, panel.omega_B);
  EXPECT_LT(norm(of_panel - Vec3<double>{0.2, 0, 0.1}), 1e-15);
  EXPECT_EQ(craft.first_torque, (std::vector<std::size_t>{0, 0, 0}));
}

TEST(SceneBodies, a_chain_is_many_links_alike) {
  const Spacecraft craft =
      read(kMass +
           "[[spacecraft.chain]]\nname = \"link{}\"\ncount = 20\nfrom = \"hub\"\nmass_kg = 0.1\n"
           "inertia_body_kg_m2 = [0.01, 0.01, 0.001]\nkind = \"spherical\"\n"
           "first_point_from_body_m = [0, 0, 2]\npoint_from_body_m = [0, 0, 0.5]\n"
           "point_to_body_m = [0, 0, -0.5]\n");
  ASSERT_EQ(craft.linked->bodies.size(), 21U);
  EXPECT_EQ(craft.linked->bodies[20].name, "link19");
  EXPECT_EQ(craft.linked->joints[0].a.point_B.z, 2);
  EXPECT_EQ(craft.linked->joints[1].a.point_B.z, 0.5);
  EXPECT_NEAR(craft.linked->bodies[20].x_I.z - craft.linked->bodies[0].x_I.z, 21.5, 1e-12);
}

TEST(SceneBodies, motors_are_actuators_one_for_each_free_coordinate) {
  const Spacecraft craft =
      read(kMass + kPanel + kHinge +
           "max_motor_torque = 0.5\nmotor_torque = 0.1\ncommanded = true\nstiffness = 2\n");
  ASSERT_EQ(craft.actuators.size(), 1U);
  EXPECT_EQ(craft.actuators[0].name, "hinge");
  EXPECT_EQ(craft.actuators[0].kind, ActuatorKind::joint);
  EXPECT_EQ(craft.actuators[0].limit.x, 0.5);
  ASSERT_EQ(craft.linked->motors.size(), 1U);
  EXPECT_EQ(craft.linked->motors[0].standing, 0.1);
  EXPECT_EQ(craft.linked->joints[0].laws[0].stiffness, 2);
  std::string universal = kHinge;
  universal.replace(universal.find("revolute"), 8, "universal");
  const Spacecraft two =
      read(kMass + kPanel + universal + "max_motor_torque = 1\ncommanded = true\n");
  ASSERT_EQ(two.actuators.size(), 2U);
  EXPECT_EQ(two.actuators[1].name, "hinge.2");
  EXPECT_EQ(two.linked->motors[1].coordinate, 1U);
}

TEST(SceneBodies, a_hinge_may_begin_wound_up_through_whole_turns) {
  const Spacecraft craft = read(kMass + kPanel + kHinge + "coordinate = -21.0\nrest = -21.0\n");
  EXPECT_EQ(craft.linked->start_coordinates[0][0], -21);
}

TEST(SceneBodies, torques_go_to_the_body_that_they_name_and_gravity_to_all) {
  const Spacecraft craft =
      read(kMass + "[spacecraft.orbit]\nsemi_major_axis_m = 7e6\n" + kPanel + kHinge +
           "[[spacecraft.torque]]\nmodel = \"commanded\"\nbody = \"panel\"\n"
           "max_torque_n_m = [1, 1, 1]\n"
           "[[spacecraft.torque]]\nmodel = \"constant\"\nframe = \"body\"\n"
           "torque_n_m = [0, 0, 1]\n[[spacecraft.torque]]\nmodel = \"gravity_gradient\"\n");
  ASSERT_EQ(craft.torques.size(), 4U);
  EXPECT_EQ(craft.first_torque, (std::vector<std::size_t>{0, 2, 4}));
  EXPECT_TRUE(std::holds_alternative<Constant<double>>(craft.torques[0]));
  EXPECT_EQ(std::get<GravityGradient<double>>(craft.torques[1]).inertia_B.xx, 0.9144);
  EXPECT_TRUE(std::holds_alternative<Commanded<double>>(craft.torques[2]));
  EXPECT_EQ(craft.actuators[0].index, 2U);
  EXPECT_EQ(std::get<GravityGradient<double>>(craft.torques[3]).inertia_B.xx, 0.5);
}

TEST(SceneBodies, say_what_does_not_fit) {
  const auto says = [](const std::string& lines, const std::string& what) {
    EXPECT_NE(refusal(in_spacecraft(lines)).find(what), std::string::npos)
        << refusal(in_spacecraft(lines));
  };
  says(kPanel + kHinge, "mass_kg: got nothing, expected the mass of the hub");
  says("mass_kg = 5\n", "a key of linked bodies without any");
  says(kMass + kPanel, "hangs on nothing");
  says(kMass + kPanel + kHinge + kHinge, "a name of its own for each joint");
  says(kMass + kPanel + kPanel + kHinge, "a name of its own for each body");
  says(kMass + kPanel + kHinge + "stop_lower = 0\n", "one stop without the other");
  says(kMass + kPanel + kHinge + "stop_lower = 0\nstop_upper = -1\nstop_stiffness = 1\n",
       "an upper stop above the lower one");
  says(kMass + kPanel + kHinge + "commanded = true\n", "max_motor_torque");
  says(kMass + kPanel + kHinge + "coordinate = [1, 2]\n", "a number");
  says("angular_momentum_body_n_m_s = [0, 0, 1]\n" + kMass + kPanel + kHinge,
       "the angular velocity of its hub");
  says(kMass + kPanel + kHinge +
           "[[spacecraft.wheel]]\nname = \"w\"\naxis_body = [1, 0, 0]\nspin_inertia_kg_m2 = 0.01\n",
       "linked bodies carry no wheels yet");
  says(kMass + kPanel + kHinge +
           "[[spacecraft.torque]]\nmodel = \"constant\"\nframe = \"body\"\n"
           "torque_n_m = [0, 0, 1]\nbody = \"panl\"\n",
       "\"panel\"");
  says(kMass + kPanel + kHinge + "max_motor_torque = 0.1\nmotor_torque = -5\n",
       "no more than max_motor_torque");
  std::string spun = kHinge;
  spun.replace(spun.find("[1, 0, 0]"), 9, "[1e200, 0, 0]");
  says(kMass + kPanel + spun,
       "spacecraft[0].joint[0].axis_body: got [1e+200, 0, 0], expected a direction");
  std::string ball = kHinge.substr(0, kHinge.find("axis_body"));
  ball.replace(ball.find("revolute"), 8, "spherical");
  says(kMass + kPanel + ball + "coordinate = [0, 0, 3.3]\n", "less than half a turn");
  std::string named = kHinge, second = kPanel;
  named.replace(named.find("\"hinge\""), 7, "\"hinge.1\"");
  ball.replace(ball.find("\"panel\""), 7, "\"boom\"");
  second.replace(second.find("\"panel\""), 7, "\"boom\"");
  const std::string motor = "max_motor_torque = 1\ncommanded = true\n";
  says(kMass + kPanel + second + ball + motor + named + motor, "a motor called \"hinge.1\" again");
  std::string to_itself = kHinge;
  to_itself.replace(to_itself.find("\"panel\""), 7, "\"hub\"");
  says(kMass + kPanel + to_itself, "with itself");
  EXPECT_NE(refusal(in_simulation("scheme = \"rkmk4\"") + kMass + kPanel + kHinge)
                .find("does not step linked bodies"),
            std::string::npos);
}

/// Two hinges from the hub to the panel: the second closes a loop.
TEST(SceneBodies, a_joint_that_closes_a_loop_stands_where_the_others_put_it) {
  std::string again = kHinge;
  again.replace(again.find("\"hinge\""), 7, "\"again\"");
  EXPECT_EQ(read(kMass + kPanel + kHinge + "coordinate = 0.3\n" + again).linked->joints.size(), 2U);
  const std::string started =
      refusal(in_spacecraft(kMass + kPanel + kHinge + again + "coordinate = 0.3\n"));
  EXPECT_NE(
      started.find("joint[1].coordinate: got a start of joint \"again\", which closes a loop"),
      std::string::npos)
      << started;
  again.replace(again.find("[0, -1, 0]"), 10, "[0, -2, 0]");
  const std::string apart = refusal(in_spacecraft(kMass + kPanel + kHinge + again));
  EXPECT_NE(apart.find("joint[1].name: got joint 'again' (revolute): "), std::string::npos)
      << apart;
  EXPECT_EQ(apart.find("place()"), std::string::npos) << apart;
}

}  // namespace
}  // namespace adstar::scene
