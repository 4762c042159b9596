// Lanes against one by one: every bit of every vehicle after every step, on every instruction set.
#include <bit>
#include <cstring>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "adstar/integrators/all.hpp"
#include "service/batch/kernels.hpp"
#include "service/runtime/fleet.hpp"
#include "tests/support/gate_harness.hpp"
#include "tests/support/random_motion.hpp"

namespace adstar::runtime {
namespace {

using test::Generator;
using test::kMs;
using test::log_uniform;
using test::make_craft;
using test::uniform;

struct Choice {
  const char* name;
  Lanewise lanewise;
  batch::InstructionSet set;
};

constexpr Choice kChoices[] = {{"sse2", Lanewise::sse2, batch::InstructionSet::sse2},
                               {"avx2", Lanewise::avx2, batch::InstructionSet::avx2},
                               {"avx512", Lanewise::avx512, batch::InstructionSet::avx512}};

bool one_of(Generator& random, int n) { return uniform(random, 0, n) < 1; }

Vec3<double> any_vector(Generator& random, double size) { return size * test::unit_vector(random); }

Frame any_frame(Generator& random) { return one_of(random, 2) ? Frame::body : Frame::inertial; }

Torque<double> any_torque(Generator& random, std::int64_t duration_ns) {
  const double size = log_uniform(random, 1e-6, 1);
  const auto instant = [&] {
    return static_cast<std::int64_t>(uniform(random, 0, static_cast<double>(duration_ns)));
  };
  switch (static_cast<int>(uniform(random, 0, 6))) {
    case 0:
      return Constant<double>{Frame::body, any_vector(random, size)};
    case 1:
      return Constant<double>{any_frame(random), any_vector(random, size)};
    case 2:
      return Harmonic<double>{any_frame(random), any_vector(random, size), any_vector(random, 3),
                              any_vector(random, 1)};
    case 5: {
      const Vec3<double> c = any_vector(random, size);
      return Damping<double>{{std::fabs(c.x), std::fabs(c.y), std::fabs(c.z)}};
    }
    case 3: {
      Table<double> table{any_frame(random),
                          one_of(random, 2) ? Interpolation::hold : Interpolation::linear,
                          one_of(random, 2) ? AfterEnd::zero : AfterEnd::hold,
                          {},
                          {}};
      std::set<std::int64_t> knots;
      while (knots.size() < 4) {
        knots.insert(instant());
      }
      for (const std::int64_t knot : knots) {
        table.time_ns.push_back(knot);
        table.torque_n_m.push_back(any_vector(random, size));
      }
      return table;
    }
    default: {
      Commanded<double> commanded;
      commanded.frame = any_frame(random);
      const std::int64_t start = instant();
      commanded.window[0] = {start, start + duration_ns / 3, any_vector(random, size)};
      commanded.intervals = one_of(random, 3) ? 0 : 1;
      return commanded;
    }
  }
}

/// Every kind of lane: at rest, slow, turning far within a step, too fast to follow, no number.
scene::Spacecraft any_craft(Generator& random, std::int64_t step_ns, std::int64_t duration_ns) {
  scene::Spacecraft craft;
  craft.name = "sat";
  const Eigen::Vector3d moments = log_uniform(random, 1e-3, 1e3) * test::moments(random);
  craft.inertia_body_kg_m2 = one_of(random, 2)
                                 ? Eigen::Matrix3d(moments.asDiagonal())
                                 : test::rotated_inertia(moments, test::unit_quaternion(random));
  const RigidBody<double> body(craft.inertia_body_kg_m2);
  const double turn = log_uniform(random, 1e-8, 2);
  const double h_s = static_cast<double>(step_ns) / 1e9;
  Vec3<double> Pi_B = body.momentum(any_vector(random, turn / h_s));
  if (one_of(random, 12)) {
    Pi_B = {};
  } else if (one_of(random, 12)) {
    Pi_B = 1e4 * Pi_B;
  } else if (one_of(random, 25)) {
    Pi_B.y = std::numeric_limits<double>::quiet_NaN();
  } else if (one_of(random, 25)) {
    Pi_B.z = std::numeric_limits<double>::infinity();
  } else if (one_of(random, 12)) {
    Pi_B.x = -0.0;
    Pi_B.y = 0.0;
  }
  const Quat<double> q = one_of(random, 6) ? Quat<double>{} : test::unit_quaternion(random);
  craft.initial = make_state(q, rotate(q, Pi_B));
  while (one_of(random, 2)) {
    craft.torques.push_back(any_torque(random, duration_ns));
  }
  return craft;
}

bool same_bits(const State<double>& a, const State<double>& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

/// Steps both; says the first difference.
std::string difference(Fleet& lanes, Fleet& alone, int steps, std::int64_t step_ns) {
  for (int n = 0; n < steps; ++n) {
    const std::size_t unresolved = alone.step(n * step_ns, step_ns);
    if (lanes.step(n * step_ns, step_ns) != unresolved) {
      return "another count of unresolved vehicles at step " + std::to_string(n);
    }
    for (std::size_t i = 0; i < alone.vehicles().size(); ++i) {
      if (!same_bits(lanes.vehicles()[i].state, alone.vehicles()[i].state) ||
          lanes.vehicles()[i].flags != alone.vehicles()[i].flags) {
        return "vehicle " + std::to_string(i) + " at step " + std::to_string(n);
      }
    }
  }
  return "";
}

std::vector<std::string_view> schemes_with_lanes() {
  std::vector<std::string_view> names;
  for (const std::string_view name : scheme_names()) {
    if (batch::find_kernels(name, batch::InstructionSet::sse2) != nullptr) {
      names.push_back(name);
    }
  }
  return names;
}

class BatchOn : public testing::TestWithParam<Choice> {
 public:
  void SetUp() override {
    if (!batch::runs_here(GetParam().set)) {
      GTEST_SKIP() << "this processor has no " << batch::name_of(GetParam().set);
    }
  }

  /// Lanes and one by one, over as many steps.
  std::string difference_of(const std::vector<scene::Spacecraft>& crafts, int steps,
                            std::int64_t step_ns, std::string_view scheme = "coadjoint_rk4",
                            const StepLimits& limits = {}) {
    Fleet lanes(crafts, scheme, limits, GetParam().lanewise);
    Fleet alone(crafts, scheme, limits, Lanewise::alone);
    return difference(lanes, alone, steps, step_ns);
  }
};

INSTANTIATE_TEST_SUITE_P(, BatchOn, testing::ValuesIn(kChoices),
                         [](const auto& choice) { return choice.param.name; });

TEST_P(BatchOn, steps_random_fleets_of_every_size_to_the_bit) {
  Generator random(20261123);
  for (const std::string_view scheme : schemes_with_lanes()) {
    for (int trial = 0; trial < 300; ++trial) {
      const auto size = static_cast<std::size_t>(uniform(random, 1, 40));
      const auto step_ns = static_cast<std::int64_t>(log_uniform(random, 1e5, 1e9));
      constexpr int kSteps = 30;
      const StepLimits limits{log_uniform(random, 0.1, 3), 16, 2};
      std::vector<scene::Spacecraft> crafts;
      for (std::size_t i = 0; i < size; ++i) {
        crafts.push_back(any_craft(random, step_ns, kSteps * step_ns));
      }
      ASSERT_EQ(difference_of(crafts, kSteps, step_ns, scheme, limits), "")
          << scheme << ", trial " << trial << " of " << size << " vehicles";
    }
  }
}

TEST_P(BatchOn, chooses_the_series_of_each_lane_by_its_own_angle) {
  // Neighbours on both sides of each border of so3.hpp, and beyond π, in every lane.
  std::vector<scene::Spacecraft> crafts;
  for (const double border : {kTinyAngleRad, kSmallAngleRad, 2 * std::sqrt(2.5)}) {
    for (const double side :
         {1 - 1e-3, 1 + 1e-3, 1 - 1e-7, 1 + 1e-7, 1 - 1e-15, 1.0, 1 + 1e-15, 0.5, 1.7}) {
      scene::Spacecraft craft = make_craft(0);
      craft.inertia_body_kg_m2 = Eigen::Vector3d(1, 1, 1).asDiagonal();
      craft.initial = make_state(Quat<double>{}, Vec3<double>{border * side, 0, 0});
      crafts.push_back(craft);
    }
  }
  for (int turn = 0; turn < 16; ++turn) {
    std::rotate(crafts.begin(), crafts.begin() + 1, crafts.end());
    for (const std::string_view scheme : schemes_with_lanes()) {
      EXPECT_EQ(difference_of(crafts, 20, 1'000'000'000, scheme, {10.0, 64, 64}), "") << scheme;
      EXPECT_EQ(difference_of(crafts, 20, 2'000'000'000, scheme, {10.0, 64, 64}), "") << scheme;
    }
  }
}

TEST_P(BatchOn, follows_commands_that_come_and_go) {
  for (const std::string_view scheme : {"coadjoint_rk4", "coadjoint_rk4_float"}) {
    std::vector<scene::Spacecraft> crafts(19, make_craft(2, Frame::inertial));
    for (std::size_t i = 0; i < crafts.size(); i += 2) {
      std::get<Commanded<double>>(crafts[i].torques[1]).frame = Frame::body;
    }
    Fleet lanes(crafts, scheme, StepLimits{}, GetParam().lanewise);
    Fleet alone(crafts, scheme, StepLimits{}, Lanewise::alone);
    Generator random(7);
    for (std::int64_t n = 0; n < 200; ++n) {
      for (std::size_t i = 0; i < crafts.size(); ++i) {
        for (std::size_t j = 0; j < 2; ++j) {
          if (one_of(random, 8)) {
            Commanded<double> next = std::get<Commanded<double>>(crafts[i].torques[j]);
            const std::int64_t start = n * 10 * kMs + (one_of(random, 2) ? 3 * kMs : 0);
            next.window[0] = {start, start + 37 * kMs, any_vector(random, 0.3)};
            next.intervals = 1;
            lanes.vehicles()[i].torques[j] = next;
            alone.vehicles()[i].torques[j] = next;
          }
        }
      }
      ASSERT_EQ(lanes.step(n * 10 * kMs, 10 * kMs), alone.step(n * 10 * kMs, 10 * kMs));
      for (std::size_t i = 0; i < crafts.size(); ++i) {
        ASSERT_TRUE(same_bits(lanes.vehicles()[i].state, alone.vehicles()[i].state))
            << scheme << ", vehicle " << i << " at step " << n;
      }
    }
  }
}

TEST_P(BatchOn, clears_the_flag_of_a_vehicle_that_can_be_followed_again) {
  std::vector<scene::Spacecraft> crafts(9, make_craft(0));
  crafts[4].initial = make_state(Quat<double>{}, Vec3<double>{5000, 0, 0});
  Fleet fleet(crafts, "coadjoint_rk4", StepLimits{1.0, 8, 64}, GetParam().lanewise);
  EXPECT_EQ(fleet.step(0, 10 * kMs), 1U);
  EXPECT_EQ(fleet.vehicles()[4].flags, kFlagUnresolvedAngle);
  EXPECT_EQ(fleet.step(10 * kMs, 1'000), 0U);
  EXPECT_EQ(fleet.vehicles()[4].flags, 0U);
}

TEST_P(BatchOn, leaves_the_kernels_nothing_of_a_fleet_that_they_can_take_whole) {
  // Else every other test here would pass on kernels that take no lane.
  constexpr std::size_t kBodies = 16;
  std::vector<State<double>> states(kBodies, make_craft(0).initial);
  const RigidBody<double> body(test::full_inertia());
  const Sym3<double>& m = body.inverse_inertia();
  const std::vector<batch::PackedBody> bodies(
      kBodies, {m.xx, m.yy, m.zz, body.inverse_moments()[0], m.xy, m.xz, m.yz, 0.0});
  std::vector<batch::PackedTorque> torques(kBodies);
  std::vector<batch::PackedHarmonics> harmonics(kBodies);
  std::vector<std::uint32_t> members, left(kBodies);
  for (std::uint32_t i = 0; i < kBodies; ++i) {
    members.push_back(i);
  }
  for (const std::string_view scheme : schemes_with_lanes()) {
    const batch::Kernels& kernels = *batch::find_kernels(scheme, GetParam().set);
    for (const batch::Kernel kernel :
         {kernels.free, kernels.body, kernels.ramps, kernels.varying}) {
      const std::vector<State<double>> before = states;
      EXPECT_EQ(kernel({&states[0].q_IB.w, batch::kStateNumbers, bodies.data()},
                       {members.data(), torques.data(), harmonics.data(), 1, kBodies, 0.0, 0.01,
                        1.0, left.data()}),
                0U)
          << scheme;
      for (std::size_t i = 0; i < kBodies; ++i) {
        EXPECT_FALSE(before[i].q_IB == states[i].q_IB) << scheme << ", body " << i;
      }
    }
  }
}

TEST_P(BatchOn, follows_harmonic_torques_into_every_quadrant_and_past_what_it_reduces) {
  Generator random(11);
  std::vector<scene::Spacecraft> crafts;
  for (int i = 0; i < 200; ++i) {
    scene::Spacecraft craft = make_craft(0);
    const int count = static_cast<int>(uniform(random, 1, 7));
    for (int k = 0; k < count; ++k) {
      Harmonic<double> harmonic{any_frame(random), any_vector(random, 0.1),
                                any_vector(random, log_uniform(random, 1e-9, 1e10)),
                                any_vector(random, log_uniform(random, 1e-9, 20))};
      if (one_of(random, 3)) {
        harmonic.amplitude_n_m.y = one_of(random, 2) ? 0.0 : -0.0;
      }
      if (one_of(random, 5)) {
        harmonic.phase_rad = {0.0, -0.0, 1.5707963267948966};
        harmonic.angular_frequency_rad_s = {0, -0.0, 0};
      }
      if (one_of(random, 60)) {
        harmonic.phase_rad.x = std::numeric_limits<double>::quiet_NaN();
      }
      craft.torques.push_back(harmonic);
      if (one_of(random, 3)) {
        craft.torques.push_back(Constant<double>{any_frame(random), any_vector(random, 0.1)});
      }
    }
    crafts.push_back(craft);
  }
  for (const std::string_view scheme : {"coadjoint_rk4", "coadjoint_rk4_float"}) {
    EXPECT_EQ(difference_of(crafts, 300, 10 * kMs, scheme), "") << scheme;
  }
}

TEST(Threads, step_a_fleet_to_the_same_bits_however_many_they_are) {
  Generator random(5);
  for (const std::size_t size : {1U, 63U, 64U, 65U, 129U, 1000U}) {
    std::vector<scene::Spacecraft> crafts;
    for (std::size_t i = 0; i < size; ++i) {
      crafts.push_back(any_craft(random, 10 * kMs, 200 * kMs));
    }
    for (const Lanewise lanewise : {Lanewise::automatic, Lanewise::alone}) {
      for (const std::size_t threads : {2U, 3U, 7U, 64U}) {
        Fleet many(crafts, "coadjoint_rk4", StepLimits{}, lanewise, threads);
        Fleet alone(crafts, "coadjoint_rk4", StepLimits{}, Lanewise::alone);
        EXPECT_EQ(difference(many, alone, 20, 10 * kMs), "")
            << size << " vehicles on " << threads << " threads";
      }
    }
  }
}

TEST(Batch, has_kernels_for_every_scheme_that_takes_lanes) {
  std::apply(
      [](auto... scheme) {
        const auto check = [](auto s) {
          using Scheme = decltype(s);
          bool takes_lanes = false;
          if constexpr (requires { Scheme::kTakesLanes; }) {
            takes_lanes = Scheme::kTakesLanes;
          }
          for (const batch::InstructionSet set : batch::kInstructionSets) {
            EXPECT_EQ(batch::find_kernels(Scheme::kName, set) != nullptr, takes_lanes)
                << Scheme::kName << ": see service/batch/table.hpp";
          }
        };
        (check(scheme), ...);
      },
      Schemes{});
}

TEST(Batch, is_as_wide_as_the_processor_and_the_fleet_allow) {
  EXPECT_FALSE(batch::best_for("coadjoint_rk4", 1));
  EXPECT_FALSE(batch::best_for("no_such_scheme", 1000));
  EXPECT_EQ(batch::best_for("coadjoint_rk4", 3), batch::InstructionSet::sse2);
  const auto widest = batch::best_for("coadjoint_rk4", 1000);
  ASSERT_TRUE(widest);
  for (const batch::InstructionSet set : batch::kInstructionSets) {
    if (batch::runs_here(set)) {
      EXPECT_LE(batch::width_of(set), batch::width_of(*widest));
      EXPECT_EQ(batch::best_for("coadjoint_rk4", batch::width_of(set)), set);
    }
  }
}

TEST(Batch, refuses_lanes_for_a_scheme_that_there_is_not) {
  EXPECT_THROW(Fleet({make_craft(0)}, "no_such_scheme", StepLimits{}, Lanewise::sse2),
               std::invalid_argument);
}

}  // namespace
}  // namespace adstar::runtime
