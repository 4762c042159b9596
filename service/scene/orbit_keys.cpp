#include "service/scene/orbit_keys.hpp"

#include <cmath>
#include <numbers>

#include "adstar/trig.hpp"
#include "service/scene/complaints.hpp"

namespace adstar::scene {
namespace {

constexpr std::string_view kExample = "semi_major_axis_m = 6.9e6 in [spacecraft.orbit]";

constexpr double kMostEccentric = 0.99;  // so far Kepler's equation is solved in a few steps

double read_angle(Keys& keys, std::string_view key) {
  return read_number(keys.optional(key), {"an angle in rad", "0.0"}).value_or(0);
}

/// Of a unit vector, by an arc tangent whose bits are our own.
double angle_of(double cosine, double sine) {
  if (cosine >= 0) {
    return 2 * atan(sine / (1 + cosine));
  }
  return std::copysign(std::numbers::pi, sine) - 2 * atan(sine / (1 - cosine));
}

/// r and v in I to the elements of the same ellipse (Vallado, Fundamentals of Astrodynamics and Applications,
/// 4th ed., algorithm 9, written with the vectors P and Q).
std::optional<KeplerOrbit<double>> from_vectors(const Value& at, const Vec3<double>& r,
                                                const Vec3<double>& v, double gravity) {
  const double distance = norm(r);
  const Vec3<double> area = cross(r, v);
  const double energy = 0.5 * dot(v, v) - gravity / distance;
  if (!(distance > 0) || !(norm(area) > 1e-9 * distance * norm(v)) || !(energy < 0)) {
    at.refuse_as("a motion that is no ellipse",
                 "a position off the centre and a velocity below escape, not along it",
                 "a velocity of about sqrt(gravity / distance) across the position");
    return std::nullopt;
  }
  KeplerOrbit<double> orbit;
  orbit.gravity_m3_s2 = gravity;
  orbit.semi_major_axis_m = -gravity / (2 * energy);
  orbit.mean_motion_rad_s = std::sqrt(gravity / orbit.semi_major_axis_m) / orbit.semi_major_axis_m;
  const Vec3<double> e = (1 / gravity) * cross(v, area) - (1 / distance) * r;
  orbit.eccentricity = norm(e);
  if (orbit.eccentricity > kMostEccentric) {
    at.refuse_as("an ellipse of eccentricity " + number_text(orbit.eccentricity),
                 "an eccentricity from 0 to 0.99", "a velocity more across the position");
    return std::nullopt;
  }
  constexpr double kCircular = 1e-12;  // below it the periapsis is round-off: the start will do
  if (orbit.eccentricity < kCircular) {
    orbit.eccentricity = 0;
    orbit.P = (1 / distance) * r;
  } else {
    orbit.P = (1 / orbit.eccentricity) * e;
  }
  orbit.Q = (1 / norm(area)) * cross(area, orbit.P);
  const double x = dot(r, orbit.P) / orbit.semi_major_axis_m + orbit.eccentricity;
  const double y = dot(r, orbit.Q) / (orbit.semi_major_axis_m *
                                      std::sqrt(1 - orbit.eccentricity * orbit.eccentricity));
  orbit.mean_anomaly_rad = angle_of(x, y) - orbit.eccentricity * y;
  return orbit;
}

}  // namespace

std::optional<KeplerOrbit<double>> read_orbit(const Value& value) {
  if (!value) {
    return std::nullopt;
  }
  Keys keys(value, kExample);
  const std::size_t complaints = value.complaints().count();
  const double gravity =
      read_positive(keys.optional("gravity_m3_s2"),
                    {"a gravitational parameter above 0 m^3/s^2", "3.986004418e14"})
          .value_or(kEarthGravity_m3_s2);
  const Value position = keys.optional("position_inertial_m");
  const Value velocity = keys.optional("velocity_inertial_m_s");
  std::optional<KeplerOrbit<double>> orbit;
  if (position || velocity) {
    constexpr std::string_view kPosition = "[6.9e6, 0.0, 0.0]", kVelocity = "[0.0, 7600.5, 0.0]";
    if (!position) {
      keys.miss("position_inertial_m", {"3 numbers, beside velocity_inertial_m_s", kPosition});
    }
    if (!velocity) {
      keys.miss("velocity_inertial_m_s", {"3 numbers, beside position_inertial_m", kVelocity});
    }
    const auto r = read_vector(position, kPosition);
    const auto v = read_vector(velocity, kVelocity);
    if (r && v) {
      orbit = from_vectors(position, *r, *v, gravity);
    }
  } else {
    const Want axis{"a semi-major axis above 0 m, or position_inertial_m and velocity_inertial_m_s",
                    "6.9e6"};
    OrbitElements<double> elements;
    elements.gravity_m3_s2 = gravity;
    elements.semi_major_axis_m =
        read_positive(keys.required("semi_major_axis_m", axis), axis).value_or(1);
    const Value eccentricity = keys.optional("eccentricity");
    elements.eccentricity =
        read_number(eccentricity, NumberRange{.least = 0.0, .most = kMostEccentric},
                    {"an eccentricity from 0 to 0.99", "0.001"})
            .value_or(0);
    elements.inclination_rad = read_angle(keys, "inclination_rad");
    elements.right_ascension_rad = read_angle(keys, "right_ascension_rad");
    elements.argument_of_periapsis_rad = read_angle(keys, "argument_of_periapsis_rad");
    elements.mean_anomaly_rad = read_angle(keys, "mean_anomaly_rad");
    orbit = make_orbit(elements);
  }
  keys.refuse_unknown();
  return value.complaints().count() == complaints ? orbit : std::nullopt;
}

}  // namespace adstar::scene
