#pragma once
// trig.hpp's sine over lanes, bit for bit: the same reduction and series in each lane. |x| ≤ kLargestAngle;
// beyond it the scalar takes another road, and what comes out here is not its value.

#include "adstar/batch/fleet_view.hpp"
#include "adstar/batch/lanes.hpp"
#include "adstar/trig.hpp"

namespace adstar::batch {

/// For |x| < 2^51: to the nearest whole number by the addition's own rounding, then down. SSE2 has no
/// instruction for it.
template <class Arch>
[[gnu::always_inline]] inline Lanes<double, Arch> lane_floor(const Lanes<double, Arch>& x) {
  using L = Lanes<double, Arch>;
  const L rounder(0x1.8p52);
  const L nearest = (x + rounder) - rounder;
  return select(nearest > x, nearest - L(1), nearest);
}

template <class Arch>
[[gnu::always_inline]] inline Lanes<double, Arch> lane_sine(const Lanes<double, Arch>& x) {
  using L = Lanes<double, Arch>;
  const L n = lane_floor(x * adstar::detail::kTwoOverPi + 0.5);
  const SinCos<L> a = adstar::detail::sincos_reduced(adstar::detail::minus_quarter_turns(x, n));
  // n mod 4: 0 sin, 1 cos, 2 -sin, 3 -cos.
  const L quadrant = n - L(4) * lane_floor(L(0.25) * n);
  const L odd = quadrant - L(2) * lane_floor(L(0.5) * quadrant);
  const L size = select(odd > L(0.5), a.cos, a.sin);
  return select(quadrant > L(1.5), -size, size);
}

}  // namespace adstar::batch
