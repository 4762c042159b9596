// A wheel's motor and bearing by themselves.
#include "adstar/bodies/wheel.hpp"

#include <gtest/gtest.h>

namespace adstar {
namespace {

Wheel<double> some_wheel() {
  Wheel<double> wheel;
  wheel.axis_B = {0, 0, 1};
  wheel.spin_inertia_kg_m2 = 0.02;
  wheel.max_torque_n_m = 0.5;
  wheel.max_speed_rad_s = 600;
  wheel.speed_gain_n_m_s_rad = 0.01;
  return wheel;
}

double given(const MotorOrder<double>& order, double Omega) {
  return motor_torque(some_wheel(), order, Omega).given;
}

TEST(Motor, gives_the_torque_that_it_is_told_up_to_its_limit) {
  EXPECT_EQ(given({false, 0.3}, 0), 0.3);
  EXPECT_EQ(given({false, -0.3}, 200), -0.3);
  EXPECT_EQ(given({false, 7}, 0), 0.5);
  EXPECT_EQ(given({false, -7}, 0), -0.5);
  EXPECT_TRUE(motor_torque(some_wheel(), {false, 7}, 0.0).torque_limited);
  EXPECT_FALSE(motor_torque(some_wheel(), {false, 0.3}, 0.0).torque_limited);
}

TEST(Motor, fades_towards_its_highest_speed_and_brakes_at_full_torque_there) {
  EXPECT_EQ(given({false, 0.5}, 588), 0.5) << "98 %";
  EXPECT_NEAR(given({false, 0.5}, 594), 0.25, 1e-15) << "99 %";
  EXPECT_EQ(given({false, 0.5}, 600), 0);
  EXPECT_EQ(given({false, 0.5}, 700), 0);
  EXPECT_EQ(given({false, -0.5}, 700), -0.5);
  EXPECT_NEAR(given({false, -0.5}, -594), -0.25, 1e-15);
  EXPECT_TRUE(motor_torque(some_wheel(), {false, 0.3}, 597.0).speed_limited);
  EXPECT_FALSE(motor_torque(some_wheel(), {false, 0.1}, 594.0).speed_limited) << "it has 0.25";
}

TEST(Motor, pulls_towards_an_ordered_speed) {
  EXPECT_NEAR(given({true, 100}, 90), 0.1, 1e-15);
  EXPECT_NEAR(given({true, 100}, 110), -0.1, 1e-15);
  EXPECT_EQ(given({true, 100}, 0), 0.5) << "its limit";
  EXPECT_EQ(given({true, 100}, 100), 0);
}

TEST(Motor, that_a_wheel_does_not_have_gives_nothing) {
  EXPECT_EQ(motor_torque(Wheel<double>{}, {false, 1.0}, 3.0).given, 0);
}

TEST(Motor, follows_the_interval_that_is_in_force_and_its_standing_order_between) {
  Motor<double> motor;
  motor.standing = {true, 5};
  motor.window[0] = {10, 20, {false, 1}};
  motor.window[1] = {20, 25, {false, 2}};
  motor.intervals = 2;
  EXPECT_TRUE(motor.order_at(9).of_speed);
  EXPECT_EQ(motor.order_at(10).value, 1);
  EXPECT_EQ(motor.order_at(20).value, 2);
  EXPECT_TRUE(motor.order_at(25).of_speed);
  EXPECT_EQ(motor.next_edge_after(0), 10);
  EXPECT_EQ(motor.next_edge_after(10), 20);
  EXPECT_EQ(motor.next_edge_after(20), 25);
  EXPECT_EQ(motor.next_edge_after(25), kNever);
}

TEST(Bearing, rubs_against_the_motion_and_never_at_rest) {
  Wheel<double> wheel = some_wheel();
  EXPECT_EQ(friction_torque(wheel, 100.0), 0);
  wheel.viscous_n_m_s_rad = 1e-4;
  wheel.coulomb_n_m = 2e-3;
  EXPECT_EQ(friction_torque(wheel, 0.0), 0);
  EXPECT_NEAR(friction_torque(wheel, 1000.0), -(0.1 + 2e-3), 2e-9);
  EXPECT_EQ(friction_torque(wheel, -7.0), -friction_torque(wheel, 7.0));
}

TEST(SpinningWheel, keeps_its_speed_when_the_body_jumps) {
  SpinningWheel<double> spinning;
  spinning.wheel = some_wheel();
  spinning.start_at(50, {0.1, 0.2, 0.3});
  EXPECT_NEAR(spinning.h.value, 0.02 * 50.3, 1e-15);
  EXPECT_NEAR(spinning.speed({0.1, 0.2, 0.3}), 50, 1e-13);
  spinning.keep_speed({0.1, 0.2, 0.3}, {0, 0, -0.4});
  EXPECT_NEAR(spinning.speed({0, 0, -0.4}), 50, 1e-13);
}

}  // namespace
}  // namespace adstar
