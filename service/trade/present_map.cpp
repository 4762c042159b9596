#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "service/plot/grid.hpp"
#include "service/trade/stability_map.hpp"

namespace adstar::trade {
namespace {

std::string percent_reported(const MapCell& cell) {
  const double percent = 100.0 * cell.reported() / std::max(1, cell.starts());
  return percent > 0 && percent < 1 ? "<1%" : fmt::format("{:.0f}%", percent);
}

bool some_reported(const MapCell& cell) {
  return cell.reported() > 0 && cell.worst() != Standing::reported;
}

/// "separatrix 12, damping 3", the most frequent first.
std::string detectors_text(const std::vector<const MapCell*>& cells) {
  std::vector<std::pair<int, std::string>> spoke;
  for (std::size_t i = 0; i < kDetectors.size(); ++i) {
    int count = 0;
    for (const MapCell* cell : cells) {
      count += cell->detectors[i];
    }
    if (count > 0) {
      spoke.emplace_back(count, kDetectors[i]);
    }
  }
  std::stable_sort(spoke.begin(), spoke.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::string text;
  for (const auto& [count, name] : spoke) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name, count);
  }
  return text.empty() ? "none" : text;
}

std::string rows_of(const Chart& chart, const std::vector<std::string>& schemes) {
  constexpr char kLetters[] = {'=', 'a', 'b', '?', 'X'};
  std::string text = fmt::format("{}\n{:<26}", chart.title, "");
  std::size_t width = 7;
  for (const std::string& column : chart.columns) {
    width = std::max(width, column.size() + 1);
  }
  for (const std::string& column : chart.columns) {
    text += fmt::format("{:>{}}", column, width);
  }
  text += fmt::format("  {}\n", chart.x_label);
  for (std::size_t row = 0; row < schemes.size(); ++row) {
    text += fmt::format("{:<26}", schemes[row]);
    for (std::size_t column = 0; column < chart.columns.size(); ++column) {
      const MapCell& cell = chart.cells[row * chart.columns.size() + column];
      std::string mark = ".";
      if (cell.starts() > 0) {
        mark = std::string(1, kLetters[static_cast<std::size_t>(cell.worst())]);
        mark += some_reported(cell) ? " " + percent_reported(cell) : "";
      }
      text += fmt::format("{:>{}}", mark, width);
    }
    text += "\n";
  }
  return text + "\n";
}

}  // namespace

std::string table(const StabilityMap& map) {
  std::string text;
  for (const Chart& chart : map.charts) {
    text += rows_of(chart, map.schemes);
  }
  text +=
      "the worst of all starts: = round-off, a within a thousandth of the turn, b within 0.1 rad, "
      "X wrong in silence; %: so many starts were reported as unresolved, ? all; . knows no "
      "torque\n"
      "reported by:\n";
  for (std::size_t row = 0; row < map.schemes.size(); ++row) {
    std::vector<const MapCell*> cells;
    for (const Chart& chart : map.charts) {
      for (std::size_t column = 0; column < chart.columns.size(); ++column) {
        cells.push_back(&chart.cells[row * chart.columns.size() + column]);
      }
    }
    text += fmt::format("{:<26}{}\n", map.schemes[row], detectors_text(cells));
  }
  text += fmt::format("the worst truth is known to {:.1e} rad\n", map.uncertainty_rad);
  for (const Chart& chart : map.charts) {
    for (const MapCell& cell : chart.cells) {
      if (cell.worst() == Standing::wrong) {
        text += fmt::format("X {} at {} {}: {} of {} starts, worst {:.2g} rad, {}\n", cell.scheme,
                            cell.column, chart.x_label, cell.counts.back(), cell.starts(),
                            cell.worst_rad, cell.worst_case);
      }
    }
  }
  return text;
}

std::string json(const StabilityMap& map) {
  nlohmann::ordered_json cells = nlohmann::ordered_json::array();
  for (const Chart& chart : map.charts) {
    for (const MapCell& cell : chart.cells) {
      if (cell.starts() == 0) {
        continue;
      }
      nlohmann::ordered_json entry;
      entry["chart"] = chart.title;
      entry["column"] = cell.column;
      entry["scheme"] = cell.scheme;
      entry["standing"] = kStandings[static_cast<std::size_t>(cell.worst())];
      for (std::size_t i = 0; i < kStandings.size(); ++i) {
        entry["starts"][kStandings[i]] = cell.counts[i];
      }
      for (std::size_t i = 0; i < kDetectors.size(); ++i) {
        entry["reported_by"][kDetectors[i]] = cell.detectors[i];
      }
      entry["worst_unreported_error_rad"] = cell.worst_rad;
      entry["worst_case"] = cell.worst_case;
      cells.push_back(std::move(entry));
    }
  }
  return nlohmann::ordered_json{{"truth_uncertainty_rad", map.uncertainty_rad}, {"cells", cells}}
             .dump(1) +
         "\n";
}

std::string picture(const StabilityMap& map) {
  const std::vector<plot::Kind> kinds = {{"exact: round-off", "#0072b2", "#fff"},
                                         {"accurate: within 1e-3 of the turn", "#56b4e9"},
                                         {"bounded: within 0.1 rad", "#f0e442"},
                                         {"all reported as unresolved (%: so many)", "#cccccc"},
                                         {"wrong in silence", "#d55e00"},
                                         {"knows no torque", "#f4f4f4"}};
  std::vector<plot::Grid> grids;
  for (const Chart& chart : map.charts) {
    plot::Grid grid{chart.title, chart.x_label, map.schemes, chart.columns, kinds, {}};
    for (const MapCell& cell : chart.cells) {
      const std::size_t kind =
          cell.starts() == 0 ? kinds.size() - 1 : static_cast<std::size_t>(cell.worst());
      grid.cells.push_back({kind, some_reported(cell) ? percent_reported(cell) : ""});
    }
    grids.push_back(std::move(grid));
  }
  return plot::svg(grids);
}

}  // namespace adstar::trade
