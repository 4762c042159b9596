#include "service/runtime/real_time.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <pthread.h>
#include <sched.h>
#include <sstream>
#include <string_view>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <unistd.h>

namespace adstar::runtime {
namespace {

/// More than a beat uses; locked pages are mapped when they are first touched.
[[gnu::noinline]] void touch_stack() {
  volatile char pages[std::size_t{256} * 1024];
  for (std::size_t i = 0; i < sizeof pages; i += 1024) {
    pages[i] = 0;
  }
}

/// The number behind `name` in a file of lines "name: number"; 0 when it is not there.
std::uint64_t number_in(const std::string& file, std::string_view name) {
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(name)) {
      return std::strtoull(line.c_str() + name.size(), nullptr, 10);
    }
  }
  return 0;
}

}  // namespace

ThreadAccount account_of(int thread) {
  ThreadAccount account;
  const std::string folder = "/proc/self/task/" + std::to_string(thread);
  // proc(5): after the name in parentheses, minflt is the eighth field and majflt the tenth.
  std::ifstream file(folder + "/stat");
  std::string text;
  std::getline(file, text);
  if (const std::size_t named = text.rfind(')'); named != std::string::npos) {
    std::istringstream fields(text.substr(named + 1));
    std::string field;
    for (int i = 1; i <= 10 && fields >> field; ++i) {
      if (i == 8) {
        account.minor_faults = std::strtoull(field.c_str(), nullptr, 10);
      } else if (i == 10) {
        account.major_faults = std::strtoull(field.c_str(), nullptr, 10);
      }
    }
  }
  account.involuntary_switches = number_in(folder + "/status", "nonvoluntary_ctxt_switches:");
  account.fifo_scheduling = sched_getscheduler(thread) == SCHED_FIFO;
  account.memory_locked = number_in("/proc/self/status", "VmLck:") > 0;
  cpu_set_t set;
  CPU_ZERO(&set);
  account.cpu_pinned = sched_getaffinity(thread, sizeof set, &set) == 0 && CPU_COUNT(&set) == 1;
  return account;
}

void lock_memory(RealTime& result) {
  if (mlockall(MCL_CURRENT) == 0 && mlockall(MCL_FUTURE | MCL_ONFAULT) == 0) {
    result.memory_locked = true;
    return;
  }
  result.warnings.push_back(
      std::string("memory is not locked (") + std::strerror(errno) +
      "): a page fault may delay a beat; run as root, or raise 'memlock' to unlimited in "
      "/etc/security/limits.d, or: setcap cap_ipc_lock,cap_sys_nice+ep adstard");
}

ShallowIdle::ShallowIdle(RealTime& result)
    : device_(open("/dev/cpu_dma_latency", O_RDWR | O_CLOEXEC)) {
  const std::int32_t latency_us = 0;
  result.idle_is_shallow =
      device_ >= 0 && write(device_, &latency_us, sizeof latency_us) == sizeof latency_us;
  if (!result.idle_is_shallow && errno != ENOENT) {
    result.warnings.push_back(
        std::string("processors may sleep deeply between beats (/dev/cpu_dma_latency: ") +
        std::strerror(errno) +
        "): they wake later then; run as root, or have somebody hold it: tuned-adm profile "
        "latency-performance");
  }
}

ShallowIdle::~ShallowIdle() {
  if (device_ >= 0) {
    close(device_);
  }
}

void make_thread_real_time(int priority, std::optional<int> cpu, RealTime& result) {
  result.thread = static_cast<int>(gettid());
  touch_stack();
  prctl(PR_SET_TIMERSLACK, 1UL);
  if (cpu) {
    cpu_set_t set;
    CPU_ZERO(&set);
    CPU_SET(static_cast<unsigned>(*cpu), &set);
    const int error = pthread_setaffinity_np(pthread_self(), sizeof set, &set);
    result.cpu_pinned = error == 0;
    if (error != 0) {
      result.warnings.push_back("the tick is not pinned to CPU " + std::to_string(*cpu) + " (" +
                                std::strerror(error) +
                                "): choose one of those in /proc/self/status, Cpus_allowed_list");
    }
  }
  if (priority > 0) {
    sched_param parameters{};
    parameters.sched_priority = priority;
    const int error = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters);
    result.fifo_scheduling = error == 0;
    if (error != 0) {
      result.warnings.push_back(
          "no SCHED_FIFO at priority " + std::to_string(priority) + " (" + std::strerror(error) +
          "): beats may come late under load; run as root, or set 'rtprio " +
          std::to_string(priority) +
          "' in /etc/security/limits.d, or: setcap cap_sys_nice,cap_ipc_lock+ep adstard");
    }
  }
}

}  // namespace adstar::runtime
