#pragma once
// What a scene will model, and what it leaves out, for people.

#include <string>

#include "service/scene/scene.hpp"

namespace adstar::report {

std::string scene_report(const scene::Scene& scene);

}  // namespace adstar::report
