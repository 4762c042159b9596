#pragma once
// The sections of a scene, a reader each. All complaints go to the keys' Complaints.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "service/scene/earth_keys.hpp"
#include "service/scene/keys.hpp"
#include "service/scene/scene.hpp"

namespace adstar::scene {

/// step_ns stays zero when the file gives none that is good.
struct SimulationSection {
  Simulation simulation;
  Value scheme;  ///< where the file names it
};
SimulationSection read_simulation(Keys& root);

/// [[spacecraft]] in order, fleets unfolded.
struct Spacecrafts {
  std::vector<Spacecraft> spacecraft;
  std::vector<std::string> names;  ///< also of spacecraft that were refused
  bool every_name_known =
      true;  ///< false when a name is missing, so that "unknown" would be a guess
};
Spacecrafts read_spacecraft(Keys& root, const std::filesystem::path& file, Tables tables,
                            const Earth* earth);

Telemetry read_telemetry(Keys& root, std::int64_t step_ns, const Spacecrafts& fleet);
Budget read_budget(Keys& root, const Simulation& simulation);
Run read_run(Keys& root);
Service read_service(Keys& root);
std::optional<Standby> read_standby(Keys& root, const Simulation& simulation,
                                    const Service& service);
Dds read_dds(Keys& root, const std::filesystem::path& file);
std::optional<Ros2> read_ros2(Keys& root, const std::vector<std::string>& names,
                              const Telemetry& telemetry, const Dds& dds);
Log read_log(Keys& root);

/// "2026-01-01T00:00:00[.5]" in that scale, of a TOML date-time or a string; as Simulation::epoch.
enum class TimeScale { utc, tai };
std::optional<std::string> read_epoch(const Value& value, TimeScale scale);

}  // namespace adstar::scene
