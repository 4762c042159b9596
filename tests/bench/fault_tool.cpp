// What tests/bench/faults.sh cannot do with the shell alone.
//   fault_tool flood DOMAIN PARTITION SPACECRAFT RATE_HZ SECONDS   commands, each from a new commander
//   fault_tool datagrams DOMAIN PARENT SECONDS                     nonsense at the ports of PARENT's child

#include <chrono>
#include <fstream>
#include <random>
#include <string>
#include <thread>

#include "service/dds/convert.hpp"
#include "service/dds/participant.hpp"
#include "service/dds/writer.hpp"
#include "service/runtime/records.hpp"
#include "tests/integration/process_account.hpp"
#include "tests/support/datagrams.hpp"

namespace {

using namespace adstar;
using Clock = std::chrono::steady_clock;

std::chrono::nanoseconds seconds(const char* text) {
  return std::chrono::nanoseconds(static_cast<std::int64_t>(1e9 * std::strtod(text, nullptr)));
}

int flood(char** words) {
  const dds::Participant participant(
      {static_cast<std::uint32_t>(std::strtoul(words[0], nullptr, 10)), "lo", words[1]});
  dds::Writer<adstar_TorqueCommand> writer(participant);
  std::mt19937_64 random(1);
  const double rate_hz = std::strtod(words[3], nullptr);
  const auto begun = Clock::now();
  const auto until = begun + seconds(words[4]);
  std::uint64_t sent = 0;
  for (auto now = begun; now < until; now = Clock::now()) {
    const double due = rate_hz * std::chrono::duration<double>(now - begun).count();
    for (; static_cast<double>(sent) < due; ++sent) {
      adstar_TorqueCommand command{};
      dds::set_text(command.spacecraft, words[2]);
      dds::set_text(command.actuator, "body");
      command.commander = {random(), random()};
      command.sequence_number = 1;
      command.start_time_ns = runtime::kStartAtNextBeat;
      command.duration_ns = 1'000'000;
      command.torque_n_m = {0.01, 0, 0};
      writer.write(command);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return 0;
}

pid_t child_of(const std::string& parent) {
  std::ifstream children("/proc/" + parent + "/task/" + parent + "/children");
  pid_t child = 0;
  children >> child;
  return child;
}

int datagrams(char** words) {
  const auto genuine =
      testing::announcements(static_cast<std::uint32_t>(std::strtoul(words[0], nullptr, 10)), 4);
  if (genuine.empty()) {
    std::fputs("fault_tool: no announcement heard\n", stderr);
    return 1;
  }
  testing::LoopbackSocket socket;
  std::mt19937_64 random(1);
  const auto until = Clock::now() + seconds(words[2]);
  while (Clock::now() < until) {
    const pid_t bridge = child_of(words[1]);
    for (const std::uint16_t port : testing::udp_ports_of(bridge)) {
      for (int i = 0; i < 20; ++i) {
        socket.send(testing::hostile_datagram(genuine, random), port);
      }
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  if (what == "flood" && argc == 7) {
    return flood(argv + 2);
  }
  if (what == "datagrams" && argc == 5) {
    return datagrams(argv + 2);
  }
  std::fputs(
      "usage: fault_tool flood DOMAIN PARTITION SPACECRAFT RATE_HZ SECONDS\n"
      "       fault_tool datagrams DOMAIN PARENT SECONDS\n",
      stderr);
  return 2;
}
