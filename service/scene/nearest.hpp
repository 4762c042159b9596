#pragma once
// "Did you mean": the known word nearest to what somebody typed.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace adstar::scene {

/// Insertions, deletions, substitutions and swaps of neighbours that turn `a` into `b`
/// (Damerau 1964, each letter touched once: the optimal string alignment distance).
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The nearest of `known`, the first of equals; one that contains `typed` (or is contained) counts
/// as near.
std::optional<std::string_view> nearest(std::string_view typed,
                                        std::span<const std::string_view> known);

/// The same, but nothing when even the nearest is a different word.
std::optional<std::string_view> nearest_plausible(std::string_view typed,
                                                  std::span<const std::string_view> known);

/// "a, b, c"
std::string joined(std::span<const std::string_view> words);

}  // namespace adstar::scene
