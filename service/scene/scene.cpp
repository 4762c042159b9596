#include "service/scene/scene.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "adstar/gyrostat.hpp"
#include "adstar/integrators/all.hpp"
#include "service/scene/files.hpp"
#include "service/scene/sections.hpp"

namespace adstar::scene {
namespace {

std::string lines_of(const std::vector<std::string>& complaints) {
  std::string text;
  for (const std::string& complaint : complaints) {
    text += (text.empty() ? "" : "\n") + complaint;
  }
  return text;
}

}  // namespace

const char* name_of(Pace pace) {
  switch (pace) {
    case Pace::clock:
      return "clock";
    case Pace::free:
      return "free";
    case Pace::lockstep:
      return "lockstep";
  }
  return "unknown";
}

std::int64_t beat_ns(const Simulation& simulation) {
  return static_cast<std::int64_t>(static_cast<double>(simulation.step_ns) / simulation.rate);
}

const Spacecraft* first_forced(const std::vector<Spacecraft>& spacecraft) {
  const auto found = std::find_if(spacecraft.begin(), spacecraft.end(),
                                  [](const Spacecraft& craft) { return !craft.torques.empty(); });
  return found == spacecraft.end() ? nullptr : &*found;
}

std::vector<SpinningWheel<double>> spinning_wheels(const Spacecraft& spacecraft) {
  std::vector<SpinningWheel<double>> spinning;
  for (const NamedWheel& wheel : spacecraft.wheels) {
    spinning.push_back(wheel.at_start);
  }
  return spinning;
}

const Spacecraft* first_with_wheels(const std::vector<Spacecraft>& spacecraft) {
  const auto found = std::find_if(spacecraft.begin(), spacecraft.end(),
                                  [](const Spacecraft& craft) { return !craft.wheels.empty(); });
  return found == spacecraft.end() ? nullptr : &*found;
}

const Spacecraft* first_linked(const std::vector<Spacecraft>& spacecraft) {
  const auto found = std::find_if(spacecraft.begin(), spacecraft.end(),
                                  [](const Spacecraft& craft) { return craft.linked != nullptr; });
  return found == spacecraft.end() ? nullptr : &*found;
}

const Spacecraft* first_with_reference(const std::vector<Spacecraft>& spacecraft) {
  const auto found =
      std::find_if(spacecraft.begin(), spacecraft.end(),
                   [](const Spacecraft& craft) { return craft.orbit || craft.target; });
  return found == spacecraft.end() ? nullptr : &*found;
}

const Actuator* first_commanded_torque(const Spacecraft& spacecraft, Frame frame) {
  const std::size_t end =
      spacecraft.linked ? spacecraft.first_torque.at(1) : spacecraft.torques.size();
  const auto found = std::find_if(
      spacecraft.actuators.begin(), spacecraft.actuators.end(), [&](const Actuator& actuator) {
        return actuator.kind == ActuatorKind::torque && actuator.index < end &&
               std::get<Commanded<double>>(spacecraft.torques[actuator.index]).frame == frame;
      });
  return found == spacecraft.actuators.end() ? nullptr : &*found;
}

SceneError::SceneError(const std::vector<std::string>& complaints)
    : std::runtime_error(lines_of(complaints)) {}

Scene parse(std::string_view text, const std::filesystem::path& file, Tables tables) {
  const Node tree = parse_tree(text, file.string());
  Complaints complaints(file.string());
  Keys root(tree, complaints);
  Scene scene;
  SimulationSection section = read_simulation(root);
  scene.simulation = std::move(section.simulation);
  const std::optional<Earth> earth = read_earth(root, scene.simulation);
  Spacecrafts fleet = read_spacecraft(root, file, tables, earth ? &*earth : nullptr);
  if (const Spacecraft* forced = first_forced(fleet.spacecraft);
      forced != nullptr && claims_of(scene.simulation.scheme).free_only) {
    section.scheme.refuse_as(
        fmt::format("{}, which knows no torque", in_quotes(scene.simulation.scheme)),
        fmt::format("a scheme that does, since {} names one", in_quotes(forced->name)),
        in_quotes(scheme_names().front()));
  }
  if (const Spacecraft* with_wheels = first_with_wheels(fleet.spacecraft);
      with_wheels != nullptr && !carries_wheels(scene.simulation.scheme)) {
    section.scheme.refuse_as(
        fmt::format("{}, which carries no wheels", in_quotes(scene.simulation.scheme)),
        fmt::format("a scheme that does, since {} has some: coadjoint_* in double, projected_*, "
                    "quaternion_rk4",
                    in_quotes(with_wheels->name)),
        in_quotes(scheme_names().front()));
  }
  if (const Spacecraft* linked = first_linked(fleet.spacecraft);
      linked != nullptr && !multibody::links_bodies(scene.simulation.scheme)) {
    section.scheme.refuse_as(
        fmt::format("{}, which does not step linked bodies", in_quotes(scene.simulation.scheme)),
        fmt::format("a scheme that does, since {} has some: coadjoint_* in double",
                    in_quotes(linked->name)),
        in_quotes(scheme_names().front()));
  }
  scene.telemetry = read_telemetry(root, scene.simulation.step_ns, fleet);
  scene.spacecraft = std::move(fleet.spacecraft);
  scene.budget = read_budget(root, scene.simulation);
  scene.run = read_run(root);
  scene.service = read_service(root);
  scene.standby = read_standby(root, scene.simulation, scene.service);
  scene.dds = read_dds(root, file);
  scene.ros2 = read_ros2(root, fleet.names, scene.telemetry, scene.dds);
  scene.log = read_log(root);
  root.refuse_unknown();
  if (complaints.count() > 0) {
    throw SceneError(complaints.lines());
  }
  return scene;
}

std::string text_of(const std::filesystem::path& file) {
  FileText text = read_file(file);
  if (!text.error.empty()) {
    throw SceneError({complaint_line(file.string(), {}, "file", text.error,
                                     "a scene that can be read", nearest_file(file, ".toml"))});
  }
  return std::move(text.text);
}

Scene load(const std::filesystem::path& file) { return parse(text_of(file), file); }

}  // namespace adstar::scene
