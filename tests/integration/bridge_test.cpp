// adstar-bridge between a segment that the test fills and empties, and DDS peers in the test.

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "service/dds/convert.hpp"
#include "service/dds/reader.hpp"
#include "service/dds/writer.hpp"
#include "tests/integration/bridge_harness.hpp"

namespace adstar {
namespace {

using runtime::BridgeState;
using testing::BridgeUnderTest;
using testing::eventually;

adstar_TorqueCommand command(const char* spacecraft, const char* actuator, std::uint64_t sequence) {
  adstar_TorqueCommand sample{};
  dds::set_text(sample.spacecraft, spacecraft);
  dds::set_text(sample.actuator, actuator);
  sample.commander = {7, 8};
  sample.sequence_number = sequence;
  sample.priority = 3;
  sample.start_time_ns = adstar_START_AT_NEXT_BEAT;
  sample.duration_ns = 5'000'000'000;
  sample.torque_n_m = {0.1, 0.2, 0.3};
  return sample;
}

runtime::TelemetryRecord telemetry(std::uint32_t spacecraft, std::uint64_t step,
                                   std::uint32_t topics) {
  runtime::TelemetryRecord record;
  record.spacecraft = spacecraft;
  record.step = step;
  record.topics = topics;
  return record;
}

class Bridge : public ::testing::Test {
 protected:
  Bridge() : where_(testing::private_corner()), client_(where_) {}

  void start(BridgeUnderTest& bridge) {
    bridge.start();
    ASSERT_TRUE(bridge.becomes(BridgeState::ready)) << bridge.segment()->bridge_message;
  }

  // As a client does: best effort may lose the first ones, so repeat.
  void send(BridgeUnderTest& bridge, const adstar_TorqueCommand& sample) {
    dds::Writer<adstar_TorqueCommand> commands(client_);
    ASSERT_TRUE(eventually([&] {
      commands.write(sample);
      return bridge.segment()->commands.size() > 0;
    }));
  }

  void push(BridgeUnderTest& bridge, const runtime::TelemetryRecord& record) {
    ASSERT_TRUE(bridge.segment()->telemetry.push(record));
    runtime::wake_bridge(*bridge.segment());
  }

  dds::ParticipantOptions where_;
  dds::Participant client_;
};

TEST_F(Bridge, hands_a_command_over_with_the_indices_of_the_scene) {
  BridgeUnderTest bridge(testing::two_spacecraft(where_), 2);
  start(bridge);
  send(bridge, command("sat2", "jets", 41));
  const auto record = bridge.segment()->commands.pop();
  ASSERT_TRUE(record);
  EXPECT_EQ(record->spacecraft, 1U);
  EXPECT_EQ(record->actuator, 1U);
  EXPECT_EQ(record->sequence, 41U);
  EXPECT_EQ(record->priority, 3);
  EXPECT_EQ(record->commander, (runtime::CommanderId{7, 8}));
  EXPECT_EQ(record->start_ns, runtime::kStartAtNextBeat);
  EXPECT_EQ(record->end_ns, 0);
  EXPECT_EQ(record->duration_ns, 5'000'000'000);
  EXPECT_EQ(record->value, (std::array{0.1, 0.2, 0.3}));
}

TEST_F(Bridge, does_not_judge_numbers) {
  BridgeUnderTest bridge(testing::two_spacecraft(where_), 2);
  start(bridge);
  adstar_TorqueCommand wild = command("sat1", "body", 0);
  wild.torque_n_m.x = std::numeric_limits<double>::quiet_NaN();
  wild.duration_ns = -1;
  send(bridge, wild);
  EXPECT_TRUE(std::isnan(bridge.segment()->commands.pop()->value[0]));
}

TEST_F(Bridge, counts_the_commands_that_find_the_ring_full) {
  BridgeUnderTest bridge(testing::two_spacecraft(where_), 2);
  start(bridge);
  dds::Writer<adstar_TorqueCommand> commands(client_);
  std::uint64_t sequence = 0;
  EXPECT_TRUE(eventually([&] {
    for (int i = 0; i < 32; ++i) {
      commands.write(command("sat1", "body", ++sequence));
    }
    return bridge.segment()->commands_lost.load() > 0;
  }));
  EXPECT_EQ(bridge.segment()->commands.size(), 4096U);
}

TEST_F(Bridge, publishes_a_verdict_as_command_status) {
  BridgeUnderTest bridge(testing::two_spacecraft(where_), 2);
  dds::Reader<adstar_CommandStatus> statuses(client_);
  start(bridge);
  runtime::VerdictRecord verdict;
  verdict.commander = {7, 8};
  verdict.sequence = 12;
  verdict.spacecraft = 1;
  verdict.actuator = 0;
  verdict.verdict = runtime::Verdict::clamped;
  verdict.step = 99;
  verdict.time_ns = 990'000'000;
  verdict.value = {0.5, 0, 0};
  ASSERT_TRUE(bridge.segment()->verdicts.push(verdict));
  runtime::wake_bridge(*bridge.segment());
  bool seen = false;
  ASSERT_TRUE(eventually([&] {
    statuses.take([&](const adstar_CommandStatus& status, const dds_sample_info_t&) {
      seen = true;
      EXPECT_EQ(dds::text_of(status.spacecraft), "sat2");
      EXPECT_EQ(dds::text_of(status.actuator), "wheels");
      EXPECT_EQ(dds::text_of(status.service), "fly");
      EXPECT_EQ(status.commander.low, 8U);
      EXPECT_EQ(status.sequence_number, 12U);
      EXPECT_EQ(status.verdict, adstar_VERDICT_CLAMPED);
      EXPECT_EQ(status.step, 99U);
      EXPECT_EQ(status.torque_applied_n_m.x, 0.5);
    });
    return seen;
  }));
}

TEST_F(Bridge, publishes_telemetry_on_the_topics_that_its_bits_name) {
  BridgeUnderTest bridge(testing::two_spacecraft(where_), 2);
  dds::Reader<adstar_AttitudeState> attitudes(client_);
  dds::Reader<adstar_MomentumState> momenta(client_);
  start(bridge);
  push(bridge, telemetry(0, 10, runtime::kTopicAttitude));
  push(bridge, telemetry(1, 20, runtime::kTopicMomentum));
  push(bridge, telemetry(1, 30, runtime::kTopicAttitude | runtime::kTopicMomentum));
  std::map<std::string, std::uint64_t> attitude;
  std::map<std::string, std::uint64_t> momentum;
  ASSERT_TRUE(eventually([&] {
    attitudes.take([&](const adstar_AttitudeState& state, const dds_sample_info_t&) {
      attitude[std::string(dds::text_of(state.spacecraft))] = state.step;
    });
    momenta.take([&](const adstar_MomentumState& state, const dds_sample_info_t&) {
      momentum[std::string(dds::text_of(state.spacecraft))] = state.step;
    });
    return attitude.size() == 2 && momentum["sat2"] == 30;
  }));
  EXPECT_EQ(attitude, (std::map<std::string, std::uint64_t>{{"sat1", 10}, {"sat2", 30}}));
  EXPECT_EQ(momentum, (std::map<std::string, std::uint64_t>{{"sat2", 30}}));
}

TEST_F(Bridge, gives_a_late_joiner_the_last_sample_and_the_health) {
  BridgeUnderTest bridge(testing::two_spacecraft(where_), 2);
  dds::Reader<adstar_AttitudeState> early(client_);
  start(bridge);
  runtime::StatusRecord health;
  health.step = 77;
  health.commands_received = 5;
  bridge.segment()->status.write(health);
  runtime::TimingRecord beats;
  beats.late_beats = 2;
  beats.fifo_scheduling = 1;
  bridge.segment()->timing.write(beats);
  for (std::uint64_t step = 1; step <= 50; ++step) {
    push(bridge, telemetry(0, step, runtime::kTopicAttitude));
  }
  std::uint64_t newest = 0;
  ASSERT_TRUE(eventually([&] {
    early.take([&](const auto& state, const auto&) { newest = state.step; });
    return newest == 50;
  }));
  dds::Reader<adstar_AttitudeState> late(client_);
  dds::Reader<adstar_ServiceStatus> status(client_);
  dds::Reader<adstar_StepTiming> timing(client_);
  std::vector<std::uint64_t> steps;
  bool healthy = false;
  bool timed = false;
  EXPECT_TRUE(eventually([&] {
    late.take([&](const auto& state, const auto&) { steps.push_back(state.step); });
    status.take([&](const adstar_ServiceStatus& state, const auto&) {
      healthy = true;
      EXPECT_EQ(state.step, 77U);
      EXPECT_EQ(state.commands_received, 5U);
      EXPECT_EQ(state.instance_high, 0xaaU);
      EXPECT_EQ(state.instance_low, 0xbbU);
      EXPECT_EQ(state.started_utc_ns, BridgeUnderTest::kStarted);
      EXPECT_EQ(state.step_length_ns, 10'000'000);
      EXPECT_EQ(state.spacecraft, 2U);
      EXPECT_EQ(dds::text_of(state.scheme), "coadjoint_rk4");
    });
    timing.take([&](const adstar_StepTiming& state, const auto&) {
      timed = true;
      EXPECT_EQ(state.late_beats, 2U);
      EXPECT_TRUE(state.fifo_scheduling);
    });
    return !steps.empty() && healthy && timed;
  }));
  EXPECT_EQ(steps, std::vector<std::uint64_t>{50});
}

TEST_F(Bridge, publishes_a_fleet_of_1200_whole_and_in_order) {
  constexpr std::size_t kCount = 1200;
  BridgeUnderTest bridge(testing::fleet(where_, kCount), kCount);
  dds::Reader<adstar_FleetState> fleet(client_);
  dds::Reader<adstar_ServiceRoster> roster(client_);
  start(bridge);
  std::vector<std::uint64_t> words(runtime::fleet_words(kCount));
  const runtime::FleetHeader header{.step = 5, .time_ns = 50, .members = kCount};
  std::memcpy(words.data(), &header, sizeof header);
  for (std::size_t i = 0; i < kCount; ++i) {
    runtime::FleetRecord record;
    record.rotational_energy_j = static_cast<double>(i);
    std::memcpy(&words[runtime::fleet_words(i)], &record, sizeof record);
  }
  bridge.segment()->fleet.write(bridge.segment().fleet_storage(), words);
  runtime::wake_bridge(*bridge.segment());
  std::set<std::uint32_t> members;
  std::set<std::string> names;
  EXPECT_TRUE(eventually([&] {
    fleet.take([&](const adstar_FleetState& state, const auto&) {
      EXPECT_EQ(state.step, 5U);
      EXPECT_LE(state.members._length, 500U);
      for (std::uint32_t i = 0; i < state.members._length; ++i) {
        EXPECT_EQ(state.members._buffer[i].rotational_energy_j, state.first_spacecraft + i);
        members.insert(state.first_spacecraft + i);
      }
    });
    roster.take([&](const adstar_ServiceRoster& part, const auto&) {
      EXPECT_EQ(part.chunks, 3U);
      for (std::uint32_t i = 0; i < part.spacecraft._length; ++i) {
        names.emplace(dds::text_of(part.spacecraft._buffer[i].name));
      }
    });
    return members.size() == kCount && names.size() == kCount;
  }));
  EXPECT_EQ(*members.rbegin(), kCount - 1);
  EXPECT_TRUE(names.contains("f01199"));
}

TEST_F(Bridge, refuses_unknown_names_itself_but_leaves_those_of_other_daemons_alone) {
  dds::Writer<adstar_ServiceRoster> other(client_);
  adstar_RosterEntry entry{};
  dds::set_text(entry.name, "theirs");
  adstar_ServiceRoster roster{};
  dds::set_text(roster.service, "other");
  roster.instance_low = 1;
  roster.chunks = 1;
  roster.spacecraft = {1, 1, &entry, false};
  other.write(roster);

  BridgeUnderTest bridge(testing::two_spacecraft(where_), 2);
  dds::Reader<adstar_CommandStatus> statuses(client_);
  start(bridge);
  dds::Writer<adstar_TorqueCommand> commands(client_);
  std::map<std::uint64_t, adstar_RefusalReason> refusals;
  int answers = 0;
  ASSERT_TRUE(eventually([&] {
    commands.write(command("theirs", "body", 1));
    commands.write(command("sat1", "thruster", 2));
    commands.write(command("nobody", "body", 3));
    statuses.take([&](const adstar_CommandStatus& status, const auto&) {
      EXPECT_EQ(status.verdict, adstar_VERDICT_REFUSED);
      refusals[status.sequence_number] = status.reason;
      ++answers;
    });
    // Several rounds, so that the silence about the first is not a loss.
    return refusals.contains(2) && refusals.contains(3) && answers > 10;
  }));
  EXPECT_EQ(refusals,
            (std::map<std::uint64_t, adstar_RefusalReason>{{2, adstar_REASON_UNKNOWN_ACTUATOR},
                                                           {3, adstar_REASON_UNKNOWN_SPACECRAFT}}));
  EXPECT_EQ(bridge.segment()->commands.size(), 0U);
}

}  // namespace
}  // namespace adstar
