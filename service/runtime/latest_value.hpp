#pragma once
// The newest value of something, over shared memory: one writer that never waits, any readers.
//
// Two sequence-locked buffers in turn (Lameter 2005; Boehm 2012 for the orderings): the writer
// fills the older one, so a reader of the newer is disturbed only if it sleeps through a whole
// write of the next. Words are copied through atomics, so a torn read is detected, never undefined.

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "service/runtime/cache_line.hpp"

namespace adstar::runtime {

/// The words of both buffers lie outside, so that the size can be chosen at run time.
class LatestWords {
  static constexpr std::size_t kLineWords = kLineBytes / 8, kAhead = 32;  // of lines

 public:
  /// Writer, a value at once. `storage` holds 2 * value.size() words.
  void write(std::span<std::uint64_t> storage, std::span<const std::uint64_t> value) noexcept {
    const std::uint64_t count = begin();
    put(count, storage, value, 0, value.size());
    end(count);
  }

  /// Writer, a value in parts: begin(), put() of every word, end(), all with what begin() has returned. Until then readers
  /// have the one before; one that never ends is nowhere.
  std::uint64_t begin() noexcept {
    const std::uint64_t count = count_.load(std::memory_order_relaxed) + 1;
    sequence_[count & 1].store(2 * count - 1, std::memory_order_relaxed);
    return count;
  }

  /// Words [first, last) of `value`, which is given whole.
  void put(std::uint64_t count, std::span<std::uint64_t> storage,
           std::span<const std::uint64_t> value, std::size_t first, std::size_t last) noexcept {
    std::uint64_t* const target = storage.data() + (count & 1) * value.size();
    for (std::size_t i = first; i < last; ++i) {
      const std::size_t ahead = i + kAhead * kLineWords;
      if (i % kLineWords == 0 && ahead < last) {
        claim(target + ahead);
      }
      std::atomic_ref(target[i]).store(value[i], std::memory_order_release);
    }
  }

  void end(std::uint64_t count) noexcept {
    sequence_[count & 1].store(2 * count, std::memory_order_release);
    count_.store(count, std::memory_order_release);
  }

  /// Reader. Returns how many values were ever written up to the one read, 0 for none (or none
  /// whole).
  std::uint64_t read(std::span<std::uint64_t> storage,
                     std::span<std::uint64_t> value) const noexcept {
    for (int attempt = 0; attempt < 4; ++attempt) {
      const std::uint64_t count = count_.load(std::memory_order_acquire);
      if (count == 0) {
        return 0;
      }
      const std::size_t half = count & 1;
      const std::uint64_t before = sequence_[half].load(std::memory_order_acquire);
      std::uint64_t* const source = storage.data() + half * value.size();
      for (std::size_t i = 0; i < value.size(); ++i) {
        value[i] = std::atomic_ref(source[i]).load(std::memory_order_acquire);
      }
      if (before == 2 * count && sequence_[half].load(std::memory_order_acquire) == before) {
        return count;
      }
    }
    return 0;
  }

 private:
  alignas(64) std::atomic<std::uint64_t> count_{0};
  std::atomic<std::uint64_t> sequence_[2]{};
};

/// The same for one fixed type.
template <class Value>
class LatestValue {
  static_assert(std::is_trivially_copyable_v<Value> && sizeof(Value) % 8 == 0);
  static constexpr std::size_t kWords = sizeof(Value) / 8;

 public:
  void write(const Value& value) noexcept {
    std::uint64_t words[kWords];
    std::memcpy(words, &value, sizeof value);
    lock_.write(storage_, words);
  }

  std::uint64_t read(Value& value) noexcept {
    std::uint64_t words[kWords];
    const std::uint64_t count = lock_.read(storage_, words);
    if (count > 0) {
      std::memcpy(&value, words, sizeof value);
    }
    return count;
  }

 private:
  LatestWords lock_;
  std::uint64_t storage_[2 * kWords]{};
};

}  // namespace adstar::runtime
