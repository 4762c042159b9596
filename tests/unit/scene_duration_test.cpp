#include <limits>

#include <gtest/gtest.h>

#include "service/scene/scene.hpp"

namespace adstar::scene {
namespace {

constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();

TEST(Duration, reads_every_unit) {
  EXPECT_EQ(parse_duration("100ns"), 100);
  EXPECT_EQ(parse_duration("250us"), 250'000);
  EXPECT_EQ(parse_duration("250\u00b5s"), 250'000);
  EXPECT_EQ(parse_duration("250\u03bcs"), 250'000);
  EXPECT_EQ(parse_duration("10ms"), 10'000'000);
  EXPECT_EQ(parse_duration("3s"), 3'000'000'000);
  EXPECT_EQ(parse_duration("1min"), 60'000'000'000);
  EXPECT_EQ(parse_duration("2h"), 7'200'000'000'000);
  EXPECT_EQ(parse_duration("1d"), 86'400'000'000'000);
}

TEST(Duration, reads_decimals_exactly) {
  EXPECT_EQ(parse_duration("1.5s"), 1'500'000'000);
  EXPECT_EQ(parse_duration("0.000000001s"), 1);
  EXPECT_EQ(parse_duration("1.50000000000000000000000000s"), 1'500'000'000);
  EXPECT_EQ(parse_duration("0.1d"), 8'640'000'000'000);
  EXPECT_EQ(parse_duration("9007199.254740993s"), 9'007'199'254'740'993);  // not a double
  EXPECT_EQ(parse_duration("1.00000000003125d"), 86'400'000'002'700);
}

TEST(Duration, reads_one_space_and_zero) {
  EXPECT_EQ(parse_duration("10 ms"), 10'000'000);
  EXPECT_EQ(parse_duration("0s"), 0);
}

TEST(Duration, refuses_what_is_none) {
  for (const char* text :
       {"", "10", "ms", " 10ms", "10  ms", "10ms ", "-10ms", "+10ms", "1..5s", ".", ".s", "1.s",
        "1e3s", "10 minutes", "10MS", "nan s", "0x10s", "10,5s"}) {
    EXPECT_EQ(parse_duration(text), std::nullopt) << text;
  }
}

TEST(Duration, refuses_fractions_of_a_nanosecond) {
  EXPECT_EQ(parse_duration("0.5ns"), std::nullopt);
  EXPECT_EQ(parse_duration("1.0000000001s"), std::nullopt);
  EXPECT_EQ(parse_duration("1.00000000003126d"), std::nullopt);
}

TEST(Duration, ends_where_64_bits_end) {
  EXPECT_EQ(parse_duration("9223372036854775807ns"), kMost);
  EXPECT_EQ(parse_duration("9223372036854775808ns"), std::nullopt);
  EXPECT_EQ(parse_duration("106752d"), std::nullopt);
  EXPECT_EQ(parse_duration("99999999999999999999999999999999999999999s"), std::nullopt);
}

TEST(Duration, is_written_in_the_largest_short_unit) {
  EXPECT_EQ(format_duration(0), "0s");
  EXPECT_EQ(format_duration(1), "1ns");
  EXPECT_EQ(format_duration(10'000'000), "10ms");
  EXPECT_EQ(format_duration(100'000'000), "100ms");
  EXPECT_EQ(format_duration(12'500'000), "12.5ms");
  EXPECT_EQ(format_duration(1'500'000'000), "1.5s");
  EXPECT_EQ(format_duration(90'000'000'000), "90s");
  EXPECT_EQ(format_duration(7'200'000'000'000), "2h");
  EXPECT_EQ(format_duration(86'400'000'000'000), "1d");
  EXPECT_EQ(format_duration(-10'000'000), "-10ms");
  EXPECT_EQ(format_duration(std::numeric_limits<std::int64_t>::min()), "-9223372036.854775808s");
}

TEST(Duration, reads_back_what_it_wrote) {
  std::uint64_t random = 1;
  for (int i = 0; i < 10'000; ++i) {
    random = random * 6364136223846793005U + 1442695040888963407U;
    const auto ns = static_cast<std::int64_t>(random >> (1 + i % 63));
    EXPECT_EQ(parse_duration(format_duration(ns)), ns) << format_duration(ns);
  }
  EXPECT_EQ(parse_duration(format_duration(kMost)), kMost);
}

}  // namespace
}  // namespace adstar::scene
