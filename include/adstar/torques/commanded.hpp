#pragma once
// An actuator: torque intervals that somebody else decides, a few of them within reach of the
// present step. The service's command gate writes the window before each step; edges lie where
// intervals begin and end.

#include <array>
#include <cstddef>
#include <span>

#include "adstar/torques/frame.hpp"
#include "adstar/torques/intervals.hpp"

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
    const TorqueInterval<T>* const interval = in_force(all(), t_ns);
    return interval == nullptr ? Ramp<T>{} : Ramp<T>{interval->torque_n_m, {}};
  }
  std::int64_t next_edge_after(std::int64_t t_ns) const {
    return adstar::next_edge_after(all(), t_ns);
  }

 private:
  std::span<const TorqueInterval<T>> all() const { return {window.data(), intervals}; }
};

}  // namespace adstar
