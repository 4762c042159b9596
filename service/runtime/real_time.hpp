#pragma once
// What the tick's thread asks of the system, and what it got.

#include <optional>
#include <string>
#include <vector>

namespace adstar::runtime {

struct RealTime {
  bool fifo_scheduling = false;
  bool memory_locked = false;
  bool cpu_pinned = false;
  std::vector<std::string> warnings;  ///< one for each thing refused, with its remedy
};

/// Locks what is mapped now and what will be, the latter as it is touched (no cost for stacks never
/// used).
void lock_memory(RealTime& result);

/// For the calling thread: SCHED_FIFO at `priority` (0: leave as it is), affinity, the finest timer
/// slack.
void make_thread_real_time(int priority, std::optional<int> cpu, RealTime& result);

}  // namespace adstar::runtime
