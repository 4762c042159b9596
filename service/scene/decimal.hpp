#pragma once
// Decimal text to integer nanoseconds, exactly: no binary fraction in between.

#include <cstdint>
#include <optional>
#include <string_view>

namespace adstar::scene {

/// One unit is mantissa · 10^exponent nanoseconds.
struct TimeUnit {
  std::string_view name;
  std::int64_t mantissa;
  int exponent;
};

inline constexpr TimeUnit kSecond{"s", 1, 9};

/// Digits with an optional sign, point and exponent ("1.5", "-2", "1e-3"), times the unit. Nothing
/// when it is no number, not a whole count of nanoseconds, or beyond 64 bits.
std::optional<std::int64_t> exact_ns(std::string_view decimal, const TimeUnit& unit);

/// The whole text as a finite number, with a plus sign or without.
std::optional<double> finite_number(std::string_view text);

}  // namespace adstar::scene
