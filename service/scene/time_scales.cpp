#include "service/scene/time_scales.hpp"

#include <array>
#include <cmath>
#include <erfa.h>

#include <fmt/format.h>

namespace adstar::scene {
namespace {

constexpr double kDay_s = 86400.0;
constexpr double kTtMinusTai_s = 32.184, kTaiMinusGps_s = 19.0;

/// Takes `count` digits and, unless it is '\0', the mark after them.
std::optional<int> take(std::string_view& text, std::size_t count, char mark) {
  const std::size_t whole = count + (mark == '\0' ? 0 : 1);
  if (text.size() < whole || (mark != '\0' && text[count] != mark)) {
    return std::nullopt;
  }
  int value = 0;
  for (const char c : text.substr(0, count)) {
    if (c < '0' || c > '9') {
      return std::nullopt;
    }
    value = value * 10 + (c - '0');
  }
  text.remove_prefix(whole);
  return value;
}

/// ".5" as 0.5: digits alone, up to a nanosecond and beyond.
std::optional<double> take_fraction(std::string_view& text) {
  if (text.empty() || text[0] != '.') {
    return 0.0;
  }
  text.remove_prefix(1);
  double value = 0, unit = 1;
  std::size_t digits = 0;
  for (; !text.empty() && text[0] >= '0' && text[0] <= '9'; text.remove_prefix(1), ++digits) {
    unit /= 10;
    value += unit * (text[0] - '0');
  }
  return digits > 0 ? std::optional(value) : std::nullopt;
}

struct Calendar {
  int year = 0, month = 1, day = 1, hour = 0, minute = 0;
  double second = 0;
};

std::optional<Calendar> calendar_of(std::string_view text) {
  Calendar c;
  const auto year = take(text, 4, '-');
  const bool day_of_year = text.size() > 3 && text[3] == 'T';
  const auto month = day_of_year ? std::optional(1) : take(text, 2, '-');
  const auto day = take(text, day_of_year ? 3 : 2, 'T');
  const auto hour = take(text, 2, ':');
  const auto minute = take(text, 2, ':');
  const auto second = take(text, 2, '\0');
  if (!year || !month || !day || !hour || !minute || !second) {
    return std::nullopt;
  }
  const auto fraction = take_fraction(text);
  if (!fraction || (!text.empty() && text != "Z")) {
    return std::nullopt;
  }
  c = {*year, *month, *day, *hour, *minute, *second + *fraction};
  if (day_of_year) {
    double day0 = 0, day1 = 0, rest = 0;
    if (*day < 1 || *day > 366 || eraCal2jd(*year, 1, 1, &day0, &day1) != 0 ||
        eraJd2cal(day0, day1 + (*day - 1), &c.year, &c.month, &c.day, &rest) != 0 ||
        c.year != *year) {
      return std::nullopt;
    }
  }
  return c;
}

double rounded(double value) {
  constexpr double kGrid = 0x1p-40;
  return std::nearbyint(value / kGrid) * kGrid;
}

}  // namespace

std::optional<TaiDate> tai_date(std::string_view text, Clock clock) {
  const auto c = calendar_of(text);
  if (!c) {
    return std::nullopt;
  }
  const bool utc = clock == Clock::utc;
  constexpr int kFirstOfLeapSeconds = 1972;  // before, UTC was stretched, or was not
  if (utc && c->year < kFirstOfLeapSeconds) {
    return std::nullopt;
  }
  double day = 0, fraction = 0;
  // 1: a year that ERFA's leap seconds do not reach is taken with the last that it knows; above it, past the day's end.
  const int status = eraDtf2d(utc ? "UTC" : "TAI", c->year, c->month, c->day, c->hour, c->minute,
                              c->second, &day, &fraction);
  if (status < 0 || status > 1) {
    return std::nullopt;
  }
  TaiDate date;
  if (utc) {
    return eraUtctai(day, fraction, &date.day, &date.fraction) < 0 ? std::nullopt
                                                                   : std::optional(date);
  }
  const double ahead = clock == Clock::tt    ? -kTtMinusTai_s
                       : clock == Clock::gps ? kTaiMinusGps_s
                                             : 0.0;
  return TaiDate{day, fraction + ahead / kDay_s};
}

std::optional<TaiDate> tai_date_of_epoch(std::string_view epoch) {
  constexpr std::string_view kUtc = " UTC", kTai = " TAI";
  if (epoch.ends_with(kUtc)) {
    return tai_date(epoch.substr(0, epoch.size() - kUtc.size()), Clock::utc);
  }
  return epoch.ends_with(kTai) ? tai_date(epoch.substr(0, epoch.size() - kTai.size()), Clock::tai)
                               : std::nullopt;
}

std::optional<std::int64_t> nanoseconds_from(const TaiDate& begin, const TaiDate& end) {
  constexpr double kFarthest_days = 106'000;
  constexpr std::int64_t kDay_ns = 86'400'000'000'000;
  const double days = end.day - begin.day;
  const double whole = std::nearbyint(days);
  if (!(std::fabs(days) < kFarthest_days)) {
    return std::nullopt;
  }
  const double rest = (days - whole) + (end.fraction - begin.fraction);
  return static_cast<std::int64_t>(whole) * kDay_ns +
         std::llround(rest * static_cast<double>(kDay_ns));
}

std::optional<std::string> utc_text(const TaiDate& begin, std::int64_t later_ns) {
  constexpr std::int64_t kDay_ns = 86'400'000'000'000;
  constexpr int kDecimals = 9;
  const std::int64_t days = later_ns / kDay_ns;
  const double rest = static_cast<double>(later_ns % kDay_ns) / static_cast<double>(kDay_ns);
  double utc = 0, utc_fraction = 0;
  int year = 0, month = 0, day = 0;
  int clock[4] = {};
  if (eraTaiutc(begin.day + static_cast<double>(days), begin.fraction + rest, &utc, &utc_fraction) <
          0 ||
      eraD2dtf("UTC", kDecimals, utc, utc_fraction, &year, &month, &day, clock) < 0 || year < 1 ||
      year > 9999) {
    return std::nullopt;
  }
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:09}", year, month, day, clock[0],
                     clock[1], clock[2], clock[3]);
}

double days_since_j2000(const TaiDate& date) {
  constexpr double kJ2000 = 2451545.0;
  return (date.day - kJ2000) + (date.fraction + kTtMinusTai_s / kDay_s);
}

double julian_year(const TaiDate& date) { return 2000.0 + days_since_j2000(date) / 365.25; }

EarthRotation<double> earth_rotation(const TaiDate& date, double ut1_minus_utc_s) {
  double tt = 0, tt_fraction = 0, utc = 0, utc_fraction = 0, ut1 = 0, ut1_fraction = 0;
  eraTaitt(date.day, date.fraction, &tt, &tt_fraction);
  eraTaiutc(date.day, date.fraction, &utc, &utc_fraction);
  eraUtcut1(utc, utc_fraction, ut1_minus_utc_s, &ut1, &ut1_fraction);
  double Q[3][3];
  eraC2i06a(tt, tt_fraction, Q);
  const auto row = [&Q](int i) {
    return Vec3<double>{rounded(Q[i][0]), rounded(Q[i][1]), rounded(Q[i][2])};
  };
  const auto unit = [](const Vec3<double>& v) { return (1 / norm(v)) * v; };
  EarthRotation<double> rotation;
  rotation.Q_z = unit(row(2));
  rotation.Q_y = unit(cross(rotation.Q_z, row(0)));
  rotation.Q_x = cross(rotation.Q_y, rotation.Q_z);
  rotation.angle_rad = rounded(eraEra00(ut1, ut1_fraction));
  return rotation;
}

}  // namespace adstar::scene
