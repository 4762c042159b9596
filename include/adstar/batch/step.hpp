#pragma once
// One step of a list of bodies, as many at a time as a register has lanes: the scheme's own step()
// over lanes, with the scalar path's bits in each.
//
// A lane is taken if the quick guard says that one part will do, and if its step ends in a finite
// quaternion; every other lane is left untouched for the scalar path (advance()), which does it
// from the beginning. Cost beside the arithmetic: two or three transposes each way.

#include <cstddef>

#include "adstar/batch/fleet_view.hpp"
#include "adstar/batch/lane_sine.hpp"
#include "adstar/batch/lanes.hpp"
#include "adstar/batch/narrow_lanes.hpp"
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

template <class Scheme>
concept FloatStages = requires {
  requires Scheme::kFloatStages;
};

/// The same for a scheme with float stages (integrators/coadjoint_float.hpp).
template <class L>
struct FloatStageLaneBodies {
  const LaneBodies<L>& bodies;
  L moment;

  [[gnu::always_inline]] explicit FloatStageLaneBodies(const LaneBodies<L>& of)
      : bodies(of), moment(L(1) / of.largest_inverse_moment) {}
  [[gnu::always_inline]] Vec3<L> angular_velocity(const Vec3<L>& Pi_B) const {
    return bodies.angular_velocity(Pi_B);
  }
  [[gnu::always_inline]] const L* inverse_moments() const { return bodies.inverse_moments(); }
  [[gnu::always_inline]] const L& smallest_moment() const { return moment; }
};

template <class L>
[[gnu::always_inline]] inline LaneBodies<NarrowOf<L>> scaled_inertia(
    const FloatStageLaneBodies<L>& a, const FloatStageLaneBodies<L>& b) {
  const auto narrow_entry = [&](L Sym3<L>::*entry) {
    return Narrower<L>::narrow(a.moment * a.bodies.J_inverse.*entry,
                               b.moment * b.bodies.J_inverse.*entry);
  };
  using N = NarrowOf<L>;
  LaneBodies<N> scaled;
  scaled.J_inverse.xx = narrow_entry(&Sym3<L>::xx);
  scaled.J_inverse.yy = narrow_entry(&Sym3<L>::yy);
  scaled.J_inverse.zz = narrow_entry(&Sym3<L>::zz);
  scaled.all_diagonal = a.bodies.all_diagonal && b.bodies.all_diagonal;
  if (!scaled.all_diagonal) {
    scaled.J_inverse.xy = narrow_entry(&Sym3<L>::xy);
    scaled.J_inverse.xz = narrow_entry(&Sym3<L>::xz);
    scaled.J_inverse.yz = narrow_entry(&Sym3<L>::yz);
    const auto flag = [](const LaneBodies<L>& one) {
      return one.all_diagonal ? L(1) : select(one.diagonal, L(1), L(0));
    };
    scaled.diagonal = Narrower<L>::narrow(flag(a.bodies), flag(b.bodies)) > N(0.5);
  }
  return scaled;
}

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

/// What the quick guard asks of a group, and the rest of its state.
template <Load kLoad, class Arch>
struct Loaded {
  using L = Lanes<double, Arch>;
  LaneBodies<L> bodies;
  State<L> state;
  typename L::Mask one_part;  ///< one part will do

  [[gnu::always_inline]] Loaded(const Group<Arch>& group, const Work& work, double stage_reach)
      : bodies(load_bodies<Arch>(group)) {
    const auto H_xy = load_at<4, Arch>(group.state);
    const auto H_z = load_at<8, Arch>(group.state);
    state.H_I.x = {H_xy.column[0], H_xy.column[1]};
    state.H_I.y = {H_xy.column[2], H_xy.column[3]};
    state.H_I.z = {H_z.column[0], H_z.column[1]};
    state.impulse_I.x = {H_z.column[2], H_z.column[3]};
    L impulse_bound(0);
    if constexpr (kLoad != Load::free) {
      impulse_bound = load_at<0, Arch>(group.torque).column[3];
    }
    one_part =
        surely_one_part(bodies, state.H_I.value(), impulse_bound, L(work.h_s), L(stage_reach),
                        StepLimits{.substep_angle_rad = work.angle_limit_rad});
  }

  [[gnu::always_inline]] void load_rest(const Group<Arch>& group) {
    const auto q = load_at<0, Arch>(group.state);
    state.q_IB = {q.column[0], q.column[1], q.column[2], q.column[3]};
    if constexpr (kLoad != Load::free) {
      const auto G_yz = load_at<12, Arch>(group.state);
      const auto work_sum = load_at<14, Arch>(group.state);
      state.impulse_I.y = {G_yz.column[0], G_yz.column[1]};
      state.impulse_I.z = {G_yz.column[2], G_yz.column[3]};
      state.work = {work_sum.column[2], work_sum.column[3]};
    }
  }
};

template <std::size_t Offset, class Arch>
[[gnu::always_inline]] inline Vec3<Lanes<double, Arch>> load_vector(const double* const* from) {
  const auto rows = load_at<Offset, Arch>(from);
  return {rows.column[0], rows.column[1], rows.column[2]};
}

/// The torques of a group.
template <Load kLoad, class Arch>
struct LoadedTorque {
  using L = Lanes<double, Arch>;
  const Group<Arch>& group;
  const Work& work;
  Vec3<L> start_B, slope_B, start_I, slope_I;

  [[gnu::always_inline]] LoadedTorque(const Group<Arch>& from, const Work& of)
      : group(from), work(of) {
    if constexpr (kLoad != Load::free) {
      start_B = load_vector<0, Arch>(group.torque);
    }
    if constexpr (kLoad != Load::free && kLoad != Load::body) {
      slope_B = load_vector<4, Arch>(group.torque);
      start_I = load_vector<8, Arch>(group.torque);
      slope_I = load_vector<12, Arch>(group.torque);
    }
  }

  /// As a step asks for them; nothing is copied.
  [[gnu::always_inline]] auto for_step() const {
    if constexpr (kLoad == Load::free) {
      return NoTorque{};
    } else if constexpr (kLoad == Load::body) {
      return body_torque([this](const Stage<L>&) {
        // Number by number: a copy of the whole goes through memory in smaller pieces, and waits.
        return TorqueSample<L>{{start_B.x, start_B.y, start_B.z}, {}};
      });
    } else {
      return mixed_torque([this](const Stage<L>& stage) {
        const L& t = stage.time_s;
        TorqueSample<L> tau{start_B + t * slope_B, start_I + t * slope_I};
        if constexpr (kLoad == Load::varying) {
          add_harmonics<Arch>(tau, group, work.most_harmonics, L(work.t_s) + t);
        }
        return tau;
      });
    }
  }
};

/// Stores those of `wanted` that the step has taken; returns which.
template <Load kLoad, class Arch>
[[gnu::always_inline]] inline unsigned store_taken(const Group<Arch>& group, unsigned wanted,
                                                   const Loaded<kLoad, Arch>& after) {
  using L = Lanes<double, Arch>;
  constexpr unsigned kAll = (1U << L::kWidth) - 1U;
  const L q_squared = squared_norm(after.state.q_IB);
  const auto taken = after.one_part & (q_squared > L(0.5)) & (q_squared < L(2));
  const unsigned which = all(taken) ? wanted : wanted & bits_of<Arch>(taken);
  if (which == kAll) {
    store_state<kLoad, Arch>(group, kAll, after.state);
  } else {
    store_state<kLoad, Arch>(group, which, after.state);
  }
  return which;
}

/// Steps the lanes of `wanted`; returns which it took.
template <class Scheme, Load kLoad, class Arch>
[[gnu::always_inline]] inline unsigned step_groups(const Group<Arch> (&group)[1], unsigned wanted,
                                                   const Work& work) {
  using L = Lanes<double, Arch>;
  Loaded<kLoad, Arch> loaded(group[0], work, Scheme::kStageReach);
  if (!any(loaded.one_part)) {
    return 0;
  }
  loaded.load_rest(group[0]);
  const LoadedTorque<kLoad, Arch> torque(group[0], work);
  Scheme::step(loaded.bodies, loaded.state, L(work.h_s), torque.for_step());
  return store_taken<kLoad, Arch>(group[0], wanted, loaded);
}

/// Two groups whose stages share a register.
template <class Scheme, Load kLoad, class Arch>
[[gnu::always_inline]] inline unsigned step_groups(const Group<Arch> (&group)[2], unsigned wanted,
                                                   const Work& work) {
  using L = Lanes<double, Arch>;
  Loaded<kLoad, Arch> low(group[0], work, Scheme::kStageReach);
  Loaded<kLoad, Arch> high(group[1], work, Scheme::kStageReach);
  if (!any(low.one_part) && !any(high.one_part)) {
    return 0;
  }
  low.load_rest(group[0]);
  high.load_rest(group[1]);
  const FloatStageLaneBodies<L> low_bodies(low.bodies), high_bodies(high.bodies);
  const LoadedTorque<kLoad, Arch> low_torque(group[0], work), high_torque(group[1], work);
  Scheme::step(low_bodies, low.state, low_torque.for_step(), high_bodies, high.state,
               high_torque.for_step(), L(work.h_s));
  constexpr unsigned kLow = (1U << L::kWidth) - 1U;
  const unsigned taken = store_taken<kLoad, Arch>(group[0], wanted & kLow, low);
  return taken | store_taken<kLoad, Arch>(group[1], wanted >> L::kWidth, high) << L::kWidth;
}

}  // namespace detail

/// Steps the members that `work` lists; returns how many of them it left.
template <class Scheme, detail::Load kLoad, class Arch>
[[gnu::flatten]] std::size_t step_members(const FleetView& fleet, const Work& work) noexcept {
  constexpr std::size_t kGroups = FloatStages<Scheme> ? 2 : 1;
  constexpr std::size_t kGroupWidth = Lanes<double, Arch>::kWidth;
  constexpr std::size_t kWidth = kGroups * kGroupWidth;
  std::size_t left = 0;
  for (std::size_t first = 0; first < work.count; first += kWidth) {
    const std::size_t lanes = work.count - first < kWidth ? work.count - first : kWidth;
    detail::Group<Arch> group[kGroups];
    for (std::size_t i = 0; i < kWidth; ++i) {
      // Lanes past the end repeat the last one; what they come to is not stored.
      const std::size_t entry = first + (i < lanes ? i : lanes - 1);
      const std::uint32_t member = work.members[entry];
      detail::Group<Arch>& its = group[i / kGroupWidth];
      const std::size_t lane = i % kGroupWidth;
      its.state[lane] = fleet.states + member * fleet.stride;
      its.body[lane] = &fleet.bodies[member].J_inverse_xx;
      if constexpr (kLoad != detail::Load::free) {
        its.torque[lane] = work.torques[entry].body_start;
      }
      if constexpr (kLoad == detail::Load::varying) {
        its.harmonics[lane] = &work.harmonics[entry];
      }
    }
    const unsigned wanted = (1U << lanes) - 1U;
    const unsigned taken = detail::step_groups<Scheme, kLoad, Arch>(group, wanted, work);
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
