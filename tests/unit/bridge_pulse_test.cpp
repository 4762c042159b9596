#include "service/adstard/bridge_pulse.hpp"

#include <gtest/gtest.h>

namespace adstar::adstard {
namespace {

constexpr std::int64_t kMs = 1'000'000;

/// Looks every 20 ms at a bridge that makes no round; the time it took to be called silent.
std::int64_t silence_until_noticed(BridgePulse& pulse, std::uint32_t rounds, std::int64_t now) {
  for (std::int64_t passed = 20 * kMs; passed < 60'000 * kMs; passed += 20 * kMs) {
    if (pulse.silent(rounds, now + passed)) {
      return passed;
    }
  }
  return -1;
}

TEST(BridgePulse, notices_silence_after_three_seconds) {
  BridgePulse pulse;
  pulse.begin(5, 0);
  EXPECT_FALSE(pulse.silent(6, 20 * kMs));
  EXPECT_EQ(silence_until_noticed(pulse, 6, 20 * kMs), 3020 * kMs);
}

TEST(BridgePulse, gives_a_bridge_ten_seconds_to_start) {
  BridgePulse pulse;
  pulse.begin(5, 0);
  EXPECT_EQ(silence_until_noticed(pulse, 5, 0), 10'020 * kMs);
}

TEST(BridgePulse, hears_one_round_as_life_even_when_the_count_wraps) {
  BridgePulse pulse;
  pulse.begin(0xFFFF'FFFFU, 0);
  for (int i = 1; i < 75; ++i) {
    EXPECT_FALSE(pulse.silent(i < 50 ? 0xFFFF'FFFFU : 0U, i * 100 * kMs));
  }
}

TEST(BridgePulse, does_not_take_its_own_standstill_for_the_bridges) {
  BridgePulse pulse;
  pulse.begin(1, 0);
  EXPECT_FALSE(pulse.silent(2, 20 * kMs));
  EXPECT_FALSE(pulse.silent(2, 3'600'000 * kMs)) << "an hour asleep, both of them";
  EXPECT_FALSE(pulse.silent(3, 3'600'020 * kMs));
}

TEST(BridgePulse, begins_anew_with_the_next_bridge) {
  BridgePulse pulse;
  pulse.begin(1, 0);
  EXPECT_FALSE(pulse.silent(2, 20 * kMs));
  ASSERT_GT(silence_until_noticed(pulse, 2, 20 * kMs), 0);
  pulse.begin(2, 100'000 * kMs);
  EXPECT_FALSE(pulse.silent(2, 100'020 * kMs));
}

}  // namespace
}  // namespace adstar::adstard
