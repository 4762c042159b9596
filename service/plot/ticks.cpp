#include "service/plot/ticks.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace adstar::plot {
namespace {

/// 10⁻⁶
std::string power_of_ten(int exponent) {
  static constexpr const char* kRaised[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "10⁻" : "10";
  for (const char digit : std::to_string(std::abs(exponent))) {
    text += kRaised[digit - '0'];
  }
  return text;
}

Ruling rule_decades(Range range, int wanted) {
  int first = static_cast<int>(std::floor(std::log10(range.least)));
  int last = static_cast<int>(std::ceil(std::log10(range.most)));
  last = std::max(last, first + 1);
  const int every = std::max(1, (last - first + wanted - 1) / wanted);
  Ruling ruling{{std::pow(10, first), std::pow(10, last)}, {}};
  for (int exponent = first; exponent <= last; exponent += every) {
    ruling.ticks.push_back({std::pow(10, exponent), power_of_ten(exponent)});
  }
  return ruling;
}

Ruling rule_evenly(Range range, int wanted) {
  if (!(range.most > range.least)) {
    const double margin = range.least == 0 ? 1 : std::fabs(range.least);
    range = {range.least - margin, range.most + margin};
  }
  const double rough = (range.most - range.least) / wanted;
  const double decade = std::pow(10, std::floor(std::log10(rough)));
  const double leading = rough / decade;
  const double step = decade * (leading <= 1 ? 1 : leading <= 2 ? 2 : leading <= 5 ? 5 : 10);
  const double first = std::floor(range.least / step), last = std::ceil(range.most / step);
  Ruling ruling{{first * step, last * step}, {}};
  for (double n = first; n <= last; ++n) {
    ruling.ticks.push_back({n * step, n == 0 ? "0" : fmt::format("{:.6g}", n * step)});
  }
  return ruling;
}

}  // namespace

Ruling rule(Scale scale, Range range, int wanted) {
  return scale == Scale::log ? rule_decades(range, wanted) : rule_evenly(range, wanted);
}

}  // namespace adstar::plot
