// How adstar-bridge starts, refuses, falls, comes back and ends.

#include <dirent.h>
#include <net/if.h>
#include <netinet/in.h>
#include <poll.h>
#include <string>
#include <sys/socket.h>
#include <sys/syscall.h>

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

// Another daemon that claims sat2, started so long after ours.
adstar_ServiceRoster rival(adstar_RosterEntry& entry, std::int64_t later_ns) {
  dds::set_text(entry.name, "sat2");
  adstar_ServiceRoster roster{};
  dds::set_text(roster.service, "rival");
  roster.instance_low = 1;
  roster.chunks = 1;
  roster.started_utc_ns = BridgeUnderTest::kStarted + later_ns;
  roster.spacecraft = {1, 1, &entry, false};
  return roster;
}

runtime::TelemetryRecord sample(std::uint64_t step) {
  runtime::TelemetryRecord record;
  record.topics = runtime::kTopicAttitude;
  record.step = step;
  return record;
}

class BridgeLife : public ::testing::Test {
 protected:
  BridgeLife() : where_(testing::private_corner()), bridge_(testing::two_spacecraft(where_), 2) {}
  dds::ParticipantOptions where_;
  BridgeUnderTest bridge_;
};

TEST_F(BridgeLife, refuses_when_an_older_daemon_flies_one_of_our_spacecraft) {
  dds::Participant peer(where_);
  dds::Writer<adstar_ServiceRoster> rosters(peer);
  adstar_RosterEntry entry{};
  rosters.write(rival(entry, -1));
  bridge_.start();
  EXPECT_TRUE(bridge_.becomes(BridgeState::refused));
  EXPECT_EQ(
      std::string(bridge_.segment()->bridge_message),
      fmt::format(
          "spacecraft 'sat2' is already flown by service 'rival' on domain {}; stop it, or choose "
          "another partition or name",
          where_.domain));
  EXPECT_EQ(bridge_.exit_code(), 3);
}

TEST_F(BridgeLife, stays_when_the_rival_is_younger) {
  dds::Participant peer(where_);
  dds::Writer<adstar_ServiceRoster> rosters(peer);
  adstar_RosterEntry entry{};
  rosters.write(rival(entry, +1));
  bridge_.start();
  EXPECT_TRUE(bridge_.becomes(BridgeState::ready));
  bridge_.ask_to_stop();
  EXPECT_EQ(bridge_.exit_code(), 0);
}

TEST_F(BridgeLife, takes_over_at_once_after_being_killed) {
  dds::Participant peer(where_);
  dds::Writer<adstar_TorqueCommand> commands(peer);
  dds::Reader<adstar_CommandStatus> statuses(peer);
  dds::Reader<adstar_AttitudeState> attitudes(peer);
  bridge_.start();
  ASSERT_TRUE(bridge_.becomes(BridgeState::ready));
  bridge_.kill_hard();

  auto& segment = *bridge_.segment();
  segment.snapshot_requested.store(0);
  runtime::VerdictRecord owed;
  owed.sequence = 5;
  ASSERT_TRUE(segment.verdicts.push(owed));
  ASSERT_TRUE(segment.telemetry.push(sample(1)));  // stale
  bridge_.start();
  ASSERT_TRUE(eventually([&] { return segment.snapshot_requested.load() == 1; }));
  ASSERT_TRUE(segment.telemetry.push(sample(2)));
  runtime::wake_bridge(segment);

  std::uint64_t answered = 0;
  std::vector<std::uint64_t> steps;
  EXPECT_TRUE(eventually([&] {
    statuses.take([&](const auto& status, const auto&) { answered = status.sequence_number; });
    attitudes.take([&](const auto& state, const auto&) { steps.push_back(state.step); });
    return answered == 5 && !steps.empty();
  }));
  EXPECT_EQ(steps, std::vector<std::uint64_t>{2});

  adstar_TorqueCommand command{};
  dds::set_text(command.spacecraft, "sat1");
  dds::set_text(command.actuator, "body");
  EXPECT_TRUE(eventually([&] {
    commands.write(command);  // best effort on the other side: a client repeats
    return segment.commands.size() > 0;
  }));
}

TEST_F(BridgeLife, publishes_what_is_left_and_exits_with_0_when_asked_to_stop) {
  dds::Participant peer(where_);
  dds::Reader<adstar_AttitudeState> attitudes(peer);
  dds::Reader<adstar_ServiceStatus> statuses(peer);
  bridge_.start();
  ASSERT_TRUE(bridge_.becomes(BridgeState::ready));
  ASSERT_TRUE(eventually([&] { return attitudes.matched() > 0 && statuses.matched() > 0; }));
  auto& segment = *bridge_.segment();
  for (std::uint64_t step = 1; step <= 3000; ++step) {
    ASSERT_TRUE(segment.telemetry.push(sample(step)));
  }
  runtime::StatusRecord last;
  last.state = static_cast<std::uint64_t>(runtime::RunState::stopped);
  segment.status.write(last);
  bridge_.ask_to_stop();
  EXPECT_EQ(bridge_.exit_code(), 0);
  std::uint64_t newest = 0;
  bool stopped = false;
  EXPECT_TRUE(eventually([&] {
    attitudes.take([&](const auto& state, const auto&) { newest = state.step; });
    statuses.take(
        [&](const auto& state, const auto&) { stopped = state.state == adstar_SERVICE_STOPPED; });
    return newest == 3000 && stopped;
  }));
}

TEST_F(BridgeLife, ends_on_SIGTERM_and_ignores_SIGINT) {
  bridge_.start();
  ASSERT_TRUE(bridge_.becomes(BridgeState::ready));
  bridge_.signal(SIGINT);
  bridge_.signal(SIGTERM);
  EXPECT_EQ(bridge_.exit_code(), 0);
}

TEST_F(BridgeLife, dies_with_its_parent) {
  int pipe_ends[2];
  ASSERT_EQ(pipe(pipe_ends), 0);
  const pid_t parent = fork();
  if (parent == 0) {
    bridge_.start(getpid());
    const pid_t bridge = bridge_.pid();
    if (write(pipe_ends[1], &bridge, sizeof bridge) == sizeof bridge) {
      pause();
    }
    _exit(1);
  }
  pid_t bridge = 0;
  ASSERT_EQ(read(pipe_ends[0], &bridge, sizeof bridge), static_cast<ssize_t>(sizeof bridge));
  close(pipe_ends[0]);
  close(pipe_ends[1]);
  ASSERT_TRUE(bridge_.becomes(BridgeState::ready));
  pollfd ended{static_cast<int>(syscall(SYS_pidfd_open, bridge, 0)), POLLIN, 0};
  ASSERT_GE(ended.fd, 0);
  EXPECT_EQ(poll(&ended, 1, 0), 0) << "it lives";
  kill(parent, SIGKILL);
  waitpid(parent, nullptr, 0);
  EXPECT_EQ(poll(&ended, 1, 10'000), 1) << "and goes with its parent";
  close(ended.fd);
}

TEST_F(BridgeLife, does_not_serve_a_stranger) {
  bridge_.start(/*claimed_parent=*/1);
  EXPECT_EQ(bridge_.exit_code(), 2);
  EXPECT_TRUE(bridge_.is(BridgeState::starting));
}

TEST(BridgeByHand, says_who_starts_it) {
  FILE* const pipe = popen(ADSTAR_BRIDGE " 2>&1", "r");
  ASSERT_NE(pipe, nullptr);
  char line[200] = {};
  EXPECT_NE(fgets(line, sizeof line, pipe), nullptr);
  EXPECT_EQ(std::string(line),
            "adstar-bridge is started by adstard, never by hand; run: adstard scene.toml\n");
  const int status = pclose(pipe);
  EXPECT_EQ(WEXITSTATUS(status), 2);
}

TEST(BridgeInterface, refuses_one_that_does_not_exist_and_names_those_that_do) {
  BridgeUnderTest bridge(testing::two_spacecraft(testing::private_corner("eth9")), 2);
  bridge.start();
  EXPECT_TRUE(bridge.becomes(BridgeState::refused));
  EXPECT_EQ(std::string(bridge.segment()->bridge_message)
                .find("no network interface 'eth9'; try one of: lo"),
            0U)
      << bridge.segment()->bridge_message;
  EXPECT_EQ(bridge.exit_code(), 2);
}

// The bridge's own sockets, looked at from outside.
TEST_F(BridgeLife, binds_every_socket_to_the_loopback_device) {
  bridge_.start();
  ASSERT_TRUE(bridge_.becomes(BridgeState::ready));
  const auto pidfd = static_cast<int>(syscall(SYS_pidfd_open, bridge_.pid(), 0));
  ASSERT_GE(pidfd, 0);
  int sockets = 0;
  DIR* const directory = opendir(fmt::format("/proc/{}/fd", bridge_.pid()).c_str());
  ASSERT_NE(directory, nullptr);
  while (const dirent* const entry = readdir(directory)) {
    const auto copy =
        static_cast<int>(syscall(SYS_pidfd_getfd, pidfd, std::atoi(entry->d_name), 0));
    int protocol = 0;
    socklen_t size = sizeof protocol;
    if (entry->d_name[0] == '.' || copy < 0) {
      continue;
    }
    if (getsockopt(copy, SOL_SOCKET, SO_PROTOCOL, &protocol, &size) == 0 &&
        protocol == IPPROTO_UDP) {
      char device[IFNAMSIZ] = {};
      size = sizeof device;
      EXPECT_EQ(getsockopt(copy, SOL_SOCKET, SO_BINDTODEVICE, device, &size), 0);
      EXPECT_STREQ(device, "lo");
      ++sockets;
    }
    close(copy);
  }
  closedir(directory);
  close(pidfd);
  EXPECT_GE(sockets, 2);
}

}  // namespace
}  // namespace adstar
