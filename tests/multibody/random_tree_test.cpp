// Trees drawn at random: shapes, joints, frames, masses over four decades, sizes over five.
#include <cmath>

#include <gtest/gtest.h>

#include "adstar/integrators/dop853.hpp"
#include "tests/multibody/mechanisms.hpp"
#include "tests/support/random_motion.hpp"

namespace adstar {
namespace {

using multibody::Formulation;
using multibody::JointKind;
using test::Flight;
using test::Generator;
using test::Mechanism;

constexpr Formulation kBoth[] = {Formulation::se3, Formulation::direct_product};

/// Coordinates move at up to `rate` [rad/s], or sizes a second.
Mechanism<double> random_tree(std::uint64_t seed, double rate) {
  Generator random(seed);
  const int count = 2 + static_cast<int>(random() % 15);
  const double size = test::log_uniform(random, 0.01, 1000);
  Mechanism<double> m;
  for (int i = 0; i < count; ++i) {
    const double mass = test::log_uniform(random, 1e-2, 1e2);
    const double length = size * test::log_uniform(random, 0.3, 2);
    const double J = mass * length * length;
    m.add_body(test::numbered("b", i), mass, {0.1 * J, 0.15 * J, 0.2 * J});
  }
  m.bodies[0].q_IB = test::unit_quaternion(random);
  m.bodies[0].omega_B = test::uniform(random, 0, 1) * test::unit_vector(random);
  for (int i = 1; i < count; ++i) {
    const int parent = static_cast<int>(random() % static_cast<std::uint64_t>(i));
    const auto kind = static_cast<JointKind>(random() % 5);
    const bool turned = random() % 2 == 0;
    auto& joint =
        m.add_joint(test::numbered("j", i), kind, turned ? i : parent, turned ? parent : i,
                    size * test::unit_vector(random), size * test::unit_vector(random));
    joint.a.q_BF = test::unit_quaternion(random);
    joint.b.q_BF = test::unit_quaternion(random);
    const double scale = kind == JointKind::prismatic ? size : 1;
    for (std::size_t k = 0; k < 3; ++k) {
      m.starts.back().q[k] = scale * test::uniform(random, -0.8, 0.8);
      m.starts.back().rate[k] = scale * test::uniform(random, -rate, rate);
    }
  }
  m.place();
  multibody::centre(m.bodies);
  return m;
}

TEST(RandomTrees, keep_totals_and_joints_and_turn_alike_in_both_formulations) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const auto tree = random_tree(seed, 0.5);
    std::vector<Flight<double>> flights;
    for (const Formulation formulation : kBoth) {
      Flight<double> flight(tree, {formulation, {}});
      const auto before = multibody::total_momentum(flight.assembly, flight.state);
      double p = 0, H = 0;
      for (const auto& body : flight.state.bodies) {
        p = std::max(p, norm(body.p_I.value()));
        H = std::max(H, norm(body.H_I.value()));
      }
      flight.run<Dop853>(100, 10'000'000);
      const auto after = multibody::total_momentum(flight.assembly, flight.state);
      EXPECT_TRUE(flight.worst.resolved()) << seed;
      EXPECT_LT(flight.worst.gap, 1e-13) << seed;
      EXPECT_LT(norm(after.p_I.value() - before.p_I.value()), 2e-15 * p) << seed;
      if (formulation == Formulation::se3) {
        EXPECT_LT(norm(after.H_I.value() - before.H_I.value()), 2e-15 * H) << seed;
      }
      flights.push_back(flight);
    }
    for (std::size_t i = 0; i < tree.bodies.size(); ++i) {
      EXPECT_LT(angle_between(flights[0].state.bodies[i].q_IB, flights[1].state.bodies[i].q_IB),
                1e-6)
          << seed;
    }
  }
}

TEST(RandomTrees, thrown_about_keep_their_energy_or_say_that_they_do_not) {
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    for (const Formulation formulation : kBoth) {
      Flight<double> flight(random_tree(seed, 30), {formulation, {}});
      double energy = flight.energy();
      for (int n = 0; n < 100; ++n) {
        flight.worst = {};
        flight.run<Rk4>(1, 10'000'000);
        if (!flight.worst.resolved()) {
          break;
        }
        EXPECT_NEAR(flight.energy(), energy, 2.01e-4 * energy) << seed << ", step " << n;
        EXPECT_LT(flight.worst.gap, 1e-10);
        energy = flight.energy();
      }
    }
  }
}

}  // namespace
}  // namespace adstar
