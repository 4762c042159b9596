#pragma once
// An actuator: torque intervals that somebody else decides, a few of them within reach of the
// present step. The service's command gate writes the window before each step; edges lie where
// intervals begin and end.

#include <array>
#include <cstddef>

#include "adstar/torques/frame.hpp"

namespace adstar {

template <class T>
struct TorqueInterval {
  std::int64_t start_ns = 0;
  std::int64_t end_ns = 0;  ///< exclusive
  Vec3<T> torque_n_m;
};

template <class T>
struct Commanded {
  static constexpr const char* kName = "commanded";
  /// Commands of one actuator that may act within one step.
  static constexpr std::size_t kWindow = 16;

  Frame frame = Frame::body;
  std::array<TorqueInterval<T>, kWindow> window{};  ///< ascending, disjoint
  std::size_t intervals = 0;

  Ramp<T> ramp_from(std::int64_t t_ns) const {
    for (std::size_t i = 0; i < intervals; ++i) {
      if (window[i].start_ns <= t_ns && t_ns < window[i].end_ns) {
        return {window[i].torque_n_m, {}};
      }
    }
    return {};
  }

  std::int64_t next_edge_after(std::int64_t t_ns) const {
    std::int64_t next = kNever;
    for (std::size_t i = 0; i < intervals; ++i) {
      if (window[i].start_ns > t_ns && window[i].start_ns < next) {
        next = window[i].start_ns;
      }
      if (window[i].end_ns > t_ns && window[i].end_ns < next) {
        next = window[i].end_ns;
      }
    }
    return next;
  }
};

}  // namespace adstar
