#include "service/plot/grid.hpp"

#include <fmt/format.h>

#include "service/plot/escape.hpp"

namespace adstar::plot {
namespace {

constexpr double kLeft = 190, kTop = 60, kCellWidth = 50, kCellHeight = 20;

}  // namespace

std::string svg(const Grid& grid) {
  const double right = kLeft + kCellWidth * static_cast<double>(grid.columns.size());
  const double bottom = kTop + kCellHeight * static_cast<double>(grid.rows.size());
  const double height = bottom + 64 + 20 * static_cast<double>(grid.kinds.size());
  std::string text = fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0}" height="{1}" viewBox="0 0 {0} {1}" )"
      R"(font-family="sans-serif" font-size="12"><rect width="100%" height="100%" fill="#fff"/>)"
      R"(<text x="16" y="28" font-size="18">{2}</text>)"
      "\n",
      right + 20, height, escaped(grid.title));
  for (std::size_t row = 0; row < grid.rows.size(); ++row) {
    const double y = kTop + kCellHeight * static_cast<double>(row);
    text += fmt::format(R"(<text x="{}" y="{}" text-anchor="end">{}</text>)", kLeft - 8, y + 14,
                        escaped(grid.rows[row]));
    for (std::size_t column = 0; column < grid.columns.size(); ++column) {
      const Cell& cell = grid.cells[row * grid.columns.size() + column];
      const double x = kLeft + kCellWidth * static_cast<double>(column);
      text += fmt::format(R"(<rect x="{}" y="{}" width="{}" height="{}" fill="{}" stroke="#fff"/>)",
                          x, y, kCellWidth, kCellHeight, grid.kinds[cell.kind].colour);
      if (!cell.text.empty()) {
        text += fmt::format(R"(<text x="{}" y="{}" text-anchor="middle" font-size="10">{}</text>)",
                            x + kCellWidth / 2, y + 14, escaped(cell.text));
      }
    }
    text += "\n";
  }
  for (std::size_t column = 0; column < grid.columns.size(); ++column) {
    text += fmt::format(R"(<text x="{}" y="{}" text-anchor="middle">{}</text>)",
                        kLeft + kCellWidth * (static_cast<double>(column) + 0.5), bottom + 16,
                        escaped(grid.columns[column]));
  }
  text += fmt::format(R"(<text x="{}" y="{}" text-anchor="middle">{}</text>)"
                      "\n",
                      (kLeft + right) / 2, bottom + 36, escaped(grid.x_label));
  for (std::size_t i = 0; i < grid.kinds.size(); ++i) {
    const double y = bottom + 50 + 20 * static_cast<double>(i);
    text += fmt::format(
        R"(<rect x="{0}" y="{1}" width="28" height="14" fill="{2}"/><text x="{3}" y="{4}">{5}</text>)"
        "\n",
        kLeft, y, grid.kinds[i].colour, kLeft + 38, y + 12, escaped(grid.kinds[i].name));
  }
  return text + "</svg>\n";
}

}  // namespace adstar::plot
