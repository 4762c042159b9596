#pragma once
// A case as a scene would state it.

#include "service/scene/scene.hpp"
#include "tests/bench/peers/method.hpp"

namespace adstar::peers {

scene::Spacecraft spacecraft_of(const Case& the_case);

}  // namespace adstar::peers
