#pragma once
// The starts of the stability map: one step of a second each, of bodies from needle to disc and from
// chipsat to station, in the states and under the torques that a scheme may fail in.

#include <string>
#include <vector>

#include "service/scene/scene.hpp"

namespace adstar::trade {

struct Extreme {
  std::string name;  ///< body, start and load
  scene::Spacecraft craft;
  double turn_rad = 0;  ///< within the step, about
};

/// A column of a chart.
struct Extremes {
  std::string name;
  std::vector<Extreme> starts;
};

struct Extremity {
  std::string title, x_label;
  std::vector<Extremes> columns;
};

/// full: what is drawn; thin: every kind once, for tests.
enum class Detail { full, thin };

inline constexpr std::int64_t kExtremeStepNs = 1'000'000'000;

/// Bodies turning so far within the step: spinning about each axis, on the separatrix, beside it and at
/// random; free, under constant torques weak and strong, and under an impulse shorter than the step.
Extremity extremes_by_turn(const std::vector<double>& turns_rad, Detail detail);

/// Constant torques of these sizes [N m], in the body and in inertial space, on bodies at rest and turning.
Extremity extremes_by_torque(const std::vector<double>& torques_n_m, Detail detail);

/// Momenta of nothing, next to it and past what can be squared; damping from weak to stiff against the
/// step; more torque edges than a step may have.
Extremity peculiar_extremes(Detail detail);

/// 1e-12 to 20 rad.
std::vector<double> default_turns();
/// 1e-12 to 1e6 N m.
std::vector<double> default_torques();

/// The three of them over the defaults.
std::vector<Extremity> all_extremes(Detail detail);

}  // namespace adstar::trade
