#include "service/trade/present.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "adstar/integrators/scheme.hpp"
#include "service/plot/plot.hpp"
#include "service/scene/scene.hpp"

namespace adstar::trade {
namespace {

std::string order_text(int order) { return order == kExactOrder ? "exact" : std::to_string(order); }

bool counted_instructions(const Trade& trade) {
  return std::any_of(trade.points.begin(), trade.points.end(),
                     [](const Measured& point) { return point.cost.instructions.has_value(); });
}

}  // namespace

std::string table(const Trade& trade) {
  std::string text = fmt::format(
      "horizon {}, reference: {}\n"
      "cost: CPU time for one simulated second of the whole scene, median of repeats (least to "
      "most); instructions: {}\n"
      "*: on the front, nothing is both cheaper and closer; ?: a step said that it could not "
      "follow "
      "the motion\n\n"
      "  {:<26} {:>5} {:>8} {:>24} {:>12} {:>12} {:>12} {:>12}\n"
      "  {:<26} {:>5} {:>8} {:>24} {:>12} {:>12} {:>12} {:>12}\n",
      scene::format_duration(trade.horizon_ns), trade.truth,
      counted_instructions(trade) ? "counted" : "this machine has no counter for them", "scheme",
      "order", "step", "cost", "instructions", "attitude", "momentum", "energy", "", "", "", "us/s",
      "1/s", "error rad", "error rel.", "error rel.");
  for (const Measured& point : trade.points) {
    const std::string cost = fmt::format("{:.4g} ({:.4g} to {:.4g})", point.cost.median_us,
                                         point.cost.least_us, point.cost.most_us);
    text += fmt::format(
        "{}{} {:<25} {:>5} {:>8} {:>24} {:>12} {:>12.2e} {:>12.2e} {:>12.2e}\n",
        point.on_front ? '*' : ' ', point.errors.resolved ? ' ' : '?', point.scheme,
        order_text(point.order), scene::format_duration(point.step_ns), cost,
        point.cost.instructions ? fmt::format("{:.3g}", *point.cost.instructions) : "-",
        point.errors.attitude_rad, point.errors.momentum_relative, point.errors.energy_relative);
  }
  return text;
}

std::string json(const Trade& trade, const std::string& scene) {
  nlohmann::ordered_json root;
  root["scene"] = scene;
  root["horizon_s"] = static_cast<double>(trade.horizon_ns) * 1e-9;
  root["reference"] = trade.truth;
  root["reference_uncertainty_rad"] = trade.uncertainty_rad;
  root["points"] = nlohmann::ordered_json::array();
  for (const Measured& point : trade.points) {
    nlohmann::ordered_json entry;
    entry["scheme"] = point.scheme;
    entry["order"] = point.order == kExactOrder ? nlohmann::ordered_json("exact")
                                                : nlohmann::ordered_json(point.order);
    entry["step_s"] = static_cast<double>(point.step_ns) * 1e-9;
    entry["cost_us_per_simulated_s"] = {{"median", point.cost.median_us},
                                        {"least", point.cost.least_us},
                                        {"most", point.cost.most_us}};
    entry["instructions_per_simulated_s"] = point.cost.instructions
                                                ? nlohmann::ordered_json(*point.cost.instructions)
                                                : nlohmann::ordered_json(nullptr);
    entry["attitude_error_rad"] = point.errors.attitude_rad;
    entry["momentum_error_relative"] = point.errors.momentum_relative;
    entry["energy_error_relative"] = point.errors.energy_relative;
    entry["resolved"] = point.errors.resolved;
    entry["on_front"] = point.on_front;
    root["points"].push_back(std::move(entry));
  }
  return root.dump(1) + "\n";
}

std::string picture(const Trade& trade, const std::string& scene) {
  constexpr double kFloor = 1e-17;
  const plot::Axis cost{"cost: CPU time for one simulated second [µs]", plot::Scale::log};
  std::vector<plot::Panel> panels = {
      {"attitude", cost, {"largest attitude error [rad]", plot::Scale::log}, {}, kFloor},
      {"inertial momentum", cost, {"largest relative error", plot::Scale::log}, {}, kFloor},
      {"rotational energy", cost, {"largest relative error", plot::Scale::log}, {}, kFloor}};
  for (const Measured& point : trade.points) {
    const double errors[] = {point.errors.attitude_rad, point.errors.momentum_relative,
                             point.errors.energy_relative};
    for (std::size_t i = 0; i < panels.size(); ++i) {
      std::vector<plot::Series>& series = panels[i].series;
      if (series.empty() || series.back().name != point.scheme) {
        series.push_back({point.scheme, {}, true});
      }
      if (point.errors.resolved) {
        series.back().points.push_back({point.cost.median_us, errors[i]});
      }
    }
  }
  return plot::svg(fmt::format("{}: work against precision over {}", scene,
                               scene::format_duration(trade.horizon_ns)),
                   panels);
}

}  // namespace adstar::trade
