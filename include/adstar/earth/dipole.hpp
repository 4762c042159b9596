#pragma once
// The Earth's magnetic field as a dipole at its centre, tilted against the pole:
//   B_E = (a/r)³ (3 (g·u) u - g),   g = (g11, h11, g10),  u = r_E/r
// the first degree of the harmonics of earth/igrf.hpp (Wertz, Spacecraft Attitude Determination and Control, 1978, appendix H). Left out: a tenth of the field near the ground, a twentieth at 1,000 km.

#include "adstar/orbit/kepler.hpp"
#include "adstar/vec3.hpp"

namespace adstar {

/// Reference radius of the field's harmonics [m] (IAGA).
inline constexpr double kMagneticRadius_m = 6371200.0;

template <class T>
struct DipoleField {
  /// (g11, h11, g10) in tesla; as it stands IGRF-14 of 2025.0.
  Vec3<T> g_T{T(-1410.3e-9), T(4545.5e-9), T(-29350.0e-9)};

  /// In E [T], of a direction in E and a distance.
  Vec3<T> field_E(const OrbitPosition<T>& at_E) const {
    const T ratio = T(kMagneticRadius_m) / at_E.distance_m;
    const Vec3<T>& u = at_E.direction_I;
    return (ratio * ratio * ratio) * (T(3) * dot(g_T, u) * u - g_T);
  }
  /// Of |B| beyond `distance_m` [T]: that over the magnetic poles.
  T bound(const T& distance_m) const {
    const T ratio = T(kMagneticRadius_m) / distance_m;
    return T(2) * ratio * ratio * ratio * norm(g_T);
  }
};

}  // namespace adstar
