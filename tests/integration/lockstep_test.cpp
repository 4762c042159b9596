// A daemon whose clock is in the hands of others, over the real bus: lock-step and run control.

#include <gtest/gtest.h>

#include "service/runtime/fleet.hpp"
#include "tests/integration/clock_holder.hpp"

namespace adstar {
namespace {

using testing::ClockHolder;
using testing::Daemon;
using testing::GroundStation;
using testing::lockstep_scene;
using testing::paper_scene;
using testing::private_corner;
using testing::replaced;

constexpr std::int64_t kMillisecond = 1'000'000;

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::array<double, 3> momentum_of(const adstar_MomentumState& state) {
  return {state.momentum_inertial_n_m_s.x, state.momentum_inertial_n_m_s.y,
          state.momentum_inertial_n_m_s.z};
}

/// What the scene's body would be after that many steps under the command.
runtime::TelemetryRecord flown(const std::string& text, std::int64_t steps,
                               const TorqueInterval<double>& command) {
  const scene::Scene scene = scene::parse(text, "test.toml");
  runtime::Fleet fleet(scene.spacecraft, scene.simulation.scheme, scene.simulation.limits);
  auto& commanded = std::get<Commanded<double>>(fleet.vehicles()[0].torques[0]);
  commanded.window[0] = command;
  commanded.intervals = 1;
  for (std::int64_t n = 0; n < steps; ++n) {
    fleet.step(n * scene.simulation.step_ns, scene.simulation.step_ns);
  }
  return runtime::sample(fleet.vehicles()[0]);
}

TEST(Lockstep, a_flight_program_drives_time_and_the_bits_are_those_of_its_commands) {
  const auto corner = private_corner();
  const std::string scene = lockstep_scene(corner);
  Daemon daemon(scene);
  GroundStation ground(corner);
  ClockHolder holder(ground.participant());
  const auto begun = holder.step(0);
  ASSERT_TRUE(begun.has_value()) << daemon.log();
  EXPECT_EQ(begun->step, 0U) << "nobody asked for a step before";

  auto command = ground.command("sat1", {0.3, -0.7, 0.11});
  command.start_time_ns = 95 * kMillisecond;
  command.duration_ns = 33 * kMillisecond;
  const auto accepted = ground.send(command);
  ASSERT_TRUE(accepted.has_value());
  EXPECT_EQ(accepted->verdict, adstar_VERDICT_ACCEPTED);
  std::uint64_t reached = 0;
  for (const std::uint64_t steps : {1U, 9U, 90U, 400U}) {
    const auto reply = holder.step(steps);
    ASSERT_TRUE(reply.has_value()) << daemon.log();
    reached += steps;
    EXPECT_EQ(reply->outcome, adstar_STEP_DONE);
    EXPECT_EQ(reply->step, reached);
    EXPECT_EQ(reply->time_ns, static_cast<std::int64_t>(reached) * 10 * kMillisecond);
    ASSERT_TRUE(ground.until([&] { return ground.momentum["sat1"].step == reached; }))
        << "the last state of a request is published";
  }
  const auto verdict = ground.final_answer(command.sequence_number);
  ASSERT_TRUE(verdict.has_value());
  EXPECT_EQ(verdict->verdict, adstar_VERDICT_APPLIED);
  EXPECT_EQ(verdict->step, 9U);
  const auto wanted = flown(scene, 500, {95 * kMillisecond, 128 * kMillisecond, {0.3, -0.7, 0.11}});
  EXPECT_EQ(momentum_of(ground.momentum["sat1"]), wanted.H_I_n_m_s);
  EXPECT_EQ(ground.momentum["sat1"].rotational_energy_j, wanted.rotational_energy_j);
  EXPECT_EQ(daemon.stop(), 0) << daemon.log();
}

TEST(Lockstep, repeated_requests_step_once_and_a_second_asker_has_a_clock_of_the_same_time) {
  const auto corner = private_corner();
  Daemon daemon(lockstep_scene(corner));
  const dds::Participant participant(corner);
  ClockHolder holder(participant), other(participant, 2);
  ASSERT_TRUE(holder.step(0).has_value()) << daemon.log();
  const auto request = holder.request(3);
  for (int i = 0; i < 20; ++i) {
    holder.write(request);
  }
  const auto reply = holder.ask(request);
  ASSERT_TRUE(reply.has_value());
  EXPECT_EQ(reply->step, 3U);
  EXPECT_EQ(other.step(0)->step, 3U);
  EXPECT_EQ(other.step(2)->step, 5U);
  EXPECT_EQ(holder.ask(request)->step, 3U) << "as it was answered then";
  EXPECT_EQ(holder.step(0)->step, 5U);
  EXPECT_EQ(daemon.stop(), 0);
}

TEST(Lockstep, says_that_it_waits_and_warns_once_that_nobody_asks) {
  const auto corner = private_corner();
  Daemon daemon(lockstep_scene(corner, {}, "10ms"));
  GroundStation ground(corner);
  ASSERT_TRUE(ground.until([&] {
    return ground.status && ground.status->state == adstar_SERVICE_WAITING;
  })) << daemon.log();
  EXPECT_EQ(dds::text_of(ground.status->pace), "lockstep");
  const std::string warning = "nobody has asked for a step";
  EXPECT_TRUE(ground.until([&] { return contains(daemon.log(), warning); })) << daemon.log();
  EXPECT_EQ(daemon.stop(), 0);
  const std::string log = daemon.log();
  EXPECT_EQ(log.find(warning), log.rfind(warning)) << log;
}

TEST(Lockstep, outlives_its_bridge) {
  const auto corner = private_corner();
  Daemon daemon(lockstep_scene(corner));
  const dds::Participant participant(corner);
  ClockHolder holder(participant);
  ASSERT_TRUE(holder.step(5).has_value()) << daemon.log();
  kill(daemon.bridge(), SIGKILL);
  const auto reply = holder.step(5);
  ASSERT_TRUE(reply.has_value()) << daemon.log();
  EXPECT_EQ(reply->step, 10U);
  EXPECT_EQ(daemon.stop(), 0);
}

TEST(Lockstep, ends_the_run_with_the_request_that_reaches_its_duration) {
  const auto corner = private_corner();
  Daemon daemon(lockstep_scene(corner, {.duration = "1s"}));
  const dds::Participant participant(corner);
  ClockHolder holder(participant);
  const auto reply = holder.step(1'000'000);
  ASSERT_TRUE(reply.has_value()) << daemon.log();
  EXPECT_EQ(reply->outcome, adstar_STEP_ENDED);
  EXPECT_EQ(reply->step, 100U);
  EXPECT_EQ(daemon.exit_code(), 0) << daemon.log();
}

TEST(RunControl, is_refused_and_logged_unless_the_scene_allows_it) {
  const auto corner = private_corner();
  Daemon daemon(paper_scene(corner, {}));
  const dds::Participant participant(corner);
  ClockHolder holder(participant);
  const auto refused = holder.ask(adstar_CONTROL_PAUSE);
  ASSERT_TRUE(refused.has_value()) << daemon.log();
  EXPECT_EQ(refused->refusal, adstar_CONTROL_REFUSAL_NOT_ALLOWED);
  EXPECT_TRUE(testing::eventually([&] {
    return contains(daemon.log(), "run control: pause refused");
  })) << daemon.log();
  const auto step = holder.step(1);
  ASSERT_TRUE(step.has_value());
  EXPECT_EQ(step->refusal, adstar_STEP_REFUSAL_NOT_STANDING);
  EXPECT_EQ(daemon.stop(), 0);
}

TEST(RunControl, pauses_changes_and_resets_a_run_by_the_clock) {
  const auto corner = private_corner();
  Daemon daemon(
      replaced(paper_scene(corner, {}), "[service]\n", "[service]\nrun_control = true\n"));
  GroundStation ground(corner);
  ClockHolder holder(ground.participant());
  ASSERT_TRUE(ground.until([&] { return ground.momentum["sat1"].step > 5; })) << daemon.log();
  const auto at_start = momentum_of(ground.momentum["sat1"]);
  const auto paused = holder.ask(adstar_CONTROL_PAUSE);
  ASSERT_TRUE(paused.has_value());
  EXPECT_EQ(paused->refusal, adstar_CONTROL_REFUSAL_NONE);
  EXPECT_TRUE(
      ground.until([&] { return ground.status && ground.status->state == adstar_SERVICE_PAUSED; }));
  const auto one = holder.step(1);
  ASSERT_TRUE(one.has_value());
  EXPECT_EQ(one->step, paused->step + 1);

  auto deployment = holder.control(adstar_CONTROL_SET_INERTIA, "sat1");
  deployment.inertia_body_kg_m2 = {1.2, 1.4, 2.1, 0, 0, 0.1};
  EXPECT_EQ(holder.ask(deployment)->refusal, adstar_CONTROL_REFUSAL_NONE);
  ASSERT_TRUE(ground.until([&] { return ground.momentum["sat1"].step == one->step; }));
  const double energy = ground.momentum["sat1"].rotational_energy_j;
  EXPECT_EQ(holder.step(100)->step, one->step + 100);
  ASSERT_TRUE(ground.until([&] { return ground.momentum["sat1"].step == one->step + 100; }));
  EXPECT_EQ(momentum_of(ground.momentum["sat1"]), at_start) << "to the last bit";
  EXPECT_EQ(ground.momentum["sat1"].work_j, 0.0);
  EXPECT_NE(ground.momentum["sat1"].rotational_energy_j, energy);

  auto nobody = holder.control(adstar_CONTROL_SET_STATE, "sat9");
  EXPECT_EQ(holder.ask(nobody)->refusal, adstar_CONTROL_REFUSAL_UNKNOWN_SPACECRAFT);
  auto still = holder.control(adstar_CONTROL_SET_STATE, "sat1");
  EXPECT_EQ(holder.ask(still)->refusal, adstar_CONTROL_REFUSAL_BAD_STATE) << "no attitude";

  const auto reset = holder.ask(adstar_CONTROL_RESET);
  ASSERT_TRUE(reset.has_value());
  EXPECT_EQ(reset->step, 0U);
  EXPECT_TRUE(ground.until([&] { return ground.momentum["sat1"].step == 0; }));
  EXPECT_TRUE(ground.until([&] { return ground.status->run == 1; }));
  EXPECT_EQ(holder.ask(adstar_CONTROL_RESUME)->refusal, adstar_CONTROL_REFUSAL_NONE);
  EXPECT_TRUE(ground.until([&] { return ground.momentum["sat1"].step > 5; }));
  EXPECT_TRUE(ground.until([&] { return ground.status->state == adstar_SERVICE_RUNNING; }));
  EXPECT_EQ(momentum_of(ground.momentum["sat1"]), at_start);
  EXPECT_EQ(daemon.stop(), 0) << daemon.log();
}

}  // namespace
}  // namespace adstar
