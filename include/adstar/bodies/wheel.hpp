#pragma once
// A wheel inside the body: a reaction or momentum wheel with its motor and its bearing, a rotor that is
// kept at one speed, or, without a motor, a viscous ring damper.
//
// Omega is the speed relative to the body, h = J (Omega + aᵀ omega_B) the axial momentum relative to
// inertial space (Hughes, Spacecraft Attitude Dynamics, 1986, section 6.3; the gyrostat of
// bodies/gyrostat.hpp). What the motor and the bearing do is internal:
//   h' = u = motor + friction,   friction = -c Omega - c_0 Omega/√(Omega² + Omega_0²)
// The bearing's dry part is smooth through zero, over Omega_0: a wheel creeps where a real one sticks.
//
// The motor follows its order: a torque, or a speed through
//   torque = gain · (Omega_ordered - Omega)
// and gives no more than max_torque; what speeds the wheel up fades to nothing over the last fiftieth
// below max_speed, as a motor's torque does near its no-load speed. So the limits are continuous, and no
// limit loses momentum: what the motor does not give, the body does not get.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "adstar/state.hpp"
#include "adstar/torques/intervals.hpp"
#include "adstar/vec3.hpp"

namespace adstar {

template <class T>
struct Wheel {
  Vec3<T> axis_B;  ///< unit
  T spin_inertia_kg_m2{};
  bool constant_speed = false;   ///< kept there by a motor of its own, whatever the body does
  T max_torque_n_m{};            ///< of the motor; 0: there is none
  T max_speed_rad_s{};           ///< relative to the body
  T speed_gain_n_m_s_rad{};      ///< of the motor under a speed order
  T viscous_n_m_s_rad{};         ///< c
  T coulomb_n_m{};               ///< c_0
  T coulomb_speed_rad_s = T(1);  ///< Omega_0
};

/// What a motor is told.
template <class T>
struct MotorOrder {
  bool of_speed = false;
  T value{};  ///< [N m], or [rad/s]
};

template <class T>
struct MotorInterval {
  std::int64_t start_ns = 0;
  std::int64_t end_ns = 0;  ///< exclusive
  MotorOrder<T> order;
};

/// Orders within reach of the present step, and what holds between them.
template <class T>
struct Motor {
  static constexpr std::size_t kWindow = 16;

  MotorOrder<T> standing;                          ///< the scene's
  std::array<MotorInterval<T>, kWindow> window{};  ///< ascending, disjoint
  std::size_t intervals = 0;

  MotorOrder<T> order_at(std::int64_t t_ns) const {
    const MotorInterval<T>* const interval = in_force(all(), t_ns);
    return interval == nullptr ? standing : interval->order;
  }
  std::int64_t next_edge_after(std::int64_t t_ns) const {
    return adstar::next_edge_after(all(), t_ns);
  }

 private:
  std::span<const MotorInterval<T>> all() const { return {window.data(), intervals}; }
};

/// Of max_speed: where the motor's torque begins to fade.
inline constexpr double kFadeShare = 0.02;

/// The motor's torque, and whether it is less than was asked for.
template <class T>
struct MotorTorque {
  T given{};
  bool torque_limited = false;
  bool speed_limited = false;
};

template <class T>
MotorTorque<T> motor_torque(const Wheel<T>& wheel, const MotorOrder<T>& order, const T& Omega) {
  if (!(wheel.max_torque_n_m > T(0))) {
    return {};
  }
  const T asked = order.of_speed ? wheel.speed_gain_n_m_s_rad * (order.value - Omega) : order.value;
  const T magnitude = asked < T(0) ? -asked : asked;
  MotorTorque<T> torque{asked, magnitude > wheel.max_torque_n_m, false};
  T most = wheel.max_torque_n_m;
  const T along = asked < T(0) ? -Omega : Omega;
  const T room = (wheel.max_speed_rad_s - along) / (T(kFadeShare) * wheel.max_speed_rad_s);
  if (room < T(1)) {
    most = room > T(0) ? most * room : T(0);
    torque.speed_limited = magnitude > most;
  }
  if (magnitude > most) {
    torque.given = asked < T(0) ? -most : most;
  }
  return torque;
}

template <class T>
T friction_torque(const Wheel<T>& wheel, const T& Omega) {
  using std::sqrt;
  T torque = T(0) - wheel.viscous_n_m_s_rad * Omega;
  if (wheel.coulomb_n_m > T(0)) {
    const T scale = wheel.coulomb_speed_rad_s;
    torque = torque - wheel.coulomb_n_m * Omega / sqrt(Omega * Omega + scale * scale);
  }
  return torque;
}

/// Most stages that a scheme has which takes wheels.
inline constexpr std::size_t kMostWheelStages = 12;

/// A wheel in flight. Of one at constant speed h is J Omega, and never changes.
template <class T>
struct SpinningWheel {
  Wheel<T> wheel;
  Motor<T> motor;
  Sum<T> h;  ///< [N m s]

  // Of the step that is being taken.
  MotorOrder<T> order;
  T h_stage{};
  std::array<T, kMostWheelStages> slope{};

  /// Relative to the body [rad/s].
  T speed(const Vec3<T>& omega_B) const { return speed_of(h.value, omega_B); }
  T speed_of(const T& momentum, const Vec3<T>& omega_B) const {
    const T rate = momentum / wheel.spin_inertia_kg_m2;
    return wheel.constant_speed ? rate : rate - dot(wheel.axis_B, omega_B);
  }
  /// At that speed [rad/s] in a body that turns at omega_B.
  void start_at(const T& Omega, const Vec3<T>& omega_B) {
    const T carried = wheel.constant_speed ? T(0) : dot(wheel.axis_B, omega_B);
    h = {wheel.spin_inertia_kg_m2 * (Omega + carried), T(0)};
  }
  /// As the body's rate changes at once.
  void keep_speed(const Vec3<T>& before_B, const Vec3<T>& after_B) {
    if (!wheel.constant_speed) {
      h.add(wheel.spin_inertia_kg_m2 * dot(wheel.axis_B, after_B - before_B));
    }
  }
};

}  // namespace adstar
