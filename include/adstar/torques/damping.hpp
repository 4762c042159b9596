#pragma once
// A viscous torque against the rotation: tau_B = -c omega_B, c ≥ 0 for each body axis.
//
// omega_B is relative to inertial space, so this is what air or eddy currents in a field at rest take
// from a body on a test bed, or a passive damper in the mean. The rate decays at J_B⁻¹ c: the guard
// counts parts from that, and reports a damping too stiff for them (integrators/guard.hpp).

#include "adstar/torques/frame.hpp"

namespace adstar {

template <class T>
struct Damping {
  static constexpr const char* kName = "damping";
  static constexpr Frame frame = Frame::body;
  Vec3<T> coefficient_n_m_s_rad;

  const Vec3<T>& damping() const { return coefficient_n_m_s_rad; }
  std::int64_t next_edge_after(std::int64_t) const { return kNever; }
};

}  // namespace adstar
