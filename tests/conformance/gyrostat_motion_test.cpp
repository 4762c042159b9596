// What wheels do to a body, as a user sees it: slews, limits, closed forms and criteria of stability, and the count of
// parts.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/support/gyrostat_flight.hpp"

namespace adstar {
namespace {

using test::Gyrostat;
using test::inertia;
using test::V;
using test::wheel;
using test::Wheels;

// ---- the paper's scheme, and what a user sees -------------------------------------------------------

/// Wheels on three axes of a body whose axes are principal; from rest to rest by 90° about z.
TEST(Slew, of_ninety_degrees_on_three_wheels_leaves_the_inertial_momentum_alone) {
  const Eigen::Matrix3d J = Eigen::Vector3d(12, 10, 8).asDiagonal();
  for (const double h : {0.1, 0.01}) {
    Wheels wheels{wheel({1, 0, 0}, 0.05, 1, 900), wheel({0, 1, 0}, 0.05, 1, 900),
                  wheel({0, 0, 1}, 0.05, 1, 900)};
    // Half the time with a torque, half against: angle = u T²/(4 J_r).
    constexpr double kHalf = 10;
    const double u = std::numbers::pi / 2 / (kHalf * kHalf) * (8 - 0.05);
    wheels[2].motor.window[0] = {0, 10'000'000'000, {false, -u}};
    wheels[2].motor.window[1] = {10'000'000'000, 20'000'000'000, {false, u}};
    wheels[2].motor.intervals = 2;
    Gyrostat body(J, wheels, {0, 0, 0}, {0, 0, 0});
    const VecSum<double> H = body.state.H_I;
    body.run<CoadjointRk4>(20, h);
    EXPECT_EQ(body.state.H_I, H);
    const double half = std::sqrt(0.5);
    EXPECT_LT(angle_between(body.state.q_IB, Quat<double>{half, 0, 0, half}), 1e-12) << h;
    EXPECT_LT(norm(body.omega_B()), 1e-13);
    EXPECT_NEAR(body.energy_residual(), 0, 1e-14);
  }
}

/// The same with a body that spins: 90° off where it would have been, and every wheel feels it.
TEST(Slew, on_a_turning_body_balances_its_energy_at_the_order_of_the_scheme) {
  const auto residual = [](double h) {
    Wheels wheels{wheel({1, 0, 0}, 0.05, 1, 900), wheel({0, 1, 0}, 0.05, 1, 900),
                  wheel({0, 0, 1}, 0.05, 1, 900)};
    wheels[2].motor.window[0] = {0, 10'000'000'000, {false, -0.12}};
    wheels[2].motor.window[1] = {10'000'000'000, 20'000'000'000, {false, 0.12}};
    wheels[2].motor.intervals = 2;
    Gyrostat body(inertia(), wheels, {0.05, 0.1, -0.02}, {100, -50, 20});
    const VecSum<double> H = body.state.H_I;
    body.run<CoadjointRk4>(20, h);
    EXPECT_EQ(body.state.H_I, H);
    return std::fabs(body.energy_residual());
  };
  const double coarse = residual(0.2), fine = residual(0.1);
  EXPECT_GT(coarse / fine, 12) << coarse << " J, then " << fine;
}

TEST(Saturation, of_torque_and_speed_loses_no_momentum_and_passes_no_limit) {
  Wheels wheels{wheel({0, 0, 1}, 0.05, 0.2, 100)};
  wheels[0].motor.standing = {false, 5.0};  // twenty-five times what it has
  Gyrostat body(inertia(), wheels, {0.02, 0.01, 0}, {0});
  const VecSum<double> H = body.state.H_I;
  for (int second = 0; second < 200; ++second) {
    body.run<CoadjointRk4>(1, 0.05, {}, second * std::int64_t{1'000'000'000});
    const double speed = body.wheels[0].speed(body.omega_B());
    ASSERT_LE(speed, 100 + 1e-3)
        << "the motor gives nothing there; its own turn may carry it a hair past";
    ASSERT_LE(motor_torque(body.wheels[0].wheel, body.wheels[0].order, speed).given, 0.2);
  }
  EXPECT_EQ(body.state.H_I, H);
  const double speed = body.wheels[0].speed(body.omega_B());
  EXPECT_GT(speed, 99.9);
  const MotorTorque<double> motor = motor_torque(body.wheels[0].wheel, body.wheels[0].order, speed);
  EXPECT_TRUE(motor.torque_limited);
  EXPECT_TRUE(motor.speed_limited);
}

TEST(SpeedOrder, is_reached_and_held_against_the_bearing) {
  Wheels wheels{wheel({0, 1, 0}, 0.05, 0.5, 600)};
  wheels[0].wheel.viscous_n_m_s_rad = 1e-5;
  wheels[0].motor.standing = {true, 250};
  Gyrostat body(inertia(), wheels, {0, 0, 0}, {0});
  body.run<CoadjointRk4>(200, 0.1);
  const Wheel<double>& w = body.wheels[0].wheel;
  const double held = w.speed_gain_n_m_s_rad * 250 / (w.speed_gain_n_m_s_rad + 1e-5);
  EXPECT_NEAR(body.wheels[0].speed(body.omega_B()), held, 1e-6);
}

/// Symmetric body, rotor along its axis: the transverse rate turns in the body at
/// ((J_3 - J_1) omega_3 + h)/J_1 (Hughes, Spacecraft Attitude Dynamics, 1986, section 6.3).
TEST(DualSpin, nutates_at_its_closed_form) {
  const Eigen::Matrix3d J = Eigen::Vector3d(10, 10, 14).asDiagonal();
  SpinningWheel<double> rotor = wheel({0, 0, 1}, 0.5);
  rotor.wheel.constant_speed = true;
  Gyrostat body(J, {rotor}, {0.02, 0, 0.1}, {-6});
  const double h = 0.5 * -6;
  const double rate = (4 * 0.1 + h) / 10;
  body.run<CoadjointDop853>(100, 0.5);
  const V omega = body.omega_B();
  EXPECT_NEAR(omega.x, 0.02 * std::cos(rate * 100), 1e-12);
  EXPECT_NEAR(omega.y, 0.02 * std::sin(rate * 100), 1e-12);
  EXPECT_NEAR(omega.z, 0.1, 1e-13);
  EXPECT_NEAR(body.energy_residual(), 0, 1e-13)
      << "less the work of the motor that keeps its speed";
}

/// Spin about axis 3 with a rotor along it, h its momentum: small deviations grow unless
///   (J_3 n + h - J_1 n)(J_3 n + h - J_2 n) > 0,
/// at λ² = -(...)(...)/(J_1 J_2) (linearised about the spin; Hughes 1986, section 6.3).
TEST(DualSpin, is_stable_where_its_criterion_says_and_grows_at_its_rate_where_not) {
  constexpr double kSpin = 0.5, J_1 = 10, J_2 = 12, J_3 = 11;  // unstable without a rotor
  for (const double h : {-4.0, -2.0, -0.2, 0.0, 0.2, 2.0, 4.0}) {
    SpinningWheel<double> rotor = wheel({0, 0, 1}, 0.5);
    rotor.wheel.constant_speed = true;
    Gyrostat body(Eigen::Vector3d(J_1, J_2, J_3).asDiagonal(), {rotor}, {1e-8, 0, kSpin},
                  {h / 0.5});
    const double product = (J_3 * kSpin + h - J_1 * kSpin) * (J_3 * kSpin + h - J_2 * kSpin);
    double largest = 0;
    constexpr double kDuration = 160;
    for (int part = 0; part < 160; ++part) {
      body.run<CoadjointRk4>(1, 0.1, {}, part * std::int64_t{1'000'000'000});
      largest = std::max(largest, std::hypot(body.omega_B().x, body.omega_B().y));
    }
    if (product > 0) {
      EXPECT_LT(largest, 1e-7) << "h = " << h;
    } else {
      const double lambda = std::sqrt(-product / (J_1 * J_2));
      // The start has equal parts of the growing and the shrinking solution.
      EXPECT_NEAR(std::log(largest / 0.5e-8) / kDuration, lambda, 0.05 * lambda + 0.01) << h;
      EXPECT_GT(largest, 1e-6) << "h = " << h;
    }
  }
}

/// A ring damper across the spin axis takes energy, not momentum: a body that spins about its axis of largest
/// inertia comes to rest in it, one about its smallest leaves it (Likins 1966: the major-axis rule).
TEST(NutationDamper, damps_about_the_major_axis_and_drives_off_the_minor) {
  const auto nutation_after = [](const V& moments, double duration) {
    SpinningWheel<double> ring = wheel({1, 0, 0}, 0.3);
    ring.wheel.viscous_n_m_s_rad = 0.05;
    const Eigen::Matrix3d J = Eigen::Vector3d(moments.x, moments.y, moments.z).asDiagonal();
    Gyrostat body(J, {ring}, {0.01, 0, 0.5}, {0});
    const VecSum<double> H = body.state.H_I;
    const double before = body.E_0;
    body.run<CoadjointRk4>(duration, 0.1);
    EXPECT_EQ(body.state.H_I, H);
    EXPECT_LT(energy(body.hub, body.view(), body_momentum(body.state)), before);
    const V omega = body.omega_B();
    return std::hypot(omega.x, omega.y) / norm(omega);
  };
  EXPECT_LT(nutation_after({10, 11, 14}, 400), 0.3 * 0.02);
  EXPECT_GT(nutation_after({10, 11, 7}, 400), 2 * 0.02);
}

TEST(ConstantRotor, at_rest_is_the_body_that_it_is_part_of) {
  SpinningWheel<double> rotor = wheel({0, 0, 1}, 0.5);
  rotor.wheel.constant_speed = true;
  Gyrostat with(inertia(), {rotor}, {0.1, 0.2, 0.3}, {0});
  const RigidBody<double> body(inertia());
  State<double> without = make_state(Quat<double>{}, body.momentum({0.1, 0.2, 0.3}));
  with.run<CoadjointRk4>(10, 0.1);
  for (int n = 0; n < 100; ++n) {
    advance<CoadjointRk4, double>(body, without, {}, n * 100'000'000LL, 100'000'000LL);
  }
  EXPECT_LT(angle_between(with.state.q_IB, without.q_IB), 1e-14);
  EXPECT_EQ(with.state.H_I, without.H_I);
}

// ---- the guard ----------------------------------------------------------------------------------------

TEST(GyrostatGuard, takes_parts_for_what_the_wheels_do_to_the_body) {
  // Released in a light body, a wheel's motor spins the body up within the step.
  Wheels wheels{wheel({0, 0, 1}, 0.01, 10, 1e5)};
  wheels[0].motor.standing = {false, 10};
  Gyrostat body(Eigen::Vector3d(0.1, 0.1, 0.1).asDiagonal(), wheels, {0, 0, 0}, {0});
  const StepReport report = body.run<CoadjointRk4>(0.5, 0.5);
  EXPECT_GT(report.parts, 10);
  const double angle = -10.0 / 0.09 * 0.125;
  EXPECT_LT(
      angle_between(body.state.q_IB, Quat<double>{std::cos(angle / 2), 0, 0, std::sin(angle / 2)}),
      1e-9);
}

TEST(GyrostatGuard, reports_a_bearing_too_stiff_for_its_parts) {
  SpinningWheel<double> ring = wheel({1, 0, 0}, 1e-3);
  ring.wheel.viscous_n_m_s_rad = 10;  // decays within 0.1 ms
  Gyrostat body(inertia(), {ring}, {0.1, 0, 0.5}, {1});
  const StepReport report = advance<CoadjointRk4, double>(
      body.hub, body.state, std::span(body.wheels), {}, 0, 1'000'000'000);
  EXPECT_TRUE(report.unresolved_damping);
  EXPECT_TRUE(std::isfinite(squared_norm(body.state.q_IB)));
}

TEST(GyrostatGuard, reports_a_body_that_turns_too_far) {
  Gyrostat body(inertia(), {wheel({1, 0, 0}, 0.05)}, {500, 0, 5}, {0});
  const VecSum<double> H = body.state.H_I;
  const StepReport report = advance<CoadjointRk4, double>(
      body.hub, body.state, std::span(body.wheels), {}, 0, 1'000'000'000);
  EXPECT_TRUE(report.unresolved_angle);
  EXPECT_EQ(body.state.H_I, H);
  EXPECT_TRUE(std::isfinite(body.wheels[0].h.value));
}

TEST(GyrostatGuard, splits_a_step_where_a_motor_gets_another_order) {
  Wheels wheels{wheel({0, 0, 1}, 0.05, 1, 900)};
  wheels[0].motor.window[0] = {33'333'333, 66'666'667, {false, 0.5}};
  wheels[0].motor.intervals = 1;
  Gyrostat body(inertia(), wheels, {0, 0, 0}, {0});
  const double before = body.wheels[0].h.value;
  EXPECT_EQ(body.run<CoadjointRk4>(0.1, 0.1).parts, 3);
  EXPECT_NEAR(body.wheels[0].h.value - before, 0.5 * 0.033333334, 1e-16);
}

}  // namespace
}  // namespace adstar
