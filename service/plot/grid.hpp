#pragma once
// A table of coloured cells as SVG text.

#include <string>
#include <vector>

namespace adstar::plot {

struct Kind {
  std::string name;
  std::string colour;  ///< "#0072b2"
};

struct Cell {
  std::size_t kind = 0;
  std::string text;
};

struct Grid {
  std::string title, x_label;
  std::vector<std::string> rows, columns;
  std::vector<Kind> kinds;
  std::vector<Cell> cells;  ///< row by row
};

std::string svg(const Grid& grid);

}  // namespace adstar::plot
