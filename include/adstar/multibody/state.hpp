#pragma once
// What an assembly carries from step to step, and how each formulation reads it.
//
//   se3:            H = Pi_I + x×p about the origin of I, p:  Pi_I = H - x×p      (the coadjoint action of SE(3))
//   direct_product: H = Pi_I, the body's own:                 Pi_I = H
// omega_I = R J_B⁻¹ Rᵀ Pi_I, v_I = p/m. In free fall I is the frame of the common centre of mass; an origin far
// away costs digits of x×p. Everything in the state is a plain number: copied bit by bit, it goes on bit by bit.

#include <array>
#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

#include "adstar/double_double.hpp"
#include "adstar/multibody/assembly.hpp"
#include "adstar/state.hpp"

namespace adstar::multibody {

template <class T>
struct BodyState {
  VecSum<T> x_I;  ///< centre of mass [m]
  Quat<T> q_IB;
  VecSum<T> p_I;  ///< [N s]
  VecSum<T> H_I;  ///< see the head of this file [N m s]
  friend bool operator==(const BodyState&, const BodyState&) = default;
};

template <class T>
struct AssemblyState {
  std::vector<BodyState<T>> bodies;
  std::vector<std::array<T, 3>> coordinates;  ///< by joint; angles count on through whole turns
  VecSum<T> impulse_I;  ///< of loads and gravity about the origin of I, since the start [N m s]
  Sum<T> work;          ///< of motors, dampers and external loads, not gravity [J]
  friend bool operator==(const AssemblyState&, const AssemblyState&) = default;
};

namespace detail {

/// H - (y p_z - z p_y): what is left where x×p is large beside it. In double with the products' own rounding and what
/// the sums carry, so that it is H that sets the digits of Pi_I, not x×p.
template <class T>
T less_moment(const Sum<T>& H, const Sum<T>& y, const Sum<T>& p_z, const Sum<T>& z,
              const Sum<T>& p_y) {
  if constexpr (std::is_same_v<T, double>) {
    const DoubleDouble first = adstar::detail::two_product(y.value, p_z.value);
    const DoubleDouble second = adstar::detail::two_product(z.value, p_y.value);
    const DoubleDouble less = adstar::detail::two_sum(H.value, -first.hi);
    const DoubleDouble more = adstar::detail::two_sum(less.hi, second.hi);
    const double carried =
        (z.value * p_y.carry + z.carry * p_y.value) - (y.value * p_z.carry + y.carry * p_z.value);
    return more.hi + (((less.lo + more.lo) + (second.lo - first.lo)) + (H.carry + carried));
  } else {
    return H.value - (y.value * p_z.value - z.value * p_y.value);
  }
}

}  // namespace detail

/// The body's own angular momentum in I [N m s].
template <class T>
Vec3<T> spin_of(Formulation formulation, const BodyState<T>& body) {
  const auto& [x, q, p, H] = body;
  if (formulation == Formulation::direct_product) {
    return H.value();
  }
  return {detail::less_moment(H.x, x.y, p.z, x.z, p.y),
          detail::less_moment(H.y, x.z, p.x, x.x, p.z),
          detail::less_moment(H.z, x.x, p.y, x.y, p.x)};
}

template <class T>
BodyMotion<T> motion_of(const Body<T>& body, const Vec3<T>& x_I, const Quat<T>& q_IB,
                        const Vec3<T>& p_I, const Vec3<T>& spin_I) {
  const Vec3<T> omega_B = body.rigid.angular_velocity(rotate_inverse(q_IB, spin_I));
  return {x_I, q_IB, (T(1) / body.mass) * p_I, rotate(q_IB, omega_B)};
}

template <class T>
BodyMotion<T> motion_of(const Assembly<T>& assembly, const AssemblyState<T>& state,
                        std::size_t body) {
  const BodyState<T>& own = state.bodies[body];
  return motion_of(assembly.bodies()[body], own.x_I.value(), own.q_IB, own.p_I.value(),
                   spin_of(assembly.options().formulation, own));
}

/// omega_B [rad/s]
template <class T>
Vec3<T> angular_velocity(const Assembly<T>& assembly, const AssemblyState<T>& state,
                         std::size_t body) {
  const BodyMotion<T> motion = motion_of(assembly, state, body);
  return rotate_inverse(motion.q_IB, motion.omega_I);
}

template <class T>
void evaluate(const Assembly<T>& assembly, std::size_t joint,
              const std::vector<BodyMotion<T>>& motions, JointMotion<T>& m) {
  const Joint<T>& of = assembly.joints()[joint];
  evaluate(of, Assembly<T>::motion_of(motions, of.body_a),
           Assembly<T>::motion_of(motions, of.body_b), m);
}

/// Of a body that moves so.
template <class T>
BodyState<T> make_state(const Assembly<T>& assembly, std::size_t of, const BodyMotion<T>& motion) {
  const Body<T>& body = assembly.bodies()[of];
  BodyState<T> own;
  own.q_IB = motion.q_IB;
  own.x_I.add(motion.x_I);
  const Vec3<T> p = body.mass * motion.v_I;
  own.p_I.add(p);
  own.H_I.add(
      rotate(motion.q_IB, body.rigid.momentum(rotate_inverse(motion.q_IB, motion.omega_I))));
  if (assembly.options().formulation == Formulation::se3) {
    own.H_I.add(cross(motion.x_I, p));
  }
  return own;
}

/// The start that the assembly was made with.
template <class T>
AssemblyState<T> make_state(const Assembly<T>& assembly) {
  AssemblyState<T> state;
  for (std::size_t i = 0; i < assembly.bodies().size(); ++i) {
    state.bodies.push_back(make_state(assembly, i, assembly.starts()[i]));
  }
  JointMotion<T> m;
  for (std::size_t j = 0; j < assembly.joints().size(); ++j) {
    evaluate(assembly, j, assembly.starts(), m);
    state.coordinates.push_back(joint_coordinates(assembly.joints()[j].kind, m));
  }
  return state;
}

/// Counts the angles on to the turn nearest to `coordinates`, by joint: a spring that was wound up knows its turns.
template <class T>
void count_from(const Assembly<T>& assembly, AssemblyState<T>& state,
                std::span<const std::array<T, 3>> coordinates) {
  for (std::size_t j = 0; j < state.coordinates.size(); ++j) {
    state.coordinates[j] =
        counted_on(assembly.joints()[j].kind, state.coordinates[j], coordinates[j]);
  }
}

/// Turns the whole about the origin until the first body has this attitude (unit) and rate [rad/s]; coordinates and rates of
/// the joints stay, to round-off. Of a free assembly. Never allocates.
template <class T>
void turn_to(const Assembly<T>& assembly, AssemblyState<T>& state, const Quat<T>& q_IB,
             const Vec3<T>& omega_B) {
  const BodyMotion<T> first = motion_of(assembly, state, 0);
  const Quat<T>& q = first.q_IB;
  const Quat<T> turn = normalised(q_IB * Quat<T>{q.w, -q.x, -q.y, -q.z});
  const Vec3<T> omega_I = rotate(q_IB, omega_B);
  for (std::size_t i = 0; i < state.bodies.size(); ++i) {
    const BodyMotion<T> before = motion_of(assembly, state, i);
    BodyMotion<T> after;
    after.x_I = rotate(turn, before.x_I);
    after.q_IB = i == 0 ? q_IB : normalised(turn * before.q_IB);
    after.v_I =
        rotate(turn, before.v_I - cross(first.omega_I, before.x_I)) + cross(omega_I, after.x_I);
    after.omega_I = rotate(turn, before.omega_I - first.omega_I) + omega_I;
    state.bodies[i] = make_state(assembly, i, after);
  }
}

/// Of the whole, about the origin of I.
template <class T>
struct TotalMomentum {
  VecSum<T> p_I;  ///< [N s]
  VecSum<T> H_I;  ///< [N m s]
};

template <class T>
TotalMomentum<T> total_momentum(const Assembly<T>& assembly, const AssemblyState<T>& state) {
  TotalMomentum<T> total;
  const auto add = [](VecSum<T>& sum, const VecSum<T>& term) {
    sum.add(term.value());
    sum.add(Vec3<T>{term.x.carry, term.y.carry, term.z.carry});
  };
  for (const BodyState<T>& body : state.bodies) {
    add(total.p_I, body.p_I);
    add(total.H_I, body.H_I);
    if (assembly.options().formulation == Formulation::direct_product) {
      total.H_I.add(cross(body.x_I.value(), body.p_I.value()));
    }
  }
  return total;
}

/// The common centre of mass [m].
template <class T>
Vec3<T> centre_of_mass(const Assembly<T>& assembly, const AssemblyState<T>& state) {
  VecSum<T> moment;
  for (std::size_t i = 0; i < state.bodies.size(); ++i) {
    moment.add(assembly.bodies()[i].mass * state.bodies[i].x_I.value());
  }
  return (T(1) / assembly.mass()) * moment.value();
}

/// Moves the origin to the common centre of mass, for loads that push it away; returns by how much [m]. Of a
/// free assembly only, and to round-off: H is then about another point.
template <class T>
Vec3<T> recentre(const Assembly<T>& assembly, AssemblyState<T>& state) {
  const Vec3<T> shift = centre_of_mass(assembly, state);
  for (BodyState<T>& body : state.bodies) {
    body.x_I.add(-shift);
    if (assembly.options().formulation == Formulation::se3) {
      body.H_I.add(-cross(shift, body.p_I.value()));
    }
  }
  return shift;
}

/// Kinetic, of springs and stops, and of uniform gravity [J].
template <class T>
struct Energy {
  T kinetic{}, springs{}, gravity{};
  T total() const { return (kinetic + springs) + gravity; }
};

namespace detail {

template <class T>
void add_energy(const Assembly<T>& assembly, std::size_t of, const BodyMotion<T>& motion,
                Energy<T>& energy) {
  const Body<T>& body = assembly.bodies()[of];
  const Vec3<T> omega_B = rotate_inverse(motion.q_IB, motion.omega_I);
  energy.kinetic = energy.kinetic + T(0.5) * (body.mass * squared_norm(motion.v_I) +
                                              dot(omega_B, body.rigid.momentum(omega_B)));
  energy.gravity = energy.gravity - body.mass * dot(assembly.options().gravity_I, motion.x_I);
}

template <class T>
void add_springs(const Assembly<T>& assembly, const std::vector<std::array<T, 3>>& coordinates,
                 Energy<T>& energy) {
  for (std::size_t j = 0; j < assembly.joints().size(); ++j) {
    const Joint<T>& joint = assembly.joints()[j];
    for (int k = 0; k < shape_of(joint.kind).coordinates; ++k) {
      const auto c = static_cast<std::size_t>(k);
      energy.springs = energy.springs + potential(joint.laws[c], coordinates[j][c]);
    }
  }
}

}  // namespace detail

template <class T>
Energy<T> energy_of(const Assembly<T>& assembly, const std::vector<BodyMotion<T>>& motions,
                    const std::vector<std::array<T, 3>>& coordinates) {
  Energy<T> energy;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    detail::add_energy(assembly, i, motions[i], energy);
  }
  detail::add_springs(assembly, coordinates, energy);
  return energy;
}

/// Never allocates.
template <class T>
Energy<T> energy(const Assembly<T>& assembly, const AssemblyState<T>& state) {
  Energy<T> energy;
  for (std::size_t i = 0; i < state.bodies.size(); ++i) {
    detail::add_energy(assembly, i, motion_of(assembly, state, i), energy);
  }
  detail::add_springs(assembly, state.coordinates, energy);
  return energy;
}

}  // namespace adstar::multibody
