#pragma once
// Sizes as people write them: "100MB", "1.5 GiB".

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace adstar::bag {

/// Nothing when it is none, or more than fits.
std::optional<std::uint64_t> parse_size(std::string_view text);

/// "3.2 MB"
std::string format_size(std::uint64_t bytes);

}  // namespace adstar::bag
