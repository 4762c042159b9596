#pragma once
// The spacecraft of a scene, those with the same models on one entry.

#include <string>
#include <vector>

#include "service/scene/scene.hpp"

namespace adstar::report {

std::string spacecraft_report(const std::vector<scene::Spacecraft>& spacecraft,
                              double end_of_run_s);

}  // namespace adstar::report
