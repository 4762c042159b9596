#pragma once
// [spacecraft.orbit]: the orbit on which the torques of the surroundings act.

#include <filesystem>
#include <optional>

#include "adstar/orbit/orbit.hpp"
#include "service/scene/keys.hpp"
#include "service/scene/scene.hpp"
#include "service/scene/time_scales.hpp"

namespace adstar::scene {

struct OrbitContext {
  const std::filesystem::path& scene_file;
  Tables tables;
  const TaiDate* epoch = nullptr;  ///< of t = 0; null: the scene has none
};

/// `value` is the "orbit" of a spacecraft, which may be absent: no orbit is modelled then.
std::optional<Orbit<double>> read_orbit(const Value& value, const OrbitContext& context);

}  // namespace adstar::scene
