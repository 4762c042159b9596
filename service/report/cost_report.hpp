#pragma once
// What each model of a scene costs in a step, measured here and now, and whether it is worth it, and what is left
// out and would be.

#include <string>

#include "service/scene/scene.hpp"

namespace adstar::report {

/// Takes some tenths of a second a kind of spacecraft, five kinds at most.
std::string cost_report(const scene::Scene& scene);

}  // namespace adstar::report
