#include "service/runtime/latest_value.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace adstar::runtime {
namespace {

/// Every word tells the same number, so that a mixture of two values shows.
struct Value {
  std::array<std::uint64_t, 32> words{};
};

Value value(std::uint64_t n) {
  Value v;
  v.words.fill(n);
  return v;
}
bool whole(const Value& v) {
  return std::all_of(v.words.begin(), v.words.end(),
                     [&](std::uint64_t w) { return w == v.words[0]; });
}

TEST(LatestValue, has_nothing_before_the_first_write) {
  LatestValue<Value> latest;
  Value got = value(77);
  EXPECT_EQ(latest.read(got), 0u);
  EXPECT_EQ(got.words[0], 77u) << "the caller's value must not be touched";
}

TEST(LatestValue, gives_the_newest_value_and_how_many_there_were) {
  LatestValue<Value> latest;
  for (std::uint64_t n = 1; n <= 10; ++n) {
    latest.write(value(100 + n));
    for (int again = 0; again < 2; ++again) {
      Value got;
      ASSERT_EQ(latest.read(got), n);
      ASSERT_TRUE(whole(got));
      ASSERT_EQ(got.words[0], 100 + n);
    }
  }
}

TEST(LatestWords, keep_a_value_whose_size_is_chosen_at_run_time) {
  for (const std::size_t size : {std::size_t{1}, std::size_t{7}, std::size_t{1000}}) {
    LatestWords latest;
    std::vector<std::uint64_t> storage(2 * size), first(size, 1), second(size, 2), got(size);
    EXPECT_EQ(latest.read(storage, got), 0u);
    latest.write(storage, first);
    EXPECT_EQ(latest.read(storage, got), 1u);
    EXPECT_EQ(got, first);
    latest.write(storage, second);
    EXPECT_EQ(latest.read(storage, got), 2u);
    EXPECT_EQ(got, second);
  }
}

TEST(LatestWords, written_in_parts_are_the_value_before_until_the_last_part) {
  LatestWords latest;
  constexpr std::size_t kSize = 100;
  std::vector<std::uint64_t> storage(2 * kSize), before(kSize, 1), next(kSize, 2), got(kSize);
  latest.write(storage, before);
  const std::uint64_t count = latest.begin();
  for (std::size_t first = 0; first < kSize; first += 30) {
    EXPECT_EQ(latest.read(storage, got), 1u);
    EXPECT_EQ(got, before);
    latest.put(count, storage, next, first, std::min(first + 30, kSize));
  }
  EXPECT_EQ(latest.read(storage, got), 1u);
  latest.end(count);
  EXPECT_EQ(latest.read(storage, got), 2u);
  EXPECT_EQ(got, next);
}

/// A reader that races a writer of values 1, 2, 3, ... without a pause.
struct Reader {
  std::uint64_t torn = 0, backwards = 0, mislabelled = 0;
  std::atomic<std::uint64_t> seen{0};

  void run(LatestValue<Value>& latest, const std::atomic<bool>& done) {
    std::uint64_t last = 0;
    while (!done.load(std::memory_order_acquire)) {
      Value got;
      const std::uint64_t count = latest.read(got);
      if (count == 0) {
        continue;
      }
      seen.fetch_add(1, std::memory_order_relaxed);
      torn += whole(got) ? 0 : 1;
      mislabelled += got.words[0] == count ? 0 : 1;
      backwards += count < last ? 1 : 0;
      last = count;
    }
  }
};

TEST(LatestValue, is_never_torn_between_a_writer_and_two_readers) {
  LatestValue<Value> latest;
  std::atomic<bool> done{false};
  std::array<Reader, 2> readers;
  std::vector<std::jthread> threads;
  for (Reader& reader : readers) {
    threads.emplace_back([&] { reader.run(latest, done); });
  }
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  const auto all_have_read = [&] {
    return std::all_of(readers.begin(), readers.end(),
                       [](const Reader& r) { return r.seen > 1000; });
  };
  std::uint64_t written = 0;
  while (written < 200'000 || (!all_have_read() && std::chrono::steady_clock::now() < deadline)) {
    latest.write(value(++written));
  }
  done.store(true, std::memory_order_release);
  threads.clear();
  for (const Reader& reader : readers) {
    EXPECT_GT(reader.seen, 1000u);
    EXPECT_EQ(reader.torn, 0u);
    EXPECT_EQ(reader.mislabelled, 0u);
    EXPECT_EQ(reader.backwards, 0u);
  }
  Value got;
  EXPECT_EQ(latest.read(got), written);
  EXPECT_EQ(got.words[0], written);
}

TEST(LatestValue, is_read_whole_while_the_writer_is_stuck_half_way_through_the_next) {
  // What a writer leaves that died in the middle: its half is marked odd, its count not yet raised.
  LatestWords latest;
  std::vector<std::uint64_t> storage(8), one(4, 1), two(4, 2), got(4);
  latest.write(storage, one);
  latest.write(storage, two);
  storage[4] = 3;  // value 3 goes to the half of value 1
  storage[5] = 3;
  EXPECT_EQ(latest.read(storage, got), 2u);
  EXPECT_EQ(got, two);
}

}  // namespace
}  // namespace adstar::runtime
