#pragma once
// How a step asks for the torque: at an instant, an attitude and a rate of its choosing.

#include <utility>

#include "adstar/attitude.hpp"
#include "adstar/so3.hpp"
#include "adstar/vec3.hpp"

namespace adstar {

/// Torque at a stage: the sum of what is given in B and the sum of what is given in I [N m].
template <class T>
struct TorqueSample {
  Vec3<T> body, inertial;
};

/// What a torque may depend on at a stage.
template <class T>
struct Stage {
  T time_s;                 ///< since the beginning of this step or part of a step
  Vec3<T> omega_B;          ///< [rad/s]
  const Quat<T>& q_n;       ///< attitude at the beginning
  const Rotation<T>& turn;  ///< since then
  int number = 0;           ///< of the scheme's Nodes, where it has them
  Quat<T> q_IB() const { return q_n * turn.quaternion(); }
};

/// No torque: the free step.
struct NoTorque {
  static constexpr bool kFree = true;
  static constexpr bool kInertial = false;
};

/// Any callable TorqueSample<T>(const Stage<T>&); Inertial = false promises that its inertial part
/// is zero, OfRate = false that it does not look at omega_B: a kick then asks once.
template <class Function, bool Inertial, bool OfRate = true>
struct StageTorque {
  static constexpr bool kFree = false;
  static constexpr bool kInertial = Inertial;
  static constexpr bool kOfRate = OfRate;
  Function function;
};

template <class Function>
StageTorque<Function, false> body_torque(Function function) {
  return {std::move(function)};
}
template <class Function>
StageTorque<Function, true> mixed_torque(Function function) {
  return {std::move(function)};
}

/// The same for torques of time and attitude alone.
template <class Function>
StageTorque<Function, false, false> rateless_body_torque(Function function) {
  return {std::move(function)};
}
template <class Function>
StageTorque<Function, true, false> rateless_mixed_torque(Function function) {
  return {std::move(function)};
}

}  // namespace adstar
