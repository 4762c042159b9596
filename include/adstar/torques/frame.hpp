#pragma once
// What every torque model speaks of: the frame it is given in, time, and its course over a smooth
// segment.
//
// A model is one of four kinds, told apart by the member it has:
//   ramp_from(t_ns)  the torque is linear in time from t to its next edge: torque(t + τ) = start + slope τ
//   at(t_s)          the torque is smooth in time from t to its next edge, evaluated at every stage; it
//                    has bound() too (of its norm, for the sub-step guard) and add_at() of several instants
//   at(t_s, q_IB)    the torque, in B, looks at the attitude too: asked at every stage; it has bound()
//   damping()        the torque is -damping() omega_B per body axis, at every stage [N m s/rad]
// and every model has next_edge_after(t_ns).

#include <cstddef>
#include <cstdint>
#include <limits>

#include "adstar/vec3.hpp"

namespace adstar {

enum class Frame : std::uint8_t { body, inertial };

/// "No edge ahead."
inline constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

/// Torque over one segment: start [N m] + slope [N m/s] · (time since the segment's beginning [s]).
template <class T>
struct Ramp {
  Vec3<T> start, slope;
};

/// N vectors, component by component.
template <class T, std::size_t N>
struct VectorRows {
  T x[N], y[N], z[N];
};

/// Integer nanoseconds to seconds, correctly rounded.
template <class T>
T seconds(std::int64_t ns) {
  return T(ns) / T(1'000'000'000);
}

}  // namespace adstar
