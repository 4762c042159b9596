#pragma once
// The drag of thin air on plates:
//   F_i = -½ ρ v² C_i A_i (n_i·u) u where n_i·u > 0,   tau_B = Σ c_i × F_i,   u = v/|v|
// with v the velocity against air that turns with the Earth (Wertz, Spacecraft Attitude Determination and Control, 1978, section
// 17.2.3; Vallado, 4th ed., section 8.6.2). ρ as earth/atmosphere.hpp has it. Left out: lift and what skims along a plate,
// plates that shade others, the body's own rotation (its rim moves by 1e-5 of v).

#include <cmath>

#include "adstar/attitude.hpp"
#include "adstar/earth/atmosphere.hpp"
#include "adstar/orbit/orbit.hpp"
#include "adstar/torques/facets.hpp"
#include "adstar/torques/frame.hpp"

namespace adstar {

template <class T>
struct Aerodynamic {
  using Scalar = T;
  static constexpr const char* kName = "aerodynamic";
  static constexpr Frame frame = Frame::body;
  Orbit<T> orbit;
  EarthRotation<T> rotation;
  Facets<T> facets;         ///< not null
  T density_factor = T(1);  ///< on the density of the table

  /// What is there whatever the attitude.
  struct Around {
    Vec3<T> u_I;  ///< v/|v|; zero where the air stands still
    T pressure_N_m2{};
  };
  Around around_at(const T& t_s) const {
    const OrbitMotion<T> motion = motion_at(orbit, t_s);
    const Vec3<T> v_I = velocity_in_air(motion, rotation);
    const T speed = norm(v_I);
    if (!(speed > T(0))) {
      return {};
    }
    const T density =
        density_factor * air_density(altitude_of(position_of(motion), rotation.pole_I()));
    return {(T(1) / speed) * v_I, T(0.5) * density * speed * speed};
  }
  /// Whether that is the same for the other, whatever its plates.
  bool is_around_too(const Aerodynamic& other) const {
    return orbit == other.orbit && rotation == other.rotation &&
           density_factor == other.density_factor;
  }

  /// `q_IB`: of any length but zero.
  Vec3<T> at(const T& t_s, const Quat<T>& q_IB) const { return torque_B(around_at(t_s), q_IB); }

  Vec3<T> torque_B(const Around& wind, const Quat<T>& q_IB) const {
    const Vec3<T> u_B = rotate_inverse(normalised(q_IB), wind.u_I);
    Vec3<T> moment{};
    for (const Facet<T>& facet : *facets) {
      const T facing = dot(facet.normal_B, u_B);
      if (facing > T(0)) {
        moment = moment + (facet.drag_coefficient * facet.area_m2 * facing) * facet.centre_B_m;
      }
    }
    // Σ c_i × F_i with one direction of all forces: (Σ C_i A_i cos_i c_i) × (-q u).
    return wind.pressure_N_m2 * cross(u_B, moment);
  }

  /// Σ F_i [N].
  Vec3<T> force_I(const Around& wind, const Quat<T>& q_IB) const {
    const Vec3<T> u_B = rotate_inverse(normalised(q_IB), wind.u_I);
    T area{};
    for (const Facet<T>& facet : *facets) {
      const T facing = dot(facet.normal_B, u_B);
      if (facing > T(0)) {
        area = area + facet.drag_coefficient * facet.area_m2 * facing;
      }
    }
    return (-wind.pressure_N_m2 * area) * wind.u_I;
  }

  T bound() const {
    T sum{};
    for (const Facet<T>& facet : *facets) {
      sum = sum + facet.drag_coefficient * facet.area_m2 * norm(facet.centre_B_m);
    }
    return pressure_bound() * sum;
  }
  /// Of the force [N].
  T force_bound() const {
    T sum{};
    for (const Facet<T>& facet : *facets) {
      sum = sum + facet.drag_coefficient * facet.area_m2;
    }
    return pressure_bound() * sum;
  }
  std::int64_t next_edge_after(std::int64_t) const { return kNever; }

 private:
  /// At the least distance, above the equator and against the Earth's turn; a percent for where the layers meet.
  T pressure_bound() const {
    using std::abs;
    const T distance = least_distance(orbit);
    const T density = T(1.01) * density_factor * air_density(T(distance - T(kEarthRadius_m)));
    const T speed = greatest_speed(orbit) + abs(rotation.rate_rad_s) * distance;
    return T(0.5) * density * speed * speed;
  }
};

}  // namespace adstar
