#pragma once
// Which steps to try, and at which instants to look.

#include <cstdint>
#include <vector>

#include "service/scene/scene.hpp"

namespace adstar::trade {

/// Ten equal parts of the horizon when that comes out in whole nanoseconds, else fewer.
std::vector<std::int64_t> instants_of(std::int64_t horizon_ns);

/// Largest |omega| that free motion of the scene's spacecraft can reach [rad/s].
double fastest_rad_s(const std::vector<scene::Spacecraft>& spacecraft);

/// Steps whose digits are 1, 1.25, 2, 2.5, 4, 5 or 8, descending, that fit the instants and turn the
/// fastest spacecraft by 3 mrad to 6 rad; when nothing turns, a hundredth of the horizon.
std::vector<std::int64_t> steps_of(const std::vector<scene::Spacecraft>& spacecraft,
                                   const std::vector<std::int64_t>& instants_ns);

}  // namespace adstar::trade
