#include "service/scene/nearest.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace adstar::scene {
namespace {

constexpr std::size_t kShortestFragment = 3;

bool one_contains_the_other(std::string_view a, std::string_view b) {
  const auto& [inner, outer] = a.size() <= b.size() ? std::pair(a, b) : std::pair(b, a);
  return inner.size() >= kShortestFragment && outer.find(inner) != std::string_view::npos;
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) {
    row[j] = j;
  }
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(before_last, last);
    std::swap(last, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substitution = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, substitution});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        row[j] = std::min(row[j], before_last[j - 2] + 1);
      }
    }
  }
  return row[b.size()];
}

std::optional<std::string_view> nearest(std::string_view typed,
                                        std::span<const std::string_view> known) {
  using Score = std::pair<std::size_t, std::size_t>;
  std::optional<Score> best;
  std::optional<std::string_view> found;
  for (const std::string_view word : known) {
    const std::size_t distance = edit_distance(typed, word);
    const Score score{
        one_contains_the_other(typed, word) ? std::min<std::size_t>(1, distance) : distance,
        distance};
    if (!best || score < *best) {
      best = score;
      found = word;
    }
  }
  return found;
}

std::optional<std::string_view> nearest_plausible(std::string_view typed,
                                                  std::span<const std::string_view> known) {
  const auto found = nearest(typed, known);
  if (!found || one_contains_the_other(typed, *found)) {
    return found;
  }
  const std::size_t tolerated = std::max<std::size_t>(1, std::max(typed.size(), found->size()) / 3);
  return edit_distance(typed, *found) <= tolerated ? found : std::nullopt;
}

std::string joined(std::span<const std::string_view> words) {
  std::string list;
  for (const std::string_view word : words) {
    if (!list.empty()) {
      list += ", ";
    }
    list += word;
  }
  return list;
}

}  // namespace adstar::scene
