#pragma once
// What ROS 2 nodes have of a scene.

#include <string>

#include "service/scene/scene.hpp"

namespace adstar::report {

/// A line each: topics, and what a torque moves; empty when the scene has none of them.
std::string ros2_report(const scene::Scene& scene);

}  // namespace adstar::report
