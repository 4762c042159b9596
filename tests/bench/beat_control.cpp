// What this machine does to a beat that has nothing of ours in it: a thread at the priority, interval and processor of beat.sh that
// spins for some microseconds of each millisecond and reads the clock. How often did that take longer, and did the kernel
// know that it was taken away?
//   beat_control_bench [seconds] [microseconds of each beat]
// Needs root, or the capabilities of README.md, "Real time".

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <sched.h>
#include <sys/mman.h>
#include <unistd.h>

#include "service/runtime/tick_parts.hpp"

int main(int argc, char** argv) {
  using namespace adstar::runtime;
  constexpr std::int64_t kPeriod_ns = 1'000'000, kOff_ns = 400'000;
  const std::int64_t beats = 1000 * (argc > 1 ? std::atoll(argv[1]) : 600);
  const std::int64_t spin_ns = 1000 * (argc > 2 ? std::atoll(argv[2]) : 100);
  cpu_set_t last;
  CPU_ZERO(&last);
  CPU_SET(static_cast<unsigned>(sysconf(_SC_NPROCESSORS_ONLN) - 1), &last);
  const sched_param priority{80};
  if (mlockall(MCL_CURRENT | MCL_FUTURE) != 0 || sched_setaffinity(0, sizeof last, &last) != 0 ||
      sched_setscheduler(0, SCHED_FIFO, &priority) != 0) {
    std::perror("beat_control: memory lock, affinity or SCHED_FIFO; run it as root");
    return 2;
  }
  std::int64_t off = 0, past_the_period = 0, charged = 0, longest_ns = 0;
  std::int64_t due = monotonic_ns();
  for (std::int64_t n = 0; n < beats; ++n) {
    due += kPeriod_ns;
    sleep_until(due);
    const std::int64_t used_before = used_by_this_thread_ns(), begun = monotonic_ns();
    std::int64_t now = begun;
    while (now - begun < spin_ns) {
      now = monotonic_ns();
    }
    const std::int64_t used = used_by_this_thread_ns() - used_before;
    const std::int64_t took = now - begun;
    if (took > spin_ns + kOff_ns) {
      ++off;
      past_the_period += took > kPeriod_ns ? 1 : 0;
      charged += used > took - kOff_ns / 2 ? 1 : 0;
    }
    longest_ns = took > longest_ns ? took : longest_ns;
    due = now > due + kPeriod_ns ? now : due;
  }
  std::printf(
      "%lld beats of 1 ms, %lld us of spinning in each: %lld took 0.4 ms longer or more (%lld of "
      "them past the period), "
      "%lld of these were charged to it as its own work; the longest took %.1f ms\n",
      static_cast<long long>(beats), static_cast<long long>(spin_ns / 1000),
      static_cast<long long>(off), static_cast<long long>(past_the_period),
      static_cast<long long>(charged), static_cast<double>(longest_ns) / 1e6);
}
