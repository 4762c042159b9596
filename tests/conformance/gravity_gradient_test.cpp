// Gravity gradient on a Kepler orbit: libration at its analytic periods, the regions of stability, and the Jacobi
// integral that a splitting keeps.
#include "adstar/torques/gravity_gradient.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <variant>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "adstar/integrators/all.hpp"
#include "adstar/propagator.hpp"

namespace adstar {
namespace {

using V = Vec3<double>;

constexpr double kRadius = 6.9e6;

KeplerOrbit<double> circular() { return make_orbit<double>({kRadius, 0, 0.7, 0.3, 0.2, 0.1}); }

/// Columns of R_IO at t: along the velocity, against the orbit's normal, towards the Earth.
Eigen::Matrix3d orbital_frame(const KeplerOrbit<double>& orbit, double t) {
  const V r = position_at(orbit, t).direction_I, normal = cross(orbit.P, orbit.Q);
  Eigen::Matrix3d R;
  R.col(0) = to_eigen(cross(normal, r));
  R.col(1) = -to_eigen(normal);
  R.col(2) = -to_eigen(r);
  return R;
}

Quat<double> quaternion_of(const Eigen::Matrix3d& R) {
  const Eigen::Quaterniond q(R);
  return {q.w(), q.x(), q.y(), q.z()};
}

/// A body near its place in the orbital frame: roll, pitch, yaw are small angles of B against O.
struct Satellite {
  KeplerOrbit<double> orbit = circular();
  RigidBody<double> body;
  std::vector<Torque<double>> torques;
  State<double> state;

  Satellite(const V& moments, const V& angles, const V& rates = {})
      : body(Eigen::Matrix3d(Eigen::Vector3d(moments.x, moments.y, moments.z).asDiagonal())) {
    GravityGradient<double> gravity;
    gravity.orbit = orbit;
    gravity.act_on(body);
    torques.emplace_back(gravity);
    const Quat<double> q =
        quaternion_of(orbital_frame(orbit, 0)) * Rotation<double>(angles).quaternion();
    // The orbital frame itself turns at -n about its second axis.
    const V frame =
        rotate_inverse(Rotation<double>(angles).quaternion(), V{0, -orbit.mean_motion_rad_s, 0});
    const V omega = frame + rates;
    state = make_state(q, rotate(normalised(q), body.momentum(omega)));
  }
  V angles(double t) const {
    const Quat<double> O = quaternion_of(orbital_frame(orbit, t));
    Quat<double> q = Quat<double>{O.w, -O.x, -O.y, -O.z} * state.q_IB;
    const double sign = q.w < 0 ? -2 : 2;
    return {sign * q.x, sign * q.y, sign * q.z};
  }
  template <class Scheme>
  void step(std::int64_t n, std::int64_t h_ns) {
    const BodyOf<Scheme, double> prepared(body);
    EXPECT_TRUE((advance<Scheme, double>(prepared, state, torques, n * h_ns, h_ns).resolved()));
  }
  /// ½ omega·J omega - n·H + 3/2 n² u·J u: constant on a circular orbit (Hughes 1986, section 9.2).
  double jacobi(double t) const {
    const V Pi = body_momentum(state);
    const V u = rotate_inverse(renormalised(state.q_IB), position_at(orbit, t).direction_I);
    const double n = orbit.mean_motion_rad_s;
    return body.energy(Pi) - n * dot(cross(orbit.P, orbit.Q), state.H_I.value()) +
           1.5 * n * n * dot(u, body.inertia() * u);
  }
};

TEST(KeplerOrbit, closes_and_keeps_energy_and_area) {
  const KeplerOrbit<double> orbit = make_orbit<double>({2.66e7, 0.74, 1.1, 2.0, 4.7, 0.3});
  const double period = 2 * std::numbers::pi / orbit.mean_motion_rad_s;
  const auto at = [&](double t) {
    const OrbitPosition<double> p = position_at(orbit, t);
    return p.distance_m * p.direction_I;
  };
  EXPECT_LT(norm(at(period) - at(0)), 1e-7 * orbit.semi_major_axis_m);
  for (double t = 0; t < period; t += period / 37) {
    EXPECT_NEAR(norm(position_at(orbit, t).direction_I), 1, 1e-15);
    constexpr double kStep = 0.2;
    const V velocity = (0.5 / kStep) * (at(t + kStep) - at(t - kStep));
    const double energy = 0.5 * dot(velocity, velocity) - orbit.gravity_m3_s2 / norm(at(t));
    EXPECT_NEAR(energy * -2 * orbit.semi_major_axis_m / orbit.gravity_m3_s2, 1, 1e-6) << t;
    const double area = norm(cross(at(t), velocity));
    const double expected = std::sqrt(orbit.gravity_m3_s2 * orbit.semi_major_axis_m *
                                      (1 - orbit.eccentricity * orbit.eccentricity));
    EXPECT_NEAR(area / expected, 1, 1e-6) << t;
  }
}

TEST(KeplerOrbit, solves_its_equation_to_round_off) {
  for (const double e : {1e-9, 0.01, 0.3, 0.79, 0.81, 0.95, 0.99}) {
    for (double M = -40; M < 40; M += 0.37) {
      const double E = eccentric_anomaly(M, e);
      const double residual = std::remainder(E - e * std::sin(E) - M, 2 * std::numbers::pi);
      EXPECT_NEAR(residual, 0, 2e-14) << "e " << e << " M " << M;
    }
  }
}

TEST(KeplerOrbit, has_the_elements_that_it_was_given) {
  const double i = 0.9, node = 2.1, argument = -0.4;
  const KeplerOrbit<double> orbit = make_orbit<double>({7e6, 0.1, i, node, argument, 0});
  const V normal = cross(orbit.P, orbit.Q);
  EXPECT_NEAR(normal.z, std::cos(i), 1e-15);
  EXPECT_NEAR(std::atan2(normal.x, -normal.y), node, 1e-15);
  const V ascending{std::cos(node), std::sin(node), 0};
  EXPECT_NEAR(dot(ascending, orbit.P), std::cos(argument), 1e-15);
  EXPECT_NEAR(dot(cross(ascending, orbit.P), normal), std::sin(argument), 1e-15);
}

TEST(GravityGradient, turns_the_long_axis_towards_the_earth) {
  // A rod along x, 0.1 rad off the vertical: the torque is 3/2 n² (J_y - J_x) sin 0.2.
  GravityGradient<double> gravity;
  gravity.orbit = make_orbit<double>({kRadius, 0, 0, 0, 0, 0});
  const RigidBody<double> rod(Eigen::Matrix3d(Eigen::Vector3d(1, 10, 10).asDiagonal()));
  gravity.act_on(rod);
  const double n = std::get<KeplerOrbit<double>>(gravity.orbit).mean_motion_rad_s;
  const V tau = gravity.at(0, Rotation<double>({0, 0, 0.1}).quaternion());
  EXPECT_NEAR(tau.z, -1.5 * n * n * 9 * std::sin(0.2), 1e-20);
  EXPECT_EQ(tau.x, 0);
  EXPECT_LE(norm(tau), gravity.bound());
}

/// Frequencies in a series with a constant step by its linear recurrence: x is a sum of `modes` harmonics.
std::vector<double> frequencies(const std::vector<double>& x, double dt, int modes) {
  const auto count = static_cast<Eigen::Index>(x.size()) - 2 * modes;
  Eigen::MatrixXd A(count, modes);
  Eigen::VectorXd b(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto m = static_cast<std::size_t>(k + modes);
    b[k] = x[m + static_cast<std::size_t>(modes)] + x[m - static_cast<std::size_t>(modes)];
    for (int j = 0; j < modes; ++j) {
      A(k, j) =
          j == 0 ? x[m] : x[m + static_cast<std::size_t>(j)] + x[m - static_cast<std::size_t>(j)];
    }
  }
  const Eigen::VectorXd c = A.colPivHouseholderQr().solve(b);
  // One mode: 2 cos w = c_0. Two: 2 cos 2w = c_0 + 2 c_1 cos w.
  if (modes == 1) {
    return {std::acos(c[0] / 2) / dt};
  }
  const double root = std::sqrt(c[1] * c[1] / 16 + (c[0] + 2) / 4);
  return {std::acos(c[1] / 4 + root) / dt, std::acos(c[1] / 4 - root) / dt};
}

TEST(Libration, in_pitch_has_its_analytic_period) {
  constexpr double kAmplitude = 1e-5;
  Satellite satellite({100, 120, 40}, {0, kAmplitude, 0});
  const double n = satellite.orbit.mean_motion_rad_s;
  constexpr std::int64_t kStep = 4'000'000'000;
  std::vector<double> pitch;
  for (std::int64_t k = 0; k < 20'000; ++k) {
    if (k % 100 == 0) {
      pitch.push_back(satellite.angles(4.0 * static_cast<double>(k)).y);
    }
    satellite.step<CoadjointDop853>(k, kStep);
  }
  const double expected = n * std::sqrt(3 * (100.0 - 40) / 120);
  EXPECT_NEAR(frequencies(pitch, 400, 1)[0] / expected, 1, 1e-6);
}

TEST(Libration, in_roll_and_yaw_has_both_its_analytic_periods) {
  constexpr double kAmplitude = 1e-5;
  Satellite satellite({100, 120, 40}, {kAmplitude, 0, 0.5 * kAmplitude});
  const double n = satellite.orbit.mean_motion_rad_s;
  constexpr std::int64_t kStep = 4'000'000'000;
  std::vector<double> roll;
  for (std::int64_t k = 0; k < 20'000; ++k) {
    if (k % 100 == 0) {
      roll.push_back(satellite.angles(4.0 * static_cast<double>(k)).x);
    }
    satellite.step<CoadjointDop853>(k, kStep);
  }
  // s⁴ + (1 + 3 k_1 + k_1 k_3) n² s² + 4 k_1 k_3 n⁴ = 0 (Hughes 1986, section 9.2)
  const double k_1 = (120.0 - 40) / 100, k_3 = (120.0 - 100) / 40;
  const double b = 1 + 3 * k_1 + k_1 * k_3, c = 4 * k_1 * k_3;
  const double low = n * std::sqrt((b - std::sqrt(b * b - 4 * c)) / 2);
  const double high = n * std::sqrt((b + std::sqrt(b * b - 4 * c)) / 2);
  std::vector<double> found = frequencies(roll, 400, 2);
  std::sort(found.begin(), found.end());
  EXPECT_NEAR(found[0] / low, 1, 1e-6);
  EXPECT_NEAR(found[1] / high, 1, 1e-6);
}

/// The largest deviation over some orbits from 1e-6 rad in all three angles.
double deviation(const V& moments) {
  Satellite satellite(moments, {1e-6, 1e-6, 1e-6});
  constexpr std::int64_t kStep = 60'000'000'000;
  double largest = 0;
  for (std::int64_t k = 0; k < 1500; ++k) {
    satellite.step<CoadjointDop853>(k, kStep);
    const V angles = satellite.angles(60.0 * static_cast<double>(k + 1));
    largest = std::max(largest, norm(angles));
  }
  return largest;
}

/// Stable: J_pitch > J_roll > J_yaw (Lagrange), or k_1, k_3 < 0 with k_1 > k_3, 1 + 3 k_1 + k_1 k_3 > 0 and its square above 16 k_1 k_3
/// (DeBra and Delp 1961).
TEST(Stability, of_the_orbital_attitude_is_where_lagrange_and_debra_and_delp_have_it) {
  EXPECT_LT(deviation({100, 120, 40}), 1e-4) << "Lagrange";
  // k_1 = (J_2 - J_3)/J_1, k_3 = (J_2 - J_1)/J_3
  const double k_1 = -0.05, k_3 = -0.3;
  const double J_1 = 1, J_3 = (1 - k_1) / (1 - k_3), J_2 = 1 + k_3 * J_3;
  ASSERT_NEAR((J_2 - J_3) / J_1, k_1, 1e-12);
  const double b = 1 + 3 * k_1 + k_1 * k_3;
  ASSERT_TRUE(b > 0 && b * b > 16 * k_1 * k_3 && J_1 > J_3);
  EXPECT_LT(deviation({J_1, J_2, J_3}), 1e-4) << "DeBra and Delp";
  EXPECT_GT(deviation({40, 120, 100}), 1e-2) << "pitch falls over";
  EXPECT_GT(deviation({100, 40, 120}), 1e-2);
  EXPECT_GT(deviation({100, 80, 60}), 1e-3) << "roll and yaw, k_1 > 0 > k_3";
}

/// What a straight line through the Jacobi integral says that it gained over the run, and how far it swung at
/// most, both relative to the energy.
struct Gain {
  double trend = 0, swing = 0;
};

template <class Scheme>
Gain jacobi_gain(std::int64_t orbits) {
  Satellite satellite({100, 120, 40}, {0.3, 0.2, -0.1}, {1e-4, -2e-4, 1e-4});
  constexpr std::int64_t kPerOrbit = 60;
  const double period = 2 * std::numbers::pi / satellite.orbit.mean_motion_rad_s;
  const auto h_ns = static_cast<std::int64_t>(period / kPerOrbit * 1e9);
  const double h = 1e-9 * static_cast<double>(h_ns);
  const double J_0 = satellite.jacobi(0);
  const double scale = satellite.body.energy(body_momentum(satellite.state));
  const std::int64_t steps = orbits * kPerOrbit;
  Gain gain;
  double along = 0, square = 0;
  for (std::int64_t k = 0; k < steps; ++k) {
    satellite.step<Scheme>(k, h_ns);
    const double off = (satellite.jacobi(h * static_cast<double>(k + 1)) - J_0) / scale;
    const double x = static_cast<double>(2 * k + 1 - steps) / static_cast<double>(steps);
    gain.swing = std::max(gain.swing, std::fabs(off));
    along += x * off;
    square += x * x;
  }
  gain.trend = 2 * along / square;
  return gain;
}

TEST(Jacobi, integral_of_a_splitting_does_not_drift_over_ten_thousand_orbits) {
  const Gain splitting = jacobi_gain<SplittingMcLachlan84>(10'000);
  EXPECT_LT(splitting.swing, 1e-5);
  // It is the same of 1,000 orbits and of 40,000: what is left of the swing, not a drift.
  EXPECT_LT(std::fabs(splitting.trend), 0.03 * splitting.swing) << splitting.swing;
  // The same of a Runge-Kutta method of that order, over a hundredth of the time.
  const Gain runge_kutta = jacobi_gain<CoadjointRk4>(100);
  EXPECT_GT(std::fabs(runge_kutta.trend), splitting.swing) << "or the test sees nothing";
  std::printf(
      "splitting_mclachlan84: swing %.1e, trend %.1e in 10,000 orbits; coadjoint_rk4: trend "
      "%.1e in 100\n",
      splitting.swing, splitting.trend, runge_kutta.trend);
}

}  // namespace
}  // namespace adstar
