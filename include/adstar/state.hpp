#pragma once
// What one spacecraft carries from step to step.
//
// H_I and not Pi_B: a free body's inertial momentum is then constant to the last bit. Sums that
// grow for the length of a run carry their rounding error along (two-sum, Knuth 1969), so that 1e9
// steps lose nothing.

#include "adstar/attitude.hpp"
#include "adstar/vec3.hpp"

namespace adstar {

/// sum + carry is the value; |carry| is below half a unit in the last place of sum.
template <class T>
struct Sum {
  T value{}, carry{};

  void add(const T& term) {
    const T t = term + carry;
    const T sum = value + t;
    const T seen = sum - value;
    carry = (value - (sum - seen)) + (t - seen);
    value = sum;
  }
  friend bool operator==(const Sum&, const Sum&) = default;
};

template <class T>
struct VecSum {
  Sum<T> x, y, z;

  [[gnu::always_inline]] void add(const Vec3<T>& term) {
    x.add(term.x);
    y.add(term.y);
    z.add(term.z);
  }
  Vec3<T> value() const { return {x.value, y.value, z.value}; }
  friend bool operator==(const VecSum&, const VecSum&) = default;
};

template <class T>
struct State {
  Quat<T> q_IB;         ///< body to inertial, unit
  VecSum<T> H_I;        ///< inertial angular momentum about the centre of mass [N m s]
  VecSum<T> impulse_I;  ///< of all torques since the start [N m s]; H_I - H_0 - impulse_I is the
                        ///< momentum residual
  Sum<T> work;          ///< of all torques since the start [J]
  friend bool operator==(const State&, const State&) = default;
};

template <class T>
State<T> make_state(const Quat<T>& q_IB, const Vec3<T>& H_I) {
  State<T> state;
  state.q_IB = normalised(q_IB);
  state.H_I.add(H_I);
  return state;
}

/// Pi_B = R_IBᵀ H_I [N m s]. Renormalised: between steps |q|² is 1 to some units in the last place
/// only, and |Pi_B| would show them doubled.
template <class T>
Vec3<T> body_momentum(const State<T>& state) {
  return rotate_inverse(renormalised(state.q_IB), state.H_I.value());
}

}  // namespace adstar
