#pragma once
// One step of one spacecraft: the step is split where a torque has an edge, each smooth segment is
// split until the scheme can follow the motion (guard.hpp), and each part takes the cheapest form of
// the scheme's step: free, constant in the body, of time, of the attitude too, or of the rate too.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <variant>

#include "adstar/integrators/all.hpp"
#include "adstar/integrators/guard.hpp"
#include "adstar/segment.hpp"
#include "adstar/state.hpp"
#include "adstar/torques/all.hpp"

namespace adstar {

/// What a step has to say. Unresolved: the result is not to be trusted to the scheme's order.
struct StepReport {
  std::int64_t parts = 0;         ///< steps of the scheme that were taken
  bool unresolved_angle = false;  ///< the sub-step limit does not let it follow the turn
  bool unresolved_edges =
      false;  ///< more torque edges than the edge limit; those past it fell inside a segment
  bool unresolved_damping = false;  ///< too stiff for the sub-step limit

  /// What unresolved_angle speaks of where it is not the turn alone: errors that leak into the lightest
  /// axis, or grow beside the separatrix, or an attitude that the scheme did not find within its limits.
  bool at_light_axis = false, at_separatrix = false, attitude_lost = false;

  bool resolved() const { return !unresolved_angle && !unresolved_edges && !unresolved_damping; }
};

namespace detail {

/// One step of the scheme; false when it could not follow the motion into a unit quaternion: then the
/// attitude stays as it was, and H_I has taken its impulse all the same.
template <class Scheme, class AnyBody, class T, class StepTorque>
[[gnu::always_inline]] inline bool follow(const AnyBody& body, State<T>& state, const T& h,
                                          const StepTorque& torque) {
  const Quat<T> q_before{state.q_IB.w, state.q_IB.x, state.q_IB.y, state.q_IB.z};
  Scheme::step(body, state, h, torque);
  const T q_squared = squared_norm(state.q_IB);
  if (q_squared > T(0.5) && q_squared < T(2)) {
    return true;
  }
  state.q_IB = q_before;
  return false;
}

/// A scheme of many stages: each form of its step takes long to compile, and what a special form saves is
/// little beside its stages, so it has the free one, the one of body torques, and the general one.
template <class Scheme>
constexpr bool has_many_stages() {
  constexpr bool kSplitting = requires { Scheme::kFreeOrder; };
  return Scheme::kOrder > 4 && !kSplitting;
}

/// run_segment() in the general form: any torque, one that looks at the attitude or at omega_B too. Out of line:
/// a scene without those does not pay for it.
template <class Scheme, class T>
[[gnu::noinline]] bool run_general(const BodyOf<Scheme, T>& body, State<T>& state,
                                   std::span<const Torque<T>> torques, const Segment<T>& segment,
                                   std::int64_t t_ns, const T& length_s, std::int64_t parts) {
  const T h = length_s / T(parts);
  const T t_s = seconds<T>(t_ns);
  bool all = true;
  for (std::int64_t i = 0; i < parts; ++i) {
    const auto timed = timed_torque<Scheme>(segment, torques, t_s, T(i) * h, h);
    const T begun_s = t_s + T(i) * h;
    const auto torque = [&](const Stage<T>& stage) {
      TorqueSample<T> tau = timed(stage);
      add_stage_torques(tau, segment, torques, begun_s + stage.time_s, stage);
      return tau;
    };
    if constexpr (requires { Scheme::kFreeOrder; }) {
      // A kick stands still: it need ask four times of the rate alone.
      if (!segment.damped) {
        all = follow<Scheme>(body, state, h, rateless_mixed_torque(torque)) && all;
        continue;
      }
    }
    all = follow<Scheme>(body, state, h, mixed_torque(torque)) && all;
  }
  return all;
}

/// One of `parts` equal ones. Without the division where there is but one: the step would wait for it.
template <class T>
[[gnu::always_inline]] inline T part_of(const T& length_s, std::int64_t parts) {
  return parts == 1 ? length_s : length_s / T(parts);
}

/// run_segment() without torque.
template <class Scheme, class T>
[[gnu::noinline]] bool run_free(const BodyOf<Scheme, T>& body, State<T>& state, const T& length_s,
                                std::int64_t parts) {
  const T h = part_of(length_s, parts);
  bool all = true;
  for (std::int64_t i = 0; i < parts; ++i) {
    all = follow<Scheme>(body, state, h, NoTorque{}) && all;
  }
  return all;
}

/// run_segment() with a torque constant in the body.
template <class Scheme, class T>
[[gnu::noinline]] bool run_constant(const BodyOf<Scheme, T>& body, State<T>& state,
                                    const Vec3<T>& tau_B, const T& length_s, std::int64_t parts) {
  const T h = part_of(length_s, parts);
  const auto torque = [x = tau_B.x, y = tau_B.y, z = tau_B.z](const Stage<T>&) {
    return TorqueSample<T>{{x, y, z}, {}};
  };
  bool all = true;
  for (std::int64_t i = 0; i < parts; ++i) {
    all = follow<Scheme>(body, state, h, rateless_body_torque(torque)) && all;
  }
  return all;
}

/// `parts` equal steps of the scheme over a segment beginning at t_ns; true when all were followed.
template <class Scheme, class T>
bool run_segment(const BodyOf<Scheme, T>& body, State<T>& state, std::span<const Torque<T>> torques,
                 const Segment<T>& segment, std::int64_t t_ns, const T& length_s,
                 std::int64_t parts) {
  const T h = part_of(length_s, parts);
  const bool inertial = !is_zero(segment.inertial.start) || !is_zero(segment.inertial.slope);
  const bool level = is_zero(segment.body.slope) && is_zero(segment.inertial.slope);
  const bool constant = !segment.varying && !inertial && level;
  const bool body_only = !inertial && !segment.varying_inertial;
  bool all = true;
  if (segment.damped || segment.oriented || (has_many_stages<Scheme>() && !body_only)) {
    return run_general<Scheme>(body, state, torques, segment, t_ns, length_s, parts);
  }
  if (constant && is_zero(segment.body.start)) {
    return run_free<Scheme>(body, state, length_s, parts);
  }
  if constexpr (!has_many_stages<Scheme>()) {
    if (constant) {
      return run_constant<Scheme>(body, state, segment.body.start, length_s, parts);
    }
  }
  const T t_s = seconds<T>(t_ns);
  for (std::int64_t i = 0; i < parts; ++i) {
    const auto timed = timed_torque<Scheme>(segment, torques, t_s, T(i) * h, h);
    const auto torque = [&timed](const Stage<T>& stage) { return timed(stage); };
    if constexpr (!has_many_stages<Scheme>()) {
      if (!body_only) {
        all = follow<Scheme>(body, state, h, rateless_mixed_torque(torque)) && all;
        continue;
      }
    }
    all = follow<Scheme>(body, state, h, rateless_body_torque(torque)) && all;
  }
  return all;
}

template <class Scheme, class T>
[[gnu::noinline]] SubstepCount count_damped_parts(const BodyOf<Scheme, T>& body,
                                                  const State<T>& state, const Segment<T>& segment,
                                                  const T& impulse, const T& length_s,
                                                  const StepLimits& limits) {
  const Vec3<T> Pi_B = body_momentum(state);
  const T all = impulse + damping_impulse_bound(body, segment, Pi_B, impulse, length_s);
  return count_parts<Scheme, T>(body, Pi_B, all, length_s, limits,
                                decay_rate(body, segment.damping));
}

inline void note(StepReport& report, const SubstepCount& count, bool followed) noexcept {
  const bool stiff = count.obstacle == Obstacle::damping;
  report.unresolved_damping = report.unresolved_damping || stiff;
  report.unresolved_angle = report.unresolved_angle || !stiff || !followed;
  report.at_light_axis = report.at_light_axis || count.obstacle == Obstacle::light_axis;
  report.at_separatrix = report.at_separatrix || count.obstacle == Obstacle::separatrix;
  report.attitude_lost = report.attitude_lost || (!followed && count.within_limit);
}

/// Where the segment ends that `segments` others went before: at the next edge, unless there are too many.
inline std::int64_t end_of_segment(std::int64_t edge_ns, std::int64_t end_ns, std::int64_t segments,
                                   const StepLimits& limits, StepReport& report) noexcept {
  if (edge_ns >= end_ns) {
    return end_ns;
  }
  if (segments < limits.edges) {
    return edge_ns;
  }
  report.unresolved_edges = true;
  return end_ns;
}

/// advance() of a body that names no torque.
template <class Scheme, class T>
StepReport advance_free(const BodyOf<Scheme, T>& body, State<T>& state, const T& h_s,
                        const StepLimits& limits) noexcept {
  SubstepCount count;
  if (!surely_one_part(body, state.H_I.value(), T(0), h_s, T(Scheme::kStageReach), limits)) {
    count = count_parts<Scheme, T>(body, body_momentum(state), T(0), h_s, limits);
  }
  StepReport report;
  report.parts = count.parts;
  const bool followed = run_free<Scheme>(body, state, h_s, count.parts);
  if (!count.within_limit || !followed) [[unlikely]] {
    note(report, count, followed);
  }
  return report;
}

}  // namespace detail

/// Advances `state` from t_ns to t_ns + h_ns [ns]. Never throws, never allocates. `Scheme` is one
/// of integrators/all.hpp. An attitude that the step could not follow into a finite quaternion
/// stays as it was and is reported; H_I takes its impulse all the same.
template <class Scheme, class T>
StepReport advance(const BodyOf<Scheme, T>& body, State<T>& state,
                   std::span<const Torque<T>> torques, std::int64_t t_ns, std::int64_t h_ns,
                   const StepLimits& given = {}) noexcept {
  const StepLimits limits = limits_for<Scheme>(given);
  if (torques.empty() && h_ns > 0) {
    return detail::advance_free<Scheme>(body, state, seconds<T>(h_ns), limits);
  }
  StepReport report;
  const std::int64_t end_ns = t_ns + h_ns;
  for (std::int64_t segments = 0; t_ns < end_ns; ++segments) {
    const std::int64_t next_ns = detail::end_of_segment(detail::next_edge_after(torques, t_ns),
                                                        end_ns, segments, limits, report);
    const T length_s = seconds<T>(next_ns - t_ns);
    const detail::Segment<T> segment = detail::make_segment(torques, t_ns);
    const T impulse = detail::impulse_bound(segment, length_s);
    const T reach = T(Scheme::kStageReach);
    SubstepCount count;
    if (segment.damped) {
      count =
          detail::count_damped_parts<Scheme, T>(body, state, segment, impulse, length_s, limits);
    } else if ((push_limit_of<Scheme>() > 0 && impulse > T(0)) ||
               !surely_one_part(body, state.H_I.value(), impulse, length_s, reach, limits)) {
      count = count_parts<Scheme, T>(body, body_momentum(state), impulse, length_s, limits);
    }
    const bool followed =
        detail::run_segment<Scheme>(body, state, torques, segment, t_ns, length_s, count.parts);
    report.parts += count.parts;
    if (!count.within_limit || !followed) [[unlikely]] {
      detail::note(report, count, followed);
    }
    t_ns = next_ns;
  }
  return report;
}

}  // namespace adstar
