// What run control does to a fleet: as if the scene had said so from the start.
#include "service/runtime/run_control.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "adstar/integrators/all.hpp"
#include "service/batch/kernels.hpp"
#include "service/runtime/fleet_snapshot.hpp"
#include "tests/support/gate_harness.hpp"

namespace adstar::runtime {
namespace {

using test::kMs;
using test::make_craft;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

ControlRecord inertia(std::uint32_t spacecraft, std::array<double, 6> tensor) {
  ControlRecord record;
  record.action = ControlAction::set_inertia;
  record.spacecraft = spacecraft;
  record.inertia_body_kg_m2 = tensor;
  return record;
}

ControlRecord state(std::uint32_t spacecraft, std::array<double, 4> q,
                    std::array<double, 3> omega) {
  ControlRecord record;
  record.action = ControlAction::set_state;
  record.spacecraft = spacecraft;
  record.attitude = q;
  record.omega_B_rad_s = omega;
  return record;
}

/// Seventy of them, so that every register is filled and some lanes are left over.
std::vector<scene::Spacecraft> crafts() {
  std::vector<scene::Spacecraft> all;
  for (int i = 0; i < 70; ++i) {
    all.push_back(make_craft(0));
    if (i % 3 == 1) {
      Constant<double> constant;
      constant.frame = i % 2 == 0 ? Frame::body : Frame::inertial;
      constant.torque_n_m = {0.01 * i, -0.02, 0.03};
      all.back().torques.emplace_back(constant);
    }
  }
  return all;
}

void fly(Fleet& fleet, std::int64_t from, std::int64_t to) {
  for (std::int64_t n = from; n < to; ++n) {
    fleet.step(n * 10 * kMs, 10 * kMs);
  }
}

constexpr std::array<double, 6> kDeployed{1.5, 2.0, 1.25, 0.1, -0.05, 0.2};

struct How {
  const char* name;
  Lanewise lanewise;
  std::size_t threads;
  bool runs;
};

std::vector<How> ways() {
  return {{"alone", Lanewise::alone, 1, true},
          {"sse2", Lanewise::sse2, 1, batch::runs_here(batch::InstructionSet::sse2)},
          {"avx2", Lanewise::avx2, 1, batch::runs_here(batch::InstructionSet::avx2)},
          {"avx512", Lanewise::avx512, 1, batch::runs_here(batch::InstructionSet::avx512)},
          {"threads", Lanewise::automatic, 2, true}};
}

TEST(SetInertia, moves_on_with_the_bits_of_a_scene_that_had_it_from_the_start) {
  for (const How& how : ways()) {
    if (!how.runs) {
      continue;
    }
    std::vector<scene::Spacecraft> scene = crafts();
    Fleet changed(scene, "coadjoint_rk4", StepLimits{}, how.lanewise, how.threads);
    fly(changed, 0, 50);
    const std::vector<std::uint32_t> deployed{0, 4, 33, 65, 69};
    for (const std::uint32_t i : deployed) {
      ASSERT_EQ(apply_control(inertia(i, kDeployed), changed).refusal, ControlRefusal::none);
      scene[i].inertia_body_kg_m2 << 1.5, 0.1, -0.05, 0.1, 2.0, 0.2, -0.05, 0.2, 1.25;
    }
    Fleet fresh(scene, "coadjoint_rk4", StepLimits{}, how.lanewise, how.threads);
    for (std::size_t i = 0; i < scene.size(); ++i) {
      fresh.vehicles()[i].state = changed.vehicles()[i].state;
    }
    fly(changed, 50, 100);
    fly(fresh, 50, 100);
    for (std::size_t i = 0; i < scene.size(); ++i) {
      EXPECT_EQ(changed.vehicles()[i].state, fresh.vehicles()[i].state) << how.name << " " << i;
    }
  }
}

TEST(SetInertia, works_under_every_scheme) {
  for (const std::string_view scheme : scheme_names()) {
    Fleet changed({make_craft(0)}, scheme, StepLimits{}, Lanewise::alone);
    ASSERT_EQ(apply_control(inertia(0, kDeployed), changed).refusal, ControlRefusal::none);
    scene::Spacecraft craft = make_craft(0);
    craft.inertia_body_kg_m2 << 1.5, 0.1, -0.05, 0.1, 2.0, 0.2, -0.05, 0.2, 1.25;
    Fleet fresh({craft}, scheme, StepLimits{}, Lanewise::alone);
    fly(changed, 0, 10);
    fly(fresh, 0, 10);
    EXPECT_EQ(changed.vehicles()[0].state, fresh.vehicles()[0].state) << scheme;
  }
}

TEST(SetInertia, keeps_momentum_and_attitude_to_the_last_bit_and_opens_the_accounts) {
  Fleet fleet(crafts(), "coadjoint_rk4", StepLimits{});
  fly(fleet, 0, 50);
  const State<double> before = fleet.vehicles()[4].state;
  const auto rate_before = sample(fleet.vehicles()[4]).omega_B_rad_s;
  ASSERT_NE(before.impulse_I.value(), Vec3<double>{});
  ASSERT_EQ(apply_control(inertia(4, kDeployed), fleet).refusal, ControlRefusal::none);
  const Vehicle& after = fleet.vehicles()[4];
  EXPECT_EQ(after.state.H_I, before.H_I);
  EXPECT_EQ(after.state.q_IB, before.q_IB);
  EXPECT_EQ(after.state.impulse_I, VecSum<double>{});
  EXPECT_EQ(after.state.work, Sum<double>{});
  const TelemetryRecord told = sample(after);
  EXPECT_NE(told.omega_B_rad_s, rate_before);
  EXPECT_EQ(told.energy_residual_j, 0.0);
  EXPECT_EQ(momentum_residual_relative(after), 0.0);
  EXPECT_EQ(told.rotational_energy_j, after.body.energy(body_momentum(after.state)));
}

TEST(SetInertia, is_taken_back_by_a_reset_whatever_became_of_the_state) {
  Fleet fleet({make_craft(0)}, "coadjoint_rk4", StepLimits{});
  fleet.keep_start();
  const Sym3<double> J = fleet.vehicles()[0].body.inertia();
  const State<double> start = fleet.vehicles()[0].state;
  ASSERT_EQ(apply_control(inertia(0, kDeployed), fleet).refusal, ControlRefusal::none);
  fleet.vehicles()[0].state.H_I.x.value = kNaN;
  ASSERT_TRUE(fleet.reset());
  EXPECT_EQ(fleet.vehicles()[0].body.inertia(), J);
  EXPECT_EQ(fleet.vehicles()[0].state, start);
}

TEST(SetInertia, refuses_what_is_no_rigid_bodys_and_changes_nothing) {
  Fleet fleet({make_craft(0)}, "coadjoint_rk4", StepLimits{});
  const State<double> before = fleet.vehicles()[0].state;
  const auto J = fleet.vehicles()[0].body.inertia();
  const std::array<double, 6> wrong[] = {{0, 0, 0, 0, 0, 0},
                                         {-1, 1, 1, 0, 0, 0},
                                         {1, 1, 2.1, 0, 0, 0},
                                         {1, 1, 1, 1.5, 0, 0},
                                         {kNaN, 1, 1, 0, 0, 0},
                                         {1, 1, 1, 0, kNaN, 0},
                                         {1, kInfinity, 1, 0, 0, 0},
                                         {1e200, 1e200, 1e200, 0, 0, 0},
                                         {1e-200, 1e-200, 1e-200, 0, 0, 0},
                                         {1, 1, 1, 0, 0, -kInfinity}};
  for (const auto& tensor : wrong) {
    EXPECT_EQ(apply_control(inertia(0, tensor), fleet).refusal, ControlRefusal::bad_inertia)
        << tensor[0] << " " << tensor[1] << " " << tensor[2];
  }
  EXPECT_EQ(fleet.vehicles()[0].state, before);
  EXPECT_EQ(fleet.vehicles()[0].body.inertia().xx, J.xx);
  EXPECT_EQ(apply_control(inertia(1, kDeployed), fleet).refusal,
            ControlRefusal::unknown_spacecraft);
  EXPECT_EQ(apply_control(inertia(0xffff'ffffU, kDeployed), fleet).refusal,
            ControlRefusal::unknown_spacecraft);
}

TEST(SetState, is_the_state_that_a_scene_would_give) {
  Fleet fleet(crafts(), "coadjoint_rk4", StepLimits{});
  fly(fleet, 0, 20);
  ASSERT_EQ(apply_control(state(1, {2, 0, -1, 0.5}, {0.1, 0.2, -0.3}), fleet).refusal,
            ControlRefusal::none);
  const Vehicle& vehicle = fleet.vehicles()[1];
  const Quat<double> q{2, 0, -1, 0.5};
  EXPECT_EQ(vehicle.state,
            make_state(q, rotate(normalised(q), vehicle.body.momentum({0.1, 0.2, -0.3}))));
  EXPECT_NEAR(sample(vehicle).omega_B_rad_s[2], -0.3, 1e-15);
  EXPECT_EQ(momentum_residual_relative(vehicle), 0.0);
  EXPECT_EQ(sample(vehicle).energy_residual_j, 0.0);
}

TEST(SetState, refuses_what_is_no_motion) {
  Fleet fleet({make_craft(0)}, "coadjoint_rk4", StepLimits{});
  const State<double> before = fleet.vehicles()[0].state;
  EXPECT_EQ(apply_control(state(0, {0, 0, 0, 0}, {}), fleet).refusal, ControlRefusal::bad_state);
  EXPECT_EQ(apply_control(state(0, {1, kNaN, 0, 0}, {}), fleet).refusal, ControlRefusal::bad_state);
  EXPECT_EQ(apply_control(state(0, {1, 0, 0, 0}, {0, kInfinity, 0}), fleet).refusal,
            ControlRefusal::bad_state);
  EXPECT_EQ(apply_control(state(0, {1, 0, 0, 0}, {0, 1e300, 0}), fleet).refusal,
            ControlRefusal::bad_state);
  EXPECT_EQ(apply_control(state(7, {1, 0, 0, 0}, {}), fleet).refusal,
            ControlRefusal::unknown_spacecraft);
  EXPECT_EQ(fleet.vehicles()[0].state, before);
}

ControlRecord target(std::uint32_t spacecraft, std::array<double, 4> attitude) {
  ControlRecord record;
  record.action = ControlAction::set_target;
  record.spacecraft = spacecraft;
  record.attitude = attitude;
  return record;
}

TEST(SetTarget, is_what_the_pointing_error_is_told_against_and_moves_nothing) {
  Fleet fleet({test::in_space(make_craft(0))}, "coadjoint_rk4", StepLimits{});
  const Vehicle& vehicle = fleet.vehicles()[0];
  const State<double> before = vehicle.state;
  const PointingRecord told = pointing(vehicle, 7);
  const auto& q_OB = told.q_OB;
  ASSERT_EQ(
      apply_control(target(0, {3 * q_OB[0], 3 * q_OB[1], 3 * q_OB[2], 3 * q_OB[3]}), fleet).refusal,
      ControlRefusal::none);
  for (const double error : pointing(vehicle, 7).error_B_rad) {
    EXPECT_NEAR(error, 0, 1e-15) << "in its orbital frame it is the attitude that it has";
  }
  EXPECT_GT(std::hypot(told.error_B_rad[0], told.error_B_rad[1], told.error_B_rad[2]), 0.1);
  EXPECT_EQ(vehicle.state, before);
}

TEST(SetTarget, is_kept_by_a_snapshot_and_taken_back_by_a_reset) {
  const std::vector<scene::Spacecraft> craft{test::in_space(make_craft(0))};
  Fleet fleet(craft, "coadjoint_rk4", StepLimits{});
  fleet.keep_start();
  const auto error = [](const Fleet& told) { return pointing(told.vehicles()[0], 0).error_B_rad; };
  const auto at_start = error(fleet);
  ASSERT_EQ(apply_control(target(0, {1, 2, 3, 4}), fleet).refusal, ControlRefusal::none);
  const auto commanded = error(fleet);
  EXPECT_NE(commanded, at_start);
  Fleet other(craft, "coadjoint_rk4", StepLimits{});
  ASSERT_TRUE(restore(other, state_of(fleet)));
  EXPECT_EQ(error(other), commanded);
  ASSERT_TRUE(fleet.reset());
  EXPECT_EQ(error(fleet), at_start);
}

TEST(SetTarget, refuses_what_is_no_attitude_and_a_spacecraft_without_a_target) {
  Fleet fleet({test::in_space(make_craft(0)), make_craft(0)}, "coadjoint_rk4", StepLimits{});
  EXPECT_EQ(apply_control(target(0, {0, 0, 0, 0}), fleet).refusal, ControlRefusal::bad_state);
  EXPECT_EQ(apply_control(target(0, {1, kNaN, 0, 0}), fleet).refusal, ControlRefusal::bad_state);
  EXPECT_EQ(apply_control(target(1, {1, 0, 0, 0}), fleet).refusal, ControlRefusal::no_target);
  EXPECT_EQ(apply_control(target(2, {1, 0, 0, 0}), fleet).refusal,
            ControlRefusal::unknown_spacecraft);
}

TEST(Reset, flies_the_same_bits_again) {
  Fleet fleet(crafts(), "coadjoint_rk4", StepLimits{});
  ControlRecord reset;
  reset.action = ControlAction::reset;
  EXPECT_EQ(apply_control(reset, fleet).refusal, ControlRefusal::not_allowed)
      << "no start was kept";
  fleet.keep_start();
  fly(fleet, 0, 60);
  std::vector<State<double>> first;
  for (const Vehicle& vehicle : fleet.vehicles()) {
    first.push_back(vehicle.state);
  }
  apply_control(inertia(3, kDeployed), fleet);
  apply_control(state(5, {1, 1, 0, 0}, {0, 0, 1}), fleet);
  fly(fleet, 60, 70);
  ASSERT_EQ(apply_control(reset, fleet).refusal, ControlRefusal::none);
  fly(fleet, 0, 60);
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(fleet.vehicles()[i].state, first[i]) << i;
  }
}

TEST(ApplyControl, answers_for_the_record_and_refuses_an_action_that_there_is_not) {
  Fleet fleet({make_craft(0)}, "coadjoint_rk4", StepLimits{});
  ControlRecord record;
  record.commander = {1, 2};
  record.sequence = 3;
  record.action = static_cast<ControlAction>(77);
  const ControlAnswerRecord answer = apply_control(record, fleet);
  EXPECT_EQ(answer.commander, record.commander);
  EXPECT_EQ(answer.sequence, 3U);
  EXPECT_EQ(answer.refusal, ControlRefusal::unknown_action);
}

}  // namespace
}  // namespace adstar::runtime
