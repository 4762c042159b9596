#pragma once
// Many spacecraft from one block: numbered names, and values drawn from ranges.
//
// What spacecraft i draws depends on (seed, i) alone, so that a fleet that grows keeps its members.
// Everything from the seed to the double is arithmetic that the standard fixes to the bit.

#include <cstdint>
#include <optional>
#include <random>
#include <string>

#include "adstar/attitude.hpp"
#include "service/scene/keys.hpp"

namespace adstar::scene {

/// The random numbers of one spacecraft: std::mt19937_64, whose output the standard fixes.
class Draws {
 public:
  Draws(std::uint64_t seed, std::uint64_t index) : seed_(seed), index_(index) {}

  /// 53 random bits in [0, 1).
  double unit();

 private:
  std::uint64_t seed_, index_;
  std::optional<std::mt19937_64> generator_;  ///< made when first needed: its state is 2.5 kB
};

/// Uniform over all rotations (Shoemake, Uniform random rotations, Graphics Gems III, 1992).
Quat<double> draw_rotation(Draws& draws);

/// A vector, or the box { min = [..], max = [..] } that it is drawn from, each component on its
/// own.
struct RangedVector {
  Vec3<double> min, max;
  bool drawn = false;

  Vec3<double> value(Draws& draws) const;
};
std::optional<RangedVector> read_ranged_vector(const Value& value, std::string_view example);

/// "sat{}" or "sat{:05}" (padded with zeros): the place of the index in a fleet's names.
struct NamePattern {
  std::string before, after;
  std::size_t width = 0;

  std::string name(std::uint64_t index) const;
};
/// The pattern for `count` names.
std::optional<NamePattern> read_name_pattern(const Value& value, std::int64_t count);

}  // namespace adstar::scene
