#pragma once
// The density of the air, by altitude alone, and the air's motion with the Earth.
//
//   ρ(h) = ρ_i exp(-(h - h_i)/H_i),   h_i ≤ h < h_i+1
// (Vallado, Fundamentals of Astrodynamics and Applications, 4th ed., 2013, table 8-4: U.S. Standard Atmosphere 1976 to 25 km,
// CIRA-72 to 500 km, CIRA-72 with an exospheric temperature of 1,000 K beyond). The pieces meet within 1e-4 (1.4e-3 at 25 km). Left out:
// day and night, the Sun's activity (a factor of 10 at 500 km between its extremes: density_factor), storms, winds.

#include <array>
#include <cstddef>

#include "adstar/earth/rotation.hpp"
#include "adstar/exponential.hpp"
#include "adstar/orbit/kepler.hpp"

namespace adstar {

struct AirLayer {
  double base_km, density_kg_m3, scale_height_km;
};

inline constexpr std::array<AirLayer, 28> kAirLayers{
    {{0, 1.225, 7.249},        {25, 3.899e-2, 6.349},    {30, 1.774e-2, 6.682},
     {40, 3.972e-3, 7.554},    {50, 1.057e-3, 8.382},    {60, 3.206e-4, 7.714},
     {70, 8.770e-5, 6.549},    {80, 1.905e-5, 5.799},    {90, 3.396e-6, 5.382},
     {100, 5.297e-7, 5.877},   {110, 9.661e-8, 7.263},   {120, 2.438e-8, 9.473},
     {130, 8.484e-9, 12.636},  {140, 3.845e-9, 16.149},  {150, 2.070e-9, 22.523},
     {180, 5.464e-10, 29.740}, {200, 2.789e-10, 37.105}, {250, 7.248e-11, 45.546},
     {300, 2.418e-11, 53.628}, {350, 9.518e-12, 53.298}, {400, 3.725e-12, 58.515},
     {450, 1.585e-12, 60.828}, {500, 6.967e-13, 63.822}, {600, 1.454e-13, 71.835},
     {700, 3.614e-14, 88.667}, {800, 1.170e-14, 124.64}, {900, 5.245e-15, 181.05},
     {1000, 3.019e-15, 268.00}}};

/// [kg/m³]; below the ground that of the ground, beyond 1,000 km the last layer goes on.
template <class T>
T air_density(const T& altitude_m) {
  const T h = altitude_m > T(0) ? T(altitude_m / T(1000)) : T(0);
  std::size_t i = kAirLayers.size() - 1;  // most spacecraft fly in the upper ones
  while (i > 0 && h < T(kAirLayers[i].base_km)) {
    --i;
  }
  const AirLayer& layer = kAirLayers[i];
  return T(layer.density_kg_m3) * exponential(T((T(layer.base_km) - h) / T(layer.scale_height_km)));
}

/// Above the ellipsoid of the Earth, straight down to the centre: h = r - a (1 - f (u·pole)²) [m], f² left out (at most 27 m).
template <class T>
T altitude_of(const OrbitPosition<T>& position, const Vec3<T>& pole_I) {
  const T sine = dot(position.direction_I, pole_I);
  return position.distance_m - T(kEarthRadius_m) * (T(1) - T(kEarthFlattening) * sine * sine);
}

/// v - omega × r [m/s]: relative to air that turns with the Earth, in I.
template <class T>
Vec3<T> velocity_in_air(const OrbitMotion<T>& motion, const EarthRotation<T>& rotation) {
  return motion.v_I - cross(rotation.omega_I(), motion.r_I);
}

}  // namespace adstar
