#pragma once
// After a step: joints are closed, then their rates are stopped, by internal impulses at the points of action.
//
//   positions:  M δ = Cᵀ ν, C δ = -Φ;  x += δx, R := exp(δθ) R       (Newton, the least δ in the metric M)
//   velocities: M δ = Cᵀ μ, C δ = -C v;  each joint's impulse Cᵀ μ on b, its opposite on a
// One factorisation serves both: the corrections are the size of a step's error, and what a Jacobian from beside
// leaves is of second order and taken by the next round; where a round hardly helps, the joints are factored anew.
// (H, p) of se3 and p of the direct product do not see the first, and the second cancels in pairs, so both totals
// stay. Rounds end when they no longer gain.

#include <algorithm>
#include <cstddef>
#include <limits>

#include "adstar/multibody/workspace.hpp"
#include "adstar/so3.hpp"

namespace adstar::multibody {

inline constexpr int kMostRounds = 6;
/// A residual above this that a round hardly lessens is not round-off: the Jacobian is taken anew.
inline constexpr double kRoundOff = 1e-12;
/// A gap of this many roundings is none. With 16 what is left open is of one sign for long: four times the error of a
/// pendulum at round-off.
inline constexpr double kClosedUlps = 4;

namespace detail {

enum class Residual { gap, rate };

/// The largest gap or rate in its own scale, and gamma := -gap or -rate.
template <class T>
T ask_for(Residual which, const Assembly<T>& assembly, Workspace<T>& work) {
  using std::abs;
  using std::max;
  T worst{};
  bool finite = true;
  for (std::size_t j = 0; j < work.joints.size(); ++j) {
    const Joint<T>& joint = assembly.joints()[j];
    const JointMotion<T>& m = work.joints[j];
    const BodyMotion<T>& a = Assembly<T>::motion_of(work.motions, joint.body_a);
    const BodyMotion<T>& b = Assembly<T>::motion_of(work.motions, joint.body_b);
    const bool gap = which == Residual::gap;
    const T tiny = std::numeric_limits<T>::min();
    const T along = (gap ? length_scale(m, a, b) : speed_scale(m, a, b)) + tiny;
    const T about = gap ? T(1) : (norm(a.omega_I) + norm(b.omega_I)) + tiny;
    for (int k = 0; k < m.shape.rows(); ++k) {
      const auto i = static_cast<std::size_t>(k);
      const T value = gap ? m.gap[i] : m.rate[i];
      work.gamma[j][i] = -value;
      const T share = abs(value) / (k < m.shape.translations ? along : about);
      worst = max(worst, share);
      finite = finite && share - share == T(0);
    }
  }
  return finite ? worst : std::numeric_limits<T>::quiet_NaN();
}

template <class T>
void solve_for_impulses(Workspace<T>& work) {
  for (Spatial<T>& each : work.accelerations) {
    each = {};
  }
  work.elimination.solve(work.accelerations, work.gamma, work.lambda);
}

template <class T>
void move_bodies(AssemblyState<T>& state, const Workspace<T>& work) {
  for (std::size_t i = 0; i < state.bodies.size(); ++i) {
    const Spatial<T>& delta = work.accelerations[i];
    BodyState<T>& body = state.bodies[i];
    body.x_I.add(Vec3<T>{delta[3], delta[4], delta[5]});
    const Rotation<T> turn(Vec3<T>{delta[0], delta[1], delta[2]});
    body.q_IB = renormalised(turn.quaternion() * body.q_IB);
  }
}

/// On b, and its opposite on a, in their sums; the moments about what H of each body is about.
template <class T>
void push_apart(const Joint<T>& joint, const Vec3<T>& force, const Vec3<T>& moment_a,
                const Vec3<T>& moment_b, AssemblyState<T>& state) {
  if (joint.body_b != kGround) {
    BodyState<T>& b = state.bodies[static_cast<std::size_t>(joint.body_b)];
    b.p_I.add(force);
    b.H_I.add(moment_b);
  }
  if (joint.body_a != kGround) {
    BodyState<T>& a = state.bodies[static_cast<std::size_t>(joint.body_a)];
    a.p_I.add(-force);
    a.H_I.add(-moment_a);
  }
}

template <class T>
void push_apart(const Assembly<T>& assembly, std::size_t joint, const JointMotion<T>& m,
                const PointWrench<T>& impulse, AssemblyState<T>& state) {
  const bool se3 = assembly.options().formulation == Formulation::se3;
  const Vec3<T> moment_a = cross(se3 ? m.c : m.s, impulse.force) + impulse.couple;
  const Vec3<T> moment_b = cross(se3 ? m.c : m.r, impulse.force) + impulse.couple;
  push_apart(assembly.joints()[joint], impulse.force, moment_a, moment_b, state);
}

/// Rounds of one kind, beginning and ending with the workspace at the state; returns the residual that is left.
template <class T>
T close(Residual which, const Assembly<T>& assembly, AssemblyState<T>& state, Workspace<T>& work,
        int& lost) {
  T before = std::numeric_limits<T>::max();
  for (int round = 0;; ++round) {
    const T worst = ask_for(which, assembly, work);
    const bool done = worst <= T(kClosedUlps) * std::numeric_limits<T>::epsilon();
    const bool slow = round > 0 && !(worst <= T(0.01) * before);
    const bool from_beside = slow && worst > T(kRoundOff);
    if (done || round == kMostRounds || !(from_beside || worst <= T(0.5) * before)) {
      return worst;
    }
    if (from_beside) {
      lost = std::max(lost, factor(assembly, work));
    }
    before = worst;
    solve_for_impulses(work);
    if (which == Residual::gap) {
      move_bodies(state, work);
    } else {
      for (std::size_t j = 0; j < work.joints.size(); ++j) {
        push_apart(assembly, j, work.joints[j], constraint_wrench(work.joints[j], work.lambda[j]),
                   state);
      }
    }
    read_state(assembly, state, work);
    evaluate_joints(assembly, work);
  }
}

}  // namespace detail

/// What a projection left open, in the scales above; `lost`: loop rows that held nothing.
template <class T>
struct ProjectionReport {
  T gap{}, rate{};
  int lost = 0;
};

/// Never allocates, never throws.
template <class T>
ProjectionReport<T> project(const Assembly<T>& assembly, Workspace<T>& work,
                            AssemblyState<T>& state) noexcept {
  ProjectionReport<T> report;
  detail::read_state(assembly, state, work);
  detail::evaluate_joints(assembly, work);
  report.lost = detail::factor(assembly, work);
  report.gap = detail::close(detail::Residual::gap, assembly, state, work, report.lost);
  report.rate = detail::close(detail::Residual::rate, assembly, state, work, report.lost);
  return report;
}

}  // namespace adstar::multibody
