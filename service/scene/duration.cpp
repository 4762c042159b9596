#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "service/scene/decimal.hpp"
#include "service/scene/scene.hpp"

namespace adstar::scene {
namespace {

// "µ" is U+00B5 on keyboards and U+03BC in Greek text; people type either.
constexpr std::array<TimeUnit, 9> kUnits{{{"ns", 1, 0},
                                          {"us", 1, 3},
                                          {"\u00b5s", 1, 3},
                                          {"\u03bcs", 1, 3},
                                          {"ms", 1, 6},
                                          {"s", 1, 9},
                                          {"min", 6, 10},
                                          {"h", 36, 11},
                                          {"d", 864, 11}}};

struct Length {
  std::string_view name;
  std::uint64_t ns;
};
constexpr std::array<Length, 7> kLengths{{{"d", 86'400'000'000'000},
                                          {"h", 3'600'000'000'000},
                                          {"min", 60'000'000'000},
                                          {"s", 1'000'000'000},
                                          {"ms", 1'000'000},
                                          {"us", 1'000},
                                          {"ns", 1}}};

/// `ns` as an exact decimal count of `unit`; empty when its fraction does not end.
std::string exact_count(std::uint64_t ns, std::uint64_t unit) {
  std::string text = std::to_string(ns / unit);
  std::uint64_t rest = ns % unit;
  if (rest == 0) {
    return text;
  }
  text += '.';
  constexpr int kMostDecimals = 18;
  for (int i = 0; rest != 0; ++i) {
    if (i == kMostDecimals) {
      return {};
    }
    rest *= 10;  // below 10 · 8.64e13
    text += static_cast<char>('0' + rest / unit);
    rest %= unit;
  }
  return text;
}

}  // namespace

std::optional<std::int64_t> parse_duration(std::string_view text) {
  const std::size_t end_of_number = text.find_first_not_of("0123456789.");
  if (end_of_number == 0 || end_of_number == std::string_view::npos) {
    return std::nullopt;
  }
  std::string_view name = text.substr(end_of_number);
  name.remove_prefix(name.front() == ' ' ? 1 : 0);
  for (const TimeUnit& unit : kUnits) {
    if (unit.name == name) {
      return exact_ns(text.substr(0, end_of_number), unit);
    }
  }
  return std::nullopt;
}

std::string format_duration(std::int64_t ns) {
  if (ns == 0) {
    return "0s";
  }
  const auto bits = static_cast<std::uint64_t>(ns);
  const std::uint64_t magnitude = ns < 0 ? std::uint64_t{0} - bits : bits;
  std::string best;
  for (const Length& unit : kLengths) {
    if (magnitude < unit.ns) {
      continue;
    }
    const std::string count = exact_count(magnitude, unit.ns);
    if (!count.empty() && (best.empty() || count.size() + unit.name.size() < best.size())) {
      best = count + std::string(unit.name);
    }
  }
  return (ns < 0 ? "-" : "") + best;
}

}  // namespace adstar::scene
