#pragma once
// Tables of coloured cells, one below the other, as SVG text.

#include <string>
#include <vector>

namespace adstar::plot {

struct Kind {
  std::string name;
  std::string colour;        ///< "#0072b2"
  std::string ink = "#000";  ///< of text on it
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

/// The kinds of the last are the legend of all.
std::string svg(const std::vector<Grid>& grids);

}  // namespace adstar::plot
