#pragma once
// The front of the trade, and the cheapest point that is good enough.

#include <cstddef>
#include <optional>
#include <vector>

#include "service/trade/measure.hpp"

namespace adstar::trade {

/// Marks every point that no other beats in both cost and attitude error. Unresolved ones are never
/// on it.
void mark_front(std::vector<Measured>& points);

/// Index of the cheapest resolved point within `accuracy_rad` whose step of the whole scene costs
/// at most `budget_us`; none when there is none.
std::optional<std::size_t> cheapest(const std::vector<Measured>& points, double accuracy_rad,
                                    std::optional<double> budget_us);

}  // namespace adstar::trade
