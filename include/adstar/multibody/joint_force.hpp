#pragma once
// What acts along a free coordinate of a joint: spring, damper, stops, and a motor.
//
//   f = -k (q - rest) - c q' + motor + stop
//   stop, δ = how far past the limit, δ' its rate:  ∓ k_s δ (1 + d δ'), never pulling back
// (Hunt and Crossley 1975: the damper comes in with the depth, so the force is continuous at the limit).
// Off by default, all of it. Potential ½ k (q - rest)² + ½ k_s δ²; the rest is work.

namespace adstar::multibody {

/// Per radian of an angle, per metre of a displacement.
template <class T>
struct CoordinateLaw {
  T stiffness{};         ///< k [N m/rad] or [N/m]
  T rest{};              ///< [rad] or [m]
  T damping{};           ///< c [N m s/rad] or [N s/m]
  bool stops = false;    ///< whether the limits below stand
  T lower{}, upper{};    ///< [rad] or [m]
  T stop_stiffness{};    ///< k_s [N m/rad] or [N/m]
  T stop_dissipation{};  ///< d [s/rad] or [s/m]
  friend bool operator==(const CoordinateLaw&, const CoordinateLaw&) = default;
};

/// Along the coordinate [N m] or [N]: what comes of the potential, and what does work.
template <class T>
struct CoordinateForce {
  T conservative{}, dissipative{};
};

/// How far past a limit, with the sign of the side; 0 between.
template <class T>
T stop_depth(const CoordinateLaw<T>& law, const T& q) {
  if (!law.stops) {
    return T(0);
  }
  return q > law.upper ? q - law.upper : q < law.lower ? q - law.lower : T(0);
}

/// Of spring and stop.
template <class T>
CoordinateForce<T> elastic_force(const CoordinateLaw<T>& law, const T& q, const T& rate) {
  CoordinateForce<T> f;
  f.conservative = law.stiffness * (law.rest - q);
  const T depth = stop_depth(law, q);
  if (!(depth == T(0))) {
    const T inward = depth > T(0) ? rate : -rate;
    const T scale = law.stop_dissipation * inward;
    f.conservative = f.conservative - law.stop_stiffness * depth;
    f.dissipative = -(law.stop_stiffness * depth) * (scale > T(-1) ? scale : T(-1));
  }
  return f;
}

/// [J]
template <class T>
T potential(const CoordinateLaw<T>& law, const T& q) {
  const T stretch = q - law.rest, depth = stop_depth(law, q);
  return T(0.5) * (law.stiffness * (stretch * stretch)) +
         T(0.5) * (law.stop_stiffness * (depth * depth));
}

}  // namespace adstar::multibody
