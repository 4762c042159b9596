// adstar torque --profile against a daemon that the test plays.

#include <map>

#include "tests/cli/fake_daemon.hpp"

namespace adstar::testing {
namespace {

using Answers = FakeDaemon::Answers;

const std::string kGood = std::string(ADSTAR_SOURCE_DIR) + "/tests/cli/scenes/good.csv";

/// The first sample of each sequence number.
std::map<std::uint64_t, adstar_TorqueCommand> by_sequence(const FakeDaemon& daemon) {
  std::map<std::uint64_t, adstar_TorqueCommand> commands;
  for (const adstar_TorqueCommand& command : daemon.heard) {
    commands.emplace(command.sequence_number, command);
  }
  return commands;
}

TEST(Profile, rows_become_commands_from_the_given_start) {
  const auto place = own_place(70);
  FakeDaemon daemon(place);
  Process client(at_place({"torque", "sat1", "--profile", kGood, "--at", "30s"}, place));
  const int code = daemon.serve(client, [](const adstar_TorqueCommand& command) {
    return Answers{answer_to(command, adstar_VERDICT_ACCEPTED)};
  });
  EXPECT_EQ(code, 0) << client.err();
  const auto commands = by_sequence(daemon);
  ASSERT_EQ(commands.size(), 2U);
  EXPECT_EQ(commands.at(1).start_time_ns, 30'000'000'000);
  EXPECT_EQ(commands.at(1).end_time_ns, 30'500'000'000);
  EXPECT_EQ(commands.at(1).torque_n_m.x, 0.01);
  EXPECT_EQ(commands.at(2).start_time_ns, 30'500'000'000);
  EXPECT_EQ(commands.at(2).end_time_ns, 31'000'000'000);
  EXPECT_EQ(commands.at(2).torque_n_m.y, 0.02);
  expect_golden("profile_accepted", client.out());
}

TEST(Profile, without_a_start_takes_the_actuator_and_begins_where_that_ends) {
  const auto place = own_place(71);
  FakeDaemon daemon(place);
  Process client(at_place({"torque", "sat1", "--profile", kGood}, place));
  const int code = daemon.serve(client, [](const adstar_TorqueCommand& command) {
    return Answers{answer_to(command, adstar_VERDICT_APPLIED)};
  });
  EXPECT_EQ(code, 0) << client.err();
  const auto commands = by_sequence(daemon);
  ASSERT_EQ(commands.size(), 3U);
  EXPECT_EQ(commands.at(1).start_time_ns, adstar_START_AT_NEXT_BEAT);
  EXPECT_EQ(commands.at(1).duration_ns, 250'000'000);
  EXPECT_EQ(commands.at(1).torque_n_m.x, 0.0);
  EXPECT_EQ(commands.at(2).start_time_ns, 12'250'000'000);
  EXPECT_EQ(commands.at(3).end_time_ns, 13'250'000'000);
  expect_golden("profile_applied", client.out());
}

TEST(Profile, begins_on_a_clock_that_stands_where_the_claim_that_waits_ends) {
  const auto place = own_place(90);
  FakeDaemon daemon(place);
  Process client(at_place({"torque", "sat1", "--profile", kGood}, place));
  const int code = daemon.serve(client, [](const adstar_TorqueCommand& command) {
    return Answers{answer_to(command, adstar_VERDICT_ACCEPTED)};
  });
  EXPECT_EQ(code, 0) << client.err();
  const auto commands = by_sequence(daemon);
  ASSERT_EQ(commands.size(), 3U);
  EXPECT_EQ(commands.at(2).start_time_ns, 12'250'000'000);
  EXPECT_EQ(commands.at(3).end_time_ns, 13'250'000'000);
  expect_golden("profile_standing", client.out());
}

TEST(Profile, that_waits_for_its_rows_says_so_and_ends_on_ctrl_c) {
  const auto place = own_place(91);
  FakeDaemon daemon(place);
  Process client(at_place({"torque", "sat1", "--profile", kGood, "--wait"}, place));
  const std::string waits = "adstar torque: 2 rows are accepted and wait for their start\n";
  bool sent = false;
  const int code = daemon.serve(
      client,
      [](const adstar_TorqueCommand& command) {
        return Answers{answer_to(command, adstar_VERDICT_ACCEPTED)};
      },
      [&] {
        if (!sent && client.err() == waits) {
          sent = true;
          client.send(SIGINT);
        }
      });
  EXPECT_EQ(code, 1);
  EXPECT_EQ(client.err(),
            waits + "adstar torque: interrupted; rows that were accepted still run\n");
  EXPECT_EQ(lines_of(client.out()).back(), "profile of 2 rows: 2 accepted");
}

TEST(Profile, interrupted_before_its_first_row_says_that_none_was_sent) {
  const auto place = own_place(92);
  FakeDaemon daemon(place);
  Process client(at_place({"torque", "sat1", "--profile", kGood}, place));
  const int code = daemon.serve(client, [&](const adstar_TorqueCommand&) {
    client.send(SIGINT);
    return Answers{};
  });
  EXPECT_EQ(code, 1);
  EXPECT_EQ(client.err(), "adstar torque: interrupted; no row was sent\n");
}

TEST(Profile, sends_a_row_only_when_the_one_before_is_answered) {
  const auto place = own_place(72);
  FakeDaemon daemon(place);
  Process client(at_place({"torque", "sat1", "--profile", kGood, "--at", "30s"}, place));
  std::uint64_t answered = 0;
  std::map<std::uint64_t, int> asked;
  daemon.serve(client, [&](const adstar_TorqueCommand& command) {
    EXPECT_LE(command.sequence_number, answered + 1);
    if (++asked[command.sequence_number] < 3) {
      return Answers{};
    }
    answered = std::max(answered, command.sequence_number);
    return Answers{answer_to(command, adstar_VERDICT_ACCEPTED)};
  });
  EXPECT_EQ(answered, 2U);
}

TEST(Profile, keeps_at_most_32_rows_waiting_at_the_service) {
  const Scratch scratch;
  std::string text = "time_s,torque_x_n_m,torque_y_n_m,torque_z_n_m\n";
  for (int i = 0; i <= 40; ++i) {
    text += std::to_string(i) + ",0,0,0.01\n";
  }
  const std::string file = scratch.write("long.csv", text);
  const auto place = own_place(73);
  FakeDaemon daemon(place);
  Process client(at_place({"torque", "sat1", "--profile", file, "--at", "30s", "--wait"}, place));
  std::uint64_t newest = 0, begun = 0;
  const int code = daemon.serve(client, [&](const adstar_TorqueCommand& command) {
    newest = std::max(newest, command.sequence_number);
    EXPECT_LE(newest, begun + 32);
    if (newest >= begun + 32 || newest == 40) {
      // The oldest rows begin; the client hears it when it asks after them.
      begun = std::max(begun, command.sequence_number);
    }
    return Answers{answer_to(command, command.sequence_number <= begun ? adstar_VERDICT_APPLIED
                                                                       : adstar_VERDICT_ACCEPTED)};
  });
  EXPECT_EQ(code, 0) << client.err();
  EXPECT_EQ(newest, 40U);
  EXPECT_EQ(lines_of(client.out()).back(), "profile of 40 rows: 40 applied");
}

TEST(Profile, stops_at_a_refusal_with_the_worst_exit_code) {
  const auto place = own_place(74);
  FakeDaemon daemon(place);
  Process client(at_place({"torque", "sat1", "--profile", kGood, "--at", "30s"}, place));
  const int code = daemon.serve(client, [](const adstar_TorqueCommand& command) {
    return Answers{refusal_of(command, adstar_REASON_NO_AUTHORITY)};
  });
  EXPECT_EQ(code, 3);
  EXPECT_EQ(by_sequence(daemon).size(), 1U);
  EXPECT_EQ(lines_of(client.out()).back(),
            "profile of 2 rows: 1 refused, 1 without an answer or not sent");
}

TEST(Profile, a_daemon_that_falls_silent_is_exit_code_4) {
  const auto place = own_place(75);
  FakeDaemon daemon(place);
  Process client(
      at_place({"torque", "sat1", "--profile", kGood, "--at", "30s", "--timeout", "400ms"}, place));
  const int code = daemon.serve(client, [](const adstar_TorqueCommand& command) {
    return command.sequence_number == 1 ? Answers{answer_to(command, adstar_VERDICT_APPLIED)}
                                        : Answers{};
  });
  EXPECT_EQ(code, 4);
  EXPECT_EQ(lines_of(client.out()).back(),
            "profile of 2 rows: 1 applied, 1 without an answer or not sent");
}

}  // namespace
}  // namespace adstar::testing
