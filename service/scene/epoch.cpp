#include <chrono>

#include "service/scene/sections.hpp"
#include "service/scene/time_scales.hpp"

namespace adstar::scene {
namespace {

std::optional<unsigned> digits(std::string_view text, std::size_t from, std::size_t count) {
  if (from + count > text.size()) {
    return std::nullopt;
  }
  unsigned value = 0;
  for (const char c : text.substr(from, count)) {
    if (c < '0' || c > '9') {
      return std::nullopt;
    }
    value = value * 10 + static_cast<unsigned>(c - '0');
  }
  return value;
}

/// Seconds of 60 are leap seconds: in UTC only, in the last minute of June or December.
bool may_be_leap_second(unsigned month, unsigned day, unsigned hour, unsigned minute) {
  return hour == 23 && minute == 59 && ((month == 6 && day == 30) || (month == 12 && day == 31));
}

bool is_date_and_time(std::string_view text, TimeScale scale) {
  constexpr std::string_view kShape = "0000-00-00T00:00:00";
  if (text.size() < kShape.size() || text[4] != '-' || text[7] != '-' || text[10] != 'T' ||
      text[13] != ':' || text[16] != ':') {
    return false;
  }
  const auto year = digits(text, 0, 4), month = digits(text, 5, 2), day = digits(text, 8, 2);
  const auto hour = digits(text, 11, 2), minute = digits(text, 14, 2), second = digits(text, 17, 2);
  if (!year || !month || !day || !hour || !minute || !second) {
    return false;
  }
  const std::chrono::year_month_day date{std::chrono::year(static_cast<int>(*year)),
                                         std::chrono::month(*month), std::chrono::day(*day)};
  const bool leap = scale == TimeScale::utc && may_be_leap_second(*month, *day, *hour, *minute);
  if (!date.ok() || *hour > 23 || *minute > 59 || *second > (leap ? 60U : 59U)) {
    return false;
  }
  const std::string_view fraction = text.substr(kShape.size());
  constexpr std::size_t kMostDecimals = 9;
  return fraction.empty() ||
         (fraction[0] == '.' && fraction.size() >= 2 && fraction.size() <= 1 + kMostDecimals &&
          digits(fraction, 1, fraction.size() - 1).has_value());
}

std::string_view without_utc_mark(std::string_view text) {
  for (const std::string_view mark : {"Z", "z", "+00:00", "-00:00"}) {
    if (text.ends_with(mark)) {
      return text.substr(0, text.size() - mark.size());
    }
  }
  return text;
}

}  // namespace

std::optional<std::string> read_epoch(const Value& value, TimeScale scale) {
  if (!value) {
    return std::nullopt;
  }
  const bool utc = scale == TimeScale::utc;
  std::string text = value.node().text;
  if (text.size() > 10 && (text[10] == ' ' || text[10] == 't')) {
    text[10] = 'T';
  }
  const std::string_view local = utc ? without_utc_mark(text) : std::string_view(text);
  // ERFA knows which leap seconds there were.
  if (!is_date_and_time(local, scale) || !tai_date(local, utc ? Clock::utc : Clock::tai)) {
    value.refuse(utc ? "a date and time in UTC, of 1972 or later"
                     : "a date and time in TAI, without an offset",
                 utc ? "2026-01-01T00:00:00Z" : "2026-01-01T00:00:00");
    return std::nullopt;
  }
  return std::string(local) + (utc ? " UTC" : " TAI");
}

}  // namespace adstar::scene
