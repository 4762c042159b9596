#pragma once
// [[spacecraft.torque]]: what a block of the scene makes for each spacecraft of its fleet.

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "service/scene/body_keys.hpp"
#include "service/scene/earth_keys.hpp"
#include "service/scene/fleet.hpp"
#include "service/scene/scene.hpp"

namespace adstar::scene {

struct ActuatorPlan {
  std::string name;
  Place name_place;
  std::string name_path;
  RangedVector limit;  ///< as Actuator::limit
  ActuatorKind kind = ActuatorKind::torque;
  std::int64_t least_on_ns = 0;
};

struct TorquePlan {
  std::function<Torque<double>(Draws&)> make;  ///< empty when the block was refused
  std::optional<ActuatorPlan> actuator;
  bool drawn = false;
  std::size_t body = 0;      ///< of linked bodies: which one it acts on
  std::string_view model{};  ///< its name, and where the file has it
  Place place{};
  std::string path{};
};

struct TorqueContext {
  const std::filesystem::path& scene_file;
  Tables tables;
  const Earth* earth = nullptr;                 ///< null: the scene has no epoch
  bool has_orbit = false;                       ///< the spacecraft names one,
  const std::optional<Orbit<double>>* orbit{};  ///< which is none when it was refused
  const LinkedPlan* linked{};                   ///< null: one body
  Facets<double> facets{};                      ///< null: the spacecraft names none
};

/// The models of one spacecraft; `value` is its "torque", which may be absent.
std::vector<TorquePlan> read_torques(const Value& value, const TorqueContext& context);

}  // namespace adstar::scene
