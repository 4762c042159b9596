#pragma once
// A trade as a table, as JSON, and as a picture.

#include <string>

#include "service/trade/campaign.hpp"

namespace adstar::trade {

/// A line a point, the front marked.
std::string table(const Trade& trade);

/// One object: horizon, reference, points. Numbers with 17 significant digits.
std::string json(const Trade& trade, const std::string& scene);

/// Work against precision: attitude error and momentum error over the cost, a line a scheme.
std::string picture(const Trade& trade, const std::string& scene);

}  // namespace adstar::trade
