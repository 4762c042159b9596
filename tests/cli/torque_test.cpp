// adstar torque against a daemon that the test plays.

#include <cmath>
#include <cstdint>
#include <ostream>
#include <set>

#include "tests/cli/fake_daemon.hpp"

namespace adstar::testing {
namespace {

using Answers = FakeDaemon::Answers;

std::vector<std::string> pulse(std::vector<std::string> more = {}) {
  std::vector<std::string> arguments{"torque", "sat1", "--torque-n-m", "0.01",
                                     "-.5",    "0.25", "--for",        "5s"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST(Torque, repeats_one_sequence_number_until_it_is_answered) {
  const auto place = own_place(60);
  FakeDaemon daemon(place);
  Process client(at_place(pulse({"--actuator", "trim", "--priority", "3"}), place));
  const int code = daemon.serve(client, [&](const adstar_TorqueCommand& command) {
    return daemon.heard.size() < 4 ? Answers{}
                                   : Answers{answer_to(command, adstar_VERDICT_APPLIED)};
  });
  EXPECT_EQ(code, 0) << client.err();
  EXPECT_EQ(client.out(),
            "applied by 'fake': step 1200, from 12 s to 17 s, torque [0.01, -0.5, 0.25] N m\n");
  ASSERT_GE(daemon.heard.size(), 4U);
  for (const adstar_TorqueCommand& command : daemon.heard) {
    EXPECT_EQ(dds::text_of(command.spacecraft), "sat1");
    EXPECT_EQ(dds::text_of(command.actuator), "trim");
    EXPECT_EQ(command.commander.high, daemon.heard[0].commander.high);
    EXPECT_EQ(command.commander.low, daemon.heard[0].commander.low);
    EXPECT_EQ(command.sequence_number, 1U);
    EXPECT_EQ(command.priority, 3);
    EXPECT_EQ(command.start_time_ns, adstar_START_AT_NEXT_BEAT);
    EXPECT_EQ(command.end_time_ns, 0);
    EXPECT_EQ(command.duration_ns, 5'000'000'000);
    EXPECT_EQ(command.torque_n_m.y, -0.5);
  }
}

TEST(Torque, at_and_until_are_simulation_time) {
  const auto place = own_place(61);
  FakeDaemon daemon(place);
  Process client(at_place(
      {"torque", "sat1", "--torque-n-m", "0", "0", "1", "--at", "20s", "--until", "20.5s"}, place));
  const int code = daemon.serve(client, [&](const adstar_TorqueCommand& command) {
    return Answers{answer_to(command, adstar_VERDICT_ACCEPTED)};
  });
  EXPECT_EQ(code, 0) << client.err();
  EXPECT_EQ(client.out(),
            "accepted by 'fake' at step 1200 (12 s): waits, from 20 s to 20.5 s, torque [0, 0, 1] "
            "N m\n");
  ASSERT_FALSE(daemon.heard.empty());
  EXPECT_EQ(daemon.heard[0].start_time_ns, 20'000'000'000);
  EXPECT_EQ(daemon.heard[0].end_time_ns, 20'500'000'000);
  EXPECT_EQ(daemon.heard[0].duration_ns, 0);
}

TEST(Torque, does_not_wait_for_a_clock_that_stands) {
  const auto place = own_place(63);
  FakeDaemon daemon(place);
  Process client(at_place(pulse(), place));
  const int code = daemon.serve(client, [](const adstar_TorqueCommand& command) {
    return Answers{answer_to(command, adstar_VERDICT_ACCEPTED)};
  });
  EXPECT_EQ(code, 0) << client.err();
  EXPECT_EQ(client.out().find("accepted by 'fake' at step 1200 (12 s): waits"), 0U) << client.out();
}

TEST(Torque, wait_hears_the_final_verdict_too) {
  const auto place = own_place(62);
  FakeDaemon daemon(place);
  Process client(at_place(pulse({"--at", "20s", "--wait"}), place));
  const int code = daemon.serve(client, [&](const adstar_TorqueCommand& command) {
    // It asks again while it waits; then the start has come.
    return Answers{answer_to(
        command, client.out().empty() ? adstar_VERDICT_ACCEPTED : adstar_VERDICT_SUPERSEDED)};
  });
  EXPECT_EQ(code, 3) << client.err();
  const auto lines = lines_of(client.out());
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].find("accepted by 'fake'"), 0U);
  EXPECT_EQ(lines[1], "superseded by 'fake' at step 1200 (12 s): a newer command took its place");
}

struct VerdictCase {
  const char* name;
  adstar_Verdict verdict;
  adstar_RefusalReason reason;
  int exit_code;
};

void PrintTo(const VerdictCase& the, std::ostream* stream) { *stream << the.name; }

class VerdictOf : public ::testing::TestWithParam<VerdictCase> {};

TEST_P(VerdictOf, a_command_has_its_exit_code_and_one_sentence) {
  const auto place = own_place(86U + static_cast<std::uint32_t>(GetParam().verdict) +
                               static_cast<std::uint32_t>(GetParam().reason));
  FakeDaemon daemon(place);
  Process client(at_place(pulse(), place));
  const int code = daemon.serve(client, [&](const adstar_TorqueCommand& command) {
    adstar_CommandStatus status = answer_to(command, GetParam().verdict);
    status.reason = GetParam().reason;
    status.torque_applied_n_m.y =
        GetParam().verdict == adstar_VERDICT_CLAMPED ? -0.25 : command.torque_n_m.y;
    return Answers{status};
  });
  EXPECT_EQ(code, GetParam().exit_code) << client.err();
  EXPECT_EQ(client.err(), "");
  expect_golden(std::string("verdict_") + GetParam().name, client.out());
}

INSTANTIATE_TEST_SUITE_P(
    All, VerdictOf,
    ::testing::Values(
        VerdictCase{"applied", adstar_VERDICT_APPLIED, adstar_REASON_NONE, 0},
        VerdictCase{"applied_late", adstar_VERDICT_APPLIED_LATE, adstar_REASON_NONE, 0},
        VerdictCase{"clamped", adstar_VERDICT_CLAMPED, adstar_REASON_NONE, 0},
        VerdictCase{"superseded", adstar_VERDICT_SUPERSEDED, adstar_REASON_NONE, 3},
        VerdictCase{"expired", adstar_VERDICT_EXPIRED, adstar_REASON_NONE, 3},
        VerdictCase{"outranked", adstar_VERDICT_OUTRANKED, adstar_REASON_NONE, 3},
        VerdictCase{"not_finite", adstar_VERDICT_REFUSED, adstar_REASON_NOT_FINITE, 3},
        VerdictCase{"unknown_spacecraft", adstar_VERDICT_REFUSED, adstar_REASON_UNKNOWN_SPACECRAFT,
                    3},
        VerdictCase{"unknown_actuator", adstar_VERDICT_REFUSED, adstar_REASON_UNKNOWN_ACTUATOR, 3},
        VerdictCase{"no_authority", adstar_VERDICT_REFUSED, adstar_REASON_NO_AUTHORITY, 3}),
    [](const auto& the) { return std::string(the.param.name); });

TEST(Torque, not_a_number_is_the_daemons_to_refuse) {
  const auto place = own_place(64);
  FakeDaemon daemon(place);
  Process client(
      at_place({"torque", "sat1", "--torque-n-m", "nan", "0", "0", "--for", "1s"}, place));
  EXPECT_EQ(daemon.serve(client,
                         [](const adstar_TorqueCommand& command) {
                           return Answers{refusal_of(command, adstar_REASON_NOT_FINITE)};
                         }),
            3);
  ASSERT_FALSE(daemon.heard.empty());
  EXPECT_TRUE(std::isnan(daemon.heard[0].torque_n_m.x));
}

TEST(Torque, a_service_that_does_not_fly_it_does_not_speak_for_the_one_that_does) {
  const auto place = own_place(65);
  FakeDaemon daemon(place);
  Process client(at_place(pulse(), place));
  const int code = daemon.serve(client, [](const adstar_TorqueCommand& command) {
    adstar_CommandStatus other = refusal_of(command, adstar_REASON_UNKNOWN_SPACECRAFT);
    dds::set_text(other.service, "another");
    return Answers{other, answer_to(command, adstar_VERDICT_APPLIED, "right")};
  });
  EXPECT_EQ(code, 0);
  EXPECT_EQ(client.out().find("applied by 'right'"), 0U) << client.out();
}

TEST(Torque, hears_only_the_service_that_was_asked_for) {
  const auto place = own_place(66);
  FakeDaemon daemon(place);
  Process client(at_place(pulse({"--service", "right"}), place));
  const int code = daemon.serve(client, [](const adstar_TorqueCommand& command) {
    return Answers{answer_to(command, adstar_VERDICT_EXPIRED, "wrong"),
                   answer_to(command, adstar_VERDICT_APPLIED, "right")};
  });
  EXPECT_EQ(code, 0) << client.out();
}

TEST(Torque, a_silent_daemon_is_exit_code_4) {
  const auto place = own_place(67);
  FakeDaemon daemon(place);
  Process client(at_place(pulse({"--timeout", "400ms"}), place));
  EXPECT_EQ(daemon.serve(client, [](const adstar_TorqueCommand&) { return Answers{}; }), 4);
  EXPECT_NE(client.err().find("though somebody listens to commands there"), std::string::npos)
      << client.err();
}

TEST(Torque, nobody_at_all_is_exit_code_4_and_says_what_to_check) {
  const auto place = own_place(68);
  const Outcome outcome = run(at_place(pulse({"--timeout", "300ms"}), place));
  EXPECT_EQ(outcome.code, 4);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err,
            "adstar torque: no answer within 300ms: nobody listens to commands on domain 68, "
            "interface lo, partition '" +
                place.partition +
                "'; is adstard running, and are domain, interface and partition those of its "
                "scene? A secured one hears only clients with --security.\n");
}

TEST(Torque, two_commanders_have_two_identities) {
  const auto place = own_place(69);
  FakeDaemon daemon(place);
  std::set<std::pair<std::uint64_t, std::uint64_t>> identities;
  for (int i = 0; i < 2; ++i) {
    Process client(at_place(pulse(), place));
    daemon.serve(client, [&](const adstar_TorqueCommand& command) {
      identities.emplace(command.commander.high, command.commander.low);
      return Answers{answer_to(command, adstar_VERDICT_APPLIED)};
    });
  }
  EXPECT_EQ(identities.size(), 2U);
}

}  // namespace
}  // namespace adstar::testing
