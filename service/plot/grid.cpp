#include "service/plot/grid.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "service/plot/escape.hpp"

namespace adstar::plot {
namespace {

constexpr double kLeft = 190, kTop = 60, kCellWidth = 54, kCellHeight = 20, kBelow = 50;

double width_of(const Grid& grid) {
  return kLeft + kCellWidth * static_cast<double>(grid.columns.size());
}
double height_of(const Grid& grid) {
  return kTop + kCellHeight * static_cast<double>(grid.rows.size()) + kBelow;
}

/// The grid from `above` down.
std::string cells_of(const Grid& grid, double above) {
  const double top = above + kTop;
  const double bottom = top + kCellHeight * static_cast<double>(grid.rows.size());
  std::string text = fmt::format(R"(<text x="16" y="{}" font-size="18">{}</text>)"
                                 "\n",
                                 above + 36, escaped(grid.title));
  for (std::size_t row = 0; row < grid.rows.size(); ++row) {
    const double y = top + kCellHeight * static_cast<double>(row);
    text += fmt::format(R"(<text x="{}" y="{}" text-anchor="end">{}</text>)", kLeft - 8, y + 14,
                        escaped(grid.rows[row]));
    for (std::size_t column = 0; column < grid.columns.size(); ++column) {
      const Cell& cell = grid.cells[row * grid.columns.size() + column];
      const double x = kLeft + kCellWidth * static_cast<double>(column);
      text += fmt::format(R"(<rect x="{}" y="{}" width="{}" height="{}" fill="{}" stroke="#fff"/>)",
                          x, y, kCellWidth, kCellHeight, grid.kinds[cell.kind].colour);
      if (!cell.text.empty()) {
        text += fmt::format(
            R"(<text x="{}" y="{}" text-anchor="middle" font-size="10" fill="{}">{}</text>)",
            x + kCellWidth / 2, y + 14, grid.kinds[cell.kind].ink, escaped(cell.text));
      }
    }
    text += "\n";
  }
  for (std::size_t column = 0; column < grid.columns.size(); ++column) {
    text += fmt::format(R"(<text x="{}" y="{}" text-anchor="middle" font-size="10">{}</text>)",
                        kLeft + kCellWidth * (static_cast<double>(column) + 0.5), bottom + 15,
                        escaped(grid.columns[column]));
  }
  return text + fmt::format(R"(<text x="{}" y="{}" text-anchor="middle">{}</text>)"
                            "\n",
                            (kLeft + width_of(grid)) / 2, bottom + 34, escaped(grid.x_label));
}

}  // namespace

std::string svg(const std::vector<Grid>& grids) {
  double width = 0, height = 0;
  std::string body;
  for (const Grid& grid : grids) {
    body += cells_of(grid, height);
    width = std::max(width, width_of(grid));
    height += height_of(grid);
  }
  const std::vector<Kind> kinds = grids.empty() ? std::vector<Kind>{} : grids.back().kinds;
  for (const Kind& kind : kinds) {
    body += fmt::format(
        R"(<rect x="{0}" y="{1}" width="28" height="14" fill="{2}"/><text x="{3}" y="{4}">{5}</text>)"
        "\n",
        kLeft, height, kind.colour, kLeft + 38, height + 12, escaped(kind.name));
    height += 20;
  }
  return fmt::format(
             R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0}" height="{1}" viewBox="0 0 {0} {1}" )"
             R"(font-family="sans-serif" font-size="12"><rect width="100%" height="100%" fill="#fff"/>)"
             "\n",
             width + 20, height + 14) +
         body + "</svg>\n";
}

}  // namespace adstar::plot
