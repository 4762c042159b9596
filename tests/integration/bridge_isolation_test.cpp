// Loopback means loopback: seen from another network namespace, a bridge on lo is not there, by DDS
// or by bare datagram. The same bridge on the connecting interface is the positive control.

#include <arpa/inet.h>
#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <sched.h>
#include <set>
#include <string>
#include <sys/socket.h>
#include <thread>

#include <gtest/gtest.h>

#include "service/dds/reader.hpp"
#include "tests/integration/bridge_harness.hpp"

namespace adstar {
namespace {

using runtime::BridgeState;
using testing::BridgeUnderTest;
using testing::eventually;

bool run(const std::string& command) { return std::system((command + " >&2").c_str()) == 0; }

// Two namespaces and a cable between them.
struct TwoHosts {
  std::string tag = std::to_string(getpid());
  std::string here = "adstar-here-" + tag;
  std::string there = "adstar-there-" + tag;
  bool up = false;

  TwoHosts() {
    up = run("ip netns add " + here) && run("ip netns add " + there) &&
         run("ip link add cable0 netns " + here + " type veth peer name cable1 netns " + there) &&
         run("ip -n " + here + " addr add 10.77.0.1/24 dev cable0") &&
         run("ip -n " + there + " addr add 10.77.0.2/24 dev cable1") &&
         run("ip -n " + here + " link set lo up") && run("ip -n " + there + " link set lo up") &&
         run("ip -n " + here + " link set cable0 up") &&
         run("ip -n " + there + " link set cable1 up");
  }
  ~TwoHosts() {
    run("ip netns del " + here + " 2>/dev/null");
    run("ip netns del " + there + " 2>/dev/null");
  }
};

// Runs on a thread of its own inside the namespace; what it starts or opens belongs there.
template <class Work>
void inside(const std::string& name, Work&& work) {
  std::thread([&] {
    const int fd = open(("/run/netns/" + name).c_str(), O_RDONLY | O_CLOEXEC);
    ASSERT_GE(fd, 0);
    ASSERT_EQ(setns(fd, CLONE_NEWNET), 0);
    close(fd);
    work();
  }).join();
}

std::set<std::uint16_t> udp_ports(pid_t process) {
  std::ifstream table(fmt::format("/proc/{}/net/udp", process));
  std::string line;
  std::getline(table, line);
  std::set<std::uint16_t> ports;
  while (std::getline(table, line)) {
    const std::size_t colon = line.find(':', line.find(':') + 1);
    ports.insert(static_cast<std::uint16_t>(std::stoul(line.substr(colon + 1, 4), nullptr, 16)));
  }
  return ports;
}

// The kernel of the other host answers that nobody listens there.
bool is_closed(std::uint16_t port) {
  const int fd = socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  sockaddr_in target{};
  target.sin_family = AF_INET;
  target.sin_port = htons(port);
  inet_pton(AF_INET, "10.77.0.1", &target.sin_addr);
  EXPECT_EQ(connect(fd, reinterpret_cast<const sockaddr*>(&target), sizeof target), 0);
  const bool closed = eventually(
      [&] {
        char answer[16];
        if (recv(fd, answer, sizeof answer, 0) < 0 && errno == ECONNREFUSED) {
          return true;
        }
        return send(fd, "RTPS", 4, 0) < 0 && errno == ECONNREFUSED;
      },
      std::chrono::milliseconds(1500));
  close(fd);
  return closed;
}

bool sees_a_roster(dds::ParticipantOptions where, const char* interface,
                   std::chrono::milliseconds patience) {
  where.interface = interface;
  const dds::Participant participant(where);
  dds::Reader<adstar_ServiceRoster> rosters(participant);
  bool seen = false;
  return eventually(
      [&] {
        rosters.take([&](const auto&, const auto&) { seen = true; });
        return seen;
      },
      patience);
}

struct Seen {
  bool from_same_host = false;
  bool from_other_host = false;
  std::size_t open_ports = 0;
  std::size_t closed_ports = 0;
};

// The same thread starts the bridge and lasts as long: the bridge dies with the thread that started
// it.
Seen look_at_bridge_on(const TwoHosts& hosts, const char* interface,
                       std::chrono::milliseconds patience) {
  Seen seen;
  const dds::ParticipantOptions where = testing::private_corner(interface);
  inside(hosts.here, [&] {
    BridgeUnderTest bridge(testing::two_spacecraft(where), 2);
    bridge.start();
    ASSERT_TRUE(bridge.becomes(BridgeState::ready)) << bridge.segment()->bridge_message;
    const std::set<std::uint16_t> ports = udp_ports(bridge.pid());
    ASSERT_GE(ports.size(), 3U);
    inside(hosts.there, [&] {
      for (const std::uint16_t port : ports) {
        ++(is_closed(port) ? seen.closed_ports : seen.open_ports);
      }
      seen.from_other_host = sees_a_roster(where, "cable1", patience);
    });
    seen.from_same_host = sees_a_roster(where, interface, std::chrono::seconds(20));
    bridge.ask_to_stop();
    EXPECT_EQ(bridge.exit_code(), 0);
  });
  return seen;
}

TEST(BridgeIsolation, nothing_of_a_bridge_on_lo_is_reachable_from_another_host) {
  const TwoHosts hosts;
  if (!hosts.up) {
    GTEST_SKIP() << "needs root and iproute2 to make network namespaces";
  }
  const Seen on_cable = look_at_bridge_on(hosts, "cable0", std::chrono::seconds(20));
  EXPECT_TRUE(on_cable.from_same_host);
  EXPECT_TRUE(on_cable.from_other_host) << "else the test below proves nothing";
  EXPECT_GE(on_cable.open_ports, 3U) << "else the test below proves nothing";

  const Seen on_loopback = look_at_bridge_on(hosts, "lo", std::chrono::seconds(4));
  EXPECT_TRUE(on_loopback.from_same_host);
  EXPECT_FALSE(on_loopback.from_other_host);
  EXPECT_EQ(on_loopback.open_ports, 0U);
  EXPECT_GE(on_loopback.closed_ports, 3U);
}

}  // namespace
}  // namespace adstar
