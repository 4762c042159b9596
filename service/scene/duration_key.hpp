#pragma once
// A key that holds a duration: "10ms".

#include "service/scene/keys.hpp"

namespace adstar::scene {

inline constexpr std::string_view kDurationRule =
    "a duration above zero in whole nanoseconds (units ns, us, ms, s, min, h, d)";

/// Nothing for an absent value; a complaint and nothing for a wrong one.
std::optional<std::int64_t> read_duration(const Value& value, std::string_view example);

/// The same into `ns`, which has the default; "off" empties it.
void read_duration_or_off(const Value& value, std::string_view example,
                          std::optional<std::int64_t>& ns);

}  // namespace adstar::scene
