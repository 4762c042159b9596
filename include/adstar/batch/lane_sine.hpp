#pragma once
// sine.hpp over lanes, bit for bit: the same reduction and series in each lane. |x| ≤ kLargestAngle;
// beyond it the scalar takes another road, and what comes out here is not its value.

#include "adstar/batch/fleet_view.hpp"
#include "adstar/batch/lanes.hpp"
#include "adstar/sine.hpp"

namespace adstar::batch {

template <class Arch>
[[gnu::always_inline]] inline Lanes<double, Arch> lane_sine(const Lanes<double, Arch>& x) {
  using L = Lanes<double, Arch>;
  const L wholes(adstar::detail::kWholes);
  const L n = (x * L(adstar::detail::kOverPi) + wholes) - wholes;
  const L y = adstar::detail::sine_less_half_turns(x, n);
  const L even = (L(0.5) * n + wholes) - wholes;  // n/2, halves to the even neighbour
  const L rest = n - L(2) * even;
  return select(rest * rest > L(0.5), -y, y);
}

}  // namespace adstar::batch
