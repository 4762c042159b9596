#pragma once
// Where an axis is ruled, and how numbers stand beside it.

#include <string>
#include <vector>

#include "service/plot/plot.hpp"

namespace adstar::plot {

/// The least and the most that an axis shows; least < most.
struct Range {
  double least = 0, most = 1;
};

struct Tick {
  double at = 0;
  std::string label;
};

/// `range` widened to whole ticks, and the ticks: decades on a logarithmic axis, 1-2-5 steps on a
/// linear one; about `wanted` of them.
struct Ruling {
  Range range;
  std::vector<Tick> ticks;
};
Ruling rule(Scale scale, Range range, int wanted);

}  // namespace adstar::plot
