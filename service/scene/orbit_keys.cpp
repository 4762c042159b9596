#include "service/scene/orbit_keys.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "adstar/earth/rotation.hpp"
#include "adstar/trig.hpp"
#include "service/scene/complaints.hpp"
#include "service/scene/oem_file.hpp"

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

/// The ellipse by its elements; position and velocity instead of them where the file has those.
OrbitElements<double> read_elements(Keys& keys, double gravity) {
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
  return elements;
}

constexpr std::string_view kPosition = "[6.9e6, 0.0, 0.0]", kVelocity = "[0.0, 7600.5, 0.0]";

/// The elements of an ellipse; a node on the x axis where the orbit lies in the equator.
OrbitElements<double> elements_of(const KeplerOrbit<double>& orbit) {
  const Vec3<double> W = cross(orbit.P, orbit.Q);
  const double sine = std::sqrt(W.x * W.x + W.y * W.y);
  OrbitElements<double> e;
  e.semi_major_axis_m = orbit.semi_major_axis_m;
  e.eccentricity = orbit.eccentricity;
  e.inclination_rad = angle_of(W.z, sine);
  e.mean_anomaly_rad = orbit.mean_anomaly_rad;
  e.gravity_m3_s2 = orbit.gravity_m3_s2;
  constexpr double kInTheEquator = 1e-12;
  if (sine > kInTheEquator) {
    e.right_ascension_rad = angle_of(-W.y / sine, W.x / sine);
    e.argument_of_periapsis_rad = angle_of(orbit.Q.z / sine, orbit.P.z / sine);
  } else {
    e.argument_of_periapsis_rad = angle_of(orbit.P.x, W.z > 0 ? orbit.P.y : -orbit.P.y);
  }
  return e;
}

/// From position and velocity, or from elements.
std::optional<KeplerOrbit<double>> read_ellipse(Keys& keys, double gravity) {
  const Value position = keys.optional("position_inertial_m");
  const Value velocity = keys.optional("velocity_inertial_m_s");
  if (!position && !velocity) {
    return make_orbit(read_elements(keys, gravity));
  }
  if (!position) {
    keys.miss("position_inertial_m", {"3 numbers, beside velocity_inertial_m_s", kPosition});
  }
  if (!velocity) {
    keys.miss("velocity_inertial_m_s", {"3 numbers, beside position_inertial_m", kVelocity});
  }
  const auto r = read_vector(position, kPosition);
  const auto v = read_vector(velocity, kVelocity);
  return r && v ? from_vectors(position, *r, *v, gravity) : std::nullopt;
}

std::optional<Orbit<double>> read_kepler(Keys& keys, double gravity) {
  const auto ellipse = read_ellipse(keys, gravity);
  return ellipse ? std::optional<Orbit<double>>(*ellipse) : std::nullopt;
}

std::optional<Orbit<double>> read_j2(Keys& keys, double gravity) {
  const auto ellipse = read_ellipse(keys, gravity);
  return ellipse ? std::optional<Orbit<double>>(make_secular_orbit(elements_of(*ellipse)))
                 : std::nullopt;
}

std::optional<Orbit<double>> read_fixed(Keys& keys, double gravity) {
  const Want want{"3 numbers: where the spacecraft stands", kPosition};
  const Value value = keys.required("position_inertial_m", want);
  const auto r = read_vector(value, kPosition);
  if (r && *r == Vec3<double>{}) {
    value.refuse("a position off the centre", kPosition);
    return std::nullopt;
  }
  return r ? std::optional<Orbit<double>>(make_fixed_position(*r, gravity)) : std::nullopt;
}

std::optional<Orbit<double>> read_oem(Keys& keys, double gravity, const OrbitContext& context) {
  constexpr Want kFile{"the path of a CCSDS OEM file, relative to the scene", "\"orbit.oem\""};
  const Value file = keys.required("file", kFile);
  const auto path = read_text(file, kFile);
  if (!path) {
    return std::nullopt;
  }
  if (path->empty()) {
    file.refuse(kFile.expected, kFile.example);
    return std::nullopt;
  }
  if (context.epoch == nullptr) {
    file.refuse_as("an orbit with dates in a scene without one",
                   "epoch_utc or epoch_tai in [simulation]", "epoch_utc = 2026-01-01T00:00:00Z");
    return std::nullopt;
  }
  if (context.tables == Tables::skip) {
    return make_fixed_position<double>({6.9e6, 0, 0}, gravity);
  }
  const auto table = read_oem_file(file, context.scene_file, *context.epoch, gravity);
  return table ? std::optional<Orbit<double>>(*table) : std::nullopt;
}

/// As lengths in km are. An orbit that leads into the Earth later may be a sounding rocket's: check warns of it.
void refuse_to_begin_inside(const Value& value, const Orbit<double>& orbit) {
  const double distance = position_at(orbit, 0.0).distance_m;
  if (is_about_the_earth(orbit) && distance < kEarthPolarRadius_m) {
    value.refuse_as("an orbit that begins " + number_text(distance) + " m from the Earth's centre",
                    "one that begins above its surface, 6.357e6 m from the centre at the poles",
                    "lengths in metres, or gravity_m3_s2 of another body");
  }
}

}  // namespace

std::optional<Orbit<double>> read_orbit(const Value& value, const OrbitContext& context) {
  if (!value) {
    return std::nullopt;
  }
  Keys keys(value, kExample);
  const std::size_t complaints = value.complaints().count();
  const double gravity =
      read_positive(keys.optional("gravity_m3_s2"),
                    {"a gravitational parameter above 0 m^3/s^2", "3.986004418e14"})
          .value_or(kEarthGravity_m3_s2);
  constexpr std::array<std::string_view, 4> kModels{"kepler", "j2", "fixed", "oem"};
  const Value model = keys.optional("model");
  const auto which = model ? read_choice(model, kModels) : std::optional<std::size_t>(0);
  if (!which) {
    return std::nullopt;
  }
  const std::optional<Orbit<double>> orbit = *which == 0   ? read_kepler(keys, gravity)
                                             : *which == 1 ? read_j2(keys, gravity)
                                             : *which == 2 ? read_fixed(keys, gravity)
                                                           : read_oem(keys, gravity, context);
  keys.refuse_unknown();
  if (orbit && value.complaints().count() == complaints) {
    refuse_to_begin_inside(value, *orbit);
  }
  return value.complaints().count() == complaints ? orbit : std::nullopt;
}

}  // namespace adstar::scene
