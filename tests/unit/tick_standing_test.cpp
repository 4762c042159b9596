// The tick in the hands of others: lock-step, pause, reset.
#include <atomic>
#include <chrono>
#include <memory>
#include <thread>

#include <gtest/gtest.h>

#include "service/runtime/journal.hpp"
#include "service/runtime/tick.hpp"
#include "tests/support/tick_scene.hpp"

namespace adstar::runtime {
namespace {

using test::kAlice;
using test::kBob;
using test::kMs;
using test::telemetry_of;
using test::tick_scene;

/// A tick on its own thread, and the bridge's side of its rings.
class Running {
 public:
  explicit Running(const scene::Scene& scene, JournalWriter* journal = nullptr)
      : segment(MappedSegment::create(scene.spacecraft.size())), tick(scene, segment) {
    tick.record_in(journal);
    runner_ = std::thread([this] {
      tick.run(stop_);
      ended = true;
    });
  }
  ~Running() { stop(); }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  void stop() {
    stop_ = true;
    if (runner_.joinable()) {
      runner_.join();
    }
  }

  template <class Condition>
  static bool wait_for(Condition&& holds) {
    const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (!holds() && std::chrono::steady_clock::now() < until) {
      std::this_thread::yield();
    }
    return holds();
  }

  template <class Ring>
  auto next(Ring& ring) {
    auto record = ring.pop();
    wait_for([&] { return record || (record = ring.pop()); });
    EXPECT_TRUE(record.has_value()) << "no answer";
    return record.value_or(typename decltype(record)::value_type{});
  }

  StepReplyRecord step(std::uint64_t steps, const CommanderId& who = kAlice) {
    segment->step_requests.push({who, ++sequence_, steps, 0});
    wake_tick(*segment);
    return next(segment->step_replies);
  }

  ControlAnswerRecord control(ControlAction action) {
    ControlRecord record;
    record.commander = kAlice;
    record.sequence = ++sequence_;
    record.action = action;
    return control(record);
  }
  ControlAnswerRecord control(const ControlRecord& record) {
    segment->controls.push(record);
    wake_tick(*segment);
    return next(segment->control_answers);
  }

  VerdictRecord command(std::int64_t start_ns, std::int64_t duration_ns) {
    CommandRecord record;
    record.commander = kAlice;
    record.sequence = ++sequence_;
    record.start_ns = start_ns;
    record.duration_ns = duration_ns;
    record.value = {0.25, 0, 0};
    segment->commands.push(record);
    wake_tick(*segment);
    return next(segment->verdicts);
  }

  std::uint64_t steps_taken() const { return tick.report().step.load(); }

  MappedSegment segment;
  Tick tick;
  std::atomic<bool> ended{false};

 private:
  std::atomic<bool> stop_{false};
  std::uint64_t sequence_ = 0;
  std::thread runner_;
};

scene::Scene lockstep(std::int64_t steps = 0) {
  scene::Scene scene = tick_scene(steps);
  scene.simulation.pace = scene::Pace::lockstep;
  scene.service.run_control = true;
  return scene;
}

scene::Scene free_running() {
  scene::Scene scene = tick_scene(0);
  scene.service.run_control = true;
  return scene;
}

// ---- lock-step ----

TEST(Lockstep, stands_until_it_is_asked_and_takes_exactly_the_steps_asked_for) {
  Running the(lockstep());
  EXPECT_TRUE(Running::wait_for([&] { return the.tick.report().waiting.load() == 1; }));
  EXPECT_EQ(the.steps_taken(), 0U);
  const StepReplyRecord five = the.step(5);
  EXPECT_EQ(five.outcome, StepOutcome::done);
  EXPECT_EQ(five.step, 5U);
  EXPECT_EQ(five.time_ns, 50 * kMs);
  EXPECT_EQ(the.step(0).step, 5U) << "a question";
  EXPECT_EQ(the.step(1000).step, 1005U);
  the.stop();
  EXPECT_EQ(the.steps_taken(), 1005U);

  Fleet fleet(tick_scene(0).spacecraft, "coadjoint_rk4", StepLimits{});
  for (std::int64_t n = 0; n < 1005; ++n) {
    fleet.step(n * 10 * kMs, 10 * kMs);
  }
  EXPECT_EQ(the.tick.fleet().vehicles()[0].state, fleet.vehicles()[0].state);
}

TEST(Lockstep, tells_everything_of_the_last_step_before_it_answers) {
  Running the(lockstep());
  the.step(7);
  const auto records = telemetry_of(the.segment);
  ASSERT_FALSE(records.empty());
  EXPECT_EQ(records.back().step, 7U) << "though neither topic is due";
  EXPECT_EQ(records.back().topics, kTopicAttitude | kTopicMomentum);
  EXPECT_EQ(test::fleet_of(the.segment).header.step, 7U);
}

TEST(Lockstep, loses_no_telemetry_however_many_steps_are_asked_for) {
  scene::Scene scene = lockstep();
  scene.telemetry = {1, 1, 0, {0, 1}};
  Running the(scene);
  constexpr std::uint64_t kSteps = 20'000;
  the.segment->step_requests.push({kBob, 1, kSteps, 0});
  wake_tick(*the.segment);
  std::uint64_t heard = 0;
  EXPECT_TRUE(Running::wait_for([&] {
    heard += telemetry_of(the.segment).size();
    return the.segment->step_replies.size() > 0;
  }));
  heard += telemetry_of(the.segment).size();
  EXPECT_EQ(heard, 2 * (kSteps + 1));
  EXPECT_EQ(the.tick.report().telemetry_lost.load(), 0U);
}

TEST(Lockstep, steps_to_the_end_of_the_run_and_says_so) {
  Running the(lockstep(10));
  EXPECT_EQ(the.step(4).outcome, StepOutcome::done);
  const StepReplyRecord last = the.step(100);
  EXPECT_EQ(last.outcome, StepOutcome::ended);
  EXPECT_EQ(last.step, 10U);
  EXPECT_EQ(telemetry_of(the.segment).back().topics, kTopicAttitude | kTopicMomentum);
  EXPECT_TRUE(Running::wait_for([&] { return the.ended.load(); }));
}

TEST(Lockstep, answers_a_request_that_is_under_way_when_the_run_is_stopped) {
  Running the(lockstep());
  the.segment->step_requests.push({kAlice, 1, StepRequests::kMostSteps, 0});
  wake_tick(*the.segment);
  EXPECT_TRUE(Running::wait_for([&] { return the.steps_taken() > 0; }));
  the.stop();
  const StepReplyRecord reply = the.next(the.segment->step_replies);
  EXPECT_EQ(reply.outcome, StepOutcome::interrupted);
  EXPECT_EQ(reply.step, the.steps_taken());
}

TEST(Lockstep, accepts_a_command_at_once_and_begins_it_with_the_next_step) {
  Running the(lockstep());
  the.step(3);
  const VerdictRecord accepted = the.command(kStartAtNextBeat, 15 * kMs);
  EXPECT_EQ(accepted.verdict, Verdict::accepted);
  EXPECT_EQ(accepted.step, 3U);
  the.step(1);
  const VerdictRecord applied = the.next(the.segment->verdicts);
  EXPECT_EQ(applied.verdict, Verdict::applied);
  EXPECT_EQ(applied.sequence, accepted.sequence);
  EXPECT_EQ(applied.step, 3U);
  EXPECT_EQ(applied.start_ns, 30 * kMs);
  EXPECT_EQ(applied.end_ns, 45 * kMs);
  const VerdictRecord senseless = the.command(kStartAtNextBeat, 0);
  EXPECT_EQ(senseless.verdict, Verdict::refused) << "what needs no step is final at once";
}

TEST(Lockstep, serves_a_snapshot_while_it_stands) {
  Running the(lockstep());
  the.step(3);
  telemetry_of(the.segment);
  the.segment->snapshot_requested = 1;
  EXPECT_TRUE(Running::wait_for([&] { return the.segment->snapshot_requested.load() == 0; }));
  EXPECT_TRUE(Running::wait_for([&] { return the.segment->telemetry.size() > 0; }));
  EXPECT_EQ(telemetry_of(the.segment).back().step, 3U);
}

TEST(Lockstep, has_nothing_to_resume) {
  Running the(lockstep());
  EXPECT_EQ(the.control(ControlAction::pause).refusal, ControlRefusal::none);
  EXPECT_EQ(the.control(ControlAction::resume).refusal, ControlRefusal::not_now);
  EXPECT_EQ(the.step(1).outcome, StepOutcome::done);
}

// ---- run control ----

TEST(RunControl, is_refused_unless_the_scene_allows_it) {
  scene::Scene scene = lockstep();
  scene.service.run_control = false;
  Running the(scene);
  the.step(2);
  for (const ControlAction action :
       {ControlAction::pause, ControlAction::reset, ControlAction::set_state,
        ControlAction::set_inertia, ControlAction::set_target}) {
    EXPECT_EQ(the.control(action).refusal, ControlRefusal::not_allowed);
  }
  EXPECT_EQ(the.step(0).step, 2U);
}

TEST(RunControl, pauses_steps_singly_and_resumes) {
  Running the(free_running());
  EXPECT_TRUE(Running::wait_for([&] { return the.steps_taken() > 10; }));
  EXPECT_EQ(the.step(1).refusal, StepRefusal::not_standing);
  const ControlAnswerRecord paused = the.control(ControlAction::pause);
  EXPECT_EQ(paused.refusal, ControlRefusal::none);
  EXPECT_EQ(the.steps_taken(), paused.step);
  EXPECT_EQ(the.tick.report().paused.load(), 1U);
  EXPECT_EQ(the.step(1).step, paused.step + 1);
  EXPECT_EQ(the.steps_taken(), paused.step + 1);
  const ControlAnswerRecord resumed = the.control(ControlAction::resume);
  EXPECT_EQ(resumed.step, paused.step + 1);
  EXPECT_TRUE(Running::wait_for([&] { return the.steps_taken() > resumed.step + 10; }));
}

TEST(RunControl, a_repeated_sequence_number_does_nothing_again) {
  Running the(free_running());
  ControlRecord pause;
  pause.commander = kBob;
  pause.sequence = 4;
  pause.action = ControlAction::pause;
  const ControlAnswerRecord first = the.control(pause);
  the.control(ControlAction::resume);
  EXPECT_TRUE(Running::wait_for([&] { return the.steps_taken() > first.step + 10; }));
  const ControlAnswerRecord again = the.control(pause);
  EXPECT_EQ(again.refusal, ControlRefusal::none);
  EXPECT_EQ(again.step, first.step);
  EXPECT_EQ(the.tick.report().paused.load(), 0U) << "the repeat paused nothing";
  pause.sequence = 3;
  EXPECT_EQ(the.control(pause).refusal, ControlRefusal::old_sequence);
}

TEST(RunControl, misses_no_beat_by_a_pause) {
  scene::Scene scene = free_running();
  scene.simulation.pace = scene::Pace::clock;
  scene.simulation.step_ns = 100 * kMs;
  Running the(scene);
  the.control(ControlAction::pause);
  the.step(20);  // two seconds of simulation time in no time
  const std::uint64_t before = the.tick.report().missed_beats.load();
  const ControlAnswerRecord resumed = the.control(ControlAction::resume);
  EXPECT_TRUE(Running::wait_for([&] { return the.steps_taken() > resumed.step + 1; }))
      << "the next beat must not wait for the wall to catch up with simulation time";
  EXPECT_EQ(the.tick.report().missed_beats.load(), before);
}

TEST(RunControl, a_pause_ends_a_request_under_way) {
  Running the(lockstep());
  the.segment->step_requests.push({kBob, 1, StepRequests::kMostSteps, 0});
  wake_tick(*the.segment);
  EXPECT_TRUE(Running::wait_for([&] { return the.steps_taken() > 0; }));
  const ControlAnswerRecord paused = the.control(ControlAction::pause);
  const StepReplyRecord reply = the.next(the.segment->step_replies);
  EXPECT_EQ(reply.outcome, StepOutcome::interrupted);
  EXPECT_EQ(reply.step, paused.step);
  EXPECT_EQ(the.steps_taken(), paused.step);
}

TEST(RunControl, reset_begins_the_run_again_to_the_same_bits_and_supersedes_what_waits) {
  Running the(lockstep());
  const VerdictRecord first = the.command(25 * kMs, 20 * kMs);
  EXPECT_EQ(first.verdict, Verdict::accepted);
  the.step(40);
  EXPECT_EQ(the.next(the.segment->verdicts).verdict, Verdict::applied);
  const State<double> flown = the.tick.fleet().vehicles()[0].state;
  EXPECT_EQ(the.command(kStartAtNextBeat, 3600'000 * kMs).verdict, Verdict::accepted);
  the.step(2);
  EXPECT_EQ(the.next(the.segment->verdicts).verdict, Verdict::applied);
  const VerdictRecord waits = the.command(7200'000 * kMs, kMs);
  EXPECT_EQ(waits.verdict, Verdict::accepted);

  const ControlAnswerRecord reset = the.control(ControlAction::reset);
  EXPECT_EQ(reset.refusal, ControlRefusal::none);
  EXPECT_EQ(reset.step, 0U);
  EXPECT_EQ(the.tick.report().run.load(), 1U);
  const VerdictRecord superseded = the.next(the.segment->verdicts);
  EXPECT_EQ(superseded.verdict, Verdict::superseded);
  EXPECT_EQ(superseded.sequence, waits.sequence);

  EXPECT_EQ(the.command(25 * kMs, 20 * kMs).verdict, Verdict::accepted);
  EXPECT_EQ(the.step(40).step, 40U);
  EXPECT_EQ(the.tick.fleet().vehicles()[0].state, flown);
}

TEST(RunControl, resets_a_run_that_goes_by_the_clock) {
  scene::Scene scene = free_running();
  scene.simulation.pace = scene::Pace::clock;
  scene.simulation.step_ns = kMs;
  Running the(scene);
  EXPECT_TRUE(Running::wait_for([&] { return the.steps_taken() > 20; }));
  EXPECT_EQ(the.control(ControlAction::reset).step, 0U);
  EXPECT_TRUE(Running::wait_for([&] { return the.steps_taken() > 5; }));
}

TEST(RunControl, reset_ends_what_is_being_handed_over_of_the_run_before) {
  scene::Scene scene = tick_scene(0);
  scene.simulation.pace = scene::Pace::clock;
  scene.simulation.step_ns = kMs;
  scene.service.run_control = true;
  scene.spacecraft.assign(1000, scene.spacecraft[0]);
  scene.telemetry = {};
  scene.telemetry.fleet_every = 1'000'000;
  Running the(scene);
  the.segment->snapshot_requested = 1;  // whereupon a beat begins to
  ASSERT_TRUE(Running::wait_for([&] { return the.segment->snapshot_requested.load() == 0; }));
  EXPECT_EQ(the.control(ControlAction::reset).refusal, ControlRefusal::none);
  EXPECT_EQ(test::fleet_of(the.segment).count, 2U);
  EXPECT_GT(test::fleet_of(the.segment).header.step, 0U);
}

TEST(RunControl, is_written_down_with_its_step_and_outcome_where_it_changes_the_fleet) {
  const auto hot = std::make_unique<HotJournal>();
  JournalWriter journal(*hot, 1);
  Running the(lockstep(), &journal);
  EXPECT_EQ(the.control(ControlAction::pause).refusal, ControlRefusal::none);
  EXPECT_EQ(hot->ring.size(), 0U) << "pause is the clock's alone";
  the.step(2);
  for (const ControlAction action : {ControlAction::set_state, ControlAction::set_inertia,
                                     ControlAction::set_target, ControlAction::reset}) {
    const ControlRefusal outcome = the.control(action).refusal;
    const auto recorded = hot->ring.pop();
    ASSERT_TRUE(recorded.has_value());
    EXPECT_EQ(recorded->kind, JournalKind::control);
    EXPECT_EQ(recorded->step, 2U);
    EXPECT_EQ(recorded->note, static_cast<std::uint32_t>(outcome));
    EXPECT_EQ(payload_of<ControlRecord>(*recorded).action, action);
  }
  EXPECT_EQ(hot->step.load(), 0U) << "a reset sets the journal's step back before it is written";
  the.step(3);
  the.command(kStartAtNextBeat, 15 * kMs);
  const auto recorded = hot->ring.pop();
  ASSERT_TRUE(recorded.has_value());
  EXPECT_EQ(recorded->kind, JournalKind::command);
  EXPECT_EQ(recorded->step, 3U) << "the step that it begins with";
}

TEST(RunControl, still_pauses_when_the_journal_is_full_and_changes_nothing_that_it_cannot_hold) {
  const auto hot = std::make_unique<HotJournal>();
  JournalWriter journal(*hot, 1);
  while (journal.has_room()) {
    journal.write(JournalKind::command, 0, 0, CommandRecord{});
  }
  Running the(lockstep(), &journal);
  EXPECT_EQ(the.control(ControlAction::pause).refusal, ControlRefusal::none);
  EXPECT_EQ(the.control(ControlAction::reset).refusal, ControlRefusal::not_recorded);
  EXPECT_EQ(the.control(ControlAction::set_state).refusal, ControlRefusal::not_recorded);
}

TEST(RunControl, refuses_everything_once_the_clock_is_halted) {
  scene::Scene scene = free_running();
  scene.simulation.pace = scene::Pace::clock;
  scene.simulation.rate = 1e6;
  scene.budget.on_overrun = scene::Overrun::halt;
  scene.budget.step_ns = 1;
  Running the(scene);
  EXPECT_TRUE(Running::wait_for([&] { return the.tick.report().halted.load() != 0; }));
  EXPECT_EQ(the.control(ControlAction::reset).refusal, ControlRefusal::not_now);
  EXPECT_EQ(the.step(1).refusal, StepRefusal::halted);
}

}  // namespace
}  // namespace adstar::runtime
