#pragma once
// Wait-free single-producer, single-consumer ring over shared memory; neither side trusts the
// other.
//
// A full ring refuses the entry (the producer counts it) and nobody waits. Every index is masked
// before it touches memory, so a peer that writes nonsense into its own index can lose entries,
// never reach outside the ring. The consumer copies an entry out before it looks at it.

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>

namespace adstar::runtime {

template <class Entry, std::size_t Capacity>
class SpscRing {
  static_assert(Capacity > 0 && (Capacity & (Capacity - 1)) == 0, "a power of two");
  static_assert(std::is_trivially_copyable_v<Entry>);
  static_assert(std::atomic<std::uint64_t>::is_always_lock_free);

 public:
  static constexpr std::size_t kCapacity = Capacity;

  /// Producer. False when the ring is full (or the consumer's index is nonsense): nothing written.
  bool push(const Entry& entry) noexcept {
    const std::uint64_t head = head_.load(std::memory_order_relaxed);
    const std::uint64_t used = head - tail_.load(std::memory_order_acquire);
    if (used >= Capacity) {
      return false;
    }
    entries_[head & (Capacity - 1)] = entry;
    head_.store(head + 1, std::memory_order_release);
    return true;
  }

  /// Consumer. Empty when there is none. A producer index more than the capacity ahead is nonsense:
  /// everything up to it is skipped.
  std::optional<Entry> pop() noexcept {
    const std::uint64_t tail = tail_.load(std::memory_order_relaxed);
    const std::uint64_t head = head_.load(std::memory_order_acquire);
    const std::uint64_t used = head - tail;
    if (used == 0) {
      return std::nullopt;
    }
    if (used > Capacity) {
      tail_.store(head, std::memory_order_release);
      return std::nullopt;
    }
    const Entry entry = entries_[tail & (Capacity - 1)];
    tail_.store(tail + 1, std::memory_order_release);
    return entry;
  }

  /// Producer: whether the next push finds a place. It stays true until then.
  bool has_room() const noexcept {
    return head_.load(std::memory_order_relaxed) - tail_.load(std::memory_order_acquire) < Capacity;
  }

  /// Producer: how many pushes find a place.
  std::size_t room() const noexcept { return Capacity - size(); }

  /// Consumer. The entry `offset` behind the oldest, which stays; below size() only.
  const Entry& peek(std::size_t offset) const noexcept {
    return entries_[(tail_.load(std::memory_order_relaxed) + offset) & (Capacity - 1)];
  }

  /// Consumer. Lets go of the oldest `count`, size() at most.
  void release(std::size_t count) noexcept {
    tail_.store(tail_.load(std::memory_order_relaxed) + count, std::memory_order_release);
  }

  /// Consumer. Forgets everything pushed so far.
  void skip_all() noexcept {
    tail_.store(head_.load(std::memory_order_acquire), std::memory_order_release);
  }

  /// Either side: entries waiting, at most the capacity.
  std::size_t size() const noexcept {
    const std::uint64_t used =
        head_.load(std::memory_order_acquire) - tail_.load(std::memory_order_acquire);
    return used > Capacity ? Capacity : static_cast<std::size_t>(used);
  }

 private:
  alignas(64) std::atomic<std::uint64_t> head_{0};
  alignas(64) std::atomic<std::uint64_t> tail_{0};
  alignas(64) Entry entries_[Capacity];
};

}  // namespace adstar::runtime
