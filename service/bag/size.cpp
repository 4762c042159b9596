#include "service/bag/size.hpp"

#include <array>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

namespace adstar::bag {
namespace {

struct Unit {
  std::string_view name;
  double bytes;
};
constexpr std::array<Unit, 9> kUnits{{{"B", 1},
                                      {"kB", 1e3},
                                      {"KB", 1e3},
                                      {"MB", 1e6},
                                      {"GB", 1e9},
                                      {"TB", 1e12},
                                      {"KiB", 1024.0},
                                      {"MiB", 1048576.0},
                                      {"GiB", 1073741824.0}}};

}  // namespace

std::optional<std::uint64_t> parse_size(std::string_view text) {
  double number = 0;
  const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), number, std::chars_format::fixed);
  if (error != std::errc{} || !(number >= 0)) {
    return std::nullopt;
  }
  std::string_view name = text.substr(static_cast<std::size_t>(end - text.data()));
  name.remove_prefix(name.starts_with(' ') ? 1 : 0);
  for (const Unit& unit : kUnits) {
    constexpr double kMost = 9e18;
    if (unit.name == name && number * unit.bytes <= kMost) {
      return static_cast<std::uint64_t>(std::llround(number * unit.bytes));
    }
  }
  return std::nullopt;
}

std::string format_size(std::uint64_t bytes) {
  const auto size = static_cast<double>(bytes);
  return size < 1e3   ? fmt::format("{} B", bytes)
         : size < 1e6 ? fmt::format("{:.1f} kB", size / 1e3)
         : size < 1e9 ? fmt::format("{:.1f} MB", size / 1e6)
                      : fmt::format("{:.1f} GB", size / 1e9);
}

}  // namespace adstar::bag
