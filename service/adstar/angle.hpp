#pragma once
// Angles as people write them: "1e-6rad", "0.5deg", "1arcsec".

#include <optional>
#include <string_view>

namespace adstar::cli {

/// In radians; nothing when it is no angle above zero. A number alone counts as radians.
std::optional<double> parse_angle(std::string_view text);

}  // namespace adstar::cli
