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
  static constexpr const char* kName = "gravity_gradient";
  static constexpr Frame frame = Frame::body;
  Orbit<T> orbit;
  Sym3<T> inertia_B;  ///< of the body that it acts on
  T spread_kg_m2{};   ///< its largest principal moment less its smallest

  void act_on(const RigidBody<T>& body) {
    inertia_B = body.inertia();
    spread_kg_m2 = body.moments()[2] - body.moments()[0];
  }

  /// `q_IB`: of any length but zero.
  Vec3<T> at(const T& t_s, const Quat<T>& q_IB) const {
    const OrbitPosition<T> position = position_at(orbit, t_s);
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
