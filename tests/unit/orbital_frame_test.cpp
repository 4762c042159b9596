#include "adstar/orbit/orbital_frame.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "adstar/arc.hpp"
#include "adstar/orbit/orbit.hpp"
#include "adstar/so3.hpp"
#include "tests/support/random_motion.hpp"
#include "tests/support/wide.hpp"

namespace adstar {
namespace {

using V = Vec3<double>;

constexpr double kPi = std::numbers::pi;

TEST(Arcs, are_those_of_the_library_within_two_ulp) {
  test::Generator random(1);
  for (int i = 0; i < 100'000; ++i) {
    const double a = test::uniform(random, -kPi, kPi), size = test::log_uniform(random, 1e-9, 1e9);
    const double c = size * std::cos(a), s = size * std::sin(a);
    ASSERT_NEAR(arc_of(c, s), std::atan2(s, c), 2 * test::ulp(a)) << a;
    const double x = test::uniform(random, 0, 1);
    ASSERT_NEAR(arc_sine(x), std::asin(x), 6e-16);
    ASSERT_NEAR(arc_cosine(2 * x - 1), std::acos(2 * x - 1), 1e-15);
  }
  EXPECT_EQ(arc_of(1.0, 0.0), 0);
  EXPECT_EQ(arc_of(0.0, 1.0), kPi / 2);
  EXPECT_EQ(arc_of(0.0, -1.0), -kPi / 2);
  EXPECT_EQ(arc_of(-1.0, 0.0), kPi);
  EXPECT_EQ(arc_of(0.0, 0.0), 0);
  EXPECT_EQ(arc_sine(1.0000001), kPi / 2);
  EXPECT_EQ(arc_cosine(-1.0000001), kPi);
}

TEST(OrbitalFrame, points_down_against_the_normal_and_forward) {
  const auto orbit = make_orbit<double>({7e6, 0.1, 0.9, 0.4, 0.7, 0.2});
  for (double t = 0; t < 6000; t += 97) {
    const OrbitMotion<double> m = motion_at(orbit, t);
    const OrbitalFrame<double> O = orbital_frame(m);
    EXPECT_NEAR(squared_norm(O.q_IO), 1, 1e-15);
    EXPECT_LT(norm(rotate(O.q_IO, V{0, 0, 1}) + (1 / norm(m.r_I)) * m.r_I), 1e-15);
    EXPECT_LT(norm(rotate(O.q_IO, V{0, 1, 0}) + cross(orbit.P, orbit.Q)), 1e-15);
    EXPECT_GT(dot(rotate(O.q_IO, V{1, 0, 0}), m.v_I), 0.99 * norm(m.v_I));
  }
}

TEST(OrbitalFrame, turns_as_fast_as_it_says) {
  const auto orbit = make_orbit<double>({2.66e7, 0.74, 1.1, 2.0, 4.7, 0.3});
  constexpr double h = 0.5;
  for (double t = 0; t < 43'000; t += 1717) {
    const auto frame = [&](double at) { return orbital_frame(motion_at(orbit, at)); };
    const V turn = rotation_vector(frame(t - h).q_IO, frame(t + h).q_IO);
    const V omega = frame(t).omega_O;
    EXPECT_LT(norm((0.5 / h) * turn - omega), 1e-6 * norm(omega)) << t;
  }
  const auto circular = make_orbit<double>({7e6, 0, 0.9, 0.4, 0.7, 0.2});
  EXPECT_NEAR(orbital_frame(motion_at(circular, 77.0)).omega_O.y / -circular.mean_motion_rad_s, 1,
              1e-14);
}

/// Against differences of O itself, whose plane J2 turns.
TEST(OrbitalFrame, of_an_orbit_whose_plane_turns_turns_as_fast_as_it_says) {
  const auto secular = make_secular_orbit<double>({7e6, 0.02, 0.9, 0.4, 0.7, 0.2});
  Ephemeris<double> rows;
  for (double t = 0; t <= 6000; t += 30) {
    const OrbitMotion<double> m = motion_at(secular, t);
    rows.rows.push_back({t, m.r_I, m.v_I});
  }
  constexpr double h = 0.5;
  for (const Orbit<double>& orbit :
       {Orbit<double>(secular), Orbit<double>(make_ephemeris(std::move(rows)))}) {
    double largest = 0;
    for (double t = 100; t < 5900; t += 171) {
      const V turn =
          rotation_vector(orbital_frame_at(orbit, t - h).q_IO, orbital_frame_at(orbit, t + h).q_IO);
      const V omega = orbital_frame_at(orbit, t).omega_O;
      EXPECT_LT(norm((0.5 / h) * turn - omega), 1e-9) << t;
      largest = std::fmax(largest, std::fabs(omega.z));
    }
    EXPECT_NEAR(largest, 2 * std::fabs(secular.node_rate_rad_s) * std::sin(0.9), 2e-8);
    EXPECT_GT(largest, 1e-6);
  }
}

TEST(OrbitalFrame, without_a_plane_is_one_all_the_same) {
  for (const V& r : {V{7e6, 0, 0}, V{0, 0, 7e6}, V{1e6, 2e6, -6e6}}) {
    for (const V& v : {V{}, 1e-3 * r}) {
      const OrbitalFrame<double> O = orbital_frame(OrbitMotion<double>{r, v});
      EXPECT_NEAR(squared_norm(O.q_IO), 1, 1e-15);
      EXPECT_LT(norm(rotate(O.q_IO, V{0, 0, 1}) + (1 / norm(r)) * r), 1e-15);
      EXPECT_EQ(norm(O.omega_O), 0);
    }
  }
}

TEST(QuaternionFromColumns, is_the_rotation_whose_columns_they_are) {
  test::Generator random(2);
  for (int i = 0; i < 10'000; ++i) {
    const Quat<double> q =
        i < 4 ? Quat<double>{i == 0 ? 1.0 : 0, i == 1 ? 1.0 : 0, i == 2 ? 1.0 : 0, i == 3 ? 1.0 : 0}
              : test::unit_quaternion(random);
    const Quat<double> p = quaternion_from_columns(rotate(q, V{1, 0, 0}), rotate(q, V{0, 1, 0}),
                                                   rotate(q, V{0, 0, 1}));
    EXPECT_LT(norm(rotation_vector(q, p)), 2e-15);
  }
}

TEST(RotationVector, is_what_was_turned_by_from_the_tiny_to_the_half_turn) {
  test::Generator random(3);
  for (int i = 0; i < 10'000; ++i) {
    const double angle = test::log_uniform(random, 1e-12, 3.14);
    const V phi = angle * test::unit_vector(random);
    const V straight = rotation_vector(Quat<double>{}, Rotation<double>(phi).quaternion());
    ASSERT_LT(norm(straight - phi), 2e-15 * angle) << angle;
    // From anywhere else, the product of quaternions rounds.
    const Quat<double> q = test::unit_quaternion(random);
    const Quat<double> turned = q * Rotation<double>(phi).quaternion();
    const Quat<double> negative{-turned.w, -turned.x, -turned.y, -turned.z};
    ASSERT_LT(norm(rotation_vector(q, turned) - phi), 2e-15) << angle;
    ASSERT_EQ(rotation_vector(q, negative), rotation_vector(q, turned));
    ASSERT_NEAR(norm(rotation_vector(q, turned)), angle_between(q, turned), 1e-15);
  }
  EXPECT_EQ(rotation_vector(Quat<double>{}, Quat<double>{}), V{});
  EXPECT_NEAR(norm(rotation_vector(Quat<double>{}, Quat<double>{0, 0, 1, 0})), kPi, 1e-15);
}

}  // namespace
}  // namespace adstar
