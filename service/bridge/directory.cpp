#include "service/bridge/directory.hpp"

namespace adstar::bridge {

Directory::Directory(const scene::Scene& scene) : scene_(&scene) {
  by_name_.reserve(scene.spacecraft.size());
  for (std::uint32_t i = 0; i < scene.spacecraft.size(); ++i) {
    by_name_.emplace(scene.spacecraft[i].name, i);
  }
}

std::optional<std::uint32_t> Directory::spacecraft(std::string_view name) const {
  const auto found = by_name_.find(name);
  return found == by_name_.end() ? std::nullopt : std::optional(found->second);
}

std::optional<std::uint32_t> Directory::actuator(std::uint32_t spacecraft, scene::ActuatorKind kind,
                                                 std::string_view name) const {
  const auto& actuators = scene_->spacecraft.at(spacecraft).actuators;
  for (std::uint32_t i = 0; i < actuators.size(); ++i) {
    if (actuators[i].name == name && actuators[i].kind == kind) {
      return i;
    }
  }
  return std::nullopt;
}

std::string_view Directory::spacecraft_name(std::uint32_t index) const noexcept {
  return index < size() ? std::string_view(scene_->spacecraft[index].name) : std::string_view();
}

std::string_view Directory::actuator_name(std::uint32_t spacecraft,
                                          std::uint32_t actuator) const noexcept {
  if (spacecraft >= size() || actuator >= scene_->spacecraft[spacecraft].actuators.size()) {
    return {};
  }
  return scene_->spacecraft[spacecraft].actuators[actuator].name;
}

std::string_view Directory::body_name(std::uint32_t spacecraft, std::uint32_t body) const noexcept {
  const scene::LinkedBodies* const linked =
      spacecraft < size() ? scene_->spacecraft[spacecraft].linked.get() : nullptr;
  return linked != nullptr && body < linked->bodies.size()
             ? std::string_view(linked->bodies[body].name)
             : std::string_view();
}

std::string_view Directory::joint_name(std::uint32_t spacecraft,
                                       std::uint32_t joint) const noexcept {
  const scene::LinkedBodies* const linked =
      spacecraft < size() ? scene_->spacecraft[spacecraft].linked.get() : nullptr;
  return linked != nullptr && joint < linked->joints.size()
             ? std::string_view(linked->joints[joint].name)
             : std::string_view();
}

std::string_view Directory::wheel_name(std::uint32_t spacecraft,
                                       std::uint32_t wheel) const noexcept {
  if (spacecraft >= size() || wheel >= scene_->spacecraft[spacecraft].wheels.size()) {
    return {};
  }
  return scene_->spacecraft[spacecraft].wheels[wheel].name;
}

}  // namespace adstar::bridge
