#include "service/scene/scene.hpp"

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

SceneError::SceneError(const std::vector<std::string>& complaints)
    : std::runtime_error(lines_of(complaints)) {}

Scene parse(std::string_view text, const std::filesystem::path& file, Tables tables) {
  const Node tree = parse_tree(text, file.string());
  Complaints complaints(file.string());
  Keys root(tree, complaints);
  Scene scene;
  scene.simulation = read_simulation(root);
  Spacecrafts fleet = read_spacecraft(root, file, tables);
  scene.telemetry = read_telemetry(root, scene.simulation.step_ns, fleet);
  scene.spacecraft = std::move(fleet.spacecraft);
  scene.service = read_service(root);
  scene.dds = read_dds(root);
  scene.log = read_log(root);
  root.refuse_unknown();
  if (complaints.count() > 0) {
    throw SceneError(complaints.lines());
  }
  return scene;
}

Scene load(const std::filesystem::path& file) {
  const FileText text = read_file(file);
  if (!text.error.empty()) {
    throw SceneError({complaint_line(file.string(), {}, "file", text.error,
                                     "a scene that can be read", nearest_file(file, ".toml"))});
  }
  return parse(text.text, file);
}

}  // namespace adstar::scene
