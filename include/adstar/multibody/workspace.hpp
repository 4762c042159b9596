#pragma once
// The memory of a step, made once, and what is worked out at one instant: accelerations and joint loads.

#include <array>
#include <cstddef>
#include <type_traits>
#include <vector>

#include "adstar/multibody/assembly.hpp"
#include "adstar/multibody/elimination.hpp"
#include "adstar/multibody/joint_coordinates.hpp"
#include "adstar/multibody/se3.hpp"
#include "adstar/multibody/state.hpp"

namespace adstar::multibody {

/// On a body at a stage: torques in B and in I, a force in B and in I at the centre of mass.
template <class T>
struct BodyLoad {
  Vec3<T> torque_B, torque_I, force_B, force_I;
};

/// What a load may depend on.
template <class T>
struct LoadStage {
  std::size_t body = 0;
  T time_s{};  ///< since the beginning of the step
  const BodyMotion<T>& motion;
};

/// No loads but gravity. Any callable BodyLoad<T>(const LoadStage<T>&) may stand in its place. Where it says
/// keeps_centre(), the bodies fall together under their common push: each feels its own less its mass's share of all.
struct NoLoad {};

/// Of one joint at one stage: the force on b, its moments as the stages of a and of b gather them, and about the
/// origin of I.
template <class T>
struct JointSlope {
  Vec3<T> force, moment_a, moment_b, moment_I;
};
template <class T>
struct LoadSlope {
  Vec3<T> force, moment, moment_I;
};

/// A BodyLoad in I.
template <class T>
struct GivenLoad {
  Vec3<T> moment, push;
};

inline constexpr std::size_t kMostStages = 12;

template <class T>
struct Workspace {
  explicit Workspace(const Assembly<T>& assembly)
      : elimination(assembly.topology(), assembly.joints(), assembly.loop_rows()),
        motions(assembly.bodies().size()),
        spins(motions.size()),
        start_velocities(motions.size()),
        start_spins(motions.size()),
        offsets(motions.size()),
        masses(motions.size()),
        given(motions.size()),
        accelerations(motions.size()),
        joints(assembly.joints().size()),
        coordinates(joints.size()),
        active(joints.size()),
        gamma(joints.size()),
        lambda(joints.size()),
        loads(joints.size()),
        xi_slopes(kMostStages * motions.size()),
        load_slopes(kMostStages * motions.size()),
        joint_slopes(kMostStages * joints.size()),
        before(make_state(assembly)) {
    for (const Joint<T>& joint : assembly.joints()) {
      for (const CoordinateLaw<T>& law : joint.laws) {
        has_laws = has_laws || law.stops || law.stiffness > T(0) || law.damping > T(0);
      }
    }
  }

  Elimination<T> elimination;
  std::vector<BodyMotion<T>> motions;
  std::vector<Vec3<T>> spins;                          ///< Pi_I
  std::vector<Vec3<T>> start_velocities, start_spins;  ///< at the beginning of the step
  std::vector<Vec3<T>> offsets;  ///< y of advance.hpp, zero in the direct product
  std::vector<MassBlock<T>> masses;
  std::vector<GivenLoad<T>> given;        ///< of the stage
  std::vector<Spatial<T>> accelerations;  ///< forces before solve(), (omega_I', v_I') after
  std::vector<JointMotion<T>> joints;
  std::vector<std::array<T, 3>> coordinates;
  std::vector<ActiveWrench<T>> active;  ///< springs, dampers, motors
  std::vector<std::array<T, 6>> gamma, lambda;
  std::vector<PointWrench<T>> loads;  ///< constraints and active ones: on b at c

  // By stage, then body or joint.
  std::vector<Twist<T>> xi_slopes;
  std::vector<LoadSlope<T>> load_slopes;
  std::vector<JointSlope<T>> joint_slopes;
  std::array<T, kMostStages> power{};

  bool has_laws = false;  ///< springs, dampers or stops

  AssemblyState<T> before;  ///< to go back to, when a step has to be taken in more parts
};

namespace detail {

/// R J Rᵀ
template <class T>
Sym3<T> turned_inertia(const Quat<T>& q, const Sym3<T>& J) {
  const Vec3<T> x = rotate(q, Vec3<T>{T(1), T(0), T(0)});
  const Vec3<T> y = rotate(q, Vec3<T>{T(0), T(1), T(0)});
  const Vec3<T> z = rotate(q, Vec3<T>{T(0), T(0), T(1)});
  const Vec3<T> a = J.xx * x + J.xy * y + J.xz * z;  // R J: its columns
  const Vec3<T> b = J.xy * x + J.yy * y + J.yz * z;
  const Vec3<T> c = J.xz * x + J.yz * y + J.zz * z;
  const auto entry = [&](T Vec3<T>::*r, T Vec3<T>::*s) {
    return a.*r * x.*s + b.*r * y.*s + c.*r * z.*s;
  };
  return {entry(&Vec3<T>::x, &Vec3<T>::x), entry(&Vec3<T>::y, &Vec3<T>::y),
          entry(&Vec3<T>::z, &Vec3<T>::z), entry(&Vec3<T>::x, &Vec3<T>::y),
          entry(&Vec3<T>::x, &Vec3<T>::z), entry(&Vec3<T>::y, &Vec3<T>::z)};
}

/// Motions and spins of the state itself.
template <class T>
void read_state(const Assembly<T>& assembly, const AssemblyState<T>& state, Workspace<T>& work) {
  for (std::size_t i = 0; i < state.bodies.size(); ++i) {
    const BodyState<T>& own = state.bodies[i];
    work.spins[i] = spin_of(assembly.options().formulation, own);
    work.motions[i] =
        motion_of(assembly.bodies()[i], own.x_I.value(), own.q_IB, own.p_I.value(), work.spins[i]);
  }
}

template <class T>
void evaluate_joints(const Assembly<T>& assembly, Workspace<T>& work) {
  for (std::size_t j = 0; j < work.joints.size(); ++j) {
    evaluate(assembly, j, work.motions, work.joints[j]);
  }
}

/// M and C at the motions, factored; how many loop rows hold nothing there.
template <class T>
int factor(const Assembly<T>& assembly, Workspace<T>& work) {
  for (std::size_t i = 0; i < work.motions.size(); ++i) {
    const Body<T>& body = assembly.bodies()[i];
    work.masses[i] = {turned_inertia(work.motions[i].q_IB, body.rigid.inertia()), body.mass};
  }
  for (std::size_t j = 0; j < work.joints.size(); ++j) {
    jacobian_block(work.joints[j], work.joints[j].s, T(-1), work.elimination.jacobians()[j].a);
    jacobian_block(work.joints[j], work.joints[j].r, T(1), work.elimination.jacobians()[j].b);
  }
  return work.elimination.factor(work.masses);
}

/// f += the wrench on b, and its opposite on a, about their centres of mass.
template <class T>
void add_wrench(const Joint<T>& joint, const JointMotion<T>& m, const PointWrench<T>& wrench,
                std::vector<Spatial<T>>& f) {
  const auto add = [&](int body, const Vec3<T>& lever, const T& sign) {
    if (body == kGround) {
      return;
    }
    Spatial<T>& own = f[static_cast<std::size_t>(body)];
    const Vec3<T> moment = sign * (cross(lever, wrench.force) + wrench.couple);
    const Vec3<T> force = sign * wrench.force;
    own = {own[0] + moment.x, own[1] + moment.y, own[2] + moment.z,
           own[3] + force.x,  own[4] + force.y,  own[5] + force.z};
  };
  add(joint.body_a, m.s, T(-1));
  add(joint.body_b, m.r, T(1));
}

/// Coordinates at the motions, counted on from `last`; needs work.joints.
template <class T>
std::array<T, 3> coordinates_near(const Joint<T>& joint, const JointMotion<T>& m,
                                  const std::array<T, 3>& last) {
  return counted_on(joint.kind, joint_coordinates(joint.kind, m), last);
}

/// Asks for the loads, into work.given; what they have in common where they keep the centre, else zero.
template <class T, class Load>
Vec3<T> common_acceleration(const Assembly<T>& assembly, Workspace<T>& work, const Load& load,
                            const T& time_s) {
  Vec3<T> all{};
  if constexpr (!std::is_same_v<Load, NoLoad>) {
    for (std::size_t i = 0; i < work.motions.size(); ++i) {
      const BodyMotion<T>& motion = work.motions[i];
      const BodyLoad<T> given = load(LoadStage<T>{i, time_s, motion});
      work.given[i] = {rotate(motion.q_IB, given.torque_B) + given.torque_I,
                       rotate(motion.q_IB, given.force_B) + given.force_I};
      all = all + work.given[i].push;
    }
    if constexpr (requires { load.keeps_centre(); }) {
      return load.keeps_centre() ? (T(1) / assembly.mass()) * all : Vec3<T>{};
    }
  }
  return {};
}

/// Everything at work.motions: joints, loads, accelerations. `last`: coordinates nearby; `motors`: by joint, or
/// null; `slopes`: of the stage, or null; `power` gets the work of motors, dampers and loads.
template <class T, class Load>
int solve_accelerations(const Assembly<T>& assembly, Workspace<T>& work,
                        const std::vector<std::array<T, 3>>& last, const std::array<T, 3>* motors,
                        const Load& load, const T& time_s, LoadSlope<T>* slopes, T& power) {
  power = T(0);
  evaluate_joints(assembly, work);
  const int lost = factor(assembly, work);
  const Vec3<T> common = common_acceleration(assembly, work, load, time_s);
  for (std::size_t i = 0; i < work.motions.size(); ++i) {
    const BodyMotion<T>& motion = work.motions[i];
    Vec3<T> force = assembly.bodies()[i].mass * assembly.options().gravity_I, moment{};
    if constexpr (!std::is_same_v<Load, NoLoad>) {
      moment = work.given[i].moment;
      const Vec3<T> push = work.given[i].push - assembly.bodies()[i].mass * common;
      force = force + push;
      power = power + (dot(moment, motion.omega_I) + dot(push, motion.v_I));
    }
    if (slopes != nullptr) {
      slopes[i] = {force, moment + cross(work.offsets[i], force),
                   moment + cross(motion.x_I, force)};
    }
    const Vec3<T> gyroscopic = moment - cross(motion.omega_I, work.spins[i]);
    work.accelerations[i] = {gyroscopic.x, gyroscopic.y, gyroscopic.z, force.x, force.y, force.z};
  }
  for (std::size_t j = 0; j < work.joints.size(); ++j) {
    const Joint<T>& joint = assembly.joints()[j];
    const JointMotion<T>& m = work.joints[j];
    work.coordinates[j] = coordinates_near(joint, m, last[j]);
    work.gamma[j] = m.gamma;
    work.active[j] = active_wrench(joint, m, work.coordinates[j], joint_rates(joint.kind, m),
                                   motors == nullptr ? nullptr : motors[j].data());
    power = power + work.active[j].power;
    add_wrench(joint, m, work.active[j].wrench, work.accelerations);
  }
  work.elimination.solve(work.accelerations, work.gamma, work.lambda);
  for (std::size_t j = 0; j < work.joints.size(); ++j) {
    const PointWrench<T> held = constraint_wrench(work.joints[j], work.lambda[j]);
    work.loads[j] = {held.force + work.active[j].wrench.force,
                     held.couple + work.active[j].wrench.couple};
  }
  return lost;
}

}  // namespace detail

/// Fills the workspace at the state: accelerations, coordinates, joint loads (constraint and active together).
template <class T, class Load = NoLoad>
void observe(const Assembly<T>& assembly, Workspace<T>& work, const AssemblyState<T>& state,
             std::type_identity_t<const std::array<T, 3>*> motors = nullptr,
             const Load& load = {}) noexcept {
  detail::read_state(assembly, state, work);
  T power{};
  detail::solve_accelerations(assembly, work, state.coordinates, motors, load, T(0),
                              static_cast<LoadSlope<T>*>(nullptr), power);
}

}  // namespace adstar::multibody
