#pragma once
// A body with wheels in flight, without a fleet around it.

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "adstar/gyrostat.hpp"
#include "adstar/integrators/all.hpp"

namespace adstar::test {

using V = Vec3<double>;
using Wheels = std::vector<SpinningWheel<double>>;

inline Eigen::Matrix3d inertia() {
  Eigen::Matrix3d J;
  J << 12, -0.4, 0.3, -0.4, 10, 0.2, 0.3, 0.2, 8;
  return J;
}

inline SpinningWheel<double> wheel(const V& axis, double inertia, double max_torque = 0,
                                   double max_speed = 0) {
  SpinningWheel<double> spinning;
  spinning.wheel.axis_B = (1 / norm(axis)) * axis;
  spinning.wheel.spin_inertia_kg_m2 = inertia;
  spinning.wheel.max_torque_n_m = max_torque;
  spinning.wheel.max_speed_rad_s = max_speed;
  spinning.wheel.speed_gain_n_m_s_rad = max_speed > 0 ? max_torque / (0.05 * max_speed) : 0;
  return spinning;
}

/// A body in flight, and what a test asks of it.
struct Gyrostat {
  RigidBody<double> hub;
  Wheels wheels;
  State<double> state;
  double E_0 = 0;

  Gyrostat(const Eigen::Matrix3d& J, Wheels all, const V& omega_B,
           const std::vector<double>& speeds)
      : hub(hub_of(RigidBody<double>(J), std::span<const SpinningWheel<double>>(all))),
        wheels(std::move(all)) {
    for (std::size_t i = 0; i < wheels.size(); ++i) {
      wheels[i].start_at(speeds[i], omega_B);
    }
    state = make_state(Quat<double>{}, hub.momentum(omega_B) + wheel_momentum(view()));
    E_0 = energy(hub, view(), body_momentum(state));
  }
  std::span<const SpinningWheel<double>> view() const { return wheels; }
  V omega_B() const { return angular_velocity(hub, view(), body_momentum(state)); }
  double energy_residual() const {
    return energy(hub, view(), body_momentum(state)) - E_0 - state.work.value;
  }

  template <class Scheme>
  StepReport run(double duration_s, double h_s, const std::vector<Torque<double>>& torques = {},
                 std::int64_t from_ns = 0) {
    const auto h_ns = static_cast<std::int64_t>(std::llround(h_s * 1e9));
    const auto steps = std::llround(duration_s / h_s);
    StepReport last;
    for (std::int64_t n = 0; n < steps; ++n) {
      last = advance<Scheme, double>(hub, state, std::span(wheels),
                                     std::span<const Torque<double>>(torques), from_ns + n * h_ns,
                                     h_ns);
      EXPECT_TRUE(last.resolved()) << "step " << n;
    }
    return last;
  }
};

}  // namespace adstar::test
