// Coils: what is possible of what is commanded, the lag in closed form, a past that does not depend on who asks for it, and edges.
#include "adstar/torques/magnetorquer.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "adstar/integrators/all.hpp"
#include "adstar/propagator.hpp"
#include "tests/support/random_motion.hpp"

namespace adstar {
namespace {

using V = Vec3<double>;

constexpr std::int64_t kSecond = 1'000'000'000;

Coils<double> coils_of(const V& limit, const V& step, double lag_s) {
  Coils<double> coils;
  coils.limit_A_m2 = limit;
  coils.step_A_m2 = step;
  coils.lag_s = lag_s;
  coils.field.orbit = make_fixed_position<double>({kMagneticRadius_m, 0, 0});
  coils.field.field.dipole.g_T = {0, 0, -3e-5};
  return coils;
}

Magnetorquer<double> make(const Coils<double>& coils,
                          const std::vector<DipoleInterval<double>>& commands = {}) {
  Magnetorquer<double> torquer;
  torquer.coils = std::make_shared<const Coils<double>>(coils);
  for (const auto& command : commands) {
    torquer.window.at(torquer.intervals++) = command;
  }
  return torquer;
}

TEST(Magnetorquer, cuts_at_the_limit_of_each_coil_and_rounds_to_its_step) {
  const auto torquer = make(coils_of({10, 10, 1}, {0, 0.4, 0.3}, 0));
  EXPECT_EQ(torquer.possible({3.3, 0, 0}), (V{3.3, 0, 0}));
  EXPECT_EQ(torquer.possible({-12, 0, 0}), (V{-10, 0, 0}));
  EXPECT_NEAR(torquer.possible({0, 1.1, 0}).y, 1.2, 1e-15);
  EXPECT_NEAR(torquer.possible({0, -1.3, 0}).y, -1.2, 1e-15);
  EXPECT_NEAR(torquer.possible({0, 0.19, 0}).y, 0, 0);
  EXPECT_NEAR(torquer.possible({0, 0, 5}).z, 0.9, 1e-15) << "the last step within the limit";
  test::Generator random(1);
  for (int i = 0; i < 1000; ++i) {
    const double asked = test::uniform(random, -12, 12), got = torquer.possible({0, asked, 0}).y;
    EXPECT_LE(std::fabs(got), 10);
    EXPECT_LE(std::fabs(std::fabs(asked) < 10 ? got - asked : 0), 0.2 + 1e-12);
    EXPECT_NEAR(std::remainder(got, 0.4), 0, 1e-13);
  }
}

TEST(Magnetorquer, is_the_cross_product_of_dipole_and_field_about_its_axes) {
  auto coils = coils_of({10, 10, 10}, {}, 0);
  coils.axes_B = {V{0, 1, 0}, V{0.6, 0, 0.8}, V{1, 0, 0}};
  const auto torquer = make(coils, {{0, kSecond, {2, 5, 0}}});
  EXPECT_EQ(torquer.dipole_B(0.5), (V{3, 2, 4}));
  EXPECT_LT(norm(torquer.at(0.5, {}) - cross(V{3, 2, 4}, V{0, 0, 3e-5})), 1e-19);
  EXPECT_EQ(torquer.at(1.5, {}), V{});
  EXPECT_GE(torquer.bound(), norm(torquer.at(0.5, {})));
}

TEST(Magnetorquer, without_a_lag_switches_within_a_microsecond_after_an_edge) {
  const auto torquer = make(coils_of({10, 10, 10}, {}, 0), {{kSecond, 2 * kSecond, {1, 0, 0}}});
  EXPECT_EQ(torquer.dipole_B(1.0), V{});  // still on the side of the step before
  EXPECT_EQ(torquer.dipole_B(1.0 + 1e-6).x, 1);
  EXPECT_EQ(torquer.dipole_B(2.0).x, 1);
  EXPECT_EQ(torquer.dipole_B(2.0 + 1e-6), V{});
  std::vector<std::int64_t> edges;
  for (std::int64_t t = 0; t != kNever; t = torquer.next_edge_after(t)) {
    edges.push_back(t);
  }
  EXPECT_EQ(edges, (std::vector<std::int64_t>{0, kSecond, kSecond + 1000, 2 * kSecond,
                                              2 * kSecond + 1000}));
  EXPECT_EQ(torquer.next_edge_after(std::numeric_limits<std::int64_t>::min()), kSecond);
  EXPECT_EQ(make(coils_of({1, 1, 1}, {}, 0)).next_edge_after(0), kNever);
}

TEST(Magnetorquer, with_a_lag_ends_segments_at_commands_and_while_the_dipole_follows) {
  const auto torquer = make(coils_of({10, 10, 10}, {}, 0.1), {{kSecond, 1'170'000'000, {1, 0, 0}}});
  std::vector<std::int64_t> edges_ms;
  for (std::int64_t t = torquer.next_edge_after(0); t != kNever; t = torquer.next_edge_after(t)) {
    edges_ms.push_back(t / 1'000'000);
  }
  EXPECT_EQ(edges_ms, (std::vector<std::int64_t>{1000, 1050, 1100, 1150, 1170, 1220, 1270,
                                                 1320, 1370, 1420, 1470, 1570, 1670, 1770,
                                                 1970, 2170, 2470, 2870, 3370, 4170}));
  EXPECT_EQ(make(coils_of({1, 1, 1}, {}, 0.1)).next_edge_after(0), kNever) << "nothing to follow";
}

/// A body too heavy to turn takes tau (T - lag (1 - e^(-T/lag))) while it is commanded and tau lag (1 - e^(-T/lag)) after.
TEST(Magnetorquer, with_a_lag_a_hundredth_of_the_step_gives_its_impulse) {
  const double lag = 1e-3, T = 0.53;
  const std::vector<Torque<double>> torques{
      make(coils_of({10, 10, 10}, {}, lag), {{kSecond / 2, 1'030'000'000, {5, 0, 0}}})};
  const RigidBody<double> body(Eigen::Matrix3d(1e9 * Eigen::Matrix3d::Identity()));
  const double tau = 5 * 3e-5;  // about -y
  const auto impulse_at = [&](std::int64_t end_ns) {
    State<double> state = make_state(Quat<double>{}, V{});
    for (std::int64_t t = 0; t < end_ns; t += kSecond / 10) {
      EXPECT_TRUE(
          advance<CoadjointRk4>(body, state, std::span(torques), t, kSecond / 10).resolved());
    }
    return -state.H_I.value().y;
  };
  EXPECT_NEAR(impulse_at(kSecond), tau * (0.5 - lag), 1e-4 * tau * lag);
  EXPECT_NEAR(impulse_at(2 * kSecond), tau * T, 1e-4 * tau * lag);
}

TEST(Magnetorquer, follows_with_its_lag_in_closed_form) {
  const double lag = 0.3;
  const auto torquer =
      make(coils_of({10, 10, 10}, {}, lag),
           {{kSecond, 2 * kSecond, {4, 0, -20}}, {3 * kSecond, 9 * kSecond, {-1, 2, 0}}});
  const auto rise = [&](double t) { return -std::expm1(-t / lag); };
  EXPECT_EQ(torquer.dipole_B(0.7), V{});
  for (double t = 1; t <= 2; t += 0.01) {
    EXPECT_NEAR(torquer.dipole_B(t).x, 4 * rise(t - 1), 1e-14) << t;
    EXPECT_NEAR(torquer.dipole_B(t).z, -10 * rise(t - 1), 1e-14) << t;
  }
  const double at_2 = 4 * rise(1), at_3 = at_2 * std::exp(-1 / lag);
  for (double t = 2; t <= 3; t += 0.01) {
    EXPECT_NEAR(torquer.dipole_B(t).x, at_2 * std::exp(-(t - 2) / lag), 1e-14) << t;
  }
  for (double t = 3; t <= 5; t += 0.01) {
    EXPECT_NEAR(torquer.dipole_B(t).x, -1 + (at_3 + 1) * std::exp(-(t - 3) / lag), 1e-14) << t;
    EXPECT_NEAR(torquer.dipole_B(t).y, 2 * rise(t - 3), 1e-14) << t;
  }
}

/// Dipoles at sampled times of a run whose window is written at the beginning of each step, as a gate does: what of the commands
/// ends after it and begins before the step's end.
std::vector<V> flown(const Coils<double>& coils,
                     const std::vector<DipoleInterval<double>>& commands, std::int64_t step_ns,
                     bool saved_and_loaded = false) {
  auto torquer = make(coils);
  std::vector<V> seen;
  for (std::int64_t t = 0; t < 10 * kSecond; t += step_ns) {
    torquer.carry_to(t);
    torquer.intervals = 0;
    for (const auto& command : commands) {
      if (command.end_ns > t && command.start_ns < t + step_ns) {
        torquer.window.at(torquer.intervals++) = command;
      }
    }
    if (saved_and_loaded) {
      auto fresh = make(coils);
      fresh.settled = torquer.settled;
      fresh.window = torquer.window;
      fresh.intervals = torquer.intervals;
      torquer = fresh;
    }
    for (std::int64_t sample = 0; sample < 10 * kSecond; sample += kSecond / 8) {
      if (t <= sample && sample < t + step_ns) {
        seen.push_back(torquer.dipole_B(seconds<double>(sample)));
      }
    }
  }
  return seen;
}

TEST(Magnetorquer, has_the_same_bits_however_often_its_past_is_carried) {
  const std::vector<DipoleInterval<double>> commands{
      {123'456'789, 987'654'321, {3, -2, 1}},
      {kSecond, 3 * kSecond + 1, {-5, 0.123, 2}},
      {3 * kSecond + 1, 3 * kSecond + 700, {5, 5, 5}},
      {5 * kSecond, 8 * kSecond, {0.7, 0.8, 0.9}}};
  const auto coils = coils_of({4, 4, 4}, {0.01, 0.01, 0}, 0.77);
  const auto once = flown(coils, commands, 10 * kSecond);
  EXPECT_EQ(once.size(), 80u);
  EXPECT_TRUE(flown(coils, commands, kSecond) == once);
  EXPECT_TRUE(flown(coils, commands, kSecond / 8) == once);
  EXPECT_TRUE(flown(coils, commands, kSecond / 100) == once);
  EXPECT_TRUE(flown(coils, commands, kSecond / 8, true) == once) << "saved and loaded";
}

TEST(Magnetorquer, does_not_forget_what_a_new_command_replaced) {
  // Commanded from 0 to 10 s; at 4 s somebody else's command takes over and the old one is gone from the window.
  auto torquer = make(coils_of({10, 10, 10}, {}, 2.0), {{0, 10 * kSecond, {8, 0, 0}}});
  const double before = torquer.dipole_B(4.0).x;
  torquer.carry_to(4 * kSecond);
  torquer.window[0] = {4 * kSecond, 6 * kSecond, {-8, 0, 0}};
  EXPECT_NEAR(torquer.dipole_B(4.0).x, before, 1e-15);
  EXPECT_NEAR(torquer.dipole_B(5.0).x, -8 + (before + 8) * std::exp(-0.5), 1e-14);
  // Nor does a window that says nothing stop it.
  torquer.intervals = 0;
  EXPECT_NEAR(torquer.dipole_B(5.0).x, before * std::exp(-0.5), 1e-14);
}

TEST(Magnetorquer, begins_from_the_state_that_it_is_given_and_never_goes_back) {
  auto torquer = make(coils_of({1, 1, 1}, {}, 2.0));
  torquer.settled = {kSecond, kSecond, {0.5, 0, 0}, {}};
  EXPECT_EQ(torquer.dipole_B(0.2).x, 0.5) << "before its beginning as at it";
  EXPECT_NEAR(torquer.dipole_B(3.0).x, 0.5 * std::exp(-1.0), 1e-15);
  torquer.carry_to(5 * kSecond);
  const auto settled = torquer.settled;
  torquer.carry_to(2 * kSecond);
  EXPECT_EQ(torquer.settled, settled);
}

TEST(Magnetorquer, stays_within_its_bound) {
  auto coils = coils_of({2, 1, 3}, {0.1, 0, 0}, 0.5);
  coils.field.orbit = make_orbit<double>({7e6, 0.01, 1.2, 0, 0, 0});
  coils.field.field.harmonics = make_igrf(2025.0);
  const auto torquer = make(coils, {{0, 20'000 * kSecond, {9, -9, 9}}});
  test::Generator random(2);
  double closest = 0;
  for (int i = 0; i < 5000; ++i) {
    const V tau = torquer.at(test::uniform(random, 0, 2e4), test::unit_quaternion(random));
    closest = std::fmax(closest, norm(tau) / torquer.bound());
  }
  EXPECT_LE(closest, 1);
  EXPECT_GT(closest, 0.3);
}

}  // namespace
}  // namespace adstar
