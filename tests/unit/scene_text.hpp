#pragma once
// Small scenes to put one line into, and the complaints about them.

#include <string>
#include <string_view>

#include "service/scene/scene.hpp"

namespace adstar::scene {

inline constexpr const char* kSimulation = "[simulation]\nstep = \"10ms\"\n";
inline constexpr const char* kSpacecraft =
    "[[spacecraft]]\nname = \"sat1\"\ninertia_body_kg_m2 = [0.9144, 1.098, 1.66]\n";

/// `line` is line 3.
inline std::string in_simulation(const std::string& line) {
  return kSimulation + line + '\n' + kSpacecraft;
}
/// `lines` begin at line 6.
inline std::string in_spacecraft(const std::string& lines) {
  return std::string(kSimulation) + kSpacecraft + lines + '\n';
}
/// `lines` begin at line 7.
inline std::string in_torque(const std::string& lines) {
  return in_spacecraft("[[spacecraft.torque]]\n" + lines);
}
/// `lines` begin at line 7.
inline std::string in_section(const std::string& section, const std::string& lines) {
  return in_spacecraft('[' + section + "]\n" + lines);
}
/// `lines` begin at line 4, after "[[spacecraft]]".
inline std::string as_spacecraft(const std::string& lines) {
  return std::string(kSimulation) + "[[spacecraft]]\n" + lines + '\n';
}

/// Everything that is said against `text`; empty when it is a good scene.
inline std::string refusal(const std::string& text,
                           const std::filesystem::path& file = "scene.toml") {
  try {
    parse(text, file);
    return {};
  } catch (const SceneError& error) {
    return error.what();
  }
}

}  // namespace adstar::scene
