#pragma once
// The Earth's magnetic field where a spacecraft is, in I: a dipole or harmonics, turned with the Earth.

#include <memory>

#include "adstar/earth/dipole.hpp"
#include "adstar/earth/igrf.hpp"
#include "adstar/earth/rotation.hpp"
#include "adstar/orbit/orbit.hpp"

namespace adstar {

/// A copy does not allocate.
template <class T>
struct MagneticField {
  EarthRotation<T> rotation;
  DipoleField<T> dipole;                                ///< in force while `harmonics` is null
  std::shared_ptr<const HarmonicField<T>> harmonics{};  ///< make_igrf()

  /// [T]
  Vec3<T> field_I(const T& t_s, const OrbitPosition<T>& position) const {
    const EarthFrame<T> frame = rotation.at(t_s);
    const OrbitPosition<T> at_E{frame.to_terrestrial(position.direction_I), position.distance_m};
    return frame.to_inertial(harmonics ? harmonics->field_E(at_E) : dipole.field_E(at_E));
  }
  /// Of |B| beyond `distance_m` [T].
  T bound(const T& distance_m) const {
    return harmonics ? harmonics->bound(distance_m) : dipole.bound(distance_m);
  }
};

/// The field that a spacecraft meets along its orbit; the torques of one spacecraft share it.
template <class T>
struct FieldOnOrbit {
  Orbit<T> orbit;
  MagneticField<T> field;

  /// [T]
  Vec3<T> field_I(const T& t_s) const { return field.field_I(t_s, position_at(orbit, t_s)); }
  T bound() const { return field.bound(least_distance(orbit)); }
};

}  // namespace adstar
