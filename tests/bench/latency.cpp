// How long from a torque command to the momentum that it changed, beside a bare ping-pong of the same
// samples through the same kind of processes, in one run: blocks alternate, a 1 kHz daemon flies throughout.
//   cmake --build build/release --target latency

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <sys/prctl.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include <fmt/format.h>

#include "service/dds/convert.hpp"
#include "service/dds/participant.hpp"
#include "service/dds/reader.hpp"
#include "service/dds/wait_set.hpp"
#include "service/dds/writer.hpp"
#include "service/runtime/records.hpp"
#include "tests/support/process.hpp"

namespace {

using namespace adstar;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr double kTick_us = 1000;
constexpr const char* kScene = R"([simulation]
step = "1ms"
[[spacecraft]]
name = "sat1"
inertia_body_kg_m2 = [0.9144, 1.098, 1.66]
angular_velocity_body_rad_s = [0.45549, 0.82623, 0.03476]
[[spacecraft.torque]]
model = "commanded"
name = "body"
frame = "inertial"
max_torque_n_m = [1.0, 1.0, 1.0]
[telemetry]
attitude_hz = 0
momentum_hz = 1000
[dds]
domain = {}
)";

/// Commands out, momentum in, on one domain.
class Station {
 public:
  explicit Station(std::uint32_t domain)
      : participant_({domain, "lo", ""}),
        commands_(participant_),
        momentum_(participant_),
        wait_set_(participant_) {
    wait_set_.attach(momentum_);
  }

  void send(const adstar_TorqueCommand& command) { commands_.write(command); }

  /// The next that holds; false after the deadline.
  template <class Condition>
  bool await(Condition&& holds, std::chrono::milliseconds deadline = 2s) {
    const auto until = Clock::now() + deadline;
    bool held = false;
    while (!held && Clock::now() < until) {
      if (momentum_.take([&](const adstar_MomentumState& s, const dds_sample_info_t&) {
            held = held || holds(s);
          }) == 0) {
        wait_set_.wait(10ms);
      }
    }
    return held;
  }

  bool matched() const { return commands_.matched() > 0 && momentum_.matched() > 0; }

 private:
  dds::Participant participant_;
  dds::Writer<adstar_TorqueCommand> commands_;
  dds::Reader<adstar_MomentumState> momentum_;
  dds::WaitSet wait_set_;
};

adstar_TorqueCommand next_command(std::uint64_t& sequence) {
  adstar_TorqueCommand command{};
  dds::set_text(command.spacecraft, "sat1");
  dds::set_text(command.actuator, "body");
  command.commander = {7, static_cast<std::uint64_t>(getpid())};
  command.sequence_number = ++sequence;
  command.start_time_ns = runtime::kStartAtNextBeat;
  command.duration_ns = 1'000'000;
  command.torque_n_m = {0.1, 0, 0};
  return command;
}

int echo(std::uint32_t domain) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  dds::Participant participant({domain, "lo", ""});
  dds::Reader<adstar_TorqueCommand> commands(participant);
  dds::Writer<adstar_MomentumState> momentum(participant);
  dds::WaitSet wait_set(participant);
  wait_set.attach(commands);
  while (true) {
    wait_set.wait(1s);
    commands.take([&](const adstar_TorqueCommand& command, const dds_sample_info_t&) {
      adstar_MomentumState sample{};
      dds::set_text(sample.spacecraft, dds::text_of(command.spacecraft));
      sample.step = command.sequence_number;
      momentum.write(sample);
    });
  }
}

/// Round trips in microseconds, begun at any phase against the beat.
template <class Holds>
std::vector<double> round_trips(Station& station, int count, std::uint64_t& sequence,
                                const Holds& holds_for) {
  static std::mt19937_64 random(1);
  std::vector<double> took_us;
  for (int i = 0; i < count; ++i) {
    std::this_thread::sleep_for(
        std::chrono::microseconds(std::uniform_int_distribution<int>(3000, 6000)(random)));
    station.await([](const adstar_MomentumState&) { return false; }, 0ms);
    const adstar_TorqueCommand command = next_command(sequence);
    const auto holds = holds_for(command);
    const auto begun = Clock::now();
    station.send(command);
    if (!station.await(holds)) {
      continue;  // lost on the way: best effort
    }
    took_us.push_back(std::chrono::duration<double, std::micro>(Clock::now() - begun).count());
  }
  return took_us;
}

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1,
                         static_cast<std::size_t>(share * static_cast<double>(values.size())))];
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 3 && std::strcmp(argv[1], "echo") == 0) {
    return echo(static_cast<std::uint32_t>(std::atoi(argv[2])));
  }
  const int blocks = argc > 1 ? std::atoi(argv[1]) : 6;
  const int count = argc > 2 ? std::atoi(argv[2]) : 300;
  const std::uint32_t domain = 20 + static_cast<std::uint32_t>(getpid()) % 82;
  std::string scene = "/tmp/adstar-latency.XXXXXX";
  close(mkstemp(scene.data()));
  std::ofstream(scene) << fmt::format(kScene, domain);
  adstar::testing::Process daemon({ADSTARD, scene});
  adstar::testing::Process echoing({argv[0], "echo", std::to_string(domain + 1)});
  Station ours(domain), bare(domain + 1);
  for (int tries = 0; tries < 1000 && !(ours.matched() && bare.matched()); ++tries) {
    std::this_thread::sleep_for(10ms);
  }
  std::filesystem::remove(scene);
  if (!ours.matched() || !bare.matched()) {
    std::fprintf(stderr, "latency: the daemon did not come up; it said:\n%s", daemon.err().c_str());
    return 1;
  }
  std::uint64_t sequence = 0;
  std::vector<double> added;
  for (int block = 1; block <= blocks; ++block) {
    const auto ping = round_trips(bare, count, sequence, [](const adstar_TorqueCommand& command) {
      return [wanted = command.sequence_number](const adstar_MomentumState& s) {
        return s.step == wanted;
      };
    });
    double H_x = 0;
    ours.await([&](const adstar_MomentumState& s) {
      H_x = s.momentum_inertial_n_m_s.x;
      return true;
    });
    const auto flown = round_trips(ours, count, sequence, [&](const adstar_TorqueCommand&) {
      return [&H_x](const adstar_MomentumState& s) {
        const bool moved = s.momentum_inertial_n_m_s.x > H_x + 0.5e-4;
        H_x = std::max(H_x, s.momentum_inertial_n_m_s.x);
        return moved;
      };
    });
    if (ping.empty() || flown.empty()) {
      std::fprintf(stderr, "latency: nothing came back in block %d\n", block);
      return 1;
    }
    added.push_back(quantile(flown, 0.5) - quantile(ping, 0.5));
    std::printf(
        "block %d  ping-pong p50 %6.0f p99 %6.0f us (%zu)   command to momentum p50 %6.0f p99 "
        "%6.0f us (%zu)   added %6.0f us\n",
        block, quantile(ping, 0.5), quantile(ping, 0.99), ping.size(), quantile(flown, 0.5),
        quantile(flown, 0.99), flown.size(), added.back());
  }
  std::printf("median over blocks: added %.0f us, %.2f ticks (aim: at most 1.2)\n",
              quantile(added, 0.5), quantile(added, 0.5) / kTick_us);
  return 0;
}
