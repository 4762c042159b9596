#pragma once
// The scene's names and indices, both ways.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

#include "service/scene/scene.hpp"

namespace adstar::bridge {

/// Views the scene's strings: the scene must outlive it and stay where it is.
class Directory {
 public:
  explicit Directory(const scene::Scene& scene);

  std::optional<std::uint32_t> spacecraft(std::string_view name) const;
  /// The commanded one of that kind and name.
  std::optional<std::uint32_t> actuator(std::uint32_t spacecraft, scene::ActuatorKind kind,
                                        std::string_view name) const;

  std::size_t size() const noexcept { return scene_->spacecraft.size(); }
  /// Empty when the index is none of the scene's.
  std::string_view spacecraft_name(std::uint32_t index) const noexcept;
  std::string_view actuator_name(std::uint32_t spacecraft, std::uint32_t actuator) const noexcept;
  std::string_view body_name(std::uint32_t spacecraft, std::uint32_t body) const noexcept;
  std::string_view joint_name(std::uint32_t spacecraft, std::uint32_t joint) const noexcept;
  std::string_view wheel_name(std::uint32_t spacecraft, std::uint32_t wheel) const noexcept;

 private:
  const scene::Scene* scene_;
  std::unordered_map<std::string_view, std::uint32_t> by_name_;
};

}  // namespace adstar::bridge
