#pragma once
// [spacecraft.orbit]: the Kepler orbit on which the torques of the surroundings act.

#include <optional>

#include "adstar/orbit/kepler.hpp"
#include "service/scene/keys.hpp"

namespace adstar::scene {

/// `value` is the "orbit" of a spacecraft, which may be absent: no orbit is modelled then.
std::optional<KeplerOrbit<double>> read_orbit(const Value& value);

}  // namespace adstar::scene
