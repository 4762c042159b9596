#pragma once
// A pair of thrusters that turns and does not push: a constant torque in B while it is on, else none.
//
// On-times come from a command window, as in torques/commanded.hpp, or from a schedule made beforehand. One shorter than
// minimum_on_ns lasts that long; where it then reaches the next one, both are one. Edges are exact to the nanosecond. Left
// out: how thrust builds up and decays, what the propellant's mass takes from the body.

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "adstar/torques/commanded.hpp"
#include "adstar/torques/frame.hpp"

namespace adstar {

struct OnInterval {
  std::int64_t start_ns = 0;
  std::int64_t end_ns = 0;  ///< exclusive
  friend bool operator==(const OnInterval&, const OnInterval&) = default;
};

/// When a thruster that was told to be on in `interval` goes off.
constexpr std::int64_t off_at(const OnInterval& interval, std::int64_t minimum_on_ns) {
  const std::int64_t room = kNever - std::max<std::int64_t>(interval.start_ns, 0);
  return std::max(interval.end_ns, interval.start_ns + std::min(minimum_on_ns, room));
}

using OnSchedule = std::shared_ptr<const std::vector<OnInterval>>;

/// In order, lengthened, and those that touch made one; empty ones (an end not past the start) left out.
inline OnSchedule make_on_schedule(std::vector<OnInterval> asked, std::int64_t minimum_on_ns) {
  std::sort(asked.begin(), asked.end(), [](const OnInterval& a, const OnInterval& b) {
    return std::pair(a.start_ns, a.end_ns) < std::pair(b.start_ns, b.end_ns);
  });
  std::vector<OnInterval> merged;
  for (const OnInterval& interval : asked) {
    if (interval.end_ns <= interval.start_ns) {
      continue;
    }
    const std::int64_t end_ns = off_at(interval, minimum_on_ns);
    if (!merged.empty() && interval.start_ns <= merged.back().end_ns) {
      merged.back().end_ns = std::max(merged.back().end_ns, end_ns);
    } else {
      merged.push_back({interval.start_ns, end_ns});
    }
  }
  return std::make_shared<const std::vector<OnInterval>>(std::move(merged));
}

template <class T>
struct Thruster {
  static constexpr const char* kName = "thruster";
  static constexpr Frame frame = Frame::body;
  static constexpr std::size_t kWindow = Commanded<T>::kWindow;

  Vec3<T> torque_n_m;              ///< while on
  std::int64_t minimum_on_ns = 0;  ///< for the window; a schedule has it in it
  OnSchedule schedule{};           ///< make_on_schedule(); null: the window is in force
  /// Ascending by start. An interval must stay in it until off_at(), or the thruster goes off with it: the service's gate
  /// lengthens what it commands itself.
  std::array<OnInterval, kWindow> window{};
  std::size_t intervals = 0;

  bool is_on(std::int64_t t_ns) const {
    if (schedule) {
      const auto next = next_in_schedule(t_ns);
      return next != schedule->begin() && t_ns < std::prev(next)->end_ns;
    }
    for (std::size_t i = 0; i < intervals; ++i) {
      const OnInterval& interval = window[i];
      if (interval.start_ns <= t_ns && interval.start_ns < interval.end_ns &&
          t_ns < off_at(interval, minimum_on_ns)) {
        return true;
      }
    }
    return false;
  }

  Ramp<T> ramp_from(std::int64_t t_ns) const {
    return is_on(t_ns) ? Ramp<T>{torque_n_m, {}} : Ramp<T>{};
  }

  std::int64_t next_edge_after(std::int64_t t_ns) const {
    std::int64_t edge = kNever;
    const auto consider = [&](std::int64_t at_ns) {
      if (at_ns > t_ns) {
        edge = std::min(edge, at_ns);
      }
    };
    if (schedule) {
      const auto next = next_in_schedule(t_ns);
      if (next != schedule->end()) {
        consider(next->start_ns);
      }
      if (next != schedule->begin()) {
        consider(std::prev(next)->end_ns);
      }
      return edge;
    }
    for (std::size_t i = 0; i < intervals; ++i) {
      if (window[i].start_ns < window[i].end_ns) {
        consider(window[i].start_ns);
        consider(off_at(window[i], minimum_on_ns));
      }
    }
    return edge;
  }

 private:
  std::vector<OnInterval>::const_iterator next_in_schedule(std::int64_t t_ns) const {
    return std::upper_bound(
        schedule->begin(), schedule->end(), t_ns,
        [](std::int64_t at_ns, const OnInterval& interval) { return at_ns < interval.start_ns; });
  }
};

}  // namespace adstar
