#pragma once
// One step of one spacecraft with wheels, as propagator.hpp has it of one without.
//
// The wheels' momenta h_i join the Runge-Kutta system of the scheme as h_i' = u_i, its stages and weights
// theirs: the scheme asks for omega_B = J_r⁻¹ (Pi_B - Σ a_i h_i) at each stage, then for the torque, and with
// the torque the slope of every h_i is taken. H_I never sees them. So any scheme that numbers its stages
// (Scheme::Nodes) and takes any body carries wheels, and the rigid body's step stays as it is.
//
// How many parts. Σ a_i h_i turns with the body and does no work on the hub, so its energy changes by the
// torques and the motors alone: |omega_B| ≤ a_1 (√(2 E_hub/a_1) + I), a_1 = 1/J_min of J_r, I the
// impulse of both. An attitude error e turns Pi_B by e|Pi_B|, all of which the hub may have to take: the
// leak of guard.hpp, with J_min of J_r. A bearing, a speed order and a motor near its no-load speed bring
// rates of their own, which count as damping does. What errors grow by beside a gyrostat's separatrix is
// not watched.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string_view>

#include "adstar/bodies/gyrostat.hpp"
#include "adstar/integrators/stage_weights.hpp"
#include "adstar/propagator.hpp"

namespace adstar {

/// Whether a scheme carries wheels.
template <class Scheme>
concept TakesWheels = requires {
  typename Scheme::Nodes;
  requires Scheme::kTakesAnyBody;
};

inline bool carries_wheels(std::string_view scheme) {
  bool carries = false;
  with_scheme(scheme, [&](auto s) { carries = TakesWheels<decltype(s)>; });
  return carries;
}

namespace detail {

/// The body as one step of the scheme sees it: J_r, and wheels that spin up from stage to stage.
template <class Nodes, class T>
class WheelStages {
 public:
  static_assert(Nodes::kStages <= kMostWheelStages);

  WheelStages(const RigidBody<T>& hub, std::span<SpinningWheel<T>> wheels, const T& h)
      : hub_(hub), wheels_(wheels), h_(h) {
    for (SpinningWheel<T>& spinning : wheels_) {
      spinning.h_stage = spinning.h.value;
    }
    add_up();
  }

  Vec3<T> angular_velocity(const Vec3<T>& Pi_B) const {
    return hub_.angular_velocity(Pi_B - spin_);
  }

  /// Once at every stage, in their order, after its omega_B is known.
  void take_slopes(int stage, const Vec3<T>& omega_B) {
    const auto s = static_cast<std::size_t>(stage);
    T work{};
    for (SpinningWheel<T>& spinning : wheels_) {
      spinning.slope[s] = T(0);
      if (!spinning.wheel.constant_speed) {
        const T Omega = spinning.speed_of(spinning.h_stage, omega_B);
        const T u = motor_torque(spinning.wheel, spinning.order, Omega).given +
                    friction_torque(spinning.wheel, Omega);
        spinning.slope[s] = u;
        work = work + u * Omega;
      }
    }
    work_ = work_ + kStageWeights<Nodes, T>.b[s] * work;
    const bool last = s + 1 == Nodes::kStages;
    const auto& weights =
        last ? kStageWeights<Nodes, T>.b : kStageWeights<Nodes, T>.a[last ? s : s + 1];
    for (SpinningWheel<T>& spinning : wheels_) {
      spinning.h_stage = spinning.h.value + h_ * weighted(spinning, weights, s + 1);
    }
    add_up();
  }

  /// The step is taken.
  void finish(State<T>& state) {
    for (SpinningWheel<T>& spinning : wheels_) {
      spinning.h.add(h_ * weighted(spinning, kStageWeights<Nodes, T>.b, Nodes::kStages));
    }
    state.work.add(h_ * work_);
  }

 private:
  static T weighted(const SpinningWheel<T>& spinning,
                    const std::array<T, StageWeights<Nodes, T>::kStages>& weights,
                    std::size_t count) {
    T sum{};
    for (std::size_t j = 0; j < count; ++j) {
      sum = sum + weights[j] * spinning.slope[j];
    }
    return sum;
  }
  void add_up() {
    spin_ = {};
    for (const SpinningWheel<T>& spinning : wheels_) {
      spin_ = spin_ + spinning.h_stage * spinning.wheel.axis_B;
    }
  }

  const RigidBody<T>& hub_;
  std::span<SpinningWheel<T>> wheels_;
  T h_;
  Vec3<T> spin_;  ///< Σ a_i h_i at the stage
  T work_{};      ///< of motors and bearings, over h
};

/// What motors and bearings may do over a segment: impulse [N m s] and fastest rate [1/s], at most.
template <class T>
struct WheelBounds {
  T impulse{};
  T decay{};
};

template <class T>
WheelBounds<T> bounds_of(const RigidBody<T>& hub, std::span<const SpinningWheel<T>> wheels,
                         const Vec3<T>& omega_B, const T& length_s) {
  using std::abs;
  WheelBounds<T> bounds;
  for (const SpinningWheel<T>& spinning : wheels) {
    const Wheel<T>& w = spinning.wheel;
    if (w.constant_speed) {
      continue;
    }
    const T mobility = T(1) / w.spin_inertia_kg_m2 + hub.inverse_moments()[0];  // of Omega under u
    const T speed = abs(spinning.speed(omega_B));
    const T asked = spinning.order.of_speed ? w.max_torque_n_m : abs(spinning.order.value);
    const T motor = asked < w.max_torque_n_m ? asked : w.max_torque_n_m;
    const T fastest = speed + mobility * motor * length_s;
    bounds.impulse =
        bounds.impulse + length_s * (motor + w.viscous_n_m_s_rad * fastest + w.coulomb_n_m);
    T stiffness = w.viscous_n_m_s_rad + w.coulomb_n_m / w.coulomb_speed_rad_s;
    if (spinning.order.of_speed) {
      stiffness = stiffness + w.speed_gain_n_m_s_rad;
    }
    if (motor > T(0) && fastest > (T(1) - T(kFadeShare)) * w.max_speed_rad_s) {
      stiffness = stiffness + w.max_torque_n_m / (T(kFadeShare) * w.max_speed_rad_s);
    }
    bounds.decay = bounds.decay + stiffness * mobility;
  }
  return bounds;
}

/// Parts of a segment in which torques other than the wheels' have an impulse of `impulse`, at most.
template <class Scheme, class T>
SubstepCount count_gyrostat_parts(const RigidBody<T>& hub, std::span<const SpinningWheel<T>> wheels,
                                  const Vec3<T>& Pi_B, const T& impulse, const T& decay,
                                  const T& length_s, const StepLimits& limits) {
  using std::ceil;
  using std::sqrt;
  const T a = hub.inverse_moments()[0];
  const Vec3<T> hub_Pi_B = Pi_B - wheel_momentum(wheels);
  const WheelBounds<T> inner = bounds_of(hub, wheels, hub.angular_velocity(hub_Pi_B), length_s);
  const T all = impulse + inner.impulse;
  const T reach = length_s * T(Scheme::kStageReach);
  const T angle = reach * sqrt(a) * (sqrt(T(2) * hub.energy(hub_Pi_B)) + all * sqrt(a));
  const T turn = angle / T(limits.substep_angle_rad);
  const T decays = (decay + inner.decay) * length_s / T(decay_limit(Scheme::kOrder));
  if (!(decays <= T(limits.substeps))) {
    return {limits.substeps, false, Obstacle::damping};
  }
  const T wanted = ceil(std::max(turn, decays));
  if (!(wanted <= T(limits.substeps))) {  // also NaN
    return {limits.substeps, false, Obstacle::turn};
  }
  std::int64_t parts = std::max<std::int64_t>(1, static_cast<std::int64_t>(wanted));
  if (Scheme::kLeakPower > 0) {
    const T leak = reach * (norm(Pi_B) + all) * a / T(limits.substep_angle_rad);
    parts = least_parts(parts, limits.substeps, [&](std::int64_t n) {
      return within_unit(leak / T(n), turn, Scheme::kLeakPower, n);
    });
    if (parts == 0) {
      return {limits.substeps, false, Obstacle::light_axis};
    }
  }
  return {parts, true, Obstacle::none};
}

/// `parts` equal steps of the scheme over a segment beginning at t_ns; true when all were followed.
template <class Scheme, class T>
bool run_gyrostat(const RigidBody<T>& hub, State<T>& state, std::span<SpinningWheel<T>> wheels,
                  std::span<const Torque<T>> torques, const Segment<T>& segment, std::int64_t t_ns,
                  const T& length_s, std::int64_t parts) {
  const T h = part_of(length_s, parts);
  const T t_s = seconds<T>(t_ns);
  bool all = true;
  for (std::int64_t i = 0; i < parts; ++i) {
    const auto timed = timed_torque<Scheme>(segment, torques, t_s, T(i) * h, h);
    WheelStages<typename Scheme::Nodes, T> body(hub, wheels, h);
    const bool followed = follow<Scheme>(body, state, h, mixed_torque([&](const Stage<T>& stage) {
                                           TorqueSample<T> tau = timed(stage);
                                           const T now_s = t_s + T(i) * h + stage.time_s;
                                           add_stage_torques(tau, segment, torques, now_s, stage);
                                           body.take_slopes(stage.number, stage.omega_B);
                                           return tau;
                                         }));
    if (followed) {
      body.finish(state);
    }
    all = followed && all;
  }
  return all;
}

}  // namespace detail

/// Advances `state` and `wheels` from t_ns to t_ns + h_ns [ns]; `hub`: of hub_of(). Never throws, never
/// allocates. An attitude that the step could not follow stays as it was, and so do the wheels.
template <TakesWheels Scheme, class T>
StepReport advance(const RigidBody<T>& hub, State<T>& state, std::span<SpinningWheel<T>> wheels,
                   std::span<const Torque<T>> torques, std::int64_t t_ns, std::int64_t h_ns,
                   const StepLimits& given = {}) noexcept {
  const StepLimits limits = limits_for<Scheme>(given);
  StepReport report;
  const std::int64_t end_ns = t_ns + h_ns;
  for (std::int64_t segments = 0; t_ns < end_ns; ++segments) {
    std::int64_t edge_ns = detail::next_edge_after(torques, t_ns);
    for (SpinningWheel<T>& spinning : wheels) {
      edge_ns = std::min(edge_ns, spinning.motor.next_edge_after(t_ns));
      spinning.order = spinning.motor.order_at(t_ns);
    }
    const std::int64_t next_ns = detail::end_of_segment(edge_ns, end_ns, segments, limits, report);
    const T length_s = seconds<T>(next_ns - t_ns);
    const detail::Segment<T> segment = detail::make_segment(torques, t_ns);
    const Vec3<T> Pi_B = body_momentum(state);
    T impulse = detail::impulse_bound(segment, length_s);
    T decay{};
    if (segment.damped) {
      const Vec3<T> hub_Pi_B = Pi_B - wheel_momentum(std::span<const SpinningWheel<T>>(wheels));
      impulse = impulse + detail::damping_impulse_bound(hub, segment, hub_Pi_B, impulse, length_s);
      decay = decay_rate(hub, segment.damping);
    }
    const SubstepCount count = detail::count_gyrostat_parts<Scheme, T>(hub, wheels, Pi_B, impulse,
                                                                       decay, length_s, limits);
    const bool followed = detail::run_gyrostat<Scheme>(hub, state, wheels, torques, segment, t_ns,
                                                       length_s, count.parts);
    report.parts += count.parts;
    if (!count.within_limit || !followed) [[unlikely]] {
      detail::note(report, count, followed);
    }
    t_ns = next_ns;
  }
  return report;
}

}  // namespace adstar
