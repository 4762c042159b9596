#pragma once
// Recorded topics as rows: the columns of each table, and the rows of one recording. A table is a topic, or
// "motion": attitude and momentum of a step in one row, as `adstar propagate` and `monitor` print them.

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "service/bag/recording.hpp"
#include "service/report/fields.hpp"

namespace adstar::samples {

struct Table {
  std::string name;     ///< "motion", "momentum_state"
  std::string columns;  ///< between commas
};

/// "motion" first.
const std::vector<Table>& tables();

/// Says yes to a spacecraft by its name. FleetState does not ask: the roster has its names.
using Wants = std::function<bool(std::string_view)>;
/// Hears a row; it is lent for the call.
using HearsRow = std::function<void(const report::Fields&)>;

/// Rows of what is wanted, in the order of the recording; returns how many samples could not be read.
/// Throws bag::Error on a file that cannot be read. The table is one of those above.
std::uint64_t for_each_row(const bag::Recording& recording, std::string_view table,
                           const Wants& wants, const HearsRow& hears);

}  // namespace adstar::samples
