#pragma once
// Whether a scene's step fits its beat on this machine: measured before the run begins.

#include <cstddef>
#include <cstdint>
#include <string>

#include "service/scene/scene.hpp"

namespace adstar::runtime {

struct StepCost {
  std::int64_t p99_ns = 0;
  std::size_t steps = 0;  ///< taken: 2,000, or what two seconds hold
};

/// The whole fleet's step at its dearest: every spacecraft turns, in as many parts as the scene allows
/// (substep_limit), with every actuator in force.
StepCost measure_step(const scene::Scene& scene);

/// What is wrong and what to do; empty when the step fits, or nothing paces it.
std::string why_it_does_not_fit(const scene::Scene& scene, const StepCost& cost);

}  // namespace adstar::runtime
