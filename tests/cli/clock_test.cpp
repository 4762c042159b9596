// The verbs that hold a clock, against a daemon that the test plays.

#include <cstdint>
#include <functional>

#include "tests/cli/fake_daemon.hpp"

namespace adstar::testing {
namespace {

/// adstard's side of step requests and run control.
class FakeClock {
 public:
  explicit FakeClock(const dds::ParticipantOptions& place)
      : participant_(place),
        requests_(participant_),
        replies_(participant_),
        controls_(participant_),
        statuses_(participant_),
        wait_set_(participant_) {
    wait_set_.attach(requests_);
    wait_set_.attach(controls_);
  }

  /// Answers until the client ends; returns its exit code. Throws at the deadline.
  int serve(Process& client) {
    const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (!client.exit_code()) {
      if (std::chrono::steady_clock::now() > until) {
        throw std::runtime_error("the client still runs; it said:\n" + client.out() + client.err());
      }
      wait_set_.wait(std::chrono::milliseconds(10));
      requests_.take([&](const adstar_StepRequest& request, const dds_sample_info_t&) {
        heard.push_back(request);
        reply(request);
      });
      controls_.take([&](const adstar_RunControl& control, const dds_sample_info_t&) {
        controlled.push_back(control);
        adstar_RunControlStatus status{};
        dds::set_text(status.service, dds::text_of(control.service));
        status.commander = control.commander;
        status.sequence_number = control.sequence_number;
        status.action = control.action;
        status.refusal = refusal;
        status.step = 1200;
        status.time_ns = 12'000'000'000;
        statuses_.write(status);
      });
    }
    return *client.exit_code();
  }

  void answer(const adstar_StepRequest& request, adstar_StepOutcome outcome,
              adstar_StepRefusal why = adstar_STEP_REFUSAL_NONE) {
    adstar_StepReply sample{};
    dds::set_text(sample.service, dds::text_of(request.service));
    sample.requester = request.requester;
    sample.sequence_number = request.sequence_number;
    sample.outcome = outcome;
    sample.refusal = why;
    sample.step = 1200;
    sample.time_ns = 12'000'000'000;
    replies_.write(sample);
  }

  const dds::Participant& participant() const { return participant_; }

  std::function<void(const adstar_StepRequest&)> reply = [](const adstar_StepRequest&) {};
  adstar_ControlRefusal refusal = adstar_CONTROL_REFUSAL_NONE;
  std::vector<adstar_StepRequest> heard;
  std::vector<adstar_RunControl> controlled;

 private:
  dds::Participant participant_;
  dds::Reader<adstar_StepRequest> requests_;
  dds::Writer<adstar_StepReply> replies_;
  dds::Reader<adstar_RunControl> controls_;
  dds::Writer<adstar_RunControlStatus> statuses_;
  dds::WaitSet wait_set_;
};

TEST(Step, repeats_one_request_until_its_final_answer) {
  const auto place = own_place(50);
  FakeClock clock(place);
  clock.reply = [&](const adstar_StepRequest& request) {
    if (clock.heard.size() > 2) {
      clock.answer(request, clock.heard.size() < 5 ? adstar_STEP_ACCEPTED : adstar_STEP_DONE);
    }
  };
  Process client(at_place({"step", "--steps", "100", "--service", "fake"}, place));
  EXPECT_EQ(clock.serve(client), 0) << client.err();
  EXPECT_EQ(client.out(), "'fake' stands at step 1200 (12 s)\n");
  ASSERT_GE(clock.heard.size(), 5U);
  for (const adstar_StepRequest& request : clock.heard) {
    EXPECT_EQ(dds::text_of(request.service), "fake");
    EXPECT_EQ(request.steps, 100U);
    EXPECT_EQ(request.sequence_number, 1U);
    EXPECT_EQ(request.requester.low, clock.heard[0].requester.low);
  }
}

TEST(Step, accepted_keeps_it_waiting_beyond_its_timeout) {
  const auto place = own_place(51);
  FakeClock clock(place);
  const auto begun = std::chrono::steady_clock::now();
  clock.reply = [&](const adstar_StepRequest& request) {
    const bool late = std::chrono::steady_clock::now() - begun > std::chrono::milliseconds(2500);
    clock.answer(request, late ? adstar_STEP_ENDED : adstar_STEP_ACCEPTED);
  };
  Process client(at_place({"step", "--service", "fake", "--timeout", "1s"}, place));
  EXPECT_EQ(clock.serve(client), 0) << client.err();
  EXPECT_EQ(client.out(), "'fake' has ended its run at step 1200 (12 s)\n");
}

TEST(Step, a_refusal_is_exit_code_3_and_a_sentence) {
  const auto place = own_place(52);
  FakeClock clock(place);
  clock.reply = [&](const adstar_StepRequest& request) {
    clock.answer(request, adstar_STEP_REFUSED, adstar_STEP_REFUSAL_NOT_STANDING);
  };
  Process client(at_place({"step", "--service", "fake"}, place));
  EXPECT_EQ(clock.serve(client), 3) << client.err();
  expect_golden("step_not_standing", client.out());
}

TEST(Step, an_interruption_is_exit_code_3) {
  const auto place = own_place(53);
  FakeClock clock(place);
  clock.reply = [&](const adstar_StepRequest& request) {
    clock.answer(request, adstar_STEP_INTERRUPTED);
  };
  Process client(at_place({"step", "--service", "fake"}, place));
  EXPECT_EQ(clock.serve(client), 3);
  EXPECT_EQ(client.out(),
            "'fake' was interrupted at step 1200 (12 s): paused, reset, halted or stopped\n");
}

TEST(Step, a_silent_daemon_is_exit_code_4) {
  const auto place = own_place(54);
  FakeClock clock(place);
  Process client(at_place({"step", "--service", "fake", "--timeout", "400ms"}, place));
  EXPECT_EQ(clock.serve(client), 4);
  EXPECT_EQ(client.out(), "");
  EXPECT_NE(client.err().find("no answer from service 'fake' within 400ms"), std::string::npos)
      << client.err();
  EXPECT_NE(
      client.err().find("The steps may still be taken: `adstar step --steps 0 --timeout 60s` asks"),
      std::string::npos)
      << client.err();
}

TEST(Step, that_only_asks_warns_of_no_steps) {
  const auto place = own_place(94);
  FakeClock clock(place);
  Process client(
      at_place({"step", "--steps", "0", "--service", "fake", "--timeout", "400ms"}, place));
  EXPECT_EQ(clock.serve(client), 4);
  EXPECT_EQ(client.err().find("may still be taken"), std::string::npos) << client.err();
}

TEST(Step, finds_the_only_service_and_asks_which_of_several) {
  const auto place = own_place(55);
  FakeClock clock(place);
  clock.reply = [&](const adstar_StepRequest& request) { clock.answer(request, adstar_STEP_DONE); };
  dds::Writer<adstar_ServiceStatus> statuses(clock.participant());
  adstar_ServiceStatus status{};
  dds::set_text(status.service, "one");
  statuses.write(status);
  {
    Process client(at_place({"step"}, place));
    EXPECT_EQ(clock.serve(client), 0) << client.err();
    EXPECT_EQ(client.out(), "'one' stands at step 1200 (12 s)\n");
  }
  dds::set_text(status.service, "two");
  statuses.write(status);
  Process client(at_place({"step"}, place));
  EXPECT_EQ(clock.serve(client), 2);
  EXPECT_EQ(client.err(),
            "adstar step: several services are on the bus: 'one', 'two'; choose with --service\n");
}

TEST(RunControl, each_verb_asks_for_its_action) {
  const std::pair<const char*, adstar_ControlAction> verbs[] = {{"pause", adstar_CONTROL_PAUSE},
                                                                {"resume", adstar_CONTROL_RESUME},
                                                                {"reset", adstar_CONTROL_RESET}};
  const auto place = own_place(56);
  FakeClock clock(place);
  for (const auto& [verb, action] : verbs) {
    clock.controlled.clear();
    Process client(at_place({verb, "--service", "fake"}, place));
    EXPECT_EQ(clock.serve(client), 0) << client.err();
    EXPECT_EQ(client.out(), "done by 'fake' at step 1200 (12 s)\n");
    ASSERT_FALSE(clock.controlled.empty());
    EXPECT_EQ(clock.controlled[0].action, action);
  }
}

TEST(RunControl, set_state_and_set_inertia_carry_their_numbers) {
  const auto place = own_place(57);
  FakeClock clock(place);
  {
    Process client(at_place({"set-state", "sat1", "--attitude", "1,0,-.5,0", "--rate",
                             "0.1,-2e-3,0", "--service", "fake"},
                            place));
    EXPECT_EQ(clock.serve(client), 0) << client.err();
    ASSERT_FALSE(clock.controlled.empty());
    const adstar_RunControl& heard = clock.controlled[0];
    EXPECT_EQ(heard.action, adstar_CONTROL_SET_STATE);
    EXPECT_EQ(dds::text_of(heard.spacecraft), "sat1");
    EXPECT_EQ(heard.attitude_body_to_inertial.y, -0.5);
    EXPECT_EQ(heard.angular_velocity_body_rad_s.y, -2e-3);
  }
  clock.controlled.clear();
  clock.refusal = adstar_CONTROL_REFUSAL_BAD_INERTIA;
  Process client(
      at_place({"set-inertia", "sat1", "--inertia", "1,2,3,.1,.2,.3", "--service", "fake"}, place));
  EXPECT_EQ(clock.serve(client), 3) << client.err();
  expect_golden("set_inertia_refused", client.out());
  ASSERT_FALSE(clock.controlled.empty());
  const adstar_InertiaTensor& J = clock.controlled[0].inertia_body_kg_m2;
  EXPECT_EQ(J.zz, 3.0);
  EXPECT_EQ(J.xy, 0.1);
  EXPECT_EQ(J.yz, 0.3);
}

TEST(RunControl, set_target_carries_its_attitude_and_says_where_there_is_none_to_replace) {
  const auto place = own_place(58);
  FakeClock clock(place);
  clock.refusal = adstar_CONTROL_REFUSAL_NO_TARGET;
  Process client(
      at_place({"set-target", "sat1", "--attitude", "1,0,-.5,0", "--service", "fake"}, place));
  EXPECT_EQ(clock.serve(client), 3) << client.err();
  expect_golden("set_target_refused", client.out());
  ASSERT_FALSE(clock.controlled.empty());
  EXPECT_EQ(clock.controlled[0].action, adstar_CONTROL_SET_TARGET);
  EXPECT_EQ(clock.controlled[0].attitude_body_to_frame.y, -0.5);
}

TEST(RunControl, numbers_that_are_none_are_a_usage_error) {
  for (const char* wrong : {"1,2", "1,2,3,4", "1,2,x", "1,2,nan", "1, 2,3", ""}) {
    const Outcome outcome = client({"set-inertia", "sat1", "--inertia", wrong});
    EXPECT_EQ(outcome.code, 2) << wrong;
    EXPECT_NE(outcome.err.find("try 0.9,1.1,1.6"), std::string::npos) << outcome.err;
  }
}

}  // namespace
}  // namespace adstar::testing
