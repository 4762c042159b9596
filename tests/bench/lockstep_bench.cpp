// How long a program that drives time waits for one step: request, step, answer, over DDS on loopback.
//
//   lockstep_bench [requests]

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "tests/integration/clock_holder.hpp"

namespace {

using namespace adstar;
using Clock = std::chrono::steady_clock;

double microseconds(Clock::duration d) {
  return std::chrono::duration<double, std::micro>(d).count();
}

}  // namespace

int main(int argc, char** argv) {
  const std::size_t requests = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 2000;
  const auto corner = testing::private_corner();
  testing::Daemon daemon(testing::lockstep_scene(corner));
  const dds::Participant participant(corner);
  testing::ClockHolder holder(participant);
  if (!holder.step(1)) {
    std::fprintf(stderr, "no answer; the daemon said:\n%s", daemon.log().c_str());
    return 1;
  }
  std::vector<Clock::duration> took;
  for (std::size_t i = 0; i < requests; ++i) {
    const auto begun = Clock::now();
    const auto reply = holder.step(1);
    took.push_back(Clock::now() - begun);
    if (!reply || reply->step != i + 2) {
      std::fprintf(stderr, "request %zu: no answer, or at the wrong step\n", i);
      return 1;
    }
  }
  std::sort(took.begin(), took.end());
  fmt::print(
      "lock-step round trip of one step, {} requests: p50 {:.0f} us, p99 {:.0f} us, max {:.0f} "
      "us\n",
      took.size(), microseconds(took[took.size() / 2]), microseconds(took[took.size() * 99 / 100]),
      microseconds(took.back()));
  return daemon.stop();
}
