#pragma once
// An attitude in a scene: where a spacecraft begins, and where it should point.

#include <optional>

#include "service/scene/keys.hpp"
#include "service/scene/scene.hpp"

namespace adstar::scene {

/// As given: make_state normalises it; the identity when absent. Nothing when it is to be drawn, which sets `drawn`, or
/// was refused.
std::optional<Quat<double>> read_attitude(const Value& value, bool& drawn);

/// [spacecraft.pointing]
std::optional<PointingTarget> read_target(const Value& value, bool has_orbit);

}  // namespace adstar::scene
