#include "service/runtime/ring.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <memory>
#include <new>
#include <random>
#include <thread>

#include <gtest/gtest.h>

namespace adstar::runtime {
namespace {

/// Three words that belong together.
struct Entry {
  std::uint64_t sequence = 0;
  std::uint64_t twice = 0;
  std::uint64_t inverse = 0;
};

Entry entry(std::uint64_t n) { return {n, 2 * n, ~n}; }
bool whole(const Entry& e) { return e.twice == 2 * e.sequence && e.inverse == ~e.sequence; }

using Ring = SpscRing<Entry, 8>;

/// Where the indices lie, as a peer that shares the memory sees them: each on a cache line of its
/// own.
std::atomic<std::uint64_t>& producer_index(void* ring) {
  return *static_cast<std::atomic<std::uint64_t>*>(ring);
}
std::atomic<std::uint64_t>& consumer_index(void* ring) {
  return *reinterpret_cast<std::atomic<std::uint64_t>*>(static_cast<std::byte*>(ring) + 64);
}

TEST(SpscRing, gives_entries_in_the_order_they_came) {
  Ring ring;
  for (std::uint64_t round = 0; round < 100; ++round) {
    for (std::uint64_t i = 0; i < 5; ++i) {
      ASSERT_TRUE(ring.push(entry(5 * round + i)));
    }
    for (std::uint64_t i = 0; i < 5; ++i) {
      const auto got = ring.pop();
      ASSERT_TRUE(got.has_value());
      ASSERT_EQ(got->sequence, 5 * round + i);
    }
  }
  EXPECT_FALSE(ring.pop().has_value());
}

TEST(SpscRing, refuses_when_full_and_keeps_what_it_has) {
  Ring ring;
  for (std::uint64_t i = 0; i < Ring::kCapacity; ++i) {
    ASSERT_TRUE(ring.push(entry(i)));
  }
  EXPECT_FALSE(ring.push(entry(99)));
  EXPECT_EQ(ring.size(), Ring::kCapacity);
  EXPECT_EQ(ring.pop()->sequence, 0u);
  EXPECT_TRUE(ring.push(entry(8)));
  for (std::uint64_t i = 1; i <= 8; ++i) {
    EXPECT_EQ(ring.pop()->sequence, i);
  }
  EXPECT_EQ(ring.size(), 0u);
}

TEST(SpscRing, skips_what_was_waiting_when_asked) {
  Ring ring;
  ring.push(entry(1));
  ring.push(entry(2));
  ring.skip_all();
  EXPECT_FALSE(ring.pop().has_value());
  ring.push(entry(3));
  EXPECT_EQ(ring.pop()->sequence, 3u);
}

TEST(SpscRing, goes_on_when_its_indices_pass_two_to_the_64) {
  Ring ring;
  producer_index(&ring) = ~std::uint64_t{0} - 2;
  consumer_index(&ring) = ~std::uint64_t{0} - 2;
  for (std::uint64_t i = 0; i < 20; ++i) {
    ASSERT_TRUE(ring.push(entry(i)));
    ASSERT_EQ(ring.size(), 1u);
    ASSERT_EQ(ring.pop()->sequence, i);
  }
}

/// A ring between two fences of known bytes.
class FencedRing {
 public:
  FencedRing() : memory_(new (std::align_val_t{64}) Memory) { fill(); }
  Ring& ring() { return memory_->ring; }
  void* bytes() { return &memory_->ring; }
  bool fences_stand() const {
    const auto stands = [](const auto& fence) {
      return std::all_of(fence.begin(), fence.end(), [](std::uint8_t b) { return b == 0xA5; });
    };
    return stands(memory_->before) && stands(memory_->after);
  }

 private:
  struct alignas(64) Memory {
    std::array<std::uint8_t, 4096> before;
    Ring ring;
    std::array<std::uint8_t, 4096> after;
  };
  void fill() {
    memory_->before.fill(0xA5);
    memory_->after.fill(0xA5);
  }
  std::unique_ptr<Memory> memory_;
};

TEST(SpscRing, survives_a_producer_that_writes_nonsense_into_its_index) {
  std::mt19937_64 random(61);
  FencedRing fenced;
  Ring& ring = fenced.ring();
  for (int i = 0; i < 20'000; ++i) {
    producer_index(fenced.bytes()) = random();
    for (std::size_t taken = 0; ring.pop().has_value(); ++taken) {
      ASSERT_LE(taken, Ring::kCapacity);
    }
    ASSERT_LE(ring.size(), Ring::kCapacity);
    ASSERT_TRUE(
        ring.push(entry(7)));  // after the nonsense is skipped the ring is empty, and good again
    const auto got = ring.pop();
    ASSERT_TRUE(got.has_value());
    ASSERT_EQ(got->sequence, 7u);
  }
  EXPECT_TRUE(fenced.fences_stand());
}

TEST(SpscRing, skips_to_a_producer_index_that_is_too_far_ahead) {
  Ring ring;
  ring.push(entry(1));
  producer_index(&ring) = 1000;
  EXPECT_FALSE(ring.pop().has_value());
  EXPECT_EQ(ring.size(), 0u);
}

TEST(SpscRing, refuses_while_the_consumers_index_is_nonsense_and_writes_nothing_outside) {
  std::mt19937_64 random(62);
  FencedRing fenced;
  Ring& ring = fenced.ring();
  for (int i = 0; i < 20'000; ++i) {
    const std::uint64_t head = producer_index(fenced.bytes());
    const std::uint64_t nonsense = i % 2 == 0 ? head + 1 + random() % 1000 : random();
    consumer_index(fenced.bytes()) = nonsense;
    const bool room = head - nonsense < Ring::kCapacity;
    ASSERT_EQ(ring.push(entry(1)), room);
    ASSERT_LE(ring.size(), Ring::kCapacity);
    consumer_index(fenced.bytes()) = producer_index(fenced.bytes()).load();
    ASSERT_TRUE(ring.push(entry(2)));
  }
  EXPECT_TRUE(fenced.fences_stand());
}

TEST(SpscRing, loses_and_tears_nothing_between_two_threads) {
  constexpr std::uint64_t kEntries = 300'000;
  Ring ring;
  std::atomic<std::uint64_t> refused{0};
  std::jthread producer([&] {
    for (std::uint64_t n = 0; n < kEntries;) {
      if (ring.push(entry(n))) {
        ++n;
      } else {
        refused.fetch_add(1, std::memory_order_relaxed);
        std::this_thread::yield();
      }
    }
  });
  std::uint64_t expected = 0, torn = 0, out_of_order = 0;
  while (expected < kEntries) {
    if (const auto got = ring.pop()) {
      torn += whole(*got) ? 0 : 1;
      out_of_order += got->sequence == expected ? 0 : 1;
      ++expected;
    } else {
      std::this_thread::yield();
    }
  }
  producer.join();
  EXPECT_EQ(torn, 0u);
  EXPECT_EQ(out_of_order, 0u);
  EXPECT_FALSE(ring.pop().has_value());
  RecordProperty("refused_when_full", std::to_string(refused.load()));
}

TEST(SpscRing, never_gives_a_torn_entry_while_a_skipping_consumer_races_the_producer) {
  constexpr std::uint64_t kEntries = 200'000;
  Ring ring;
  std::atomic<bool> done{false};
  std::jthread producer([&] {
    for (std::uint64_t n = 0; n < kEntries; ++n) {
      if (!ring.push(entry(n))) {
        std::this_thread::yield();
      }
    }
    done.store(true, std::memory_order_release);
  });
  std::uint64_t torn = 0, backwards = 0, next = 0, taken = 0;
  while (!done.load(std::memory_order_acquire)) {
    if (++taken % 5 == 0) {
      ring.skip_all();
    }
    if (const auto got = ring.pop()) {
      torn += whole(*got) ? 0 : 1;
      backwards += got->sequence < next ? 1 : 0;
      next = got->sequence + 1;
    }
  }
  EXPECT_EQ(torn, 0u);
  EXPECT_EQ(backwards, 0u);
}

}  // namespace
}  // namespace adstar::runtime
