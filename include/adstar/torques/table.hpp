#pragma once
// A torque given as a time series, held (zero-order) or joined by lines. Its knots are edges: a
// step that holds one is split there. Zero before the first knot; after the last, zero or the last
// value, as asked.

#include <algorithm>
#include <cstddef>
#include <vector>

#include "adstar/torques/frame.hpp"

namespace adstar {

enum class Interpolation : std::uint8_t { hold, linear };
enum class AfterEnd : std::uint8_t { zero, hold };

template <class T>
struct Table {
  static constexpr const char* kName = "table";
  Frame frame = Frame::body;
  Interpolation interpolation = Interpolation::hold;
  AfterEnd after_end = AfterEnd::zero;
  std::vector<std::int64_t> time_ns;  ///< strictly rising
  std::vector<Vec3<T>> torque_n_m;    ///< one a knot

  Ramp<T> ramp_from(std::int64_t t_ns) const {
    const auto next = std::upper_bound(time_ns.begin(), time_ns.end(), t_ns);
    if (next == time_ns.begin()) {
      return {};
    }
    const auto i = static_cast<std::size_t>(next - time_ns.begin()) - 1;
    if (next == time_ns.end()) {
      return after_end == AfterEnd::hold ? Ramp<T>{torque_n_m[i], {}} : Ramp<T>{};
    }
    if (interpolation == Interpolation::hold) {
      return {torque_n_m[i], {}};
    }
    const Vec3<T> slope =
        (T(1) / seconds<T>(time_ns[i + 1] - time_ns[i])) * (torque_n_m[i + 1] - torque_n_m[i]);
    return {torque_n_m[i] + seconds<T>(t_ns - time_ns[i]) * slope, slope};
  }

  std::int64_t next_edge_after(std::int64_t t_ns) const {
    const auto next = std::upper_bound(time_ns.begin(), time_ns.end(), t_ns);
    return next == time_ns.end() ? kNever : *next;
  }
};

}  // namespace adstar
