#pragma once
// The pressure of sunlight on plates:
//   F_i = -ν P (1/d²) A_i cos_i ((1 - s_i) u + 2 (s_i cos_i + k_i/3) n_i) where cos_i = n_i·u > 0,   tau_B = Σ c_i × F_i
// u to the Sun, s and k the parts that are reflected like by a mirror and like by chalk (Wertz, Spacecraft Attitude Determination and
// Control, 1978, section 17.2.2; Vallado, 4th ed., section 8.6.4), ν the light that passes the Earth (earth/shadow.hpp).
// Left out: light from the Earth, plates that shade others, heat that they give off again.

#include "adstar/attitude.hpp"
#include "adstar/earth/shadow.hpp"
#include "adstar/earth/sun.hpp"
#include "adstar/orbit/orbit.hpp"
#include "adstar/torques/facets.hpp"
#include "adstar/torques/frame.hpp"

namespace adstar {

/// At 1 au [N/m²]: 1361 W/m² (IAU 2015 resolution B3) over the speed of light.
inline constexpr double kSolarPressure_N_m2 = 1361.0 / 299792458.0;

template <class T>
struct SolarPressure {
  static constexpr const char* kName = "solar_pressure";
  static constexpr Frame frame = Frame::body;
  Orbit<T> orbit;
  SunMotion<T> sun;
  Facets<T> facets;  ///< not null
  Shadow shadow = Shadow::cone;
  bool seasonal = true;  ///< the Sun's distance counts (±3.4 %); else it is 1 au
  T pressure_N_m2 = T(kSolarPressure_N_m2);

  /// `q_IB`: of any length but zero.
  Vec3<T> at(const T& t_s, const Quat<T>& q_IB) const {
    const SunPosition<T> position = sun.at(t_s);
    const T light =
        shadow == Shadow::none ? T(1) : light_at(shadow, position_at(orbit, t_s), position);
    if (!(light > T(0))) {
      return {};
    }
    const T distance = seasonal ? position.distance_au : T(1);
    const Vec3<T> u_B = rotate_inverse(normalised(q_IB), position.direction_I);
    Vec3<T> tau{};
    for (const Facet<T>& facet : *facets) {
      const T facing = dot(facet.normal_B, u_B);
      if (facing > T(0)) {
        const T along = T(1) - facet.specular;
        const T inwards = T(2) * (facet.specular * facing + facet.diffuse / T(3));
        const Vec3<T> force = along * u_B + inwards * facet.normal_B;
        tau = tau + (facet.area_m2 * facing) * cross(force, facet.centre_B_m);
      }
    }
    return (light * pressure_N_m2 / (distance * distance)) * tau;
  }

  T bound() const {
    const T distance = seasonal ? T(kLeastSunDistance_au) : T(1);
    T sum{};
    for (const Facet<T>& facet : *facets) {
      const T most = T(1) + facet.specular + T(2) * facet.diffuse / T(3);
      sum = sum + facet.area_m2 * most * norm(facet.centre_B_m);
    }
    return pressure_N_m2 / (distance * distance) * sum;
  }
  std::int64_t next_edge_after(std::int64_t) const { return kNever; }
};

}  // namespace adstar
