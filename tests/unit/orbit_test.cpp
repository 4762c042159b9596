// Orbits of every kind: motion against its own derivative, against numbers of textbooks, and against a force that is integrated.
#include "adstar/orbit/orbit.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "adstar/so3.hpp"
#include "tests/support/random_motion.hpp"
#include "tests/support/wide.hpp"

namespace adstar {
namespace {

using V = Vec3<double>;
using Quad = test::Quad;

constexpr double kDegree = std::numbers::pi / 180, kDay = 86400;

OrbitElements<double> eccentric() { return {2.66e7, 0.74, 1.1, 2.0, 4.7, 0.3}; }

template <class To>
OrbitElements<To> elements_in(const OrbitElements<double>& e) {
  return {To(e.semi_major_axis_m),
          To(e.eccentricity),
          To(e.inclination_rad),
          To(e.right_ascension_rad),
          To(e.argument_of_periapsis_rad),
          To(e.mean_anomaly_rad),
          To(e.gravity_m3_s2)};
}

/// Relative difference of the velocity from the derivative of the position, fourth-order differences in 113 bits.
template <class AnyOrbit>
double velocity_defect(const AnyOrbit& orbit, double t_s) {
  const Quad t(t_s), h(0.01);
  const auto at = [&](int k) {
    const OrbitPosition<Quad> p = position_at(orbit, Quad(t + Quad(k) * h));
    return Vec3<Quad>(p.distance_m * p.direction_I);
  };
  const Vec3<Quad> slope =
      (Quad(1) / (Quad(12) * h)) * (Quad(8) * (at(1) - at(-1)) - (at(2) - at(-2)));
  const OrbitMotion<Quad> motion = motion_at(orbit, t);
  EXPECT_LT(test::to_double(Quad(norm(motion.r_I - at(0)) / norm(at(0)))), 1e-30);
  return test::to_double(Quad(norm(motion.v_I - slope) / norm(slope)));
}

TEST(KeplerMotion, is_the_derivative_of_the_position) {
  for (const double e : {0.0, 0.01, 0.3, 0.74}) {
    auto elements = eccentric();
    elements.eccentricity = e;
    const auto orbit = make_orbit(elements_in<Quad>(elements));
    for (double t = 0; t < 43'000; t += 3989) {
      EXPECT_LT(velocity_defect(orbit, t), 1e-15) << e << " " << t;
    }
  }
}

TEST(KeplerMotion, keeps_energy_and_area_to_round_off) {
  const auto orbit = make_orbit(eccentric());
  const double area = std::sqrt(orbit.gravity_m3_s2 * 2.66e7 * (1 - 0.74 * 0.74));
  for (double t = 0; t < 1e5; t += 971) {
    const OrbitMotion<double> m = motion_at(orbit, t);
    const double energy = 0.5 * squared_norm(m.v_I) - orbit.gravity_m3_s2 / norm(m.r_I);
    EXPECT_NEAR(energy * -2 * 2.66e7 / orbit.gravity_m3_s2, 1, 2e-14) << t;
    EXPECT_NEAR(norm(cross(m.r_I, m.v_I)) / area, 1, 5e-15) << t;
  }
}

TEST(KeplerMotion, has_the_vectors_of_a_textbooks_example) {
  // Vallado, 4th ed., example 2-5: r = (6524.834, 6862.875, 6448.296) km, v = (4.901327, 5.533756, -1.976341) km/s has
  // a = 36127.343 km, e = 0.832853, i = 87.870°, node 227.898°, periapsis 53.38°, true anomaly 92.335°.
  const double e = 0.832853, half = 0.5 * 92.335 * kDegree;
  const double E = 2 * std::atan(std::sqrt((1 - e) / (1 + e)) * std::tan(half));
  const auto orbit = make_orbit<double>(
      {36127.343e3, e, 87.870 * kDegree, 227.898 * kDegree, 53.38 * kDegree, E - e * std::sin(E)});
  const OrbitMotion<double> m = motion_at(orbit, 0.0);
  EXPECT_LT(norm(m.r_I - V{6524.834e3, 6862.875e3, 6448.296e3}), 2e3);  // of angles to 0.01°
  EXPECT_LT(norm(m.v_I - V{4901.327, 5533.756, -1976.341}), 1.5);
}

TEST(SecularOrbit, without_J2_is_keplers) {
  const auto kepler = make_orbit(eccentric());
  const auto secular = make_secular_orbit(eccentric(), 0.0);
  for (double t = 0; t < 1e5; t += 7919) {
    const OrbitPosition<double> a = position_at(kepler, t), b = position_at(secular, t);
    EXPECT_EQ(a.direction_I, b.direction_I);
    EXPECT_EQ(a.distance_m, b.distance_m);
    EXPECT_EQ(motion_at(kepler, t).v_I, motion_at(secular, t).v_I);
  }
}

TEST(SecularOrbit, turns_once_a_year_where_textbooks_say_so) {
  // The sun-synchronous orbit at 800 km: 360° in 365.2422 days = 0.98565°/day (Vallado, 4th ed., section 11.4.1).
  const auto orbit = make_secular_orbit<double>({7178e3, 0, 98.6 * kDegree});
  EXPECT_NEAR(orbit.node_rate_rad_s * kDay / kDegree, 0.9856, 0.004);
  // Its inclination, cos i = -(a/12352 km)^(7/2), is the one for which it is exact.
  const double i = std::acos(-std::pow(7178.0 / 12352, 3.5));
  EXPECT_NEAR(make_secular_orbit<double>({7178e3, 0, i}).node_rate_rad_s * kDay / kDegree, 0.98565,
              2e-4);
}

TEST(SecularOrbit, holds_its_periapsis_at_the_critical_inclination) {
  const double critical = std::acos(1 / std::sqrt(5.0));
  const auto orbit = make_secular_orbit<double>({2.66e7, 0.74, critical});
  EXPECT_LT(std::fabs(orbit.periapsis_rate_rad_s), 1e-20);
  EXPECT_GT(make_secular_orbit<double>({2.66e7, 0.74, critical - 0.01}).periapsis_rate_rad_s,
            1e-11);
  EXPECT_LT(make_secular_orbit<double>({2.66e7, 0.74, critical + 0.01}).periapsis_rate_rad_s,
            -1e-11);
}

TEST(SecularOrbit, moves_as_its_position_does) {
  const auto orbit = make_secular_orbit(elements_in<Quad>(eccentric()));
  for (double t = 0; t < 43'000; t += 3989) {
    EXPECT_LT(velocity_defect(orbit, t), 1e-15) << t;
  }
}

/// A satellite under the point mass and J2, by the classical fourth-order method.
struct Flattened {
  V r, v;

  static V acceleration(const V& r) {
    const double d = norm(r), z2 = r.z * r.z / (d * d);
    const double k = 1.5 * kEarthJ2 * kEarthEquator_m * kEarthEquator_m / (d * d);
    const double g = kEarthGravity_m3_s2 / (d * d * d);
    return {-g * r.x * (1 + k * (1 - 5 * z2)), -g * r.y * (1 + k * (1 - 5 * z2)),
            -g * r.z * (1 + k * (3 - 5 * z2))};
  }
  void step(double h) {
    const V k1 = acceleration(r), r2 = r + (h / 2) * v, v2 = v + (h / 2) * k1;
    const V k2 = acceleration(r2), r3 = r + (h / 2) * v2, v3 = v + (h / 2) * k2;
    const V k3 = acceleration(r3), r4 = r + h * v3, v4 = v + h * k3;
    r = r + (h / 6) * (v + 2.0 * (v2 + v3) + v4);
    v = v + (h / 6) * (k1 + 2.0 * (k2 + k3) + acceleration(r4));
  }
};

TEST(SecularOrbit, drifts_as_the_flattened_earths_force_makes_an_orbit_drift) {
  const auto orbit = make_secular_orbit<double>({7.2e6, 0.05, 0.9, 0.4, 0.7, 0});
  const OrbitMotion<double> begin = motion_at(orbit, 0.0);
  Flattened flown{begin.r_I, begin.v_I};
  const auto node = [](const Flattened& s) {
    const V h = cross(s.r, s.v);
    return std::atan2(h.x, -h.y);
  };
  const double period = 2 * std::numbers::pi / orbit.anomaly_rate_rad_s;
  constexpr int kPerOrbit = 600, kOrbits = 30;
  // Means over the first revolution and over the last: what swings within one falls out.
  double first = 0, last = 0;
  for (int k = 0; k < kPerOrbit * kOrbits; ++k) {
    (k < kPerOrbit ? first : last) +=
        k < kPerOrbit || k >= kPerOrbit * (kOrbits - 1) ? node(flown) / kPerOrbit : 0;
    flown.step(period / kPerOrbit);
  }
  EXPECT_NEAR((last - first) / (period * (kOrbits - 1)) / orbit.node_rate_rad_s, 1, 0.01);
}

/// Osculating: a, argument of latitude of the periapsis, mean argument of latitude (Vallado, 4th ed., algorithm 9).
struct Osculating {
  double a_m = 0, periapsis_rad = 0, latitude_rad = 0;
};

Osculating osculating(const Flattened& s) {
  const double mu = kEarthGravity_m3_s2, d = norm(s.r);
  const V h = cross(s.r, s.v), e = (1 / mu) * cross(s.v, h) - (1 / d) * s.r;
  const V W = (1 / norm(h)) * h, N = (1 / std::hypot(h.x, h.y)) * V{-h.y, h.x, 0};
  const auto angle = [&](const V& v) { return std::atan2(dot(v, cross(W, N)), dot(v, N)); };
  const double a = 1 / (2 / d - squared_norm(s.v) / mu), ecc = norm(e);
  const double nu = angle(s.r) - angle(e);
  const double E = 2 * std::atan(std::sqrt((1 - ecc) / (1 + ecc)) * std::tan(0.5 * nu));
  return {a, angle(e), angle(e) + E - ecc * std::sin(E)};
}

TEST(SecularOrbit, runs_and_turns_its_periapsis_as_the_flattened_earths_force_does) {
  const OrbitElements<double> asked{7.2e6, 0.05, 0.9, 0.4, 0.7, 0};
  const auto begin = motion_at(make_secular_orbit(asked), 0.0);
  Flattened flown{begin.r_I, begin.v_I};
  const double period = 2 * std::numbers::pi / make_secular_orbit(asked).anomaly_rate_rad_s;
  constexpr int kPerOrbit = 600, kOrbits = 100;
  struct Mean {
    double a_m = 0, periapsis_rad = 0, latitude_rad = 0;
  } first, last;
  double latitude = 0;  // counted on
  for (int k = 0; k < kPerOrbit * kOrbits; ++k) {
    const Osculating now = osculating(flown);
    latitude += std::remainder(now.latitude_rad - latitude, 2 * std::numbers::pi);
    if (k < kPerOrbit || k >= kPerOrbit * (kOrbits - 1)) {
      Mean& mean = k < kPerOrbit ? first : last;
      mean.a_m += now.a_m / kPerOrbit;
      mean.periapsis_rad += now.periapsis_rad / kPerOrbit;
      mean.latitude_rad += latitude / kPerOrbit;
    }
    flown.step(period / kPerOrbit);
  }
  // The rates are those of the mean axis, which is not the one it began with.
  OrbitElements<double> mean = asked;
  mean.semi_major_axis_m = first.a_m;
  const auto orbit = make_secular_orbit(mean);
  const double time = period * (kOrbits - 1);
  const double periapsis_rate = (last.periapsis_rad - first.periapsis_rad) / time;
  EXPECT_NEAR(periapsis_rate / orbit.periapsis_rate_rad_s, 1, 0.02);
  const double n = std::sqrt(mean.gravity_m3_s2 / first.a_m) / first.a_m;
  const double beyond_kepler = (last.latitude_rad - first.latitude_rad) / time - n;
  EXPECT_NEAR(beyond_kepler / (orbit.periapsis_rate_rad_s + orbit.anomaly_rate_rad_s - n), 1, 0.02);
}

Ephemeris<double> sampled(const Orbit<double>& orbit, double gap_s, int rows,
                          EphemerisMethod method, int degree, double begin_s = 0) {
  Ephemeris<double> table;
  table.method = method;
  table.degree = degree;
  for (int i = 0; i < rows; ++i) {
    const double t = begin_s + gap_s * i;
    const OrbitMotion<double> m = motion_at(orbit, t);
    table.rows.push_back({t, m.r_I, m.v_I});
  }
  return table;
}

/// Of position [m] and velocity [m/s], at most, in the middle half of the table.
std::pair<double, double> errors(const Orbit<double>& orbit, double gap_s, EphemerisMethod method,
                                 int degree) {
  const int rows = static_cast<int>(6000 / gap_s) + 1;
  const Orbit<double> table = make_ephemeris(sampled(orbit, gap_s, rows, method, degree));
  double position = 0, velocity = 0;
  for (double t = 1500; t < 4500; t += 7.3) {
    const OrbitMotion<double> got = motion_at(table, t), truth = motion_at(orbit, t);
    position = std::fmax(position, norm(got.r_I - truth.r_I));
    velocity = std::fmax(velocity, norm(got.v_I - truth.v_I));
    const OrbitPosition<double> p = position_at(table, t);
    EXPECT_LT(norm(p.distance_m * p.direction_I - got.r_I), 1e-8);
  }
  return {position, velocity};
}

TEST(Ephemeris, of_minutes_is_good_to_millimetres_and_gains_with_its_degree) {
  const Orbit<double> orbit = make_orbit<double>({7e6, 0.02, 0.9, 0.4, 0.7, 0});
  const auto hermite = errors(orbit, 60, EphemerisMethod::hermite, 7);
  EXPECT_LT(hermite.first, 1e-4);
  EXPECT_LT(hermite.second, 1e-5);
  const auto lagrange = errors(orbit, 60, EphemerisMethod::lagrange, 8);
  EXPECT_LT(lagrange.first, 1e-2);
  EXPECT_LT(lagrange.second, 1e-5);
  // Degree d: the position's error falls like the gap to the d + 1.
  for (const auto& [method, degree] :
       {std::pair(EphemerisMethod::hermite, 3), std::pair(EphemerisMethod::hermite, 5),
        std::pair(EphemerisMethod::lagrange, 3), std::pair(EphemerisMethod::lagrange, 5)}) {
    const double coarse = errors(orbit, 200, method, degree).first;
    const double fine = errors(orbit, 100, method, degree).first;
    EXPECT_NEAR(std::log2(coarse / fine), degree + 1, 0.4) << degree;
  }
}

TEST(Ephemeris, reproduces_polynomials_of_its_degree_and_meets_its_rows) {
  const auto cubic = [](double t) {
    return V{7e6 + t * (1 + t * (0.01 - 1e-4 * t)), 100 * t, -t * t};
  };
  const auto slope = [](double t) { return V{1 + t * (0.02 - 3e-4 * t), 100, -2 * t}; };
  for (const EphemerisMethod method : {EphemerisMethod::hermite, EphemerisMethod::lagrange}) {
    Ephemeris<double> table;
    table.method = method;
    table.degree = 3;
    for (const double t : {0.0, 7.0, 9.0, 20.0, 31.0, 32.0}) {
      table.rows.push_back({t, cubic(t), slope(t)});
    }
    const auto shared = make_ephemeris(table);
    for (double t = 0; t < 32; t += 0.37) {
      EXPECT_LT(norm(motion_at(*shared, t).r_I - cubic(t)), 1e-8) << t;
      EXPECT_LT(norm(motion_at(*shared, t).v_I - slope(t)), 1e-9) << t;
    }
    for (const auto& row : table.rows) {
      EXPECT_LT(norm(motion_at(*shared, row.t_s).r_I - row.r_I), 2e-9);
    }
  }
}

TEST(Ephemeris, stands_at_its_ends_outside_its_span) {
  const Orbit<double> orbit = make_orbit<double>({7e6, 0.02, 0.9, 0.4, 0.7, 0});
  const Orbit<double> table =
      make_ephemeris(sampled(orbit, 60, 20, EphemerisMethod::hermite, 7, 100));
  EXPECT_EQ(span_s(table), std::pair(100.0, 1240.0));
  for (const double t : {-1e9, 0.0, 100.0}) {
    EXPECT_EQ(motion_at(table, t).r_I, motion_at(orbit, 100.0).r_I);
  }
  for (const double t : {1240.0, 1241.0, 1e9}) {
    EXPECT_EQ(motion_at(table, t).r_I, motion_at(orbit, 1240.0).r_I);
    EXPECT_NEAR(position_at(table, t).distance_m, position_at(orbit, 1240.0).distance_m, 1e-8);
  }
  EXPECT_LT(span_s(orbit).first, -1e300);
  EXPECT_GT(span_s(orbit).second, 1e300);
}

TEST(Ephemeris, says_what_is_wrong_with_it) {
  const Orbit<double> orbit = make_orbit<double>({7e6, 0.02, 0.9, 0.4, 0.7, 0});
  const auto good = sampled(orbit, 60, 20, EphemerisMethod::hermite, 7);
  EXPECT_EQ(defect_of(good), nullptr);
  auto bad = good;
  bad.degree = 6;
  EXPECT_STREQ(defect_of(bad), "a Hermite polynomial has an odd degree");
  bad = good;
  bad.degree = 16;
  EXPECT_STREQ(defect_of(bad), "the degree is not from 1 to 15");
  bad = good;
  bad.rows.resize(3);
  EXPECT_STREQ(defect_of(bad), "it has fewer epochs than its polynomial needs");
  bad = good;
  bad.rows[7].t_s = bad.rows[6].t_s;
  EXPECT_STREQ(defect_of(bad), "its epochs do not rise");
  bad = good;
  bad.rows[7].r_I = {};
  EXPECT_STREQ(defect_of(bad), "a row is not a motion off the centre");
}

TEST(Orbit, knows_how_near_and_how_fast_it_gets) {
  const auto elements = eccentric();
  std::vector<Orbit<double>> orbits{make_orbit(elements), make_secular_orbit(elements),
                                    make_fixed_position<double>({1e6, -2e6, 7e6})};
  orbits.emplace_back(make_ephemeris(sampled(orbits[0], 300, 200, EphemerisMethod::hermite, 7)));
  for (const Orbit<double>& orbit : orbits) {
    double nearest = 1e300, fastest = 0;
    for (double t = 0; t < 6e4; t += 5.1) {
      const OrbitMotion<double> m = motion_at(orbit, t);
      nearest = std::fmin(nearest, norm(m.r_I));
      fastest = std::fmax(fastest, norm(m.v_I));
    }
    EXPECT_LE(least_distance(orbit), nearest * (1 + 1e-14)) << orbit.index();
    EXPECT_GT(least_distance(orbit), 0.99 * nearest) << orbit.index();
    EXPECT_GE(greatest_speed(orbit), fastest * (1 - 1e-14)) << orbit.index();
    EXPECT_LE(greatest_speed(orbit), 1.05 * fastest + 1) << orbit.index();
    EXPECT_EQ(gravity_of(orbit), kEarthGravity_m3_s2);
  }
}

TEST(Orbit, given_as_keplers_has_keplers_bits) {
  const auto kepler = make_orbit(eccentric());
  const Orbit<double> orbit = kepler;
  for (double t = 0; t < 1e5; t += 7919) {
    EXPECT_EQ(position_at(orbit, t).direction_I, position_at(kepler, t).direction_I);
    EXPECT_EQ(position_at(orbit, t).distance_m, position_at(kepler, t).distance_m);
    EXPECT_EQ(motion_at(orbit, t).v_I, motion_at(kepler, t).v_I);
  }
}

TEST(Orbit, that_is_a_place_stays_there) {
  const Orbit<double> orbit = make_fixed_position<double>({0, -3e6, 4e6});
  EXPECT_EQ(position_at(orbit, 123.0).distance_m, 5e6);
  EXPECT_LT(norm(position_at(orbit, 123.0).direction_I - V{0, -0.6, 0.8}), 2e-16);
  EXPECT_EQ(motion_at(orbit, 5.0).v_I, V{});
}

}  // namespace
}  // namespace adstar
