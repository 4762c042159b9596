#include "service/report/numbers.hpp"

#include <array>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

namespace adstar::report {

void append_number(std::string& text, double value) {
  if (std::isnan(value)) {
    text += "nan";
    return;
  }
  std::array<char, 32> digits{};
  constexpr int kSignificant = 17;
  const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                    std::chars_format::general, kSignificant);
  text.append(digits.data(), result.ptr);
}

void append_seconds(std::string& text, std::int64_t ns) {
  constexpr std::uint64_t kPerSecond = 1'000'000'000;
  const auto bits = static_cast<std::uint64_t>(ns);
  const std::uint64_t magnitude = ns < 0 ? std::uint64_t{0} - bits : bits;
  fmt::format_to(std::back_inserter(text), FMT_STRING("{}{}"), ns < 0 ? "-" : "",
                 magnitude / kPerSecond);
  if (magnitude % kPerSecond != 0) {
    fmt::format_to(std::back_inserter(text), FMT_STRING(".{:09}"), magnitude % kPerSecond);
    text.resize(text.find_last_not_of('0') + 1);
  }
}

std::string seconds_text(std::int64_t ns) {
  std::string text;
  append_seconds(text, ns);
  return text;
}

std::string counted(std::uint64_t count) {
  std::string text = std::to_string(count);
  for (std::size_t i = text.size(); i > 3; i -= 3) {
    text.insert(i - 3, 1, ',');
  }
  return text;
}

std::string short_number(double value) { return fmt::format("{:.6g}", value); }

}  // namespace adstar::report
