#pragma once
// From where the Sun shines, to 0.012° between 1950 and 2050 (the aberration of light in it), and how far it is, to 1e-4 au.
//
//   M = 357.5291092° + 35999.05034° T,   λ = 280.460° + 36000.771° T + 1.914666471° sin M + 0.019994643° sin 2M
//   d = 1.000140612 - 0.016708617 cos M - 0.000139589 cos 2M au,   T Julian centuries since J2000
// (Vallado, Fundamentals of Astrodynamics and Applications, 4th ed., algorithm 29, after the Astronomical Almanac). λ there counts
// from the equinox of date; I's axes are those of J2000, so what the equinox moves, 1.3972° T, is taken off it and the ecliptic is
// inclined by its angle of J2000, 23.439291° (Montenbruck and Gill, Satellite Orbits, 2000, section 3.3.2). As seen from the Earth's centre: the
// spacecraft's own place would move it by 0.003° in a low orbit, 0.02° at the geostationary distance.

#include "adstar/trig.hpp"
#include "adstar/vec3.hpp"

namespace adstar {

/// [m] (IAU 2012 resolution B2).
inline constexpr double kAstronomicalUnit_m = 149597870700.0;

template <class T>
struct SunPosition {
  Vec3<T> direction_I;  ///< from the Earth, unit
  T distance_au{};
};

template <class T>
struct SunMotion {
  T days_since_J2000_at_start{};  ///< of t = 0, terrestrial time (2000-01-01 12:00 TT is 0)

  SunPosition<T> at(const T& t_s) const {
    constexpr double kRadian = 0.017453292519943295;
    const T centuries = (days_since_J2000_at_start + t_s / T(86400)) / T(36525);
    const SinCos<T> M = sincos(T(T(kRadian) * (T(357.5291092) + T(35999.05034) * centuries)));
    const T sine_2M = T(2) * M.sin * M.cos, cosine_2M = T(1) - T(2) * M.sin * M.sin;
    const SinCos<T> longitude =
        sincos(T(T(kRadian) * (T(280.460) + T(36000.771 - 1.3972) * centuries +
                               T(1.914666471) * M.sin + T(0.019994643) * sine_2M)));
    constexpr double kSine = 0.39777715593013446, kCosine = 0.9174820620699532;  // of 23.439291111°
    return {{longitude.cos, T(kCosine) * longitude.sin, T(kSine) * longitude.sin},
            T(1.000140612) - T(0.016708617) * M.cos - T(0.000139589) * cosine_2M};
  }
  friend bool operator==(const SunMotion&, const SunMotion&) = default;
};

/// The Sun is never nearer [au].
inline constexpr double kLeastSunDistance_au = 0.983;

}  // namespace adstar
