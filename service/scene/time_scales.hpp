#pragma once
// Dates in the scales that orbits and epochs are given in, by ERFA.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "adstar/earth/rotation.hpp"

namespace adstar::scene {

/// A date in TAI, a Julian date in two parts.
struct TaiDate {
  double day = 0;
  double fraction = 0;
};

enum class Clock { utc, tai, tt, gps };

/// Of "2026-01-01T00:00:00.5" or "2026-001T00:00:00" (day of the year), with or without a Z at its end; nothing when
/// it is neither, or in UTC before 1972.
std::optional<TaiDate> tai_date(std::string_view text, Clock clock);

/// Of Simulation::epoch, "2026-01-01T00:00:00 UTC" or "... TAI".
std::optional<TaiDate> tai_date_of_epoch(std::string_view epoch);

/// From one to the other [ns]; nothing beyond 292 years.
std::optional<std::int64_t> nanoseconds_from(const TaiDate& begin, const TaiDate& end);

/// The date so long after `begin` (SI seconds), in UTC: "2026-01-01T00:00:00.500000000", a leap second
/// as 60. Nothing outside the years 1 to 9999.
std::optional<std::string> utc_text(const TaiDate& begin, std::int64_t later_ns);

/// Julian years, 2000.0 at noon of the 1st of January 2000 TT.
double julian_year(const TaiDate& date);

/// TT days since then.
double days_since_j2000(const TaiDate& date);

/// How the Earth stands at t = 0, for I on the axes of the GCRF: IAU 2006/2000A precession and nutation, the Earth rotation
/// angle of UT1 (IERS Conventions 2010, chapter 5). Rounded to 2^-40: ERFA works with the machine's sines, ours
/// are the same bits everywhere.
EarthRotation<double> earth_rotation(const TaiDate& date, double ut1_minus_utc_s);

}  // namespace adstar::scene
