#include "service/runtime/fleet.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "adstar/integrators/all.hpp"
#include "tests/support/gate_harness.hpp"
#include "tests/support/random_motion.hpp"

namespace adstar::runtime {
namespace {

using test::kMs;
using test::make_craft;

scene::Spacecraft torqued(Frame frame, const Vec3<double>& torque) {
  scene::Spacecraft craft = make_craft(0);
  Constant<double> constant;
  constant.frame = frame;
  constant.torque_n_m = torque;
  craft.torques.emplace_back(constant);
  return craft;
}

TEST(Fleet, refuses_a_scheme_that_there_is_not) {
  EXPECT_THROW(Fleet({make_craft(0)}, "coadjoint_rk5", StepLimits{}), std::invalid_argument);
  EXPECT_THROW(Fleet({make_craft(0)}, "", StepLimits{}), std::invalid_argument);
}

TEST(Fleet, steps_with_every_scheme_of_the_table) {
  for (const std::string_view scheme : scheme_names()) {
    Fleet fleet({make_craft(0)}, scheme, StepLimits{});
    const State<double> before = fleet.vehicles()[0].state;
    EXPECT_EQ(fleet.step(0, 10 * kMs), 0U) << scheme;
    EXPECT_FALSE(fleet.vehicles()[0].state.q_IB == before.q_IB) << scheme;
    if (claims_of(scheme).exact_momentum) {
      EXPECT_EQ(fleet.vehicles()[0].state.H_I, before.H_I) << scheme;
    }
  }
}

TEST(Fleet, steps_each_vehicle_as_if_it_were_alone) {
  const std::vector<scene::Spacecraft> crafts{make_craft(0), torqued(Frame::body, {0.1, 0, -0.2}),
                                              torqued(Frame::inertial, {0, 0.3, 0})};
  Fleet together(crafts, "coadjoint_rk4", StepLimits{});
  for (std::int64_t n = 0; n < 100; ++n) {
    together.step(n * 10 * kMs, 10 * kMs);
  }
  for (std::size_t i = 0; i < crafts.size(); ++i) {
    Fleet alone({crafts[i]}, "coadjoint_rk4", StepLimits{});
    for (std::int64_t n = 0; n < 100; ++n) {
      alone.step(n * 10 * kMs, 10 * kMs);
    }
    EXPECT_EQ(alone.vehicles()[0].state, together.vehicles()[i].state) << i;
  }
}

TEST(Fleet, flags_and_counts_a_vehicle_that_turns_too_far_and_clears_the_flag) {
  scene::Spacecraft fast = make_craft(0);
  fast.initial = make_state(Quat<double>{}, Vec3<double>{5000, 0, 0});
  Fleet fleet({make_craft(0), fast}, "coadjoint_rk4", StepLimits{1.0, 8, 64});
  EXPECT_EQ(fleet.step(0, 10 * kMs), 1U);
  EXPECT_EQ(fleet.vehicles()[0].flags, 0U);
  EXPECT_EQ(fleet.vehicles()[1].flags, kFlagUnresolvedAngle);
  EXPECT_EQ(sample(fleet.vehicles()[1]).flags, kFlagUnresolvedAngle);
  EXPECT_EQ(fleet.step(10 * kMs, 1'000), 0U);
  EXPECT_EQ(fleet.vehicles()[1].flags, 0U);
}

TEST(Fleet, flags_more_edges_than_the_limit) {
  scene::Spacecraft craft = make_craft(1);
  Fleet fleet({craft}, "coadjoint_rk4", StepLimits{1.0, 64, 2});
  auto& commanded = std::get<Commanded<double>>(fleet.vehicles()[0].torques[0]);
  for (std::int64_t i = 0; i < 4; ++i) {
    commanded.window[static_cast<std::size_t>(i)] = {
        (2 * i + 1) * kMs, (2 * i + 2) * kMs, {1, 0, 0}};
  }
  commanded.intervals = 4;
  EXPECT_EQ(fleet.step(0, 10 * kMs), 1U);
  EXPECT_EQ(fleet.vehicles()[0].flags, kFlagUnresolvedEdges);
}

TEST(Sample, says_what_the_state_means) {
  Fleet fleet({torqued(Frame::body, {0.1, 0.05, -0.2})}, "coadjoint_rk4", StepLimits{});
  for (std::int64_t n = 0; n < 500; ++n) {
    fleet.step(n * 10 * kMs, 10 * kMs);
  }
  const Vehicle& vehicle = fleet.vehicles()[0];
  const TelemetryRecord s = sample(vehicle);
  const auto& q = vehicle.state.q_IB;
  EXPECT_EQ(s.q_IB, (std::array<double, 4>{q.w, q.x, q.y, q.z}));
  EXPECT_EQ(s.H_I_n_m_s[1], vehicle.state.H_I.y.value);
  const Eigen::Matrix3d R = to_eigen(q).toRotationMatrix();
  const Eigen::Vector3d H = to_eigen(vehicle.state.H_I.value());
  const Eigen::Vector3d Pi = R.transpose() * H;
  const Eigen::Vector3d omega = test::full_inertia().inverse() * Pi;
  const Eigen::Map<const Eigen::Vector3d> Pi_got(s.Pi_B_n_m_s.data());
  const Eigen::Map<const Eigen::Vector3d> omega_got(s.omega_B_rad_s.data());
  EXPECT_LT((Pi_got - Pi).norm(), 1e-13);
  EXPECT_LT((omega_got - omega).norm(), 1e-13);
  EXPECT_NEAR(s.rotational_energy_j, 0.5 * omega.dot(Pi), 1e-13);
  EXPECT_NEAR(s.energy_residual_j, (s.rotational_energy_j - vehicle.E_0) - s.work_j, 1e-15);
  EXPECT_LT(std::fabs(s.energy_residual_j), 1e-9);
  EXPECT_GT(std::fabs(s.work_j), 1e-3);
  for (const double residual : s.momentum_residual_I_n_m_s) {
    EXPECT_LT(std::fabs(residual), 1e-14);
  }
}

TEST(Sample, of_the_start_has_no_residuals) {
  const Fleet fleet({make_craft(0)}, "coadjoint_rk4", StepLimits{});
  const TelemetryRecord s = sample(fleet.vehicles()[0]);
  EXPECT_EQ(s.work_j, 0);
  EXPECT_EQ(s.energy_residual_j, 0);
  EXPECT_EQ(s.momentum_residual_I_n_m_s, (std::array<double, 3>{}));
  EXPECT_NEAR(s.omega_B_rad_s[1], 0.82623, 1e-15);
}

TEST(MomentumResidual, is_relative_to_momentum_or_impulse_and_sees_a_fault) {
  Fleet fleet({torqued(Frame::inertial, {0, 0, 1})}, "coadjoint_rk4", StepLimits{});
  for (std::int64_t n = 0; n < 100; ++n) {
    fleet.step(n * 10 * kMs, 10 * kMs);
  }
  Vehicle& vehicle = fleet.vehicles()[0];
  EXPECT_LT(momentum_residual_relative(vehicle), 1e-15);
  const double H = norm(vehicle.state.H_I.value());
  vehicle.state.H_I.add({1e-6 * H, 0, 0});
  EXPECT_NEAR(momentum_residual_relative(vehicle), 1e-6, 1e-9);
}

TEST(MomentumResidual, is_zero_at_rest_and_no_number_when_the_momentum_is_none) {
  scene::Spacecraft still = make_craft(0);
  still.initial = make_state(Quat<double>{}, Vec3<double>{});
  Fleet fleet({still}, "coadjoint_rk4", StepLimits{});
  EXPECT_EQ(momentum_residual_relative(fleet.vehicles()[0]), 0);
  fleet.vehicles()[0].state.H_I.add({std::numeric_limits<double>::quiet_NaN(), 0, 0});
  EXPECT_TRUE(std::isnan(momentum_residual_relative(fleet.vehicles()[0])));
}

}  // namespace
}  // namespace adstar::runtime
