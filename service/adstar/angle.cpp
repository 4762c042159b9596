#include "service/adstar/angle.hpp"

#include <charconv>
#include <cmath>
#include <numbers>
#include <utility>

namespace adstar::cli {

std::optional<double> parse_angle(std::string_view text) {
  constexpr double kDegree = std::numbers::pi / 180;
  constexpr std::pair<std::string_view, double> kUnits[] = {
      {"", 1},        {"rad", 1},       {"mrad", 1e-3},           {"urad", 1e-6},
      {"nrad", 1e-9}, {"deg", kDegree}, {"arcmin", kDegree / 60}, {"arcsec", kDegree / 3600}};
  double number = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc{} || !std::isfinite(number) || number <= 0) {
    return std::nullopt;
  }
  for (const auto& [unit, factor] : kUnits) {
    if (std::string_view(rest, static_cast<std::size_t>(end - rest)) == unit) {
      return number * factor;
    }
  }
  return std::nullopt;
}

}  // namespace adstar::cli
