// What a standby's bridge does without a bus: checkpoints in parts, and who of two primaries goes before.
#include <cstring>
#include <string>

#include <gtest/gtest.h>

#include "service/bridge/claim.hpp"
#include "service/bridge/standby_checkpoints.hpp"

namespace adstar::bridge {
namespace {

std::optional<std::string> add(CheckpointParts& parts, std::uint64_t checkpoint, std::uint32_t part,
                               std::uint32_t count, const std::string& text) {
  const auto* const bytes = reinterpret_cast<const std::uint8_t*>(text.data());
  const auto whole = parts.add(checkpoint, part, count, {bytes, text.size()});
  if (!whole) {
    return std::nullopt;
  }
  return std::string(reinterpret_cast<const char*>(whole->data()), whole->size());
}

TEST(CheckpointParts, are_put_together_in_whatever_order_they_come) {
  CheckpointParts parts;
  EXPECT_FALSE(add(parts, 7, 2, 3, "xyz"));
  EXPECT_FALSE(add(parts, 7, 0, 3, "ab"));
  EXPECT_FALSE(add(parts, 7, 0, 3, "ab"));  // again
  EXPECT_EQ(add(parts, 7, 1, 3, "c"), "abcxyz");
}

TEST(CheckpointParts, of_a_newer_one_displace_those_of_an_older) {
  CheckpointParts parts;
  EXPECT_FALSE(add(parts, 7, 0, 2, "old"));
  EXPECT_FALSE(add(parts, 8, 1, 2, "er"));
  EXPECT_FALSE(add(parts, 7, 1, 2, "old"));
  EXPECT_EQ(add(parts, 8, 0, 2, "new"), "newer");
}

TEST(CheckpointParts, that_make_no_sense_are_nobodys) {
  CheckpointParts parts;
  EXPECT_FALSE(add(parts, 7, 3, 3, "x"));
  EXPECT_FALSE(add(parts, 7, 0, 0, "x"));
  EXPECT_FALSE(add(parts, 7, 0, 4'000'000'000U, "x"));
  EXPECT_FALSE(add(parts, 7, 0, 2, "a"));
  EXPECT_EQ(add(parts, 7, 0, 1, "b"), "b");  // of another count: they begin anew
}

TEST(Claims, the_higher_term_goes_before_and_of_equal_ones_the_lower_process) {
  EXPECT_TRUE(goes_before({3, {9, 9}}, {2, {1, 1}}));
  EXPECT_FALSE(goes_before({2, {1, 1}}, {3, {9, 9}}));
  EXPECT_TRUE(goes_before({2, {1, 1}}, {2, {1, 2}}));
  EXPECT_FALSE(goes_before({2, {1, 2}}, {2, {1, 1}}));
  EXPECT_FALSE(goes_before({2, {1, 1}}, {2, {1, 1}}));
}

}  // namespace
}  // namespace adstar::bridge
