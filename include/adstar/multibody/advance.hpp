#pragma once
// One step of an assembly, over any explicit Runge-Kutta tableau.
//
// Within a step each body is seen from a frame of its own that moves on at the velocity v_n which the body has at its
// beginning: x = x_n + v_n t + y, p = m v_n + π. Then from zero (Terze, Müller, Zlatar, eq. 3 to 7, for SE(3); Iserles,
// Munthe-Kaas, Nørsett, Zanna 2000; the moving frame is ours)
//   se3:            xi' = dexpinv(-xi, (omega_B, Rᵀ π/m)),  (R, y) = (R_n, 0) exp(xi),   π' = F_i,
//                   K' = (c - x_n - v_n t)×F + T,           Pi_I = Pi_n + K - y×π          (the coadjoint action)
//   direct_product: psi' = dexpinv(-psi, omega_B),          y' = π/m, R = R_n exp(psi),  π' = F_i
//                   K' = (c - x)×F + T,                     Pi_I = Pi_n + K
// F, T of each joint (and loads) from the index-1 system at every stage, F_i the force on body i. About a fixed origin y
// and π would be as large as x and p, and an error of a stage's x would turn the body by δx×p: the same order, at four
// times the error on four tumbling bodies. At the end
//   se3:            H += h Σ b (c×F + T),    p += h Σ b F
//   direct_product: H += h Σ b K',           p += h Σ b F
// The sum over the stages is taken joint by joint and put on b and, negated, on a: in se3 both totals are exact
// for any tableau, to the rounding of compensated sums. Then joints are projected (projection.hpp).
//
// How many parts. From the rates at the start, and from springs and dampers:
//   h |omega| ≤ angle,   h √λ ≤ 1,   h c ≤ decay_limit,   λ, c ≤ 2 max over bodies of Σ k (1/mass seen by k)
// (K ≤ 2 × its blocks on the diagonal; joints only make masses heavier: sound for unprojected motion). No bound on
// the rates *within* the step is sharp for linked bodies, so the step is watched instead: when a part
// turned a body further than the limit, or a stage twice as far, or the projection did not close the joints, or the
// step's E - E_0 - W is more than a share of the energy at play, the step is taken again in twice the parts, up to
// the limit of parts. Past it the report says so. The balance is what sees a light body among heavy ones: an error δx of a
// stage turns it at δx×p/J_min.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "adstar/integrators/coadjoint.hpp"
#include "adstar/integrators/guard.hpp"
#include "adstar/integrators/stage_weights.hpp"
#include "adstar/multibody/fast_rates.hpp"
#include "adstar/multibody/projection.hpp"
#include "adstar/multibody/se3.hpp"
#include "adstar/multibody/workspace.hpp"
#include "adstar/torques/frame.hpp"

namespace adstar::multibody {

/// What a step has to say. Unresolved: the result is not to be trusted to the scheme's order.
template <class T>
struct AssemblyReport {
  std::int64_t parts = 0;             ///< steps of the scheme, of the attempt that counts
  bool unresolved_angle = false;      ///< a body turns too far for the limit of parts
  bool unresolved_gap = false;        ///< joints, or their rates, stayed open
  bool unresolved_stiffness = false;  ///< springs or dampers too stiff for the limit of parts
  bool out_of_balance =
      false;  ///< what unresolved_angle speaks of where it is not the turn: energy and work
              ///< do not balance, errors grow in a light body
  bool at_dead_point = false;  ///< a loop's rows depend on one another here: loads not unique
  bool lost = false;           ///< no finite result: the state is as it was before the step
  T gap{}, gap_rate{};         ///< left after projection, by size and speed of the joint

  bool resolved() const {
    return !unresolved_angle && !unresolved_gap && !unresolved_stiffness && !at_dead_point && !lost;
  }
};

struct AssemblyLimits {
  double substep_angle_rad = 0;  ///< of a body in a part of a step; 0: that of the coadjoint scheme
  std::int64_t substeps = 64;
  double gap = 1e-10;    ///< what a projection may leave, by size of the joint
  double energy = 1e-4;  ///< |E - E_0 - W| of a step, by the energy at play; 0: not looked at
  bool project = true;
};

namespace detail {

/// Σ weights[l] k_l over the stages before `count`, of a member of the slopes.
template <class T, class Slope, class Weights>
Vec3<T> weighted(const T& h, const Weights& weights, std::size_t count,
                 const std::vector<Slope>& slopes, std::size_t stride, std::size_t at,
                 Vec3<T> Slope::*member) {
  Vec3<T> sum{};
  for (std::size_t l = 0; l < count; ++l) {
    sum = sum + (h * weights[l]) * (slopes[l * stride + at].*member);
  }
  return sum;
}

/// Bodies at stage s: their motions from the slopes before it, and the slope of xi.
template <class Tableau, class T>
void move_to_stage(const Assembly<T>& assembly, const AssemblyState<T>& state, Workspace<T>& work,
                   std::size_t s, const T& h, T& farthest) {
  const auto& weights = adstar::detail::kStageWeights<Tableau, T>;
  const auto& a = weights.a[s];
  const bool se3 = assembly.options().formulation == Formulation::se3;
  const std::size_t bodies = state.bodies.size(), joints = work.joints.size();
  // π and K gather where velocities and spins will be.
  for (std::size_t i = 0; i < bodies; ++i) {
    const auto sum = [&](Vec3<T> LoadSlope<T>::*member) {
      return weighted(h, a, s, work.load_slopes, bodies, i, member);
    };
    work.motions[i].v_I = sum(&LoadSlope<T>::force);
    work.spins[i] = sum(&LoadSlope<T>::moment);
  }
  for (std::size_t j = 0; j < joints; ++j) {
    const auto sum = [&](Vec3<T> JointSlope<T>::*member) {
      return weighted(h, a, s, work.joint_slopes, joints, j, member);
    };
    const Joint<T>& joint = assembly.joints()[j];
    const Vec3<T> force = sum(&JointSlope<T>::force);
    if (joint.body_b != kGround) {
      const auto b = static_cast<std::size_t>(joint.body_b);
      work.motions[b].v_I = work.motions[b].v_I + force;
      work.spins[b] = work.spins[b] + sum(&JointSlope<T>::moment_b);
    }
    if (joint.body_a != kGround) {
      const auto b = static_cast<std::size_t>(joint.body_a);
      work.motions[b].v_I = work.motions[b].v_I - force;
      work.spins[b] = work.spins[b] - sum(&JointSlope<T>::moment_a);
    }
  }
  const T t = weights.c[s] * h;
  for (std::size_t i = 0; i < bodies; ++i) {
    const Body<T>& body = assembly.bodies()[i];
    const Twist<T> xi{weighted(h, a, s, work.xi_slopes, bodies, i, &Twist<T>::angular),
                      weighted(h, a, s, work.xi_slopes, bodies, i, &Twist<T>::linear)};
    const Rotation<T> turn(xi.angular);
    // A turn of a stage counts half: it may go twice as far as the step.
    farthest = std::max(farthest, T(0.25) * turn.squared_angle());
    const Quat<T>& q_n = state.bodies[i].q_IB;
    BodyMotion<T>& motion = work.motions[i];
    const Vec3<T> pi = motion.v_I, w = (T(1) / body.mass) * pi;
    const Vec3<T> y = se3 ? rotate(q_n, exp_translation(turn, xi.linear)) : xi.linear;
    work.offsets[i] = se3 ? y : Vec3<T>{};
    work.spins[i] = work.start_spins[i] + (work.spins[i] - cross(work.offsets[i], pi));
    motion.x_I = state.bodies[i].x_I.value() + (t * work.start_velocities[i] + y);
    motion.q_IB = renormalised(q_n * turn.quaternion());
    motion.v_I = work.start_velocities[i] + w;
    const Vec3<T> omega_B = body.rigid.angular_velocity(rotate_inverse(motion.q_IB, work.spins[i]));
    motion.omega_I = rotate(motion.q_IB, omega_B);
    work.xi_slopes[s * bodies + i] =
        se3 ? dexpinv_minus(xi, Twist<T>{omega_B, rotate_inverse(motion.q_IB, w)})
            : Twist<T>{turn.dexpinv_minus(omega_B), w};
  }
}

/// The state over the step, from the slopes of all stages.
template <class Tableau, class T>
void finish(const Assembly<T>& assembly, AssemblyState<T>& state, Workspace<T>& work, const T& h,
            T& farthest) {
  const auto& b = adstar::detail::kStageWeights<Tableau, T>.b;
  const bool se3 = assembly.options().formulation == Formulation::se3;
  const std::size_t bodies = state.bodies.size(), joints = work.joints.size();
  constexpr std::size_t kStages = Tableau::kStages;
  for (std::size_t i = 0; i < bodies; ++i) {
    const auto sum = [&](const auto& slopes, auto member) {
      return weighted(h, b, kStages, slopes, bodies, i, member);
    };
    BodyState<T>& body = state.bodies[i];
    const Rotation<T> turn(sum(work.xi_slopes, &Twist<T>::angular));
    const Vec3<T> rho = sum(work.xi_slopes, &Twist<T>::linear);
    farthest = std::max(farthest, turn.squared_angle());
    body.x_I.add(h * work.start_velocities[i] +
                 (se3 ? rotate(body.q_IB, exp_translation(turn, rho)) : rho));
    body.q_IB = renormalised(body.q_IB * turn.quaternion());
    body.p_I.add(sum(work.load_slopes, &LoadSlope<T>::force));
    const Vec3<T> impulse = sum(work.load_slopes, &LoadSlope<T>::moment_I);
    body.H_I.add(se3 ? impulse : sum(work.load_slopes, &LoadSlope<T>::moment));
    state.impulse_I.add(impulse);
  }
  for (std::size_t j = 0; j < joints; ++j) {
    const auto sum = [&](Vec3<T> JointSlope<T>::*member) {
      return weighted(h, b, kStages, work.joint_slopes, joints, j, member);
    };
    const Vec3<T> force = sum(&JointSlope<T>::force);
    if (se3) {
      const Vec3<T> moment = sum(&JointSlope<T>::moment_I);
      push_apart(assembly.joints()[j], force, moment, moment, state);
    } else {
      push_apart(assembly.joints()[j], force, sum(&JointSlope<T>::moment_a),
                 sum(&JointSlope<T>::moment_b), state);
    }
  }
  T done{};
  for (std::size_t l = 0; l < kStages; ++l) {
    done = done + b[l] * work.power[l];
  }
  state.work.add(h * done);
}

/// Of the stage that was just solved: moments about where y = 0 of each body is, and about the origin.
template <class T>
void take_slopes(const Assembly<T>& assembly, Workspace<T>& work, std::size_t s) {
  const std::size_t joints = work.joints.size();
  const auto lever = [&](int body, const Vec3<T>& from_centre) {
    return body == kGround ? from_centre
                           : from_centre + work.offsets[static_cast<std::size_t>(body)];
  };
  for (std::size_t j = 0; j < joints; ++j) {
    const Joint<T>& joint = assembly.joints()[j];
    const JointMotion<T>& m = work.joints[j];
    const auto& [force, couple] = work.loads[j];
    work.joint_slopes[s * joints + j] = {force, cross(lever(joint.body_a, m.s), force) + couple,
                                         cross(lever(joint.body_b, m.r), force) + couple,
                                         cross(m.c, force) + couple};
  }
}

/// One step of the scheme; the largest squared angle that a body turned, a stage's counted by a quarter.
template <class Tableau, class T, class Load>
T step(const Assembly<T>& assembly, Workspace<T>& work, AssemblyState<T>& state, const T& h,
       const std::array<T, 3>* motors, const Load& load, const T& since, int& lost) {
  static_assert(Tableau::kStages <= kMostStages);
  const auto& c = adstar::detail::kStageWeights<Tableau, T>.c;
  const std::size_t bodies = state.bodies.size();
  read_state(assembly, state, work);
  for (std::size_t i = 0; i < bodies; ++i) {
    work.start_velocities[i] = work.motions[i].v_I;
    work.start_spins[i] = work.spins[i];
  }
  T farthest{};
  for (std::size_t s = 0; s < static_cast<std::size_t>(Tableau::kStages); ++s) {
    move_to_stage<Tableau>(assembly, state, work, s, h, farthest);
    lost = std::max(
        lost, solve_accelerations(assembly, work, state.coordinates, motors, load, since + c[s] * h,
                                  &work.load_slopes[s * bodies], work.power[s]));
    take_slopes(assembly, work, s);
  }
  finish<Tableau>(assembly, state, work, h, farthest);
  return farthest;
}

/// Coordinates at work.joints, counted on.
template <class T>
void count_on(const Assembly<T>& assembly, const Workspace<T>& work, AssemblyState<T>& state) {
  for (std::size_t j = 0; j < work.joints.size(); ++j) {
    state.coordinates[j] =
        coordinates_near(assembly.joints()[j], work.joints[j], state.coordinates[j]);
  }
}

template <class T>
bool finite(const AssemblyState<T>& state) {
  for (const BodyState<T>& body : state.bodies) {
    const T q2 = squared_norm(body.q_IB);
    if (!finite(body.x_I.value()) || !finite(body.p_I.value()) || !finite(body.H_I.value()) ||
        !(q2 > T(0.5) && q2 < T(2))) {
      return false;
    }
  }
  return true;
}

/// |E - E_0 - W| against a share of what is in motion or in springs, or went into height or work; round-off of height
/// itself; and `least`.
template <class T>
bool balances(const Energy<T>& E_0, const Energy<T>& E, const T& W, const T& share,
              const T& least) {
  using std::abs;
  const T stored = (E_0.kinetic + E.kinetic) + (E_0.springs + E.springs);
  const T scale = stored + (abs(E.gravity - E_0.gravity) + abs(W));
  const T round_off = T(1000) * std::numeric_limits<T>::epsilon() * (stored + abs(E.gravity));
  return abs((E.total() - E_0.total()) - W) <= share * scale + (round_off + least);
}

/// The energy of turning about the origin by 1e-12 rad a step: what has come to rest is round-off below it.
template <class T>
T energy_at_rest(const Assembly<T>& assembly, const std::vector<BodyMotion<T>>& motions,
                 const T& h) {
  T inertia{};
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const Body<T>& body = assembly.bodies()[i];
    inertia = inertia + (body.mass * squared_norm(motions[i].x_I) + body.rigid.moments()[2]);
  }
  const T rate = T(1e-12) / h;
  return T(0.5) * (inertia * (rate * rate));
}

}  // namespace detail

/// Advances `state` by h_ns [ns]. `motors`: by joint and free coordinate, constant over the step [N m] or [N], or
/// null. A load that damps says how fast, in decay() [1/s]. Never throws, never allocates.
template <class Tableau, class T, class Load = NoLoad>
AssemblyReport<T> advance(const Assembly<T>& assembly, Workspace<T>& work, AssemblyState<T>& state,
                          std::int64_t h_ns,
                          std::type_identity_t<const std::array<T, 3>*> motors = nullptr,
                          const Load& load = {}, const AssemblyLimits& limits = {}) noexcept {
  using std::ceil;
  using std::max;
  const T length = seconds<T>(h_ns);
  const T angle = limits.substep_angle_rad > 0 ? T(limits.substep_angle_rad)
                                               : T(Coadjoint<Tableau>::kSubstepAngleRad);
  AssemblyReport<T> report;
  detail::read_state(assembly, state, work);
  T fastest{};
  for (const BodyMotion<T>& motion : work.motions) {
    fastest = max(fastest, norm(motion.omega_I));
  }
  detail::FastRates<T> rates;
  if (work.has_laws) {
    detail::evaluate_joints(assembly, work);
    work.coordinates = state.coordinates;
    rates = detail::fast_rates(assembly, work, length);
  }
  if constexpr (requires { load.decay(); }) {
    rates.decay = rates.decay + load.decay();
  }
  const T stiff = length * max(rates.oscillation, rates.decay / T(decay_limit(Tableau::kOrder)));
  const T wanted = ceil(max(max(T(1), length * fastest / angle), stiff));
  const T most = T(limits.substeps);
  report.unresolved_stiffness = !(stiff <= most);
  std::int64_t parts =
      wanted <= most ? static_cast<std::int64_t>(wanted) : limits.substeps;  // also NaN
  work.before = state;
  const Energy<T> E_0 = energy_of(assembly, work.motions, state.coordinates);
  const T least = detail::energy_at_rest(assembly, work.motions, length);
  for (;; parts = std::min(2 * parts, limits.substeps)) {
    const T h = length / T(parts);
    report.parts = parts;
    report.gap = report.gap_rate = T(0);
    int lost = 0;
    bool turned_too_far = false, open = false;
    for (std::int64_t i = 0; i < parts; ++i) {
      const T farthest =
          detail::step<Tableau>(assembly, work, state, h, motors, load, T(i) * h, lost);
      turned_too_far = turned_too_far || !(farthest <= angle * angle);
      if (limits.project) {
        const ProjectionReport<T> closed = project(assembly, work, state);
        report.gap = max(report.gap, closed.gap);
        report.gap_rate = max(report.gap_rate, closed.rate);
        lost = max(lost, closed.lost);
        open = open || !(closed.gap <= T(limits.gap)) || !(closed.rate <= T(limits.gap));
      } else {
        detail::read_state(assembly, state, work);
        detail::evaluate_joints(assembly, work);
      }
      detail::count_on(assembly, work, state);
    }
    report.lost = !detail::finite(state);
    report.unresolved_gap = open;
    report.at_dead_point = lost > 0;
    const T W =
        (state.work.value - work.before.work.value) + (state.work.carry - work.before.work.carry);
    report.out_of_balance =
        limits.energy > 0 &&
        !detail::balances(E_0, energy_of(assembly, work.motions, state.coordinates), W,
                          T(limits.energy), least);
    report.unresolved_angle = turned_too_far || report.out_of_balance;
    if ((!report.unresolved_angle && !open && !report.lost) || parts == limits.substeps) {
      break;
    }
    state = work.before;
  }
  if (report.lost) {
    state = work.before;
  }
  return report;
}

}  // namespace adstar::multibody
