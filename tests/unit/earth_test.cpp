// The Earth's turn, its air, its Sun and its shadow.
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include "adstar/earth/atmosphere.hpp"
#include "adstar/earth/rotation.hpp"
#include "adstar/earth/shadow.hpp"
#include "adstar/earth/sun.hpp"
#include "adstar/orbit/orbit.hpp"
#include "tests/support/random_motion.hpp"
#include "tests/support/wide.hpp"

namespace adstar {
namespace {

using V = Vec3<double>;

constexpr double kDegree = std::numbers::pi / 180;

TEST(EarthRotation, is_one_turn_in_a_stellar_day) {
  // 86164.098903691 s (IERS, useful constants).
  EXPECT_NEAR(2 * std::numbers::pi / kEarthRotation_rad_s, 86164.098903691, 1e-6);
  EarthRotation<double> rotation;
  rotation.angle_rad = 0.7;
  const EarthFrame<double> frame = rotation.at(3600);
  const double turn = 0.7 + 3600 * kEarthRotation_rad_s;
  EXPECT_LT(norm(frame.to_terrestrial({std::cos(turn), std::sin(turn), 0}) - V{1, 0, 0}), 1e-15);
  EXPECT_EQ(frame.to_terrestrial({0, 0, 1}), (V{0, 0, 1}));
  EXPECT_EQ(rotation.omega_I(), (V{0, 0, kEarthRotation_rad_s}));
}

TEST(EarthRotation, goes_there_and_back_about_a_pole_that_is_not_z) {
  test::Generator random(1);
  const Quat<double> q = test::unit_quaternion(random);
  EarthRotation<double> rotation;
  rotation.Q_x = rotate(q, V{1, 0, 0});
  rotation.Q_y = rotate(q, V{0, 1, 0});
  rotation.Q_z = rotate(q, V{0, 0, 1});
  for (int i = 0; i < 100; ++i) {
    const EarthFrame<double> frame = rotation.at(test::uniform(random, -1e6, 1e8));
    const V v = test::unit_vector(random);
    EXPECT_LT(norm(frame.to_inertial(frame.to_terrestrial(v)) - v), 2e-15);
    EXPECT_LT(norm(frame.to_terrestrial(rotation.pole_I()) - V{0, 0, 1}), 2e-15);
  }
  // A point of the ground moves at omega × r.
  const V place{0.6, 0.3, 0.5};
  constexpr double h = 10;
  const V moved = rotation.at(100 + h).to_inertial(place) - rotation.at(100 - h).to_inertial(place);
  const V r = rotation.at(100).to_inertial(place);
  EXPECT_LT(norm((0.5 / h) * moved - cross(rotation.omega_I(), r)), 1e-11);
}

TEST(Air, is_that_of_the_table_at_its_altitudes_and_in_between) {
  for (const AirLayer& layer : kAirLayers) {
    EXPECT_EQ(air_density(1e3 * layer.base_km), layer.density_kg_m3);
  }
  // 747.2119 km: 3.614e-14 exp(-(747.2119 - 700)/88.667) = 2.1219854e-14 (Vallado, 4th ed., example 8-4).
  EXPECT_NEAR(air_density(747.2119e3) / 2.1219854e-14, 1, 2e-5);
  EXPECT_NEAR(air_density(1500e3) / (3.019e-15 * std::exp(-500 / 268.0)), 1, 1e-14);
  EXPECT_EQ(air_density(-1.0), 1.225);
}

TEST(Air, has_layers_that_meet_and_thins_upwards) {
  double before = 2;
  for (std::size_t i = 1; i < kAirLayers.size(); ++i) {
    const double h = 1e3 * kAirLayers[i].base_km;
    const double jump = air_density(std::nextafter(h, 0.0)) / air_density(h);
    EXPECT_NEAR(jump, 1, i == 1 ? 1.4e-3 : 1e-4) << kAirLayers[i].base_km;
    EXPECT_LT(air_density(h), before);
    before = air_density(h);
  }
}

TEST(Altitude, is_above_the_ellipsoid) {
  const V pole{0, 0, 1};
  EXPECT_NEAR(altitude_of<double>({{1, 0, 0}, 7e6}, pole), 7e6 - 6378137, 1e-9);
  EXPECT_NEAR(altitude_of<double>({{0, 0, 1}, 7e6}, pole), 7e6 - 6356752.3, 0.1);
  for (double latitude = 0; latitude < 1.5; latitude += 0.1) {
    const double s = std::sin(latitude), c = std::cos(latitude), b = 6356752.3142;
    const double radius = 1 / std::sqrt(c * c / (6378137.0 * 6378137.0) + s * s / (b * b));
    EXPECT_NEAR(altitude_of<double>({{c, 0, s}, 7e6}, pole), 7e6 - radius, 80) << latitude;
  }
}

TEST(Air, at_rest_over_the_ground_blows_at_nothing) {
  const EarthRotation<double> rotation;
  const V r{4e6, -5e6, 2e6};
  EXPECT_LT(norm(velocity_in_air<double>({r, cross(rotation.omega_I(), r)}, rotation)), 1e-12);
  // Eastwards over the equator the Earth's turn takes 511 m/s off at 7,000 km.
  EXPECT_NEAR(velocity_in_air<double>({{7e6, 0, 0}, {0, 7546, 0}}, rotation).y, 7546 - 510.448,
              1e-3);
}

double days_since_J2000(double julian_date) { return julian_date - 2451545; }

/// Ecliptic longitude of date [deg], 0 to 360.
double longitude_of_date(double days) {
  const SunPosition<double> sun = SunMotion<double>{days}.at(0);
  const double tilt = 23.439291111 * kDegree;
  const V& u = sun.direction_I;
  const double longitude = std::atan2(u.y * std::cos(tilt) + u.z * std::sin(tilt), u.x) / kDegree;
  const double of_date = longitude + 1.3972 * days / 36525;
  return of_date < -1 ? of_date + 360 : of_date;
}

TEST(Sun, is_where_a_textbooks_example_has_it) {
  // Vallado, 4th ed., example 5-1: 2006 April 2, 0 h: (0.9771945, 0.1924424, 0.0834308) au against the equinox of date; the
  // Astronomical Almanac has, for J2000, (0.9776782, 0.1911521, 0.0828717) au.
  const double days = days_since_J2000(2453827.5);
  const SunPosition<double> sun = SunMotion<double>{days}.at(0);
  const V almanac{0.9776782, 0.1911521, 0.0828717};
  EXPECT_LT(norm(cross(sun.direction_I, almanac)) / norm(almanac) / kDegree, 0.01);
  EXPECT_NEAR(sun.distance_au, norm(almanac), 2e-4);
  EXPECT_NEAR(sun.distance_au, norm(V{0.9771945, 0.1924424, 0.0834308}), 1e-6);
  const double tilt = (23.439291 - 0.0130042 * days / 36525) * kDegree;
  const double expected =
      std::atan2(0.1924424 * std::cos(tilt) + 0.0834308 * std::sin(tilt), 0.9771945);
  EXPECT_NEAR(longitude_of_date(days), expected / kDegree, 1e-4);
}

TEST(Sun, is_at_the_equinoxes_and_solstices_when_the_calendar_says_so) {
  // 2020, UTC, to the minute: March 20 03:50, June 20 21:44, September 22 13:31, December 21 10:02; of 2000, March 20 07:35.
  constexpr double kDelay = 69.2 / 86400;  // TT - UTC
  EXPECT_NEAR(longitude_of_date(days_since_J2000(2458928.5 + 230 / 1440.0) + kDelay), 0, 0.012);
  EXPECT_NEAR(longitude_of_date(days_since_J2000(2459020.5 + 1304 / 1440.0) + kDelay), 90, 0.012);
  EXPECT_NEAR(longitude_of_date(days_since_J2000(2459114.5 + 811 / 1440.0) + kDelay), 180, 0.012);
  EXPECT_NEAR(longitude_of_date(days_since_J2000(2459204.5 + 602 / 1440.0) + kDelay), 270, 0.012);
  EXPECT_NEAR(longitude_of_date(days_since_J2000(2451623.5 + 455 / 1440.0)), 0, 0.012);
}

TEST(Sun, is_where_a_full_theory_has_it_to_a_hundredth_of_a_degree) {
  // ERFA 2.0 (eraEpv00: VSOP87's main terms, 5e-8 au), the Sun from the Earth in the axes of the ICRF [au], moved by the aberration of
  // light; days since J2000 (TDB). Over the whole of 1950 to 2050 the worst is 0.0112°.
  struct Case {
    double days;
    V sun_au;
  };
  constexpr Case kCases[] = {
      {-18000, {-1.0032620, 0.0378966, 0.0164229}}, {-9000, {0.6290581, 0.7252603, 0.3144903}},
      {0, {0.1770374, -0.8874449, -0.3847500}},     {3653, {0.1845127, -0.8861406, -0.3841655}},
      {7305, {0.1748608, -0.8877808, -0.3848553}},  {9500, {0.2340294, -0.8762625, -0.3798436}},
      {9800, {-0.7855454, -0.5570372, -0.2414576}}, {12000, {-0.6860243, -0.6557681, -0.2842452}},
      {18000, {0.9208678, 0.3639875, 0.1577453}}};
  for (const Case& c : kCases) {
    const SunPosition<double> sun = SunMotion<double>{c.days}.at(0);
    EXPECT_LT(norm(cross(sun.direction_I, c.sun_au)) / norm(c.sun_au) / kDegree, 0.012) << c.days;
    EXPECT_NEAR(sun.distance_au, norm(c.sun_au), 1e-4) << c.days;
  }
}

TEST(Sun, comes_nearest_in_january) {
  // 2020: 0.98324 au on January 5, 1.01669 au on July 4.
  EXPECT_NEAR(SunMotion<double>{days_since_J2000(2458853.8)}.at(0).distance_au, 0.98324, 1e-4);
  EXPECT_NEAR(SunMotion<double>{days_since_J2000(2459035.0)}.at(0).distance_au, 1.01669, 1e-4);
  for (double day = 0; day < 20'000; day += 3) {
    const SunPosition<double> sun = SunMotion<double>{day}.at(0);
    EXPECT_GT(sun.distance_au, kLeastSunDistance_au);
    EXPECT_NEAR(norm(sun.direction_I), 1, 1e-15);
  }
  // Time within a run counts as days before it do.
  EXPECT_LT(norm(SunMotion<double>{100}.at(86400 * 7.5).direction_I -
                 SunMotion<double>{107.5}.at(0).direction_I),
            1e-13);
}

/// When `light` falls below (or rises above) the level, between two times on either side.
double crossing(const std::function<double(double)>& light, double level, double a, double b) {
  const bool high = light(a) > level;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (a + b);
    ((light(middle) > level) == high ? a : b) = middle;
  }
  return 0.5 * (a + b);
}

TEST(Cylinder, is_entered_and_left_where_the_circular_orbits_closed_form_says) {
  // The half-arc in the dark: cos η = √(1 - (R/r)²)/cos β, β the Sun's height above the orbit's plane.
  for (const double radius : {6.778e6, 7.2e6, 4.2164e7}) {
    for (const double beta : {0.0, 0.1, -0.4, 1.0}) {
      const auto orbit = make_orbit<double>({radius, 0, 0, 0, 0, 0});  // noon at t = 0
      const V sun{std::cos(beta), 0, std::sin(beta)};
      const auto light = [&](double t) {
        return light_behind_cylinder(position_at(orbit, t), sun);
      };
      const double n = orbit.mean_motion_rad_s, midnight = std::numbers::pi / n;
      const double ratio = kEarthRadius_m / radius;
      const double cosine = std::sqrt(1 - ratio * ratio) / std::cos(beta);
      if (cosine >= 1) {
        EXPECT_EQ(light(midnight), 1.0) << radius << " " << beta;
        continue;
      }
      ASSERT_EQ(light(midnight), 0.0);
      const double half = std::acos(cosine) / n;
      EXPECT_NEAR(crossing(light, 0.5, 0, midnight), midnight - half, 1e-6);
      EXPECT_NEAR(crossing(light, 0.5, midnight, 2 * midnight), midnight + half, 1e-6);
    }
  }
}

TEST(Shadows, of_the_geostationary_orbit_at_equinox_last_as_long_as_is_known) {
  // 69.4 min behind the cylinder; of the cone 67 to 68 min in the umbra and 71 to 72 min from first to last contact.
  const auto orbit = make_orbit<double>({42164.17e3, 0, 0, 0, 0, 0});
  const SunPosition<double> sun{{1, 0, 0}, 1};
  const double midnight = std::numbers::pi / orbit.mean_motion_rad_s;
  const auto cylinder = [&](double t) {
    return light_behind_cylinder(position_at(orbit, t), sun.direction_I);
  };
  const auto cone = [&](double t) { return light_behind_cone(position_at(orbit, t), sun); };
  const auto minutes = [&](const auto& light, double level) {
    return (midnight - crossing(light, level, midnight - 4000, midnight)) * 2 / 60;
  };
  EXPECT_NEAR(minutes(cylinder, 0.5), 69.4, 0.1);
  EXPECT_NEAR(minutes(cone, 1e-9), 67.4, 0.4);
  EXPECT_NEAR(minutes(cone, 1 - 1e-9), 71.5, 0.4);
  EXPECT_NEAR(minutes(cone, 0.5), minutes(cylinder, 0.5), 0.2);
}

TEST(Cone, has_its_edges_on_the_common_tangents_of_sun_and_earth) {
  // A distance x behind the Earth, the umbra ends (R/sin α - x) tan α off the axis, sin α = (R_S - R)/D, and the penumbra
  // (R/sin β + x) tan β off it, sin β = (R_S + R)/D.
  const SunPosition<double> sun{{0, 0, 1}, 1};
  const double inner = (kSunRadius_m - kEarthRadius_m) / kAstronomicalUnit_m;
  const double outer = (kSunRadius_m + kEarthRadius_m) / kAstronomicalUnit_m;
  for (const double x : {1e6, 3e6, 7e6, 4.2e7, 3.8e8}) {
    const auto light = [&](double aside) {
      const V r{aside, 0, -x};
      return light_behind_cone<double>({(1 / norm(r)) * r, norm(r)}, sun);
    };
    const double umbra = (kEarthRadius_m / inner - x) * inner / std::sqrt(1 - inner * inner);
    const double penumbra = (kEarthRadius_m / outer + x) * outer / std::sqrt(1 - outer * outer);
    const double width = penumbra - umbra;
    EXPECT_EQ(light(umbra - 1e-4 * width), 0) << x;
    EXPECT_GT(light(umbra + 1e-4 * width), 0) << x;
    EXPECT_LT(light(penumbra - 1e-4 * width), 1) << x;
    EXPECT_EQ(light(penumbra + 1e-4 * width), 1) << x;
    double before = 0;
    for (double aside = umbra; aside < penumbra; aside += 0.01 * width) {
      EXPECT_GE(light(aside), before);
      before = light(aside);
    }
  }
  // Past the umbra's tip the Earth leaves a ring: 1 - (b/a)².
  const double far = 3e9, D = kAstronomicalUnit_m + far;
  const double a = std::asin(kSunRadius_m / D), b = std::asin(kEarthRadius_m / far);
  EXPECT_NEAR((light_behind_cone<double>({{0, 0, -1}, far}, sun)), 1 - b * b / (a * a), 1e-9);
}

TEST(CoveredPart, is_the_area_that_two_discs_share) {
  test::Generator random(7);
  for (int i = 0; i < 60; ++i) {
    const double a = test::uniform(random, 0.2, 1), b = test::uniform(random, 0.2, 2);
    const double c = test::uniform(random, 0, 1.1 * (a + b));
    // Strips across the line of centres, their length the shorter chord.
    double area = 0;
    constexpr int kStrips = 40'000;
    for (int k = 0; k < kStrips; ++k) {
      const double x = a * (2 * (k + 0.5) / kStrips - 1);
      const double one = a * a - x * x, other = b * b - (x - c) * (x - c);
      if (other > 0) {
        area += 2 * std::sqrt(std::fmin(one, other)) * 2 * a / kStrips;
      }
    }
    EXPECT_NEAR(covered_part(a, b, c), area / (std::numbers::pi * a * a), 2e-6);
  }
}

TEST(LightAt, of_the_dayside_and_without_a_shadow_is_all_there_is) {
  const SunPosition<double> sun{{1, 0, 0}, 1};
  for (const Shadow shadow : {Shadow::none, Shadow::cylinder, Shadow::cone}) {
    EXPECT_EQ((light_at<double>(shadow, {{0.6, 0.8, 0}, 6.8e6}, sun)), 1.0);
    EXPECT_EQ((light_at<double>(shadow, {{-1, 0, 0}, 6.8e6}, sun)),
              shadow == Shadow::none ? 1.0 : 0.0);
  }
}

}  // namespace
}  // namespace adstar
