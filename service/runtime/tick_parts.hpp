#pragma once
// What the files of the tick share: its clock, and counters with one writer.

#include <atomic>
#include <cerrno>
#include <cstdint>
#include <time.h>

namespace adstar::runtime {

inline constexpr std::int64_t kSecond = 1'000'000'000;

inline std::int64_t monotonic_ns() noexcept {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * kSecond + now.tv_nsec;
}

/// Of the processor: without what the host, interrupts and other programs took of it, as far as the kernel knows.
inline std::int64_t used_by_this_thread_ns() noexcept {
  timespec used{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
  return used.tv_sec * kSecond + used.tv_nsec;
}

/// What `clock` shows more than the monotonic one. No system call: the vDSO answers.
inline std::int64_t offset_of(clockid_t clock) noexcept {
  const std::int64_t before = monotonic_ns();
  timespec there{};
  clock_gettime(clock, &there);
  const std::int64_t after = monotonic_ns();
  return there.tv_sec * kSecond + there.tv_nsec - (before + (after - before) / 2);
}

inline void sleep_until(std::int64_t due) noexcept {
  const timespec deadline{due / kSecond, due % kSecond};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &deadline, nullptr) == EINTR) {}
}

/// What lay in a ring while this process stood still is nobody's wish any more; who means it repeats it.
/// `received_ns` 0: not stamped.
inline bool is_stale(std::int64_t received_ns, std::int64_t now_ns) noexcept {
  return received_ns != 0 && now_ns - received_ns > 2 * kSecond;
}

/// Until a step that is a multiple of `every`; at least one.
inline std::uint64_t beats_left(std::uint64_t step, std::uint64_t every) noexcept {
  return every - step % every;
}

/// One writer: a load and a store, no locked instruction.
inline void add(std::atomic<std::uint64_t>& counter, std::uint64_t amount) noexcept {
  counter.store(counter.load(std::memory_order_relaxed) + amount, std::memory_order_relaxed);
}

/// A high-water mark.
inline void raise(std::atomic<std::uint64_t>& mark, std::uint64_t level) noexcept {
  if (level > mark.load(std::memory_order_relaxed)) {
    mark.store(level, std::memory_order_relaxed);
  }
}

}  // namespace adstar::runtime
