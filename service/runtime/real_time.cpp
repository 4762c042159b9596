#include "service/runtime/real_time.hpp"

#include <cerrno>
#include <cstring>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>

namespace adstar::runtime {

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

void make_thread_real_time(int priority, std::optional<int> cpu, RealTime& result) {
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
