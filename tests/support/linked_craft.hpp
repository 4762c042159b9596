#pragma once
// A spacecraft of linked bodies: a hub, a panel on a sprung, damped hinge with a motor, a boom on a ball joint.

#include <string>

#include "service/scene/scene.hpp"

namespace adstar::test {

inline const std::string kLinkedScene = R"(
[simulation]
step = "10ms"
[[spacecraft]]
name = "sat1"
mass_kg = 100
inertia_body_kg_m2 = [9, 11, 16]
angular_velocity_body_rad_s = [0.1, -0.05, 0.2]
[[spacecraft.body]]
name = "panel"
mass_kg = 5
inertia_body_kg_m2 = [0.5, 0.2, 0.6]
[[spacecraft.body]]
name = "boom"
mass_kg = 2
inertia_body_kg_m2 = [0.3, 0.3, 0.01]
[[spacecraft.joint]]
name = "hinge"
kind = "revolute"
from = "hub"
to = "panel"
point_from_body_m = [0, 0.5, 0]
point_to_body_m = [0, -1, 0]
axis_body = [1, 0, 0]
coordinate = 0.4
stiffness = 3.0
damping = 0.1
max_motor_torque = 0.5
commanded = true
[[spacecraft.joint]]
name = "ball"
kind = "spherical"
from = "hub"
to = "boom"
point_from_body_m = [0, 0, -0.6]
point_to_body_m = [0, 0, 0.8]
rate = [0.1, 0.0, 0.3]
)";

inline scene::Spacecraft linked_craft() {
  return scene::parse(kLinkedScene, "linked.toml").spacecraft.front();
}

/// Its spring at rest too.
inline scene::Spacecraft resting_linked_craft() {
  std::string text = kLinkedScene;
  for (const std::string key : {"angular_velocity_body_rad_s", "coordinate = 0.4", "rate = [0.1"}) {
    const std::size_t begin = text.find(key);
    text.erase(begin, text.find('\n', begin) - begin);
  }
  return scene::parse(text, "linked.toml").spacecraft.front();
}

}  // namespace adstar::test
