// Every scheme that carries wheels: against an independent formulation in another library, and the momentum
// that nothing inside can touch.
#include <algorithm>
#include <cmath>
#include <vector>

#include <boost/numeric/odeint.hpp>
#include <gtest/gtest.h>

#include "tests/support/gyrostat_flight.hpp"
#include "tests/support/schemes.hpp"

namespace adstar {
namespace {

using test::Gyrostat;
using test::inertia;
using test::V;
using test::wheel;
using test::Wheels;

template <bool Exact, class... Scheme>
auto with_wheels(std::tuple<Scheme...>) {
  return std::tuple_cat(
      std::conditional_t < TakesWheels<Scheme> && (Scheme::kClaims.exact_momentum || !Exact),
      std::tuple<Scheme>, std::tuple < >> {}...);
}
using WheelSchemes = test::AsTestTypes<decltype(with_wheels<false>(Schemes{}))>::type;
using ExactWheelSchemes = test::AsTestTypes<decltype(with_wheels<true>(Schemes{}))>::type;

// ---- an independent run: (q, omega_B, Omega) in long double by Boost.odeint ------------------------

using Real = long double;
using Flat = std::vector<Real>;  // q, omega_B, Omega_i

/// J_r omega' = -omega × (J_r omega + Σ a h) + tau_B - Σ a u, Omega_i' = u_i/J_i - a_i·omega'.
struct EulerOfGyrostat {
  Eigen::Matrix<Real, 3, 3> J_r, J_r_inverse;
  Wheels wheels;
  V torque_amplitude, torque_rate;  ///< tau_B = amplitude sin(rate t), per axis

  EulerOfGyrostat(const Gyrostat& start, const V& amplitude, const V& rate)
      : wheels(start.wheels), torque_amplitude(amplitude), torque_rate(rate) {
    J_r = matrix_of(start.hub.inertia()).cast<Real>();
    J_r_inverse = J_r.inverse();
  }

  void operator()(const Flat& y, Flat& dy, Real t) const {
    using Vector = Eigen::Matrix<Real, 3, 1>;
    const Vector omega(y[4], y[5], y[6]);
    Vector momentum = J_r * omega;
    Vector torque(torque_amplitude.x * std::sin(torque_rate.x * t),
                  torque_amplitude.y * std::sin(torque_rate.y * t),
                  torque_amplitude.z * std::sin(torque_rate.z * t));
    std::vector<Real> u(wheels.size());
    for (std::size_t i = 0; i < wheels.size(); ++i) {
      const Wheel<double>& w = wheels[i].wheel;
      const Vector a(w.axis_B.x, w.axis_B.y, w.axis_B.z);
      const Real Omega = y[7 + i], J = w.spin_inertia_kg_m2;
      momentum += a * (J * (Omega + a.dot(omega)));
      const MotorOrder<double>& order = wheels[i].motor.standing;
      u[i] = order.of_speed ? w.speed_gain_n_m_s_rad * (order.value - Omega) : order.value;
      u[i] -= w.viscous_n_m_s_rad * Omega +
              w.coulomb_n_m * Omega / std::hypot(Omega, Real(w.coulomb_speed_rad_s));
      torque -= a * u[i];
    }
    const Vector rate = J_r_inverse * (torque - omega.cross(momentum));
    dy[0] = (-y[1] * omega[0] - y[2] * omega[1] - y[3] * omega[2]) / 2;
    dy[1] = (y[0] * omega[0] + y[2] * omega[2] - y[3] * omega[1]) / 2;
    dy[2] = (y[0] * omega[1] + y[3] * omega[0] - y[1] * omega[2]) / 2;
    dy[3] = (y[0] * omega[2] + y[1] * omega[1] - y[2] * omega[0]) / 2;
    for (int k = 0; k < 3; ++k) {
      dy[static_cast<std::size_t>(4 + k)] = rate[k];
    }
    for (std::size_t i = 0; i < wheels.size(); ++i) {
      const V& a = wheels[i].wheel.axis_B;
      dy[7 + i] = u[i] / wheels[i].wheel.spin_inertia_kg_m2 -
                  (a.x * rate[0] + a.y * rate[1] + a.z * rate[2]);
    }
  }
};

Flat independent_run(const Gyrostat& start, const V& amplitude, const V& rate, Real duration_s) {
  namespace odeint = boost::numeric::odeint;
  const EulerOfGyrostat equations(start, amplitude, rate);
  const V omega = start.omega_B();
  Flat y{1, 0, 0, 0, omega.x, omega.y, omega.z};
  for (const SpinningWheel<double>& spinning : start.wheels) {
    y.push_back(spinning.speed(omega));
  }
  odeint::integrate_adaptive(odeint::make_controlled(Real(1e-15), Real(1e-15),
                                                     odeint::runge_kutta_fehlberg78<Flat, Real>()),
                             equations, y, Real(0), duration_s, Real(1e-3));
  return y;
}

/// Three wheels that are told something each, with friction.
Gyrostat busy_body() {
  Wheels wheels{wheel({1, 0, 0}, 0.05, 0.5, 900), wheel({0, 1, 0.2}, 0.04, 0.4, 900),
                wheel({-1, 1, 1}, 0.06, 0.5, 900)};
  wheels[0].motor.standing = {false, 0.11};
  wheels[1].motor.standing = {true, 22.0};
  wheels[1].wheel.speed_gain_n_m_s_rad = 0.02;
  wheels[2].wheel.viscous_n_m_s_rad = 2e-3;
  wheels[2].wheel.coulomb_n_m = 4e-3;
  return {inertia(), std::move(wheels), {0.11, -0.23, 0.31}, {30, 15, -40}};
}

template <class Scheme>
class WheelsOf : public testing::Test {};
TYPED_TEST_SUITE(WheelsOf, WheelSchemes);

TYPED_TEST(WheelsOf, turn_as_an_independent_run_of_other_equations_has_them_at_the_order) {
  const V amplitude{0.3, 0.2, -0.25}, rate{0.7, 1.1, 0.4};
  constexpr double kDuration = 4;
  const Flat truth = independent_run(busy_body(), amplitude, rate, kDuration);
  const Quat<double> q{static_cast<double>(truth[0]), static_cast<double>(truth[1]),
                       static_cast<double>(truth[2]), static_cast<double>(truth[3])};
  const auto errors = [&](double h) {
    Gyrostat body = busy_body();
    body.run<TypeParam>(kDuration, h, {Harmonic<double>{Frame::body, amplitude, rate, {0, 0, 0}}});
    const V omega = body.omega_B();
    double speed = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      speed = std::max(speed,
                       std::fabs(body.wheels[i].speed(omega) - static_cast<double>(truth[7 + i])));
    }
    return std::pair{angle_between(normalised(body.state.q_IB), normalised(q)), speed};
  };
  const int order = TypeParam::kOrder;
  const double h = order >= 8 ? 1.0 : order >= 5 ? 0.4 : order >= 4 ? 0.2 : 0.02;
  const auto coarse = errors(h), fine = errors(h / 2);
  const double least = 0.7 * std::pow(2, order);
  EXPECT_TRUE(coarse.first / fine.first > least || fine.first < 1e-13)
      << coarse.first << " rad, then " << fine.first;
  EXPECT_TRUE(coarse.second / fine.second > least || fine.second < 1e-12)
      << coarse.second << " rad/s, then " << fine.second;
  const auto finest = errors(h / 16);
  EXPECT_LT(finest.first, order == 2 ? 1e-4 : 1e-7);
}

template <class Scheme>
class ExactWheelsOf : public testing::Test {};
TYPED_TEST_SUITE(ExactWheelsOf, ExactWheelSchemes);

TYPED_TEST(ExactWheelsOf, keep_the_inertial_momentum_to_the_last_bit) {
  Gyrostat body = busy_body();
  const VecSum<double> H = body.state.H_I;
  body.run<TypeParam>(20, 0.1);
  EXPECT_EQ(body.state.H_I, H);
  EXPECT_GT(std::fabs(body.wheels[0].h.value - busy_body().wheels[0].h.value), 1.0) << "it span up";
}

TYPED_TEST(WheelsOf, account_for_the_work_of_motors_and_bearings_at_the_order) {
  const auto residual = [](double h) {
    Gyrostat body = busy_body();
    body.run<TypeParam>(4, h);
    return std::fabs(body.energy_residual());
  };
  const double h = TypeParam::kOrder >= 8 ? 0.5 : TypeParam::kOrder >= 4 ? 0.2 : 0.02;
  const double coarse = residual(h), fine = residual(h / 2);
  EXPECT_TRUE(coarse / fine > 0.7 * std::pow(2, TypeParam::kOrder) || fine < 1e-11)
      << coarse << " J, then " << fine;
}

}  // namespace
}  // namespace adstar
