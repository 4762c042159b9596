// Fleets: numbered names, and draws that depend on the seed and the index alone.

#include <cmath>

#include <gtest/gtest.h>

#include "adstar/bodies/rigid_body.hpp"
#include "scene_text.hpp"

namespace adstar::scene {
namespace {

std::string fleet(int count, int seed, const std::string& extra = "") {
  return as_spacecraft("name = \"s{:03}\"\ncount = " + std::to_string(count) +
                       "\nseed = " + std::to_string(seed) +
                       "\ninertia_body_kg_m2 = { min = [2, 2, 2], max = [3, 3, 3] }\n"
                       "attitude_body_to_inertial = \"uniform\"\n"
                       "angular_velocity_body_rad_s = { min = [-1, 0, 5], max = [1, 0, 6] }\n" +
                       extra);
}

TEST(Fleet, numbers_its_names_from_zero) {
  const auto names = [](const std::string& pattern, int count) {
    std::string list;
    for (const Spacecraft& sat :
         parse(as_spacecraft("name = \"" + pattern + "\"\ncount = " + std::to_string(count) +
                             "\ninertia_body_kg_m2 = [1, 1, 1]"),
               "")
             .spacecraft) {
      list += sat.name + ' ';
    }
    return list;
  };
  EXPECT_EQ(names("sat{}", 3), "sat0 sat1 sat2 ");
  EXPECT_EQ(names("a{:05}z", 2), "a00000z a00001z ");
  EXPECT_EQ(names("{:01}", 11), "0 1 2 3 4 5 6 7 8 9 10 ");
  EXPECT_EQ(names("only{}", 1), "only0 ");
}

TEST(Fleet, is_the_same_every_time_and_whatever_its_size) {
  const auto large = parse(fleet(100, 7), "").spacecraft;
  const auto small = parse(fleet(10, 7), "").spacecraft;
  ASSERT_EQ(large.size(), 100U);
  for (std::size_t i = 0; i < small.size(); ++i) {
    EXPECT_EQ(small[i].name, large[i].name);
    EXPECT_EQ(small[i].inertia_body_kg_m2, large[i].inertia_body_kg_m2);
    EXPECT_EQ(small[i].initial, large[i].initial);
  }
}

// The bits of a fleet are a promise: scenes name a seed in order to get the same fleet in years.
TEST(Fleet, draws_the_bits_it_always_drew) {
  const Spacecraft sat = parse(fleet(3, 7), "").spacecraft.at(2);
  EXPECT_EQ(sat.inertia_body_kg_m2(0, 0), 0x1.45f5c67902df1p+1);
  EXPECT_EQ(sat.initial.q_IB.w, -0x1.f284d549fe2cp-2);
  EXPECT_EQ(sat.initial.H_I.value().x, -0x1.f99669e6484a9p+1);
}

TEST(Fleet, differs_by_seed_and_by_index) {
  const auto seven = parse(fleet(2, 7), "").spacecraft;
  const auto eight = parse(fleet(2, 8), "").spacecraft;
  EXPECT_NE(seven[0].initial, eight[0].initial);
  EXPECT_NE(seven[0].initial, seven[1].initial);
  EXPECT_NE(seven[1].initial, eight[0].initial);
}

TEST(Fleet, draws_within_its_ranges) {
  for (const Spacecraft& sat : parse(fleet(200, 1), "").spacecraft) {
    const RigidBody<double> body(sat.inertia_body_kg_m2);
    const Vec3<double> omega_B = body.angular_velocity(body_momentum(sat.initial));
    EXPECT_LE(std::fabs(omega_B.x), 1.0 + 1e-12);
    EXPECT_NEAR(omega_B.y, 0.0, 1e-12);
    EXPECT_GE(omega_B.z, 5.0 - 1e-12);
    EXPECT_LE(omega_B.z, 6.0 + 1e-12);
    for (int i = 0; i < 3; ++i) {
      EXPECT_GE(sat.inertia_body_kg_m2(i, i), 2.0);
      EXPECT_LT(sat.inertia_body_kg_m2(i, i), 3.0);
    }
  }
}

// Of a uniform rotation each body axis points evenly over the sphere: mean 0, mean square 1/3.
TEST(Fleet, spreads_uniform_attitudes_evenly) {
  constexpr int kCount = 20'000;
  Vec3<double> sum{}, squares{};
  double w_squared = 0.0;
  for (const Spacecraft& sat : parse(fleet(kCount, 3), "").spacecraft) {
    const Vec3<double> x = rotate(sat.initial.q_IB, Vec3<double>{1.0, 0.0, 0.0});
    sum = sum + x;
    squares = squares + Vec3<double>{x.x * x.x, x.y * x.y, x.z * x.z};
    w_squared += sat.initial.q_IB.w * sat.initial.q_IB.w;
    EXPECT_NEAR(squared_norm(sat.initial.q_IB), 1.0, 1e-15);
  }
  const double five_sigma = 5.0 / std::sqrt(3.0 * kCount);
  EXPECT_LT(norm(sum) / kCount, 2.0 * five_sigma);
  EXPECT_NEAR(squares.x / kCount, 1.0 / 3.0, five_sigma);
  EXPECT_NEAR(squares.y / kCount, 1.0 / 3.0, five_sigma);
  EXPECT_NEAR(w_squared / kCount, 0.25, five_sigma);
}

TEST(Fleet, draws_torques_and_actuator_limits_too) {
  const auto sats =
      parse(fleet(50, 1,
                  "[[spacecraft.torque]]\nmodel = \"constant\"\nframe = \"inertial\"\n"
                  "torque_n_m = { min = [1, 1, 1], max = [2, 2, 2] }\n"
                  "[[spacecraft.torque]]\nmodel = \"commanded\"\n"
                  "max_torque_n_m = { min = [3, 3, 3], max = [4, 4, 4] }\n"),
            "")
          .spacecraft;
  for (const Spacecraft& sat : sats) {
    const auto& constant = std::get<Constant<double>>(sat.torques.at(0));
    EXPECT_EQ(constant.frame, Frame::inertial);
    EXPECT_GE(constant.torque_n_m.x, 1.0);
    EXPECT_LT(constant.torque_n_m.x, 2.0);
    ASSERT_EQ(sat.actuators.size(), 1U);
    EXPECT_EQ(sat.actuators[0].index, 1U);
    EXPECT_GE(sat.actuators[0].limit.z, 3.0);
    EXPECT_LT(sat.actuators[0].limit.z, 4.0);
  }
  EXPECT_NE(std::get<Constant<double>>(sats[0].torques[0]).torque_n_m,
            std::get<Constant<double>>(sats[1].torques[0]).torque_n_m);
}

TEST(Fleet, asks_for_the_seed_when_something_is_drawn) {
  EXPECT_EQ(refusal(in_spacecraft("attitude_body_to_inertial = \"uniform\"")),
            "scene.toml:3:1: spacecraft[0].seed: got nothing, expected an integer, for what this "
            "block draws at random; try seed = 1");
  EXPECT_EQ(refusal(in_torque("model = \"constant\"\nframe = \"body\"\n"
                              "torque_n_m = { min = [0, 0, 0], max = [1, 1, 1] }")),
            "scene.toml:3:1: spacecraft[0].seed: got nothing, expected an integer, for what this "
            "block draws at random; try seed = 1");
}

TEST(Fleet, refuses_names_without_a_place_for_the_index) {
  const std::string rule =
      ", expected a name of 1 to 63 characters out of A-Z a-z 0-9 _ . - with one {} or {:05} for "
      "the index; try ";
  const auto named = [](const std::string& name) {
    return refusal(
        as_spacecraft("name = \"" + name + "\"\ncount = 100\n" + "inertia_body_kg_m2 = [1, 1, 1]"));
  };
  const std::string at = "scene.toml:4:8: spacecraft[0].name: got ";
  EXPECT_EQ(named("sat"), at + "\"sat\"" + rule + "\"sat{}\"");
  EXPECT_EQ(named("sat{:5}"), at + "\"sat{:5}\"" + rule + "\"sat{}\"");
  EXPECT_EQ(named("a b{}"), at + "\"a b{}\"" + rule + "\"a_b{}\"");
  EXPECT_EQ(named("{}{}"), at + "\"{}{}\"" + rule + "\"sat{}\"");
  const std::string long_name(62, 'x');  // two digits more are one too many
  EXPECT_EQ(named(long_name + "{}"),
            at + '"' + long_name + "{}\"" + rule + '"' + std::string(56, 'x') + "{}\"");
}

TEST(Fleet, refuses_a_pattern_without_a_count) {
  EXPECT_EQ(
      refusal(as_spacecraft("name = \"sat{}\"\ninertia_body_kg_m2 = [1, 1, 1]")),
      "scene.toml:4:8: spacecraft[0].name: got \"sat{}\", expected a count beside a name with "
      "a pattern; try count = 10 in this block");
}

TEST(Fleet, refuses_counts_beyond_reason) {
  const auto counted = [](const std::string& count) {
    return refusal(
        as_spacecraft("name = \"s{}\"\ninertia_body_kg_m2 = [1, 1, 1]\ncount = " + count));
  };
  const std::string expected = ", expected an integer from 1 to 1000000; try ";
  EXPECT_EQ(counted("0"), "scene.toml:6:9: spacecraft[0].count: got 0" + expected + "1");
  EXPECT_EQ(counted("1000001"),
            "scene.toml:6:9: spacecraft[0].count: got 1000001" + expected + "1000000");
  EXPECT_EQ(counted("2.0"), "scene.toml:6:9: spacecraft[0].count: got 2" + expected + "10");
}

TEST(Fleet, refuses_ranges_upside_down_or_incomplete) {
  const auto velocity = [](const std::string& range) {
    return refusal(in_spacecraft("seed = 1\nangular_velocity_body_rad_s = " + range));
  };
  EXPECT_EQ(velocity("{ min = [0, 2, 0], max = [1, 1, 1] }"),
            "scene.toml:7:43: spacecraft[0].angular_velocity_body_rad_s.min[1]: got 2, expected a "
            "number up to max, 1; try exchanging the two");
  EXPECT_EQ(velocity("{ min = [0, 0, 0] }"),
            "scene.toml:7:31: spacecraft[0].angular_velocity_body_rad_s.max: got nothing, expected "
            "an array of 3 numbers; try max = [0.45549, 0.82623, 0.03476]");
  EXPECT_EQ(velocity("{ min = [-1.7e308, 0, 0], max = [1.7e308, 1, 1] }"),
            "scene.toml:7:40: spacecraft[0].angular_velocity_body_rad_s.min[0]: got -1.7e+308, "
            "expected a range whose width is a finite number; try a narrower range");
}

TEST(Fleet, names_the_spacecraft_whose_drawn_inertia_cannot_be) {
  const std::string text =
      refusal(as_spacecraft("name = \"s{}\"\ncount = 2\nseed = 1\n"
                            "inertia_body_kg_m2 = { min = [1, 1, 3], max = [1, 1, 3] }"));
  EXPECT_EQ(text,
            "scene.toml:7:22: spacecraft[0].inertia_body_kg_m2: got principal moments 1, 1, 3 for "
            "\"s0\" (and 1 others that cannot be), expected a largest moment up to the sum of the "
            "other two (triangle inequality); try a largest moment of at most 2");
}

}  // namespace
}  // namespace adstar::scene
