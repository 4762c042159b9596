// adstar monitor and adstar list against a daemon that the test plays.

#include <array>
#include <cmath>

#include "tests/cli/fake_daemon.hpp"

namespace adstar::testing {
namespace {

using Answers = FakeDaemon::Answers;

const FakeDaemon::Reply kDeaf = [](const adstar_TorqueCommand&) { return Answers{}; };

/// Telemetry of `sat1`, a step every call.
class Telemetry {
 public:
  explicit Telemetry(const dds::Participant& participant)
      : attitude_(participant), momentum_(participant) {}

  void publish(bool with_momentum = true) {
    runtime::TelemetryRecord record;
    record.step = ++step_;
    record.time_ns = static_cast<std::int64_t>(step_) * 10'000'000;
    record.q_IB = {1, 0, 0, 0};
    record.H_I_n_m_s = {0.1, 0.2, 0.3};
    attitude_.write(dds::to_attitude(record, "sat1", "fake"));
    if (with_momentum) {
      momentum_.write(dds::to_momentum(record, "sat1", "fake"));
    }
  }

 private:
  dds::Writer<adstar_AttitudeState> attitude_;
  dds::Writer<adstar_MomentumState> momentum_;
  std::uint64_t step_ = 0;
};

/// Who the fake daemon is: its roster and its status.
class Presence {
 public:
  Presence(const dds::Participant& participant, std::size_t spacecraft)
      : roster_(participant), status_(participant) {
    char body[] = "body", trim[] = "trim";
    std::array<char*, 2> actuators{body, trim};
    std::vector<adstar_RosterEntry> entries(spacecraft);
    for (std::size_t i = 0; i < spacecraft; ++i) {
      dds::set_text(entries[i].name, "sat" + std::to_string(i + 1));
      entries[i].actuators._length = entries[i].actuators._maximum = i == 0 ? 2 : 0;
      entries[i].actuators._buffer = actuators.data();
    }
    adstar_ServiceRoster roster{};
    dds::set_text(roster.service, "fake");
    roster.instance_low = 1;
    roster.chunks = 1;
    roster.spacecraft._length = roster.spacecraft._maximum =
        static_cast<std::uint32_t>(entries.size());
    roster.spacecraft._buffer = entries.data();
    roster_.write(roster);
    adstar_ServiceStatus status{};
    dds::set_text(status.service, "fake");
    status.instance_low = 1;
    status.state = adstar_SERVICE_RUNNING;
    status.step = 1'234'567;
    status.time_ns = 1'234'567'000'000;
    status.step_length_ns = 1'000'000;
    dds::set_text(status.pace, "clock");
    dds::set_text(status.scheme, "coadjoint_rk4");
    status.spacecraft = static_cast<std::uint32_t>(spacecraft);
    status.worst_momentum_residual_relative = 1.25e-16;
    status.commands_received = 12;
    status.commands_refused = 3;
    status_.write(status);
  }

 private:
  dds::Writer<adstar_ServiceRoster> roster_;
  dds::Writer<adstar_ServiceStatus> status_;
};

TEST(Monitor, joins_the_halves_of_a_step_into_csv_lines) {
  const auto place = own_place(76);
  FakeDaemon daemon(place);
  Telemetry telemetry(daemon.participant());
  Process client(at_place({"monitor", "--samples", "5"}, place));
  EXPECT_EQ(daemon.serve(client, kDeaf, [&] { telemetry.publish(); }), 0);
  const auto lines = lines_of(client.out());
  ASSERT_EQ(lines.size(), 6U) << client.out() << client.err();
  EXPECT_EQ(lines[0], lines_of(shell("$ADSTAR propagate configs/scenes/paper_free.toml").out)[0]);
  std::size_t whole = 0;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const auto fields = fields_of(lines[i]);
    ASSERT_EQ(fields.size(), 18U) << lines[i];
    EXPECT_EQ(fields[0], "sat1");
    EXPECT_EQ(std::stoll(fields[1]) * 10, std::llround(std::stod(fields[2]) * 1000));
    whole += fields[3] == "1" && fields[10] == "0.10000000000000001" ? 1 : 0;
  }
  EXPECT_GE(whole, 3U) << client.out();
}

TEST(Monitor, leaves_fields_empty_when_the_other_half_never_comes) {
  const auto place = own_place(77);
  FakeDaemon daemon(place);
  Telemetry telemetry(daemon.participant());
  Process client(at_place({"monitor", "sat1", "--samples", "2"}, place));
  EXPECT_EQ(daemon.serve(client, kDeaf, [&] { telemetry.publish(false); }), 0);
  const auto lines = lines_of(client.out());
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_TRUE(lines[1].ends_with(",1,0,0,0,0,0,0,,,,,,,,")) << lines[1];
}

TEST(Monitor, json_lines_are_objects_with_the_csv_names) {
  const auto place = own_place(78);
  FakeDaemon daemon(place);
  Telemetry telemetry(daemon.participant());
  Process client(at_place({"monitor", "--format", "json", "--samples", "3"}, place));
  EXPECT_EQ(daemon.serve(client, kDeaf, [&] { telemetry.publish(); }), 0);
  const Scratch scratch;
  const std::string file = scratch.write("lines.json", client.out());
  const Outcome python =
      run({"python3", "-c",
           "import json,sys\n"
           "rows=[json.loads(line) for line in open(sys.argv[1])]\n"
           "print(len(rows), all(r['spacecraft']=='sat1' for r in rows), ','.join(rows[0]))",
           file});
  const std::string header =
      lines_of(shell("$ADSTAR propagate configs/scenes/paper_free.toml").out)[0];
  EXPECT_EQ(python.out, "3 True " + header + "\n") << python.err << client.out();
}

TEST(Monitor, shows_a_fleet_whose_members_have_no_topics_of_their_own) {
  const auto place = own_place(79);
  FakeDaemon daemon(place);
  const Presence presence(daemon.participant(), 3);
  dds::Writer<adstar_FleetState> fleet(daemon.participant());
  std::array<adstar_FleetMember, 3> members{};
  for (std::size_t i = 0; i < members.size(); ++i) {
    members[i].attitude_body_to_inertial = {1, 0, 0, 0};
    members[i].momentum_inertial_n_m_s = {static_cast<double>(i + 1), 0, 0};
  }
  std::uint64_t step = 0;
  Process client(at_place({"monitor", "--samples", "3"}, place));
  const int code = daemon.serve(client, kDeaf, [&] {
    adstar_FleetState sample{};
    dds::set_text(sample.service, "fake");
    sample.step = ++step;
    sample.members._length = sample.members._maximum = members.size();
    sample.members._buffer = members.data();
    fleet.write(sample);
  });
  EXPECT_EQ(code, 0) << client.err();
  const auto lines = lines_of(client.out());
  ASSERT_EQ(lines.size(), 4U) << client.out();
  for (std::size_t i = 1; i < 4; ++i) {
    const auto fields = fields_of(lines[i]);
    EXPECT_EQ(fields[0], "sat" + std::to_string(i));
    EXPECT_EQ(fields[10], std::to_string(i));
    EXPECT_EQ(fields[13], std::to_string(i));
    EXPECT_EQ(fields[17], "");
  }
}

TEST(Monitor, says_once_that_no_daemon_is_heard_and_gives_up_when_told_to) {
  const auto place = own_place(80);
  const Outcome outcome = run(at_place({"monitor", "--timeout", "2500ms"}, place));
  EXPECT_EQ(outcome.code, 4);
  const auto lines = lines_of(outcome.err);
  ASSERT_EQ(lines.size(), 2U) << outcome.err;
  EXPECT_EQ(lines[0].find("adstar monitor: no daemon heard on domain 80, interface lo"), 0U);
  EXPECT_EQ(lines[1].find("adstar monitor: nothing came within 2.5s on domain 80"), 0U);
}

TEST(Monitor, names_the_nearest_spacecraft_when_the_one_asked_for_is_not_there) {
  const auto place = own_place(81);
  FakeDaemon daemon(place);
  const Presence presence(daemon.participant(), 1);
  Process client(at_place({"monitor", "stat1", "--timeout", "2500ms"}, place));
  EXPECT_EQ(daemon.serve(client, kDeaf), 4);
  EXPECT_NE(client.err().find("no telemetry of stat1; waiting. Did you mean 'sat1'?"),
            std::string::npos)
      << client.err();
}

TEST(Monitor, ends_with_0_on_ctrl_c) {
  const auto place = own_place(82);
  FakeDaemon daemon(place);
  Telemetry telemetry(daemon.participant());
  Process client(at_place({"monitor"}, place));
  bool sent = false;
  const int code = daemon.serve(client, kDeaf, [&] {
    telemetry.publish();
    if (!sent && lines_of(client.out()).size() > 1) {
      sent = true;
      client.send(SIGINT);
    }
  });
  EXPECT_TRUE(sent);
  EXPECT_EQ(code, 0) << client.err();
}

TEST(List, shows_daemons_with_their_spacecraft_and_actuators) {
  const auto place = own_place(83);
  FakeDaemon daemon(place);
  const Presence presence(daemon.participant(), 2);
  Process client(at_place({"list"}, place));
  EXPECT_EQ(daemon.serve(client, kDeaf), 0) << client.err();
  expect_golden("list", client.out());
}

TEST(List, summarises_a_fleet_unless_asked_for_all) {
  const auto place = own_place(84);
  FakeDaemon daemon(place);
  const Presence presence(daemon.participant(), 450);
  Process client(at_place({"list"}, place));
  EXPECT_EQ(daemon.serve(client, kDeaf), 0) << client.err();
  EXPECT_EQ(lines_of(client.out()).back(), "    ... 430 more; --all shows them");
  Process all(at_place({"list", "--all"}, place));
  EXPECT_EQ(daemon.serve(all, kDeaf), 0) << all.err();
  EXPECT_EQ(lines_of(all.out()).back(), "    sat450  no actuators");
}

TEST(List, of_a_standby_says_that_its_spacecraft_are_the_primary_s) {
  const auto place = own_place(93);
  FakeDaemon daemon(place);
  dds::Writer<adstar_ServiceStatus> statuses(daemon.participant());
  adstar_ServiceStatus status{};
  dds::set_text(status.service, "fake.standby");
  status.state = adstar_SERVICE_STANDBY;
  statuses.write(status);
  Process client(at_place({"list"}, place));
  EXPECT_EQ(daemon.serve(client, kDeaf), 0) << client.err();
  const auto lines = lines_of(client.out());
  ASSERT_EQ(lines.size(), 3U) << client.out();
  EXPECT_EQ(lines[0].find("service 'fake.standby': a standby, "), 0U) << lines[0];
  EXPECT_EQ(lines[2], "  spacecraft: none until it goes on in the primary's place");
}

TEST(List, nobody_is_exit_code_4) {
  const auto place = own_place(85);
  const Outcome outcome = run(at_place({"list", "--timeout", "300ms"}, place));
  EXPECT_EQ(outcome.code, 4);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err.find("adstar list: no service answers within 300ms on domain 85"), 0U)
      << outcome.err;
}

/// A StepTiming with a number of its own in every field that is shown.
adstar_StepTiming some_timing() {
  adstar_StepTiming timing{};
  dds::set_text(timing.service, "fake");
  timing.step = 12'345;
  timing.time_ns = 12'345'000'000;
  timing.wake_up_lateness = {
      {12'345, 3'100, 9'800, 33'000, 120'400}, 40'000'000, {3, 12'340, 2}, 200'000, 0};
  timing.command_phase = {{12'345, 100, 300, 2'100, 8'000}, 0, {}, 0, 0};
  timing.step_phase = {{12'345, 400, 700, 5'000, 51'000}, 6'000'000, {0, 12'345}, 50'000, 1};
  timing.hand_over_phase = {{12'345, 90, 1'900, 25'000, 60'000}, 0, {}, 0, 0};
  timing.tick_body = {12'345, 600, 2'900, 27'000, 61'000};
  timing.late_beats = 6;
  timing.late_after_work = 2;
  timing.late_after_loss = 1;
  timing.late_after_sleep = 3;
  timing.missed_beats = 5;
  timing.behind_wall_ns = 5'000'000;
  timing.involuntary_switches = 4;
  timing.most_commands_waiting = 7;
  timing.fifo_scheduling = true;
  return timing;
}

TEST(Timing, shows_every_part_of_a_beat_against_its_budget) {
  const auto place = own_place(86);
  FakeDaemon daemon(place);
  dds::Writer<adstar_StepTiming> writer(daemon.participant());
  writer.write(some_timing());
  Process client(at_place({"timing", "fake", "--samples", "1"}, place));
  EXPECT_EQ(daemon.serve(client, kDeaf), 0) << client.err();
  expect_golden("timing", client.out());
}

TEST(Timing, is_a_line_of_json_for_machines) {
  const auto place = own_place(87);
  FakeDaemon daemon(place);
  dds::Writer<adstar_StepTiming> writer(daemon.participant());
  writer.write(some_timing());
  Process client(at_place({"timing", "--json", "--samples", "1"}, place));
  EXPECT_EQ(daemon.serve(client, kDeaf), 0) << client.err();
  const Scratch scratch;
  const std::string file = scratch.write("line.json", client.out());
  const Outcome python = run({"python3", "-c",
                              "import json,sys\n"
                              "t=json.loads(open(sys.argv[1]).read())\n"
                              "print(t['service'], t['step_phase']['over_budget'], "
                              "t['wake_up_lateness']['p99_9_ns'], t['behind_wall_ns'])\n"
                              "w=t['wake_up_lateness']\n"
                              "print(w['sum_ns'], w['quarter_octaves'][:4], "
                              "len(w['quarter_octaves']), t['step_phase']['quarter_octaves'][1])",
                              file});
  EXPECT_EQ(python.out, "fake 1 33000 5000000\n40000000 [3, 12340, 2, 0] 90 12345\n")
      << python.err << client.out();
}

TEST(Timing, of_a_service_that_is_not_there_is_exit_code_4) {
  const auto place = own_place(88);
  const Outcome outcome = run(at_place({"timing", "nobody", "--timeout", "300ms"}, place));
  EXPECT_EQ(outcome.code, 4);
  EXPECT_EQ(outcome.err.find("adstar timing: no timing of nobody within 300ms on domain 88"), 0U)
      << outcome.err;
}

}  // namespace
}  // namespace adstar::testing
