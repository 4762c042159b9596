#pragma once
// The gravity of a point mass, stronger on the near side of the body than on the far one:
//   tau_B = 3 μ/r³ u_B × (J_B u_B),   u_B = R_IBᵀ r_I/r
// of the body with its wheels (Hughes, Spacecraft Attitude Dynamics, 1986, section 8.1; terms of the fourth moments
// and on left out: of the order of the body's length over r, 1e-7).

#include "adstar/attitude.hpp"
#include "adstar/bodies/rigid_body.hpp"
#include "adstar/orbit/orbit.hpp"
#include "adstar/torques/frame.hpp"

namespace adstar {

template <class T>
struct GravityGradient {
  using Scalar = T;
  static constexpr const char* kName = "gravity_gradient";
  static constexpr Frame frame = Frame::body;
  Orbit<T> orbit;
  Sym3<T> inertia_B;  ///< of the body that it acts on
  T spread_kg_m2{};   ///< its largest principal moment less its smallest

  void act_on(const RigidBody<T>& body) {
    inertia_B = body.inertia();
    spread_kg_m2 = body.moments()[2] - body.moments()[0];
  }

  /// What is there whatever the attitude.
  using Around = OrbitPosition<T>;
  Around around_at(const T& t_s) const { return position_at(orbit, t_s); }
  /// Whether that is the same for the other, whatever its inertia.
  bool is_around_too(const GravityGradient& other) const { return orbit == other.orbit; }

  /// `q_IB`: of any length but zero.
  Vec3<T> at(const T& t_s, const Quat<T>& q_IB) const { return torque_B(around_at(t_s), q_IB); }

  Vec3<T> torque_B(const Around& position, const Quat<T>& q_IB) const {
    const Vec3<T> u_B = rotate_inverse(normalised(q_IB), position.direction_I);
    return strength(position.distance_m) * cross(u_B, inertia_B * u_B);
  }
  /// |u × J u| is at most half the spread of the moments.
  T bound() const { return T(0.5) * strength(least_distance(orbit)) * spread_kg_m2; }
  std::int64_t next_edge_after(std::int64_t) const { return kNever; }

 private:
  T strength(const T& r) const { return T(3) * (gravity_of(orbit) / r / r / r); }
};

}  // namespace adstar
