#pragma once
// One step of a list of bodies, as many at a time as a register has lanes: the scheme's own step()
// over lanes, with the scalar path's bits in each.
//
// A lane is taken if the quick guard says that one part will do, and if its step ends in a finite
// quaternion; every other lane is left untouched for the scalar path (advance()), which does it
// from the beginning. Cost beside the arithmetic: two or three transposes each way.

#include <limits>

#include "adstar/batch/fleet_view.hpp"
#include "adstar/batch/lane_sine.hpp"
#include "adstar/batch/lanes.hpp"
#include "adstar/batch/rows.hpp"
#include "adstar/integrators/guard.hpp"
#include "adstar/integrators/stage_torque.hpp"
#include "adstar/state.hpp"

namespace adstar::batch {

/// The bodies of one group of lanes, as a scheme's step() sees them.
template <class L>
struct LaneBodies {
  Sym3<L> J_inverse;
  L largest_inverse_moment;
  typename L::Mask diagonal;
  bool all_diagonal;

  [[gnu::always_inline]] Vec3<L> angular_velocity(const Vec3<L>& Pi_B) const {
    const Vec3<L> by_axis{J_inverse.xx * Pi_B.x, J_inverse.yy * Pi_B.y, J_inverse.zz * Pi_B.z};
    if (all_diagonal) {
      return by_axis;
    }
    // Not the full product alone: a zero of the other sign is another bit.
    const Vec3<L> full = J_inverse * Pi_B;
    return {select(diagonal, by_axis.x, full.x), select(diagonal, by_axis.y, full.y),
            select(diagonal, by_axis.z, full.z)};
  }
  [[gnu::always_inline]] const L* inverse_moments() const { return &largest_inverse_moment; }
};

namespace detail {

enum class Load { free, body, ramps, varying };

/// One group: where each lane's numbers lie.
template <class Arch>
struct Group {
  static constexpr std::size_t kWidth = Lanes<double, Arch>::kWidth;
  double* state[kWidth];
  const double* body[kWidth];
  const double* torque[kWidth];
  const PackedHarmonics* harmonics[kWidth];
};

template <std::size_t Offset, class Arch, class Pointer>
[[gnu::always_inline]] inline Rows<Lanes<double, Arch>> load_at(const Pointer* from) {
  const double* shifted[Group<Arch>::kWidth];
  for (std::size_t i = 0; i < Group<Arch>::kWidth; ++i) {
    shifted[i] = from[i] + Offset;
  }
  return load_rows<Arch>(shifted);
}

template <std::size_t Offset, class Arch>
[[gnu::always_inline]] inline void store_at(const Group<Arch>& group, unsigned which,
                                            const Lanes<double, Arch>& a,
                                            const Lanes<double, Arch>& b,
                                            const Lanes<double, Arch>& c,
                                            const Lanes<double, Arch>& d) {
  double* shifted[Group<Arch>::kWidth];
  for (std::size_t i = 0; i < Group<Arch>::kWidth; ++i) {
    shifted[i] = group.state[i] + Offset;
  }
  store_rows<Arch>({{a, b, c, d}}, shifted, which);
}

template <class Arch>
[[gnu::always_inline]] inline LaneBodies<Lanes<double, Arch>> load_bodies(
    const Group<Arch>& group) {
  using L = Lanes<double, Arch>;
  bool all_diagonal = true;
  for (std::size_t i = 0; i < Group<Arch>::kWidth; ++i) {
    all_diagonal = all_diagonal && group.body[i][7] != 0;
  }
  const auto axes = load_at<0, Arch>(group.body);
  LaneBodies<L> bodies;
  bodies.J_inverse.xx = axes.column[0];
  bodies.J_inverse.yy = axes.column[1];
  bodies.J_inverse.zz = axes.column[2];
  bodies.largest_inverse_moment = axes.column[3];
  bodies.all_diagonal = all_diagonal;
  if (!all_diagonal) {
    const auto products = load_at<4, Arch>(group.body);
    bodies.J_inverse.xy = products.column[0];
    bodies.J_inverse.xz = products.column[1];
    bodies.J_inverse.yz = products.column[2];
    bodies.diagonal = products.column[3] > L(0.5);
  }
  return bodies;
}

/// The lanes of a mask as bits.
template <class Arch>
unsigned bits_of(const LaneMask<double, Arch>& mask) {
  using L = Lanes<double, Arch>;
  double one[L::kWidth];
  select(mask, L(1), L(0)).values.store_unaligned(one);
  unsigned bits = 0;
  for (std::size_t i = 0; i < L::kWidth; ++i) {
    bits |= one[i] != 0 ? 1U << i : 0U;
  }
  return bits;
}

/// What a step of that kind has changed, for the lanes of `which`.
template <Load kLoad, class Arch>
[[gnu::always_inline]] inline void store_state(const Group<Arch>& group, unsigned which,
                                               const State<Lanes<double, Arch>>& state) {
  const auto& [q, H, G, W] = state;
  store_at<0, Arch>(group, which, q.w, q.x, q.y, q.z);
  if constexpr (kLoad != Load::free) {
    store_at<4, Arch>(group, which, H.x.value, H.x.carry, H.y.value, H.y.carry);
    store_at<8, Arch>(group, which, H.z.value, H.z.carry, G.x.value, G.x.carry);
    store_at<12, Arch>(group, which, G.y.value, G.y.carry, G.z.value, G.z.carry);
    store_at<14, Arch>(group, which, G.z.value, G.z.carry, W.value, W.carry);
  }
}

/// Adds every lane's harmonic torques at t [s], in their order, as add_varying() of propagator.hpp.
/// Out of line: once a stage, and its registers are its own.
template <class Arch>
[[gnu::noinline]] void add_harmonics(TorqueSample<Lanes<double, Arch>>& sum,
                                     const Group<Arch>& group, std::size_t most,
                                     const Lanes<double, Arch>& t_s) {
  using L = Lanes<double, Arch>;
  for (std::size_t k = 0; k < most; ++k) {
    const double* from[L::kWidth];
    for (std::size_t i = 0; i < L::kWidth; ++i) {
      from[i] = group.harmonics[i]->at[k].amplitude;
    }
    const auto amplitude = load_at<0, Arch>(from);
    const auto rate = load_at<4, Arch>(from);
    const auto phase = load_at<8, Arch>(from);
    const auto in_body = (amplitude.column[3] > L(0.5)) & (amplitude.column[3] < L(1.5));
    const auto in_inertial = amplitude.column[3] > L(1.5);
    L* const body[] = {&sum.body.x, &sum.body.y, &sum.body.z};
    L* const inertial[] = {&sum.inertial.x, &sum.inertial.y, &sum.inertial.z};
    for (std::size_t j = 0; j < 3; ++j) {
      const L& size = amplitude.column[j];
      const auto none = (size <= L(0)) & (L(0) <= size);
      const L torque = select(none, L(0), size * lane_sine(rate.column[j] * t_s + phase.column[j]));
      *body[j] = select(in_body, *body[j] + torque, *body[j]);
      *inertial[j] = select(in_inertial, *inertial[j] + torque, *inertial[j]);
    }
  }
}

/// Steps the lanes of `wanted`; returns which it took.
template <class Scheme, Load kLoad, class Arch>
[[gnu::always_inline]] inline unsigned step_group(const Group<Arch>& group, unsigned wanted,
                                                  const Work& work) {
  using L = Lanes<double, Arch>;
  constexpr unsigned kAll = (1U << L::kWidth) - 1U;
  const LaneBodies<L> bodies = load_bodies<Arch>(group);
  const auto H_xy = load_at<4, Arch>(group.state);
  const auto H_z = load_at<8, Arch>(group.state);
  State<L> state;
  state.H_I.x = {H_xy.column[0], H_xy.column[1]};
  state.H_I.y = {H_xy.column[2], H_xy.column[3]};
  state.H_I.z = {H_z.column[0], H_z.column[1]};
  L impulse_bound(0);
  if constexpr (kLoad != Load::free) {
    impulse_bound = load_at<0, Arch>(group.torque).column[3];
  }
  const L h(work.h_s);
  const auto one_part =
      surely_one_part(bodies, state.H_I.value(), impulse_bound, h, L(Scheme::kStageReach),
                      StepLimits{.substep_angle_rad = work.angle_limit_rad});
  if (!any(one_part)) {
    return 0;
  }
  const auto q = load_at<0, Arch>(group.state);
  state.q_IB = {q.column[0], q.column[1], q.column[2], q.column[3]};
  if constexpr (kLoad == Load::free) {
    Scheme::step(bodies, state, h, NoTorque{});
  } else {
    const auto G_yz = load_at<12, Arch>(group.state);
    const auto work_sum = load_at<14, Arch>(group.state);
    state.impulse_I.x = {H_z.column[2], H_z.column[3]};
    state.impulse_I.y = {G_yz.column[0], G_yz.column[1]};
    state.impulse_I.z = {G_yz.column[2], G_yz.column[3]};
    state.work = {work_sum.column[2], work_sum.column[3]};
    const auto body_start = load_at<0, Arch>(group.torque);
    const Vec3<L> start_B{body_start.column[0], body_start.column[1], body_start.column[2]};
    if constexpr (kLoad == Load::body) {
      Scheme::step(bodies, state, h, body_torque([&](const Stage<L>&) {
                     return TorqueSample<L>{start_B, {}};
                   }));
    } else {
      const auto body_slope = load_at<4, Arch>(group.torque);
      const auto inertial_start = load_at<8, Arch>(group.torque);
      const auto inertial_slope = load_at<12, Arch>(group.torque);
      const Vec3<L> slope_B{body_slope.column[0], body_slope.column[1], body_slope.column[2]};
      const Vec3<L> start_I{inertial_start.column[0], inertial_start.column[1],
                            inertial_start.column[2]};
      const Vec3<L> slope_I{inertial_slope.column[0], inertial_slope.column[1],
                            inertial_slope.column[2]};
      Scheme::step(
          bodies, state, h, mixed_torque([&](const Stage<L>& stage) {
            TorqueSample<L> tau{start_B + stage.time_s * slope_B, start_I + stage.time_s * slope_I};
            if constexpr (kLoad == Load::varying) {
              add_harmonics<Arch>(tau, group, work.most_harmonics, L(work.t_s) + stage.time_s);
            }
            return tau;
          }));
    }
  }
  const L q_squared = squared_norm(state.q_IB);
  const auto taken = one_part & (q_squared > L(0.5)) & (q_squared < L(2));
  const unsigned which = all(taken) ? wanted : wanted & bits_of<Arch>(taken);
  if (which == kAll) {
    store_state<kLoad, Arch>(group, kAll, state);
  } else {
    store_state<kLoad, Arch>(group, which, state);
  }
  return which;
}

}  // namespace detail

/// Steps the members that `work` lists; returns how many of them it left.
template <class Scheme, detail::Load kLoad, class Arch>
[[gnu::flatten]] std::size_t step_members(const FleetView& fleet, const Work& work) noexcept {
  constexpr std::size_t kWidth = Lanes<double, Arch>::kWidth;
  std::size_t left = 0;
  for (std::size_t first = 0; first < work.count; first += kWidth) {
    const std::size_t lanes = work.count - first < kWidth ? work.count - first : kWidth;
    detail::Group<Arch> group;
    for (std::size_t i = 0; i < kWidth; ++i) {
      // Lanes past the end repeat the last one; what they come to is not stored.
      const std::size_t entry = first + (i < lanes ? i : lanes - 1);
      const std::uint32_t member = work.members[entry];
      group.state[i] = fleet.states + member * fleet.stride;
      group.body[i] = &fleet.bodies[member].J_inverse_xx;
      if constexpr (kLoad != detail::Load::free) {
        group.torque[i] = work.torques[entry].body_start;
      }
      if constexpr (kLoad == detail::Load::varying) {
        group.harmonics[i] = &work.harmonics[entry];
      }
    }
    const unsigned wanted = (1U << lanes) - 1U;
    const unsigned taken = detail::step_group<Scheme, kLoad, Arch>(group, wanted, work);
    if (taken != wanted) {
      for (std::size_t i = 0; i < lanes; ++i) {
        if ((taken >> i & 1U) == 0) {
          work.left[left++] = work.members[first + i];
        }
      }
    }
  }
  return left;
}

template <class Scheme, class Arch>
constexpr Kernels kernels() {
  return {step_members<Scheme, detail::Load::free, Arch>,
          step_members<Scheme, detail::Load::body, Arch>,
          step_members<Scheme, detail::Load::ramps, Arch>,
          step_members<Scheme, detail::Load::varying, Arch>};
}

}  // namespace adstar::batch
