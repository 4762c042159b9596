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
  Quat<T> q_IB() const { return q_n * turn.quaternion(); }
};

/// No torque: the free step.
struct NoTorque {
  static constexpr bool kFree = true;
  static constexpr bool kInertial = false;
};

/// Any callable TorqueSample<T>(const Stage<T>&); Inertial = false promises that its inertial part
/// is zero.
template <class Function, bool Inertial>
struct StageTorque {
  static constexpr bool kFree = false;
  static constexpr bool kInertial = Inertial;
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

}  // namespace adstar
