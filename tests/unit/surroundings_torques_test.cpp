// The torques of the surroundings against closed forms written out by hand, and their bounds over random attitudes.
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "adstar/torques/all.hpp"
#include "tests/support/random_motion.hpp"
#include "tests/support/wide.hpp"

namespace adstar {
namespace {

using V = Vec3<double>;

Orbit<double> low_orbit() { return make_orbit<double>({6.778e6, 0.002, 0.9, 0.4, 0.7, 0.1}); }

std::shared_ptr<const FieldOnOrbit<double>> field_on(const Orbit<double>& orbit, bool harmonics) {
  FieldOnOrbit<double> field{orbit, {}};
  field.field.rotation.angle_rad = 1.1;
  if (harmonics) {
    field.field.harmonics = make_igrf(2025.5);
  }
  return std::make_shared<const FieldOnOrbit<double>>(field);
}

/// The largest of |tau| over the bound, over random attitudes and times of half a day.
template <class Model>
double closest_to_bound(const Model& model, std::uint64_t seed) {
  test::Generator random(seed);
  double closest = 0;
  for (int i = 0; i < 20'000; ++i) {
    const double t = test::uniform(random, 0, 43'200);
    closest = std::fmax(closest, norm(model.at(t, test::unit_quaternion(random))) / model.bound());
  }
  return closest;
}

TEST(ResidualDipole, is_the_cross_product_with_the_field_and_along_it_nothing) {
  // A place over the equator in a field that points north: m along x and B along z give -m B about y.
  FieldOnOrbit<double> along{make_fixed_position<double>({kMagneticRadius_m, 0, 0}), {}};
  along.field.dipole.g_T = {0, 0, -3e-5};
  const auto field = std::make_shared<const FieldOnOrbit<double>>(along);
  const ResidualDipole<double> model{{2, 0, 0}, field};
  EXPECT_LT(norm(model.at(0, {}) - V{0, -6e-5, 0}), 1e-19);
  // The same, the body turned by a right angle about x: B lies along its y, the torque along its z.
  const double half = std::sqrt(0.5);
  EXPECT_LT(norm(model.at(0, {half, half, 0, 0}) - V{0, 0, 6e-5}), 1e-19);
  EXPECT_LT(norm(ResidualDipole<double>{{0, 0, 5}, field}.at(0, {})), 1e-19);
  EXPECT_NEAR(model.bound(), 2 * 6e-5, 1e-18);  // over a pole the field is twice as strong
}

TEST(ResidualDipole, stays_within_its_bound_and_across_dipole_and_field) {
  for (const bool harmonics : {false, true}) {
    const ResidualDipole<double> model{{0.3, -0.2, 0.5}, field_on(low_orbit(), harmonics)};
    const double closest = closest_to_bound(model, 1);
    EXPECT_LE(closest, 1);
    EXPECT_GT(closest, 0.4);
    test::Generator random(2);
    for (int i = 0; i < 100; ++i) {
      const Quat<double> q = test::unit_quaternion(random);
      const V tau = model.at(50.0 * i, q);
      const V B_B = rotate_inverse(q, model.field->field_I(50.0 * i));
      EXPECT_LT(std::fabs(dot(tau, model.dipole_B_A_m2)), 1e-19);
      EXPECT_LT(std::fabs(dot(tau, B_B)), 1e-23);
      EXPECT_LT(norm(tau - cross(model.dipole_B_A_m2, B_B)), 1e-19);
    }
  }
}

/// A box of 1 by 2 by 3 m whose middle lies at d from its centre of mass.
constexpr V kLengths{1, 2, 3}, kMiddle{0.1, -0.05, 0.2};

TEST(Box, has_six_sides_and_is_closed) {
  const auto facets = box_facets(kLengths, kMiddle);
  ASSERT_EQ(facets.size(), 6u);
  V sum{}, volume{};
  for (const Facet<double>& facet : facets) {
    sum = sum + facet.area_m2 * facet.normal_B;
    volume = volume + dot(facet.centre_B_m, facet.normal_B) * facet.area_m2 * V{1, 0, 0};
  }
  EXPECT_EQ(norm(sum), 0);
  EXPECT_NEAR(volume.x / 3, 1 * 2 * 3, 1e-14);  // the divergence theorem
  EXPECT_EQ(facets[1].normal_B, (V{-1, 0, 0}));
  EXPECT_LT(norm(facets[1].centre_B_m - V{-0.4, -0.05, 0.2}), 1e-16);
  EXPECT_EQ(facets[4].area_m2, 2);
}

Aerodynamic<double> in_air(const Orbit<double>& orbit) {
  Aerodynamic<double> model;
  model.orbit = orbit;
  model.facets = make_facets(box_facets(kLengths, kMiddle));
  return model;
}

TEST(Aerodynamic, torque_of_a_box_in_a_flow_is_the_one_worked_out_by_hand) {
  // Each lit pair of sides brings q C A_i |u_i| (-u) at d + ½ l_i sign(u_i) e_i. With a_i = C A_i |u_i|:
  // tau = -q (Σ a_i (d + ½ l_i sign(u_i) e_i)) × u.
  auto model = in_air(low_orbit());
  model.density_factor = 1.7;
  test::Generator random(3);
  for (int i = 0; i < 500; ++i) {
    const double t = 37.0 * i;
    const Quat<double> q = test::unit_quaternion(random);
    const OrbitMotion<double> m = motion_at(model.orbit, t);
    const V v = m.v_I - cross(V{0, 0, kEarthRotation_rad_s}, m.r_I);
    const V u = rotate_inverse(q, (1 / norm(v)) * v);
    const double latitude_sine = m.r_I.z / norm(m.r_I);
    const double altitude =
        norm(m.r_I) - kEarthRadius_m * (1 - kEarthFlattening * latitude_sine * latitude_sine);
    const double pressure = 0.5 * 1.7 * air_density(altitude) * dot(v, v);
    const double sides[3] = {2.2 * 6 * std::fabs(u.x), 2.2 * 3 * std::fabs(u.y),
                             2.2 * 2 * std::fabs(u.z)};
    const V arm{kMiddle.x * (sides[0] + sides[1] + sides[2]) + 0.5 * std::copysign(sides[0], u.x),
                kMiddle.y * (sides[0] + sides[1] + sides[2]) + 1.0 * std::copysign(sides[1], u.y),
                kMiddle.z * (sides[0] + sides[1] + sides[2]) + 1.5 * std::copysign(sides[2], u.z)};
    const V expected = -pressure * cross(arm, u);
    ASSERT_LT(norm(model.at(t, q) - expected), 1e-13 * pressure) << i;
  }
}

TEST(Aerodynamic, flow_along_an_axis_pulls_at_the_middle_alone) {
  // A fixed place: the air comes with the Earth's turn, from the west.
  auto model = in_air(make_fixed_position<double>({6.578e6, 0, 0}));
  const double wind = kEarthRotation_rad_s * 6.578e6;  // the body moves at -y through it
  const double force = 0.5 * air_density(6.578e6 - kEarthRadius_m) * wind * wind * 2.2 * 3;
  // Along +y on the side -y: c = (0.1, -1.05, 0.2), tau = c × F.
  EXPECT_LT(norm(model.at(0, {}) - force * V{-0.2, 0, 0.1}), 1e-14 * force);
  EXPECT_LT(norm(model.force_I(model.around_at(0), {}) - force * V{0, 1, 0}), 1e-14 * force);
  EXPECT_LE(force, model.force_bound());
}

/// Its arm is across its normal: what comes straight at it has the whole arm.
Facets<double> plate_on_an_arm(double specular = 0, double diffuse = 0) {
  return make_facets<double>({{2, {1, 0, 0}, {0, 0, 0.5}, 2.2, specular, diffuse}});
}

TEST(Aerodynamic, of_a_plate_against_the_earths_turn_comes_to_its_bound) {
  // An equatorial circle flown westward; the percent is for where the layers of the air meet.
  auto model = in_air(make_orbit<double>({6.7e6, 0, M_PI, 0, 0, 0}));
  model.facets = plate_on_an_arm();
  const double closest = closest_to_bound(model, 8);
  EXPECT_LE(closest, 1);
  EXPECT_GT(closest, 0.95);
}

TEST(Aerodynamic, stays_within_its_bound) {
  for (const Orbit<double>& orbit :
       {low_orbit(), Orbit<double>(make_orbit<double>({8e6, 0.18, 1.7, 0.4, 0.7, 0.1})),
        Orbit<double>(make_secular_orbit<double>({6.8e6, 0.01, 1.7, 0.4, 0.7, 0.1}))}) {
    const double closest = closest_to_bound(in_air(orbit), 4);
    EXPECT_LE(closest, 1);
    EXPECT_GT(closest, 0.03);  // the sides partly cancel, the bound lets them not
  }
}

SolarPressure<double> in_sun() {
  SolarPressure<double> model;
  model.orbit = low_orbit();
  model.sun.days_since_J2000_at_start = 9000;
  Facet<double> like;
  like.specular = 0.3;
  like.diffuse = 0.2;
  model.facets = make_facets(box_facets(kLengths, kMiddle, like));
  return model;
}

TEST(SolarPressure, torque_of_a_box_in_sunlight_is_the_one_worked_out_by_hand) {
  // Side i: F_i = -P A_i |u_i| ((1 - s) u + 2 (s |u_i| + k/3) sign(u_i) e_i) at c_i = d + ½ l_i sign(u_i) e_i.
  auto model = in_sun();
  model.shadow = Shadow::none;
  test::Generator random(5);
  for (int i = 0; i < 500; ++i) {
    const double t = 5000.0 * i;
    const Quat<double> q = test::unit_quaternion(random);
    const SunPosition<double> sun = model.sun.at(t);
    const V u = rotate_inverse(q, sun.direction_I);
    const double P = 4.5398e-6 / (sun.distance_au * sun.distance_au);
    const double areas[3] = {6, 3, 2}, lengths[3] = {1, 2, 3}, along[3] = {u.x, u.y, u.z};
    V expected{};
    for (int k = 0; k < 3; ++k) {
      const double sign = along[k] < 0 ? -1 : 1, facing = std::fabs(along[k]);
      const V n{k == 0 ? sign : 0, k == 1 ? sign : 0, k == 2 ? sign : 0};
      const V force = -P * areas[k] * facing * (0.7 * u + 2 * (0.3 * facing + 0.2 / 3) * n);
      expected = expected + cross(kMiddle + 0.5 * lengths[k] * n, force);
    }
    ASSERT_LT(norm(model.at(t, q) - expected), 2e-5 * P) << i;  // of P's five digits
  }
}

/// Where all plates have one centre, the torque is that of their force there.
template <class Model>
void expect_a_force_at(Model model) {
  const V centre{0.3, -0.7, 0.4};
  std::vector<Facet<double>> facets = *model.facets;
  for (Facet<double>& facet : facets) {
    facet.centre_B_m = centre;
  }
  model.facets = make_facets(std::move(facets));
  test::Generator random(7);
  for (int i = 0; i < 200; ++i) {
    const double t = 31.0 * i;
    const Quat<double> q = test::unit_quaternion(random);
    const V force = model.force_I(model.around_at(t), q);
    ASSERT_LT(norm(model.at(t, q) - cross(centre, rotate_inverse(q, force))),
              1e-15 * model.bound());
    ASSERT_LE(norm(force), model.force_bound());
  }
}

TEST(Aerodynamic, pushes_with_the_force_that_its_torque_comes_of) {
  expect_a_force_at(in_air(low_orbit()));
}

TEST(SolarPressure, pushes_with_the_force_that_its_torque_comes_of) { expect_a_force_at(in_sun()); }

TEST(SolarPressure, of_a_mirror_pushes_along_its_normal_and_of_a_black_plate_along_the_light) {
  auto model = in_sun();
  model.shadow = Shadow::none;
  model.seasonal = false;
  const V u = model.sun.at(0).direction_I;
  Facet<double> plate{2, {}, {0, 0, 0.5}, 0, 1, 0};
  plate.normal_B = u;
  model.facets = make_facets<double>({plate});
  const double P = kSolarPressure_N_m2;
  EXPECT_LT(norm(model.at(0, {}) - cross(V{0, 0, 0.5}, -2 * P * 2.0 * u)), 1e-20);
  plate.specular = 0;
  model.facets = make_facets<double>({plate});
  EXPECT_LT(norm(model.at(0, {}) - cross(V{0, 0, 0.5}, -P * 2.0 * u)), 1e-20);
  EXPECT_LT(norm(model.force_I(model.around_at(0), {}) + (P * 2.0) * u), 1e-20);
  plate.normal_B = -u;
  model.facets = make_facets<double>({plate});
  EXPECT_EQ(model.at(0, {}), V{}) << "it looks away";
}

TEST(SolarPressure, is_what_the_shadow_leaves) {
  auto model = in_sun();
  auto lit = model;
  lit.shadow = Shadow::none;
  const Quat<double> q{0.5, 0.5, -0.5, 0.5};
  int dark = 0, partly = 0, bright = 0;
  for (double t = 0; t < 12'000; t += 1) {
    const double light = light_at(Shadow::cone, position_at(model.orbit, t), model.sun.at(t));
    EXPECT_LT(norm(model.at(t, q) - light * lit.at(t, q)), 1e-20);
    ++(light == 0 ? dark : light < 1 ? partly : bright);
  }
  EXPECT_GT(dark, 3000);
  EXPECT_GT(partly, 20);
  EXPECT_GT(bright, 6000);
}

TEST(SolarPressure, of_a_plate_in_january_comes_to_its_bound) {
  auto model = in_sun();
  model.sun.days_since_J2000_at_start = 9500;  // 4 January 2026: the Sun is nearest
  model.shadow = Shadow::none;
  model.facets = plate_on_an_arm(0.3, 0.2);
  const double closest = closest_to_bound(model, 9);
  EXPECT_LE(closest, 1);
  EXPECT_GT(closest, 0.95);
}

TEST(SolarPressure, stays_within_its_bound) {
  const double closest = closest_to_bound(in_sun(), 6);
  EXPECT_LE(closest, 1);
  EXPECT_GT(closest, 0.03);
}

TEST(GravityGradient, stays_within_its_bound_on_every_kind_of_orbit) {
  const RigidBody<double> body(Eigen::Matrix3d(Eigen::Vector3d(1, 2, 2.5).asDiagonal()));
  Ephemeris<double> table;
  for (int i = 0; i < 200; ++i) {
    const OrbitMotion<double> m = motion_at(low_orbit(), 240.0 * i);
    table.rows.push_back({240.0 * i, m.r_I, m.v_I});
  }
  for (const Orbit<double>& orbit :
       {low_orbit(), Orbit<double>(make_secular_orbit<double>({6.8e6, 0.01, 1.7, 0.4, 0.7, 0.1})),
        Orbit<double>(make_fixed_position<double>({0, 6.9e6, 1e6})),
        Orbit<double>(make_ephemeris(table))}) {
    GravityGradient<double> model;
    model.orbit = orbit;
    model.act_on(body);
    const double closest = closest_to_bound(model, 7);
    EXPECT_LE(closest, 1) << orbit.index();
    EXPECT_GT(closest, 0.9) << orbit.index();
  }
}

TEST(Torques, of_the_surroundings_compile_in_113_bits) {
  using Quad = test::Quad;
  SolarPressure<Quad> sun;
  sun.orbit = make_orbit<Quad>({Quad(7e6), Quad(0), Quad(1), Quad(0), Quad(0), Quad(0)});
  sun.facets =
      make_facets(box_facets<Quad>({Quad(1), Quad(2), Quad(3)}, {Quad(1), Quad(0), Quad(0)}));
  Aerodynamic<Quad> air;
  air.orbit = make_secular_orbit<Quad>({Quad(7e6), Quad(0), Quad(1), Quad(0), Quad(0), Quad(0)});
  air.facets = sun.facets;
  Coils<Quad> coils;
  coils.limit_A_m2 = {Quad(1), Quad(1), Quad(1)};
  coils.lag_s = Quad(0.1);
  coils.field.orbit = make_fixed_position<Quad>({Quad(7e6), Quad(0), Quad(0)});
  coils.field.field.harmonics = make_igrf(Quad(2025));
  Magnetorquer<Quad> torquer;
  torquer.coils = std::make_shared<const Coils<Quad>>(coils);
  torquer.window[0] = {0, 1'000'000'000, {Quad(1), Quad(0), Quad(0)}};
  torquer.intervals = 1;
  const ResidualDipole<Quad> dipole{{Quad(1), Quad(0), Quad(0)},
                                    std::make_shared<const FieldOnOrbit<Quad>>(coils.field)};
  const std::vector<Torque<Quad>> torques{sun, air, torquer, dipole, Thruster<Quad>{}};
  for (const Torque<Quad>& torque : torques) {
    std::visit(
        [](const auto& model) {
          if constexpr (requires(const Quat<Quad>& q) { model.at(Quad(), q); }) {
            const Vec3<Quad> tau = model.at(Quad(0.5), Quat<Quad>{});
            EXPECT_TRUE(norm(tau) <= model.bound());
          }
        },
        torque);
  }
}

}  // namespace
}  // namespace adstar
