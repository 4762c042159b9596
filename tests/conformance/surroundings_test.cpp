// A body under each torque of the surroundings, advanced by the propagator: the coadjoint Runge-Kutta method keeps its order, edges
// do not cost it, the impulse balance holds, and no step touches the heap.
#include <cmath>
#include <cstdio>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "adstar/integrators/all.hpp"
#include "adstar/propagator.hpp"
#include "tests/support/count_allocations.hpp"

namespace adstar {
namespace {

using V = Vec3<double>;

constexpr std::int64_t kSecond = 1'000'000'000;

Orbit<double> orbit() { return make_secular_orbit<double>({6.628e6, 0.003, 1.7, 0.4, 0.7, 0.1}); }

FieldOnOrbit<double> field() {
  FieldOnOrbit<double> field{orbit(), {}};
  field.field.harmonics = make_igrf(2025.5);
  return field;
}

RigidBody<double> body() {
  return RigidBody<double>(Eigen::Matrix3d(Eigen::Vector3d(0.9144, 1.098, 1.66).asDiagonal()));
}

Magnetorquer<double> torquer(double lag_s) {
  Coils<double> coils;
  coils.limit_A_m2 = {900, 900, 900};
  coils.lag_s = lag_s;
  coils.field = field();
  Magnetorquer<double> model;
  model.coils = std::make_shared<const Coils<double>>(coils);
  model.window[0] = {3'700'000'000, 11'111'111'111, {500, -300, 800}};
  model.window[1] = {13 * kSecond, 17'999'999'999, {-700, 100, 900}};
  model.intervals = 2;
  return model;
}

const Quat<double> kBegin = normalised(Quat<double>{0.8, 0.1, -0.5, 0.2});

/// One plate that looks where something comes from, throughout the run: where a plate turns its back there is a kink.
Facets<double> plate(const V& direction_I, double area) {
  return make_facets<double>(
      {{area, rotate_inverse(kBegin, direction_I), {0.5, 0.3, -0.7}, 2.2, 0.3, 0.1}});
}

Torque<double> in_air() {
  Aerodynamic<double> model;
  model.orbit = orbit();
  const V v = motion_at(model.orbit, 0.0).v_I;
  model.facets = plate((1 / norm(v)) * v, 0.7);
  model.density_factor = 3;
  return model;
}

Torque<double> in_sun() {
  SolarPressure<double> model;
  model.orbit = orbit();
  model.sun.days_since_J2000_at_start = 9300;
  model.facets = plate(model.sun.at(0).direction_I, 900);
  model.shadow = Shadow::none;
  return model;
}

Torque<double> thruster() {
  Thruster<double> model;
  model.torque_n_m = {0.02, -0.01, 0.03};
  model.schedule =
      make_on_schedule({{3'700'000'000, 3'700'000'001}, {9 * kSecond, 14'141'414'141}}, kSecond);
  return model;
}

Torque<double> gravity() {
  GravityGradient<double> model;
  model.orbit = orbit();
  model.act_on(RigidBody<double>(Eigen::Matrix3d(Eigen::Vector3d(9e3, 1e4, 1.6e4).asDiagonal())));
  return model;
}

constexpr std::int64_t kRun = 20 * kSecond;

State<double> flown(const Torque<double>& torque, std::int64_t steps) {
  const BodyOf<CoadjointRk4, double> prepared(body());
  State<double> state = make_state(kBegin, body().momentum({0.02, -0.05, 0.03}));
  const std::vector<Torque<double>> torques{torque};
  const std::int64_t h = kRun / steps;
  for (std::int64_t n = 0; n < steps; ++n) {
    EXPECT_TRUE((advance<CoadjointRk4, double>(prepared, state, torques, n * h, h).resolved()));
  }
  return state;
}

double distance(const State<double>& a, const State<double>& b) {
  return angle_between(a.q_IB, b.q_IB) + norm(a.H_I.value() - b.H_I.value()) / norm(b.H_I.value());
}

struct Case {
  std::string name;
  Torque<double> torque;
};
void PrintTo(const Case& one, std::ostream* out) { *out << one.name; }

class Under : public testing::TestWithParam<Case> {};

TEST_P(Under, a_step_half_as_long_errs_by_a_sixteenth) {
  const State<double> truth = flown(GetParam().torque, 2560);
  const double coarse = distance(flown(GetParam().torque, 20), truth);
  const double middle = distance(flown(GetParam().torque, 40), truth);
  const double fine = distance(flown(GetParam().torque, 80), truth);
  EXPECT_GT(coarse, 1e-9) << "the torque does too little to tell";
  EXPECT_NEAR(std::log2(coarse / middle), 4, 0.5);
  EXPECT_NEAR(std::log2(middle / fine), 4, 0.5);
  std::printf("%s: %.1e %.1e %.1e\n", GetParam().name.c_str(), coarse, middle, fine);
}

TEST_P(Under, the_momentum_is_the_impulse_to_round_off) {
  const State<double> state = flown(GetParam().torque, 200);
  const V begun = make_state(kBegin, body().momentum({0.02, -0.05, 0.03})).H_I.value();
  EXPECT_LT(norm(state.H_I.value() - begun - state.impulse_I.value()), 1e-16);
  EXPECT_GT(norm(state.impulse_I.value()), 1e-4);
}

TEST_P(Under, neither_a_step_nor_a_copy_needs_the_heap) {
  const BodyOf<CoadjointRk4, double> prepared(body());
  State<double> state = make_state(Quat<double>{}, body().momentum({0.02, -0.05, 0.03}));
  const std::vector<Torque<double>> torques{GetParam().torque};
  Torque<double> copy = GetParam().torque;
  const std::uint64_t before = test::allocation_count();
  for (std::int64_t n = 0; n < 50; ++n) {
    advance<CoadjointRk4, double>(prepared, state, torques, n * 400'000'000, 400'000'000);
    copy = torques[0];
  }
  EXPECT_EQ(test::allocation_count() - before, 0u);
}

INSTANTIATE_TEST_SUITE_P(
    Surroundings, Under,
    testing::Values(Case{"gravity_gradient", gravity()},
                    Case{"residual_dipole",
                         ResidualDipole<double>{
                             {300, -500, 400},
                             std::make_shared<const FieldOnOrbit<double>>(field())}},
                    Case{"magnetorquer", torquer(0)}, Case{"magnetorquer_lagging", torquer(13)},
                    Case{"aerodynamic", in_air()}, Case{"solar_pressure", in_sun()},
                    Case{"thruster", thruster()}),
    [](const auto& one) { return one.param.name; });

/// Of one lag's length of the torque's four turns, as magnetorquer.hpp has it of Simpson's rule.
TEST(Surroundings, a_coil_whose_lag_is_far_below_the_step_errs_by_5e_5_of_the_impulse_in_a_lag) {
  const double turns_A_m2 = 2 * (norm(V{500, -300, 800}) + norm(V{-700, 100, 900}));
  for (const double lag : {1e-3, 5e-3}) {
    const double most = 5e-5 * lag * turns_A_m2 * field().bound();
    const V coarse = flown(torquer(lag), 200).H_I.value();
    const double off = norm(coarse - flown(torquer(lag), 200'000).H_I.value());
    EXPECT_LT(off, most) << lag;
    EXPECT_GT(off, 1e-3 * most) << "nothing to see: the step is not above the lag";
  }
}

TEST(Torques, of_the_surroundings_do_not_make_the_others_larger_by_much) {
  EXPECT_LE(sizeof(Torque<double>), 768u);
}

}  // namespace
}  // namespace adstar
