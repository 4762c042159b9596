#pragma once
// Where a spacecraft is, as a function of time: one type for every way that an orbit may be given.
//
// A place that does not move, a Kepler ellipse, an ellipse that J2 turns, or a table. None of them is a state: nothing is
// integrated, nothing saved. A copy does not allocate. Centre of attraction at the origin of a frame parallel to I.

#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <variant>

#include "adstar/orbit/ephemeris.hpp"
#include "adstar/orbit/kepler.hpp"
#include "adstar/orbit/secular.hpp"

namespace adstar {

/// At rest in I: a laboratory's stand-in for an orbit.
template <class T>
struct FixedPosition {
  OrbitPosition<T> position;
  T gravity_m3_s2 = T(kEarthGravity_m3_s2);
  friend bool operator==(const FixedPosition&, const FixedPosition&) = default;
};

template <class T>
FixedPosition<T> make_fixed_position(const Vec3<T>& r_I,
                                     const T& gravity_m3_s2 = T(kEarthGravity_m3_s2)) {
  const T distance = norm(r_I);
  return {{(T(1) / distance) * r_I, distance}, gravity_m3_s2};
}

template <class T>
OrbitPosition<T> position_at(const FixedPosition<T>& fixed, const T&) {
  return fixed.position;
}
template <class T>
OrbitMotion<T> motion_at(const FixedPosition<T>& fixed, const T&) {
  return {fixed.position.distance_m * fixed.position.direction_I, {}};
}

/// The pointer of a table is not null.
template <class T>
using Orbit = std::variant<KeplerOrbit<T>, SecularOrbit<T>, FixedPosition<T>,
                           std::shared_ptr<const Ephemeris<T>>>;

namespace detail {

template <class Model>
const Model& pointed_to(const Model& model) {
  return model;
}
template <class T>
const Ephemeris<T>& pointed_to(const std::shared_ptr<const Ephemeris<T>>& table) {
  return *table;
}

}  // namespace detail

/// Direction in I and distance [m].
template <class T>
OrbitPosition<T> position_at(const Orbit<T>& orbit, const T& t_s) {
  if (const auto* const kepler = std::get_if<KeplerOrbit<T>>(&orbit)) {
    return position_at(*kepler, t_s);
  }
  return std::visit([&](const auto& model) { return position_at(detail::pointed_to(model), t_s); },
                    orbit);
}

/// Position [m] and velocity [m/s] in I.
template <class T>
OrbitMotion<T> motion_at(const Orbit<T>& orbit, const T& t_s) {
  if (const auto* const kepler = std::get_if<KeplerOrbit<T>>(&orbit)) {
    return motion_at(*kepler, t_s);
  }
  return std::visit([&](const auto& model) { return motion_at(detail::pointed_to(model), t_s); },
                    orbit);
}

template <class T>
OrbitPosition<T> position_of(const OrbitMotion<T>& motion) {
  const T distance = norm(motion.r_I);
  return {(T(1) / distance) * motion.r_I, distance};
}

/// When the orbit is known [s]: always, but of a table.
template <class T>
std::pair<T, T> span_s(const Orbit<T>& orbit) {
  if (const auto* const table = std::get_if<std::shared_ptr<const Ephemeris<T>>>(&orbit)) {
    return span_s(**table);
  }
  return {std::numeric_limits<T>::lowest(), std::numeric_limits<T>::max()};
}

/// μ [m³/s²] of what it goes about.
template <class T>
T gravity_of(const Orbit<T>& orbit) {
  if (const auto* const secular = std::get_if<SecularOrbit<T>>(&orbit)) {
    return secular->at_start.gravity_m3_s2;
  }
  if (const auto* const kepler = std::get_if<KeplerOrbit<T>>(&orbit)) {
    return kepler->gravity_m3_s2;
  }
  if (const auto* const fixed = std::get_if<FixedPosition<T>>(&orbit)) {
    return fixed->gravity_m3_s2;
  }
  return std::get<std::shared_ptr<const Ephemeris<T>>>(orbit)->gravity_m3_s2;
}

/// Whether μ is the Earth's, to 1 %: then so are the centre, the air and the field.
template <class T>
bool is_about_the_earth(const Orbit<T>& orbit) {
  const T ratio = gravity_of(orbit) / T(kEarthGravity_m3_s2);
  return ratio > T(0.99) && ratio < T(1.01);
}

/// The spacecraft is never nearer to the centre [m]: what torques are bounded with.
template <class T>
T least_distance(const Orbit<T>& orbit) {
  if (const auto* const kepler = std::get_if<KeplerOrbit<T>>(&orbit)) {
    return kepler->semi_major_axis_m * (T(1) - kepler->eccentricity);
  }
  if (const auto* const secular = std::get_if<SecularOrbit<T>>(&orbit)) {
    return secular->at_start.semi_major_axis_m * (T(1) - secular->at_start.eccentricity);
  }
  if (const auto* const fixed = std::get_if<FixedPosition<T>>(&orbit)) {
    return fixed->position.distance_m;
  }
  return std::get<std::shared_ptr<const Ephemeris<T>>>(orbit)->least_distance_m;
}

/// And never faster [m/s]: n a √((1 + e)/(1 - e)) at the periapsis, and what the drift adds at the apoapsis.
template <class T>
T greatest_speed(const Orbit<T>& orbit) {
  using std::abs;
  using std::sqrt;
  const auto at_periapsis = [](const T& n, const T& a, const T& e) {
    return T(n * a * sqrt((T(1) + e) / (T(1) - e)));
  };
  if (const auto* const kepler = std::get_if<KeplerOrbit<T>>(&orbit)) {
    return at_periapsis(kepler->mean_motion_rad_s, kepler->semi_major_axis_m, kepler->eccentricity);
  }
  if (const auto* const secular = std::get_if<SecularOrbit<T>>(&orbit)) {
    const OrbitElements<T>& e = secular->at_start;
    const T drift = abs(secular->node_rate_rad_s) + abs(secular->periapsis_rate_rad_s);
    return at_periapsis(secular->anomaly_rate_rad_s, e.semi_major_axis_m, e.eccentricity) +
           drift * e.semi_major_axis_m * (T(1) + e.eccentricity);
  }
  if (std::holds_alternative<FixedPosition<T>>(orbit)) {
    return T(0);
  }
  return std::get<std::shared_ptr<const Ephemeris<T>>>(orbit)->greatest_speed_m_s;
}

}  // namespace adstar
