#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "service/plot/grid.hpp"
#include "service/trade/stability_map.hpp"

namespace adstar::trade {
namespace {

double percent_reported(const MapCell& cell) {
  return 100.0 * cell.reported() / std::max(1, cell.starts());
}

}  // namespace

std::string table(const StabilityMap& map) {
  constexpr char kLetters[] = {'=', 'a', 'b', '?', 'X'};
  std::string text = fmt::format("{:<24}", "|omega| h [rad]");
  for (const double turn : map.turns_rad) {
    text += fmt::format("{:>8}", fmt::format("{:.4g}", turn));
  }
  text += "\n";
  for (std::size_t row = 0; row < map.schemes.size(); ++row) {
    text += fmt::format("{:<24}", map.schemes[row]);
    for (std::size_t column = 0; column < map.turns_rad.size(); ++column) {
      const MapCell& cell = map.cells[row * map.turns_rad.size() + column];
      std::string mark(1, kLetters[static_cast<std::size_t>(cell.worst())]);
      if (cell.reported() > 0 && cell.worst() != Standing::reported) {
        mark += fmt::format(" {:.0f}%", percent_reported(cell));
      }
      text += fmt::format("{:>8}", mark);
    }
    text += "\n";
  }
  text +=
      "\nthe worst of all starts: = round-off, a within a thousandth of the turn, b within 0.1 "
      "rad, "
      "X wrong in silence; %: so many starts were reported as unresolved, ? all\n";
  for (const MapCell& cell : map.cells) {
    if (cell.worst() == Standing::wrong) {
      text += fmt::format(
          "X {} at {:.4g} rad: {} of {} starts, worst {:.2g} rad, {}\n", cell.scheme, cell.turn_rad,
          cell.counts.back(),
          cell.counts[0] + cell.counts[1] + cell.counts[2] + cell.counts[3] + cell.counts[4],
          cell.worst_rad, cell.worst_case);
    }
  }
  return text;
}

std::string json(const StabilityMap& map) {
  nlohmann::ordered_json cells = nlohmann::ordered_json::array();
  for (const MapCell& cell : map.cells) {
    nlohmann::ordered_json entry;
    entry["scheme"] = cell.scheme;
    entry["turn_rad"] = cell.turn_rad;
    entry["standing"] = kStandings[static_cast<std::size_t>(cell.worst())];
    for (std::size_t i = 0; i < kStandings.size(); ++i) {
      entry["starts"][kStandings[i]] = cell.counts[i];
    }
    entry["worst_unreported_error_rad"] = cell.worst_rad;
    entry["worst_case"] = cell.worst_case;
    cells.push_back(std::move(entry));
  }
  return nlohmann::ordered_json{{"cells", cells}}.dump(1) + "\n";
}

std::string picture(const StabilityMap& map) {
  plot::Grid grid;
  grid.title = "One step of every scheme at the extremes: the worst of all starts";
  grid.x_label = "|omega| h [rad]";
  grid.rows = map.schemes;
  for (const double turn : map.turns_rad) {
    grid.columns.push_back(fmt::format("{:.4g}", turn));
  }
  grid.kinds = {{"exact: round-off", "#0072b2"},
                {"accurate: within 1e-3 of the turn", "#56b4e9"},
                {"bounded: within 0.1 rad", "#f0e442"},
                {"all reported as unresolved (%: so many)", "#cccccc"},
                {"wrong in silence", "#d55e00"}};
  for (const MapCell& cell : map.cells) {
    grid.cells.push_back({static_cast<std::size_t>(cell.worst()),
                          cell.reported() > 0 && cell.worst() != Standing::reported
                              ? fmt::format("{:.0f}%", percent_reported(cell))
                              : ""});
  }
  return plot::svg(grid);
}

}  // namespace adstar::trade
