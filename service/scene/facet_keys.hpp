#pragma once
// [spacecraft.box] and [[spacecraft.facet]]: the outside of a spacecraft, for the air and the sunlight.

#include "adstar/torques/facets.hpp"
#include "service/scene/keys.hpp"

namespace adstar::scene {

/// Of the spacecraft's table; null when it has neither. The box's sides stand first.
Facets<double> read_facets(Keys& spacecraft);

}  // namespace adstar::scene
