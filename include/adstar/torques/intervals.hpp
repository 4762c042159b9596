#pragma once
// Intervals that somebody else decides: ascending and disjoint, each with a beginning and an end that is not in it.

#include <algorithm>
#include <span>

#include "adstar/torques/frame.hpp"

namespace adstar {

/// The one that t_ns is in; null when it is in none.
template <class Interval>
const Interval* in_force(std::span<const Interval> intervals, std::int64_t t_ns) {
  for (const Interval& interval : intervals) {
    if (interval.start_ns <= t_ns && t_ns < interval.end_ns) {
      return &interval;
    }
  }
  return nullptr;
}

/// The first beginning or end past t_ns.
template <class Interval>
std::int64_t next_edge_after(std::span<const Interval> intervals, std::int64_t t_ns) {
  std::int64_t next = kNever;
  for (const Interval& interval : intervals) {
    if (interval.start_ns > t_ns) {
      next = std::min(next, interval.start_ns);
    }
    if (interval.end_ns > t_ns) {
      next = std::min(next, interval.end_ns);
    }
  }
  return next;
}

}  // namespace adstar
