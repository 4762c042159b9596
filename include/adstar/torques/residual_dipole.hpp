#pragma once
// A spacecraft that is a weak magnet in the Earth's field:
//   tau_B = m_B × B_B,   B_B = R_IBᵀ B_I
// (Wertz, Spacecraft Attitude Determination and Control, 1978, section 17.2.4) with a dipole m_B that stays what it
// is. Left out: induced dipoles, eddy currents, hysteresis.

#include <memory>

#include "adstar/attitude.hpp"
#include "adstar/earth/magnetic_field.hpp"
#include "adstar/torques/frame.hpp"

namespace adstar {

template <class T>
struct ResidualDipole {
  static constexpr const char* kName = "residual_dipole";
  static constexpr Frame frame = Frame::body;
  Vec3<T> dipole_B_A_m2;
  std::shared_ptr<const FieldOnOrbit<T>> field;  ///< not null

  /// `q_IB`: of any length but zero.
  Vec3<T> at(const T& t_s, const Quat<T>& q_IB) const {
    return cross(dipole_B_A_m2, rotate_inverse(normalised(q_IB), field->field_I(t_s)));
  }
  T bound() const { return norm(dipole_B_A_m2) * field->bound(); }
  std::int64_t next_edge_after(std::int64_t) const { return kNever; }
};

}  // namespace adstar
