#include "service/scene/decimal.hpp"

#include <charconv>
#include <cmath>
#include <limits>
#include <string>

namespace adstar::scene {
namespace {

// A wider intermediate: 25 digits times a mantissa of three.
__extension__ using Wide = unsigned __int128;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// digits · 10^exponent with neither leading nor trailing zeros in `digits`.
struct Decimal {
  bool negative = false;
  std::string digits;
  long exponent = 0;
};

std::optional<Decimal> parse_decimal(std::string_view text) {
  Decimal decimal;
  std::size_t i = 0;
  if (i < text.size() && (text[i] == '-' || text[i] == '+')) {
    decimal.negative = text[i++] == '-';
  }
  bool any_digit = false;
  bool after_point = false;
  for (; i < text.size() && (is_digit(text[i]) || (text[i] == '.' && !after_point)); ++i) {
    if (text[i] == '.') {
      after_point = true;
      continue;
    }
    any_digit = true;
    decimal.exponent -= after_point ? 1 : 0;
    if (text[i] != '0' || !decimal.digits.empty()) {
      decimal.digits += text[i];
    }
  }
  if (!any_digit || text[i - 1] == '.') {
    return std::nullopt;
  }
  if (i < text.size() && (text[i] == 'e' || text[i] == 'E')) {
    ++i;
    if (i < text.size() && text[i] == '+' && i + 1 < text.size() && is_digit(text[i + 1])) {
      ++i;
    }
    int power = 0;
    const auto [end, error] = std::from_chars(text.data() + i, text.data() + text.size(), power);
    if (error != std::errc{}) {
      return std::nullopt;
    }
    decimal.exponent += power;
    i = static_cast<std::size_t>(end - text.data());
  }
  if (i != text.size()) {
    return std::nullopt;
  }
  while (!decimal.digits.empty() && decimal.digits.back() == '0') {
    decimal.digits.pop_back();
    ++decimal.exponent;
  }
  return decimal;
}

}  // namespace

std::optional<std::int64_t> exact_ns(std::string_view text, const TimeUnit& unit) {
  const auto decimal = parse_decimal(text);
  if (!decimal) {
    return std::nullopt;
  }
  if (decimal->digits.empty()) {
    return 0;
  }
  // A whole int64 has 19 digits; a mantissa of 864 = 2^5 27 turns at most five more into trailing
  // zeros.
  constexpr std::size_t kMostDigits = 25;
  if (decimal->digits.size() > kMostDigits) {
    return std::nullopt;
  }
  Wide value = 0;
  for (const char digit : decimal->digits) {
    value = value * 10 + static_cast<unsigned>(digit - '0');
  }
  value *= static_cast<Wide>(unit.mantissa);
  constexpr auto kMost = static_cast<Wide>(std::numeric_limits<std::int64_t>::max());
  long exponent = decimal->exponent + unit.exponent;
  for (; exponent > 0; --exponent) {
    value *= 10;
    if (value > kMost) {
      return std::nullopt;
    }
  }
  for (; exponent < 0; ++exponent) {
    if (value % 10 != 0) {
      return std::nullopt;
    }
    value /= 10;
  }
  if (value > kMost) {
    return std::nullopt;
  }
  const auto ns = static_cast<std::int64_t>(value);
  return decimal->negative ? -ns : ns;
}

std::optional<double> finite_number(std::string_view text) {
  text.remove_prefix(text.size() > 1 && text[0] == '+' && text[1] != '-' ? 1 : 0);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

}  // namespace adstar::scene
