#pragma once
// Recorded topics as CSV: the columns of each, and how one of its samples becomes lines.

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace adstar::cli {

struct TopicTable {
  std::string_view name;  ///< "momentum_state"
  std::string columns;    ///< with its end of line
  /// Appends what `wants` (by the spacecraft's name) says yes to; false when the bytes are no such sample.
  bool (*append)(std::string& text, std::span<const std::byte> payload,
                 const std::function<bool(std::string_view)>& wants);
};

const std::vector<TopicTable>& topic_tables();

}  // namespace adstar::cli
