#pragma once
// A body with wheels in it: its total momentum is still the state, and what the wheels do cannot touch it.
//
// With J_B of the body and all its wheels locked, and J_r = J_B - Σ J_i a_i a_iᵀ over the wheels that turn
// freely about their axes a_i (Hughes, Spacecraft Attitude Dynamics, 1986, section 6.3):
//   Pi_B = J_r omega_B + Σ a_i h_i,   h_i = J_i (Omega_i + a_iᵀ omega_B),   H_I' = R_IB tau_B + tau_I
//   E = ½ omega_Bᵀ J_r omega_B + Σ h_i²/(2 J_i)
// A rotor at constant speed stays in J_r, with h_i = J_i Omega_i for ever; E then leaves out the work of
// the motor that keeps it there.

#include <span>

#include <Eigen/Core>

#include "adstar/bodies/rigid_body.hpp"
#include "adstar/bodies/wheel.hpp"

namespace adstar {

template <class T>
Eigen::Matrix<T, 3, 3> matrix_of(const Sym3<T>& J) {
  Eigen::Matrix<T, 3, 3> matrix;
  matrix << J.xx, J.xy, J.xz, J.xy, J.yy, J.yz, J.xz, J.yz, J.zz;
  return matrix;
}

/// J_r of J_B: the body without what turns freely in it.
template <class T>
RigidBody<T> hub_of(const RigidBody<T>& body, std::span<const SpinningWheel<T>> wheels) {
  Eigen::Matrix<T, 3, 3> J = matrix_of(body.inertia());
  for (const SpinningWheel<T>& spinning : wheels) {
    if (!spinning.wheel.constant_speed) {
      const Eigen::Matrix<T, 3, 1> a = to_eigen(spinning.wheel.axis_B);
      J -= spinning.wheel.spin_inertia_kg_m2 * (a * a.transpose());
    }
  }
  return RigidBody<T>(J);
}

/// Whether there is something beside the wheels, about every axis, to more than round-off.
template <class T>
bool is_body_beside_wheels(const RigidBody<T>& hub) {
  return hub.moments()[0] > T(1e-12) * hub.moments()[2];
}

/// Σ a_i h_i [N m s]
template <class T>
Vec3<T> wheel_momentum(std::span<const SpinningWheel<T>> wheels) {
  Vec3<T> sum{};
  for (const SpinningWheel<T>& spinning : wheels) {
    sum = sum + spinning.h.value * spinning.wheel.axis_B;
  }
  return sum;
}

/// omega_B = J_r⁻¹ (Pi_B - Σ a_i h_i) [rad/s]
template <class T>
Vec3<T> angular_velocity(const RigidBody<T>& hub, std::span<const SpinningWheel<T>> wheels,
                         const Vec3<T>& Pi_B) {
  return hub.angular_velocity(Pi_B - wheel_momentum(wheels));
}

/// E [J]
template <class T>
T energy(const RigidBody<T>& hub, std::span<const SpinningWheel<T>> wheels, const Vec3<T>& Pi_B) {
  T sum = hub.energy(Pi_B - wheel_momentum(wheels));
  for (const SpinningWheel<T>& spinning : wheels) {
    const T h = spinning.h.value;
    sum = sum + T(0.5) * (h * (h / spinning.wheel.spin_inertia_kg_m2));
  }
  return sum;
}

}  // namespace adstar
