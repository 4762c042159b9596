#include "service/runtime/shared_segment.hpp"

#include <atomic>
#include <chrono>
#include <cstring>
#include <fcntl.h>
#include <stdexcept>
#include <sys/mman.h>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace adstar::runtime {
namespace {

/// The other side's view, as the bridge gets it: a descriptor of its own on the same memory.
MappedSegment other_side(const MappedSegment& segment) {
  return MappedSegment::attach(fcntl(segment.fd(), F_DUPFD_CLOEXEC, 0));
}

struct OwnFd {
  int fd;
  ~OwnFd() { close(fd); }
};

TEST(SharedSegment, shows_both_sides_the_same_memory) {
  MappedSegment daemon = MappedSegment::create(3);
  MappedSegment bridge = other_side(daemon);
  EXPECT_NE(&*daemon, &*bridge);
  EXPECT_EQ(bridge.fleet_size(), 3U);

  CommandRecord command;
  command.sequence = 42;
  ASSERT_TRUE(bridge->commands.push(command));
  const auto got = daemon->commands.pop();
  ASSERT_TRUE(got.has_value());
  EXPECT_EQ(got->sequence, 42U);

  VerdictRecord verdict;
  verdict.step = 7;
  ASSERT_TRUE(daemon->verdicts.push(verdict));
  EXPECT_EQ(bridge->verdicts.pop()->step, 7U);

  bridge->snapshot_requested = 1;
  EXPECT_EQ(daemon->snapshot_requested.exchange(0), 1U);
  EXPECT_EQ(bridge->snapshot_requested.load(), 0U);
}

TEST(SharedSegment, carries_the_fleet_behind_it_to_the_last_word) {
  for (const std::size_t members : {std::size_t{0}, std::size_t{1}, std::size_t{1000}}) {
    MappedSegment daemon = MappedSegment::create(members);
    MappedSegment bridge = other_side(daemon);
    ASSERT_EQ(daemon.fleet_storage().size(), 2 * fleet_words(members));
    std::vector<std::uint64_t> words(fleet_words(members)), got(words.size());
    for (std::uint64_t round = 1; round <= 3; ++round) {
      for (std::size_t i = 0; i < words.size(); ++i) {
        words[i] = round * 1'000'000 + i;
      }
      daemon->fleet.write(daemon.fleet_storage(), words);
      EXPECT_EQ(bridge->fleet.read(bridge.fleet_storage(), got), round);
      EXPECT_EQ(got, words);
    }
  }
}

TEST(SharedSegment, begins_empty_and_in_the_state_of_starting) {
  MappedSegment segment = MappedSegment::create(1);
  EXPECT_EQ(segment->bridge_state.load(), static_cast<std::uint32_t>(BridgeState::starting));
  EXPECT_EQ(segment->stop_requested.load(), 0U);
  EXPECT_FALSE(segment->commands.pop().has_value());
  EXPECT_FALSE(segment->verdicts.pop().has_value());
  EXPECT_FALSE(segment->telemetry.pop().has_value());
  StatusRecord status;
  EXPECT_EQ(segment->status.read(status), 0U);
}

TEST(SharedSegment, can_be_neither_shrunk_nor_grown_nor_unsealed) {
  const MappedSegment segment = MappedSegment::create(2);
  const int seals = fcntl(segment.fd(), F_GET_SEALS);
  EXPECT_EQ(seals & F_SEAL_SHRINK, F_SEAL_SHRINK);
  EXPECT_EQ(seals & F_SEAL_GROW, F_SEAL_GROW);
  EXPECT_EQ(seals & F_SEAL_SEAL, F_SEAL_SEAL);
  EXPECT_NE(ftruncate(segment.fd(), 0), 0);
  EXPECT_NE(ftruncate(segment.fd(), 1 << 30), 0);
}

TEST(SharedSegment, is_not_inherited_by_chance) {
  const MappedSegment segment = MappedSegment::create(1);
  EXPECT_NE(fcntl(segment.fd(), F_GETFD) & FD_CLOEXEC, 0);
}

TEST(SharedSegment, of_another_build_is_refused) {
  MappedSegment segment = MappedSegment::create(2);
  segment->layout ^= 1;
  const OwnFd fd{dup(segment.fd())};
  EXPECT_THROW(MappedSegment::attach(fd.fd), std::runtime_error);
}

TEST(SharedSegment, whose_fleet_does_not_fit_its_size_is_refused) {
  for (const std::uint64_t lie :
       {std::uint64_t{0}, std::uint64_t{3}, ~std::uint64_t{0}, std::uint64_t{1} << 61,
        std::uint64_t{2} + (std::uint64_t{1} << 61)}) {
    MappedSegment segment = MappedSegment::create(2);
    segment->fleet_size = lie;
    const OwnFd fd{dup(segment.fd())};
    EXPECT_THROW(MappedSegment::attach(fd.fd), std::runtime_error) << lie;
  }
}

TEST(SharedSegment, that_is_too_small_or_no_memory_at_all_is_refused) {
  const OwnFd small{memfd_create("small", MFD_CLOEXEC)};
  ASSERT_EQ(ftruncate(small.fd, 64), 0);
  EXPECT_THROW(MappedSegment::attach(small.fd), std::runtime_error);
  EXPECT_THROW(MappedSegment::attach(-1), std::runtime_error);
}

TEST(SharedSegment, does_not_believe_the_other_side_about_the_size_of_the_fleet) {
  MappedSegment segment = MappedSegment::create(2);
  segment->fleet_size = 1'000'000;
  EXPECT_EQ(segment.fleet_size(), 2U);
  EXPECT_EQ(segment.fleet_storage().size(), 2 * fleet_words(2));
}

TEST(SharedSegment, can_be_attached_again_after_a_dying_bridge_scribbled_on_its_header) {
  const MappedSegment segment = MappedSegment::create(3);
  segment->layout = 0;
  segment->fleet_size = 1'000'000;
  const OwnFd refused{dup(segment.fd())};
  EXPECT_THROW(MappedSegment::attach(refused.fd), std::runtime_error);
  segment.restore_header();
  EXPECT_EQ(MappedSegment::attach(dup(segment.fd())).fleet_size(), 3U);
}

TEST(SharedSegment, moves_with_its_memory_and_closes_once) {
  MappedSegment first = MappedSegment::create(2);
  SharedSegment* const memory = &*first;
  const int fd = first.fd();
  {
    const MappedSegment second = std::move(first);
    EXPECT_EQ(&*second, memory);
    EXPECT_EQ(second.fd(), fd);
    EXPECT_EQ(second.fleet_size(), 2U);
    EXPECT_NE(fcntl(fd, F_GETFD), -1);
  }
  EXPECT_EQ(fcntl(fd, F_GETFD), -1);
}

// ---- wake and sleep ----

constexpr int kLong_ms = 60'000;

TEST(SharedSegment, does_not_sleep_through_a_wake_that_came_before) {
  MappedSegment segment = MappedSegment::create(0);
  const std::uint32_t seen = segment->wake_count.load();
  wake_bridge(*segment);
  const auto begun = std::chrono::steady_clock::now();
  sleep_until_woken(*segment, seen, kLong_ms);
  EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::milliseconds(kLong_ms));
  EXPECT_EQ(segment->bridge_sleeps.load(), 0U);
}

TEST(SharedSegment, sleeps_no_longer_than_its_timeout) {
  MappedSegment segment = MappedSegment::create(0);
  const auto begun = std::chrono::steady_clock::now();
  sleep_until_woken(*segment, segment->wake_count.load(), 20);
  EXPECT_GE(std::chrono::steady_clock::now() - begun, std::chrono::milliseconds(15));
  EXPECT_EQ(segment->bridge_sleeps.load(), 0U);
}

TEST(SharedSegment, wakes_a_sleeper_on_the_other_mapping_every_time) {
  MappedSegment daemon = MappedSegment::create(0);
  MappedSegment bridge = other_side(daemon);
  constexpr std::uint32_t kRounds = 200;
  std::atomic<std::uint32_t> answered{0};
  std::atomic<bool> overslept{false};
  std::thread sleeper([&] {
    for (std::uint32_t seen = 0; seen < kRounds && !overslept;) {
      const auto begun = std::chrono::steady_clock::now();
      sleep_until_woken(*bridge, seen, kLong_ms);
      overslept = std::chrono::steady_clock::now() - begun >= std::chrono::milliseconds(kLong_ms);
      seen = bridge->wake_count.load();
      answered = seen;
    }
  });
  for (std::uint32_t round = 1; round <= kRounds && !overslept; ++round) {
    if (round % 2 == 0) {  // half the time only once it sleeps for certain
      while (daemon->bridge_sleeps.load() == 0 && !overslept) {
        std::this_thread::yield();
      }
    }
    wake_bridge(*daemon);
    while (answered < round && !overslept) {
      std::this_thread::yield();
    }
  }
  sleeper.join();
  EXPECT_FALSE(overslept);
  EXPECT_EQ(answered, kRounds);
}

}  // namespace
}  // namespace adstar::runtime
