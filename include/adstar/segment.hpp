#pragma once
// All torques of one spacecraft over one smooth segment of a step: summed where they are linear in
// time, asked at the stages where they are not.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>

#include "adstar/bodies/rigid_body.hpp"
#include "adstar/integrators/stage_torque.hpp"
#include "adstar/torques/all.hpp"

namespace adstar::detail {

/// All torques of one spacecraft over one smooth segment.
template <class T>
struct Segment {
  Ramp<T> body, inertial;         ///< the models that are linear in time, summed
  bool varying = false;           ///< some model is to be asked at every stage
  bool varying_inertial = false;  ///< and one of those in I
  T varying_bound{};              ///< of the norm of those [N m]
  bool oriented = false;          ///< some model looks at the attitude
  bool damped = false;            ///< some model looks at omega_B
  Vec3<T> damping;                ///< -∂tau_B/∂omega_B per body axis, summed [N m s/rad]
};

template <class T>
bool is_zero(const Vec3<T>& v) {
  return v == Vec3<T>{};
}

template <class T>
void add_to(Ramp<T>& sum, const Ramp<T>& term) {
  sum.start = sum.start + term.start;
  sum.slope = sum.slope + term.slope;
}

template <class T>
Segment<T> make_segment(std::span<const Torque<T>> torques, std::int64_t t_ns) {
  Segment<T> segment;
  for (const Torque<T>& torque : torques) {
    std::visit(
        [&](const auto& model) {
          if constexpr (requires { model.ramp_from(t_ns); }) {
            add_to(model.frame == Frame::body ? segment.body : segment.inertial,
                   model.ramp_from(t_ns));
          } else if constexpr (requires { model.damping(); }) {
            segment.damping = segment.damping + model.damping();
            segment.damped = segment.damped || !is_zero(model.damping());
          } else if constexpr (requires(const Quat<T>& q) { model.at(T(), q); }) {
            segment.oriented = true;
            segment.varying_bound = segment.varying_bound + model.bound();
          } else {
            segment.varying = true;
            segment.varying_inertial = segment.varying_inertial || model.frame == Frame::inertial;
            segment.varying_bound = segment.varying_bound + model.bound();
          }
        },
        torque);
  }
  return segment;
}

/// The first edge of any of them past t_ns.
template <class T>
[[gnu::always_inline]] inline std::int64_t next_edge_after(std::span<const Torque<T>> torques,
                                                           std::int64_t t_ns) {
  std::int64_t next = kNever;
  for (const Torque<T>& torque : torques) {
    next = std::min(
        next, std::visit([&](const auto& model) { return model.next_edge_after(t_ns); }, torque));
  }
  return next;
}

template <class T>
Vec3<T> damping_torque(const Segment<T>& segment, const Vec3<T>& omega_B) {
  const Vec3<T>& c = segment.damping;
  return {-(c.x * omega_B.x), -(c.y * omega_B.y), -(c.z * omega_B.z)};
}

/// What looks at the attitude or at omega_B, added to what does not; t_s: of the stage.
template <class T>
void add_stage_torques(TorqueSample<T>& sum, const Segment<T>& segment,
                       std::span<const Torque<T>> torques, const T& t_s, const Stage<T>& stage) {
  if (segment.oriented) {
    const Quat<T> q_IB = stage.q_IB();
    for (const Torque<T>& torque : torques) {
      std::visit(
          [&](const auto& model) {
            if constexpr (requires { model.at(t_s, q_IB); }) {
              sum.body = sum.body + model.at(t_s, q_IB);
            }
          },
          torque);
    }
  }
  if (segment.damped) {
    sum.body = sum.body + damping_torque(segment, stage.omega_B);
  }
}

/// The stage-varying models, summed at one instant.
template <class T>
void add_varying(TorqueSample<T>& sum, std::span<const Torque<T>> torques, const T& t_s) {
  for (const Torque<T>& torque : torques) {
    std::visit(
        [&](const auto& model) {
          if constexpr (requires { model.at(t_s); }) {
            Vec3<T>& part = model.frame == Frame::body ? sum.body : sum.inertial;
            part = part + model.at(t_s);
          }
        },
        torque);
  }
}

/// |x| + |y| + |z|: a bound of the norm that needs no root.
template <class T>
T sum_of_magnitudes(const Vec3<T>& v) {
  using std::abs;
  return abs(v.x) + abs(v.y) + abs(v.z);
}

/// ∫|tau| dt over the segment, at most.
template <class T>
T impulse_bound(const Segment<T>& s, const T& length_s) {
  const auto largest = [&](const Ramp<T>& ramp) {
    return sum_of_magnitudes(ramp.start) + length_s * sum_of_magnitudes(ramp.slope);
  };
  return length_s * (largest(s.body) + largest(s.inertial) + s.varying_bound);
}

/// ∫|tau| dt of the damping, at most, beside other torques of `impulse`: |omega|² ≤ 2E/J_min, and damping
/// takes E down; nor can it change the momentum by more than the most that E allows, back and forth.
template <class T>
T damping_impulse_bound(const RigidBody<T>& body, const Segment<T>& s, const Vec3<T>& Pi_B,
                        const T& impulse, const T& length_s) {
  using std::sqrt;
  const T root = sqrt(T(2) * body.energy(Pi_B)) + impulse * sqrt(body.inverse_moments()[0]);
  const T largest = std::max(std::max(s.damping.x, s.damping.y), s.damping.z);
  const T by_rate = length_s * largest * root * sqrt(body.inverse_moments()[0]);
  const T by_energy = T(2) * root / sqrt(body.inverse_moments()[2]);
  return by_rate > by_energy ? by_energy : by_rate;
}

/// All that does not look at omega_B, `since` the segment's beginning at t_s.
template <class T>
[[gnu::always_inline]] inline TorqueSample<T> torque_at(const Segment<T>& segment,
                                                        std::span<const Torque<T>> torques,
                                                        const T& t_s, const T& since) {
  TorqueSample<T> tau{segment.body.start + since * segment.body.slope,
                      segment.inertial.start + since * segment.inertial.slope};
  if (segment.varying) {
    add_varying(tau, torques, t_s + since);
  }
  return tau;
}

/// torque_at() at every node of a tableau, for a step of h that begins at t_s + begun: the same bits as
/// asked one by one, and the stages need not wait for sines.
template <class Nodes, class T>
class NodeTorques {
 public:
  NodeTorques(const Segment<T>& segment, std::span<const Torque<T>> torques, const T& t_s,
              const T& begun, const T& h) {
    T at_s[kStages];
    for (std::size_t i = 0; i < kStages; ++i) {
      const T since = begun + h * Nodes::c[i].template as<T>();
      at_s[i] = t_s + since;
      set(body_, i, segment.body.start + since * segment.body.slope);
      set(inertial_, i, segment.inertial.start + since * segment.inertial.slope);
    }
    if (!segment.varying) {
      return;
    }
    for (const Torque<T>& torque : torques) {
      std::visit(
          [&](const auto& model) {
            if constexpr (requires { model.add_at(at_s, body_); }) {
              model.add_at(at_s, model.frame == Frame::body ? body_ : inertial_);
            }
          },
          torque);
    }
  }

  TorqueSample<T> operator()(const Stage<T>& stage) const {
    const int i = stage.number;
    return {{body_.x[i], body_.y[i], body_.z[i]}, {inertial_.x[i], inertial_.y[i], inertial_.z[i]}};
  }

 private:
  static constexpr std::size_t kStages = Nodes::kStages;

  static void set(VectorRows<T, kStages>& rows, std::size_t i, const Vec3<T>& v) {
    rows.x[i] = v.x;
    rows.y[i] = v.y;
    rows.z[i] = v.z;
  }

  VectorRows<T, kStages> body_, inertial_;
};

/// What one step of h beginning at t_s + begun asks of the torques that do not look at omega_B: a
/// function of its stages, valid while the arguments live.
template <class Scheme, class T>
[[gnu::always_inline]] inline auto timed_torque(const Segment<T>& segment,
                                                std::span<const Torque<T>> torques, const T& t_s,
                                                const T& begun, const T& h) {
  if constexpr (requires { typename Scheme::Nodes; }) {
    return NodeTorques<typename Scheme::Nodes, T>(segment, torques, t_s, begun, h);
  } else {
    return [&segment, torques, &t_s, begun](const Stage<T>& stage) {
      return torque_at(segment, torques, t_s, begun + stage.time_s);
    };
  }
}

}  // namespace adstar::detail
