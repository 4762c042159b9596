#pragma once
// How large each torque of the surroundings is for a spacecraft, to an order of magnitude, whether its scene models it or not.

#include <optional>
#include <string>
#include <vector>

#include "service/scene/scene.hpp"

namespace adstar::report {

struct TorqueEstimate {
  const char* model = "";  ///< its name in a scene
  bool modelled = false;
  std::optional<double>
      torque_n_m;       ///< at most, or about; none: not estimable without an orbit, or about
                        ///< another body than the Earth
  double turn_rad = 0;  ///< ½ tau t²/J of the least moment, or π when it is more
};

/// Of the torques of the surroundings, over `horizon_s`. What the scene does not say is taken from the inertia: a cube
/// of 300 kg/m³ with its centre of pressure off by a tenth of its side, 3e-3 A m² a kg of residual dipole (NASA SP-8018,
/// 1969, for a spacecraft without magnetic discipline). Linked bodies are the whole of them, as they stand at the start: cubes of
/// their masses, pushed at their places.
std::vector<TorqueEstimate> estimates_of(const scene::Spacecraft& craft, double horizon_s);

/// What the estimates are for: the scene's duration, or else a revolution, or else an hour [s].
double horizon_of(const scene::Simulation& simulation, const scene::Spacecraft& craft);

}  // namespace adstar::report
