#include "service/runtime/command_memory.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace adstar::runtime {
namespace {

VerdictRecord verdict(std::uint64_t sequence) {
  VerdictRecord record;
  record.sequence = sequence;
  return record;
}

TEST(Stream, recalls_the_last_eight_final_verdicts_and_no_more) {
  Stream stream;
  for (std::uint64_t n = 1; n <= 20; ++n) {
    stream.remember(verdict(n));
  }
  for (std::uint64_t n = 0; n <= 21; ++n) {
    const VerdictRecord* const known = stream.recall(n);
    ASSERT_EQ(known != nullptr, n >= 13 && n <= 20) << n;
    EXPECT_TRUE(known == nullptr || known->sequence == n);
  }
}

TEST(Stream, recalls_nothing_for_sequence_zero) { EXPECT_EQ(Stream{}.recall(0), nullptr); }

TEST(CommandMemory, finds_the_same_stream_again) {
  CommandMemory memory(10);
  Stream* const stream = memory.find_or_make({1, 2}, 3, 1);
  ASSERT_NE(stream, nullptr);
  stream->last_sequence = 42;
  EXPECT_EQ(memory.find_or_make({1, 2}, 3, 2), stream);
  EXPECT_EQ(stream->last_sequence, 42U);
  EXPECT_EQ(&memory.at(memory.index_of(*stream)), stream);
}

TEST(CommandMemory, keeps_streams_apart_that_differ_in_one_word) {
  CommandMemory memory(10);
  Stream* const stream = memory.find_or_make({1, 2}, 3, 1);
  EXPECT_NE(memory.find_or_make({2, 2}, 3, 2), stream);
  EXPECT_NE(memory.find_or_make({1, 3}, 3, 3), stream);
  EXPECT_NE(memory.find_or_make({1, 2}, 4, 4), stream);
}

TEST(CommandMemory, never_gives_away_a_stream_with_a_command_in_force_or_waiting) {
  CommandMemory memory(1);
  std::vector<CommanderId> busy;
  bool refused = false;
  for (std::uint64_t n = 1; n <= 1'000'000 && !refused; ++n) {
    Stream* const stream = memory.find_or_make({n, ~n}, 0, n);
    refused = stream == nullptr;
    if (!refused) {
      ASSERT_EQ(stream->live, 0U) << "a busy one was given away";
      stream->live = 1;
      stream->last_sequence = n;
      busy.push_back({n, ~n});
    }
  }
  ASSERT_TRUE(refused) << "memory without bound";
  EXPECT_GT(busy.size(), 1000U);
  for (const CommanderId& commander : busy) {
    const Stream* const stream = memory.find_or_make(commander, 0, 1);
    ASSERT_NE(stream, nullptr);
    EXPECT_EQ(stream->last_sequence, commander.high);
  }
}

TEST(CommandMemory, has_room_for_one_commander_on_every_actuator_of_a_large_fleet) {
  constexpr std::uint32_t kActuators = 10'000;
  CommandMemory memory(kActuators);
  std::uint32_t kept = 0;
  for (std::uint32_t actuator = 0; actuator < kActuators; ++actuator) {
    Stream* const stream = memory.find_or_make({5, 6}, actuator, actuator);
    if (stream != nullptr) {
      stream->live = 1;
      ++kept;
    }
  }
  EXPECT_EQ(kept, kActuators);
}

TEST(CommandMemory, forgets_the_longest_silent_first) {
  CommandMemory memory(1);
  // The first speaks again and again while strangers pass by; the second falls silent.
  const CommanderId talker{1, 1}, silent{2, 2};
  memory.find_or_make(talker, 0, 1)->last_sequence = 10;
  memory.find_or_make(silent, 0, 2)->last_sequence = 20;
  for (std::uint64_t n = 3; n < 60'000; ++n) {
    ASSERT_NE(memory.find_or_make({n, n + 1'000'000}, 0, n), nullptr);
    ASSERT_EQ(memory.find_or_make(talker, 0, n)->last_sequence, 10U);
  }
  EXPECT_EQ(memory.find_or_make(silent, 0, 60'000)->last_sequence, 0U);
}

TEST(CommandMemory, chooses_by_the_stream_of_commands_alone) {
  CommandMemory one(100), other(100);
  for (std::uint64_t n = 1; n < 100'000; ++n) {
    const CommanderId commander{n * 0x9e3779b97f4a7c15U % 3000, 1};
    const auto actuator = static_cast<std::uint32_t>(n % 7);
    Stream* const a = one.find_or_make(commander, actuator, n);
    Stream* const b = other.find_or_make(commander, actuator, n);
    ASSERT_EQ(a == nullptr, b == nullptr);
    ASSERT_EQ(one.index_of(*a), other.index_of(*b));
  }
}

}  // namespace
}  // namespace adstar::runtime
