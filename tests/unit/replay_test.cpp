// A recorded run is flown again: the same bits, or where they part; run control and all.

#include "service/run/refly.hpp"
#include "tests/support/killed_run.hpp"

namespace adstar::run {
namespace {

runtime::ControlRecord control(std::uint64_t sequence, runtime::ControlAction action) {
  runtime::ControlRecord record;
  record.commander = {3, 4};
  record.sequence = sequence;
  record.action = action;
  record.spacecraft = action == runtime::ControlAction::set_target ? 2 : 1;
  record.attitude = {1, 2, 3, 4};
  record.omega_B_rad_s = {0.1, -0.2, 0.3};
  record.inertia_body_kg_m2 = {1.1, 1.2, 1.3, 0.01, 0, 0};
  return record;
}

/// Another inertia at 130, a reset at 170, another state and another target at 40 after it.
void fly_with_controls(RecordedFlight& flight, std::uint64_t until_after_reset) {
  if (flight.at() < runtime::Instant{0, 130}) {
    flight.run_to(130);
  }
  if (flight.at().resets == 0) {
    flight.control(control(1, runtime::ControlAction::set_inertia));
    flight.run_to(170);
    flight.control(control(2, runtime::ControlAction::reset));
  }
  flight.run_to(std::min<std::uint64_t>(40, until_after_reset));
  if (until_after_reset > 40) {
    flight.control(control(3, runtime::ControlAction::set_state));
    flight.control(control(4, runtime::ControlAction::set_target));
    flight.run_to(until_after_reset);
  }
}

TEST_F(KilledRun, goes_on_over_changed_inertia_resets_set_states_and_targets) {
  for (const bool keep_all : {false, true}) {
    for (const std::uint64_t killed_after : {0U, 1U, 40U, 41U, 90U}) {
      std::error_code ignored;
      fs::remove_all(path_, ignored);
      std::optional<RecordedFlight> flight(std::in_place, 5, path_, run_);
      flight->run_to(100);
      flight->checkpoint(keep_all);
      fly_with_controls(*flight, killed_after);
      if (killed_after == 90) {
        flight->checkpoint(keep_all);
      }
      flight.reset();
      flight.emplace(5, path_);
      ASSERT_EQ(flight->at(), (runtime::Instant{1, killed_after}));
      fly_with_controls(*flight, 120);
      RecordedFlight never_killed(5);
      fly_with_controls(never_killed, 120);
      EXPECT_EQ(flight->hash(), never_killed.hash()) << killed_after;
      EXPECT_EQ(flight->schedule(), never_killed.schedule()) << killed_after;
      flight->checkpoint(keep_all);
      flight.reset();
      const auto directory = RunDirectory::open(path_, RunDirectory::Use::look);
      const Reflight again =
          refly(directory, test::recorded_scene(), 7, [](double) { return true; });
      EXPECT_FALSE(again.differs_at) << again.differs_at->step << " " << again.differs_in;
      EXPECT_EQ(again.to, (runtime::Instant{1, 120}));
    }
  }
}

TEST_F(KilledRun, flown_again_gives_the_same_bits) {
  {
    RecordedFlight flight(8, path_, run_);
    for (std::uint64_t step = 50; step <= 400; step += 50) {
      flight.run_to(step);
      flight.checkpoint(true);
    }
  }
  const auto directory = RunDirectory::open(path_, RunDirectory::Use::look);
  const Reflight again = refly(directory, test::recorded_scene(), 7, [](double) { return true; });
  EXPECT_EQ(again.from.step, 0U);
  EXPECT_EQ(again.to.step, 400U);
  EXPECT_EQ(again.hashes, 8U);
  EXPECT_EQ(again.checkpoints, 3U);
  EXPECT_FALSE(again.differs_at) << again.differs_at->step << again.differs_in;
}

TEST_F(KilledRun, flown_again_from_the_oldest_checkpoint_when_the_beginning_was_dropped) {
  {
    RecordedFlight flight(8, path_, run_);
    for (std::uint64_t step = 50; step <= 400; step += 50) {
      flight.run_to(step);
      flight.checkpoint();
    }
  }
  const auto directory = RunDirectory::open(path_, RunDirectory::Use::look);
  const Reflight again = refly(directory, test::recorded_scene(), 7, [](double) { return true; });
  EXPECT_EQ(again.from.step, 300U);
  EXPECT_EQ(again.to.step, 400U);
  EXPECT_FALSE(again.differs_at);
}

TEST_F(KilledRun, flown_again_with_another_body_says_where_it_parts) {
  {
    RecordedFlight flight(8, path_, run_);
    for (std::uint64_t step = 50; step <= 200; step += 50) {
      flight.run_to(step);
      flight.checkpoint(true);
    }
  }
  scene::Scene other = test::recorded_scene();
  other.spacecraft[1].name = "other";
  other.spacecraft[1].inertia_body_kg_m2(0, 0) += 1e-12;
  const auto directory = RunDirectory::open(path_, RunDirectory::Use::look);
  const Reflight again = refly(directory, other, 7, [](double) { return true; });
  ASSERT_TRUE(again.differs_at);
  EXPECT_EQ(again.differs_at->step, 50U);
}

TEST_F(KilledRun, flown_again_names_the_first_step_that_differs_where_every_step_left_a_digest) {
  {
    RecordedFlight flight(8, path_, run_);
    flight.digest_every_step();
    for (std::uint64_t step = 50; step <= 200; step += 50) {
      flight.run_to(step);
      flight.checkpoint(true);
    }
    flight.end_digests();
  }
  const auto directory = RunDirectory::open(path_, RunDirectory::Use::look);
  const auto on = [](double) { return true; };
  const Reflight same = refly(directory, test::recorded_scene(), 7, on);
  EXPECT_FALSE(same.differs_at) << same.differs_at->step << same.differs_in;
  EXPECT_EQ(same.to.step, 200U);
  EXPECT_GE(same.hashes, 190U);

  scene::Scene other = test::recorded_scene();
  other.spacecraft[0].torques.push_back(Table<double>{
      Frame::body, Interpolation::hold, AfterEnd::hold, {123 * 10 * test::kMs}, {{1e-9, 0, 0}}});
  const Reflight again = refly(directory, other, 7, on);
  ASSERT_TRUE(again.differs_at);
  EXPECT_EQ(again.same_until.step, 123U);
  EXPECT_EQ(again.differs_at->step, 124U);
}

TEST_F(KilledRun, flown_again_tells_which_part_of_a_checkpoint_it_does_not_come_to) {
  const auto parts_in = [&](const auto& change) {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
    {
      RecordedFlight flight(8, path_, run_);
      flight.run_to(50);
      flight.log().move_records();
      runtime::FleetState changed = flight.state();
      change(changed);
      flight.log().write_checkpoint(flight.at(), changed, true);
    }
    const auto directory = RunDirectory::open(path_, RunDirectory::Use::look);
    return refly(directory, test::recorded_scene(), 7, [](double) { return true; }).differs_in;
  };
  EXPECT_EQ(parts_in([](auto&) {}), "");
  EXPECT_NE(parts_in([](auto& state) { state.vehicles[2].state.q_IB.w = 0.5; }).find("'sat'"),
            std::string::npos);
  EXPECT_EQ(parts_in([](auto& state) { state.wheel_momenta[0].carry = 1; }),
            "the momentum of a wheel");
  EXPECT_EQ(parts_in([](auto& state) { ++state.memory.back(); }), "what a model remembers");
}

TEST_F(KilledRun, killed_and_gone_on_with_the_digests_of_both_parts_are_compared) {
  {
    RecordedFlight flight(8, path_, run_);
    flight.digest_every_step();
    flight.run_to(77);  // moved to no file: they are found in memory
  }
  {
    RecordedFlight flight(8, path_);
    flight.digest_every_step();
    flight.run_to(150);
    flight.end_digests();
    flight.checkpoint(true);
  }
  const auto directory = RunDirectory::open(path_, RunDirectory::Use::look);
  const Reflight again = refly(directory, test::recorded_scene(), 7, [](double) { return true; });
  EXPECT_FALSE(again.differs_at) << again.differs_at->step << again.differs_in;
  EXPECT_EQ(again.hashes,
            76U + 73U + 1U);  // a block's 19 four times; the killed one's last is lost
}

TEST_F(KilledRun, flown_again_over_a_checkpoint_that_was_written_within_a_beat) {
  std::optional<RecordedFlight> flight(std::in_place, 8, path_, run_);
  std::uint64_t step = 50;
  for (flight->run_to(step); test::commands_of_beat(8, step).empty(); ++step) {
    flight->beat();
  }
  flight->hear();  // the beat's commands, and there it is killed
  flight.reset();
  flight.emplace(8, path_);
  flight->checkpoint(true);
  flight->run_to(step + 30);
  flight->checkpoint(true);
  const auto directory = RunDirectory::open(path_, RunDirectory::Use::look);
  const Reflight again = refly(directory, test::recorded_scene(), 7, [](double) { return true; });
  EXPECT_FALSE(again.differs_at) << again.differs_at->step << again.differs_in;
  EXPECT_EQ(again.checkpoints, 2U);
  EXPECT_EQ(again.to.step, step + 30);
}

}  // namespace
}  // namespace adstar::run
