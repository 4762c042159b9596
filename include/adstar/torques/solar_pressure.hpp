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
  using Scalar = T;
  static constexpr const char* kName = "solar_pressure";
  static constexpr Frame frame = Frame::body;
  Orbit<T> orbit;
  SunMotion<T> sun;
  Facets<T> facets;  ///< not null
  Shadow shadow = Shadow::cone;
  bool seasonal = true;  ///< the Sun's distance counts (±3.4 %); else it is 1 au
  T pressure_N_m2 = T(kSolarPressure_N_m2);

  /// What is there whatever the attitude.
  struct Around {
    Vec3<T> u_I;  ///< unit, to the Sun
    T pressure_N_m2{};
  };
  Around around_at(const T& t_s) const {
    const SunPosition<T> position = sun.at(t_s);
    const T light =
        shadow == Shadow::none ? T(1) : light_at(shadow, position_at(orbit, t_s), position);
    if (!(light > T(0))) {
      return {};
    }
    const T distance = seasonal ? position.distance_au : T(1);
    return {position.direction_I, light * pressure_N_m2 / (distance * distance)};
  }
  /// Whether that is the same for the other, whatever its plates.
  bool is_around_too(const SolarPressure& other) const {
    return orbit == other.orbit && sun == other.sun && shadow == other.shadow &&
           seasonal == other.seasonal && pressure_N_m2 == other.pressure_N_m2;
  }

  /// `q_IB`: of any length but zero.
  Vec3<T> at(const T& t_s, const Quat<T>& q_IB) const { return torque_B(around_at(t_s), q_IB); }

  Vec3<T> torque_B(const Around& light, const Quat<T>& q_IB) const {
    if (!(light.pressure_N_m2 > T(0))) {
      return {};
    }
    const Vec3<T> u_B = rotate_inverse(normalised(q_IB), light.u_I);
    Vec3<T> tau{};
    for (const Facet<T>& facet : *facets) {
      const T facing = dot(facet.normal_B, u_B);
      if (facing > T(0)) {
        tau =
            tau + (facet.area_m2 * facing) * cross(share_of(facet, facing, u_B), facet.centre_B_m);
      }
    }
    return light.pressure_N_m2 * tau;
  }

  /// Σ F_i [N].
  Vec3<T> force_I(const Around& light, const Quat<T>& q_IB) const {
    if (!(light.pressure_N_m2 > T(0))) {
      return {};
    }
    const Quat<T> unit = normalised(q_IB);
    const Vec3<T> u_B = rotate_inverse(unit, light.u_I);
    Vec3<T> share{};
    for (const Facet<T>& facet : *facets) {
      const T facing = dot(facet.normal_B, u_B);
      if (facing > T(0)) {
        share = share + (facet.area_m2 * facing) * share_of(facet, facing, u_B);
      }
    }
    return -light.pressure_N_m2 * rotate(unit, share);
  }

  T bound() const {
    T sum{};
    for (const Facet<T>& facet : *facets) {
      sum = sum + most_of(facet) * norm(facet.centre_B_m);
    }
    return pressure_bound() * sum;
  }
  /// Of the force [N].
  T force_bound() const {
    T sum{};
    for (const Facet<T>& facet : *facets) {
      sum = sum + most_of(facet);
    }
    return pressure_bound() * sum;
  }
  std::int64_t next_edge_after(std::int64_t) const { return kNever; }

 private:
  T pressure_bound() const {
    const T distance = seasonal ? T(kLeastSunDistance_au) : T(1);
    return pressure_N_m2 / (distance * distance);
  }
  static T most_of(const Facet<T>& facet) {
    return facet.area_m2 * (T(1) + facet.specular + T(2) * facet.diffuse / T(3));
  }

  /// (1 - s) u + 2 (s cos + k/3) n.
  static Vec3<T> share_of(const Facet<T>& facet, const T& facing, const Vec3<T>& u_B) {
    const T along = T(1) - facet.specular;
    const T inwards = T(2) * (facet.specular * facing + facet.diffuse / T(3));
    return along * u_B + inwards * facet.normal_B;
  }
};

}  // namespace adstar
