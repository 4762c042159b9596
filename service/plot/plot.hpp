#pragma once
// Line plots as SVG text: no display, no library, the same bytes for the same numbers.

#include <string>
#include <vector>

namespace adstar::plot {

enum class Scale { linear, log };

struct Axis {
  std::string label;
  Scale scale = Scale::linear;
};

struct Point {
  double x = 0, y = 0;
};

struct Series {
  std::string name;  ///< in the legend; once for several series of that name
  std::vector<Point> points;
  bool marks = true;  ///< a mark on every point
};

/// One set of axes. What a logarithmic axis cannot show (not above zero, not finite) is left out.
struct Panel {
  std::string title;
  Axis x, y;
  std::vector<Series> series;
  double least_y = 0;  ///< logarithmic y: smaller values are drawn here, on the floor; 0: no floor
};

/// Panels one below the other. A series keeps its colour in every panel.
std::string svg(const std::string& title, const std::vector<Panel>& panels);

}  // namespace adstar::plot
