#pragma once
// What the tick's thread asks of the system, and what it got.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace adstar::runtime {

struct RealTime {
  bool fifo_scheduling = false;
  bool memory_locked = false;
  bool cpu_pinned = false;
  bool idle_is_shallow = false;
  int thread = 0;                     ///< the tick's, as the system numbers it
  std::vector<std::string> warnings;  ///< one for each thing refused, with its remedy
};

/// Locks what is mapped now and what will be, the latter as it is touched (no cost for stacks never
/// used).
void lock_memory(RealTime& result);

/// For the calling thread: SCHED_FIFO at `priority` (0: leave as it is), affinity, the finest timer
/// slack, a stack that is already there.
void make_thread_real_time(int priority, std::optional<int> cpu, RealTime& result);

/// While it lives no processor sleeps so deeply between beats that it wakes late, as cyclictest(8) has it: the system's
/// PM QoS request, which ends with the process. Nothing where there is no such device: in a container, under the unit.
class ShallowIdle {
 public:
  explicit ShallowIdle(RealTime& result);
  ~ShallowIdle();
  ShallowIdle(const ShallowIdle&) = delete;
  ShallowIdle& operator=(const ShallowIdle&) = delete;

 private:
  int device_;
};

/// What the system has done to a thread since it began, and what it grants it now. Zero where /proc does
/// not say. Off the tick: reads files.
struct ThreadAccount {
  std::uint64_t minor_faults = 0;
  std::uint64_t major_faults = 0;
  std::uint64_t involuntary_switches = 0;
  bool fifo_scheduling = false;
  bool memory_locked = false;  ///< of the process
  bool cpu_pinned = false;
};
ThreadAccount account_of(int thread);

}  // namespace adstar::runtime
