#pragma once
// [earth]: where the Earth is turned to at t = 0, and its magnetic field.

#include <optional>
#include <string_view>

#include "adstar/earth/magnetic_field.hpp"
#include "adstar/earth/rotation.hpp"
#include "service/scene/keys.hpp"
#include "service/scene/scene.hpp"
#include "service/scene/time_scales.hpp"

namespace adstar::scene {

/// What models of the surroundings ask for. Without an epoch there is none of it.
struct Earth {
  TaiDate epoch;
  EarthRotation<double> rotation;
  MagneticField<double> field;
  double year = 0;              ///< Julian, at t = 0
  double days_since_j2000 = 0;  ///< at t = 0, TT
};

/// Nothing when the scene has no epoch.
std::optional<Earth> read_earth(Keys& root, const Simulation& simulation);

}  // namespace adstar::scene
