#include "service/report/ros2_report.hpp"

#include <map>

#include <fmt/format.h>

#include "service/report/numbers.hpp"

namespace adstar::report {
namespace {

std::string moved_by(const scene::Spacecraft& craft) {
  std::string text;
  const auto add = [&](Frame frame, const char* name) {
    if (const auto* const actuator = scene::first_commanded_torque(craft, frame)) {
      text +=
          fmt::format("{}frame_id {} moves '{}'", text.empty() ? "" : ", ", name, actuator->name);
    }
  };
  add(Frame::body, "<spacecraft>/body");
  add(Frame::inertial, "inertial");
  return text.empty() ? "no commanded torque, no topic" : text;
}

std::string published(const scene::Scene& scene) {
  std::string text;
  const auto add = [&](bool on, const char* name) {
    text += on ? (text.empty() ? "" : ", ") + std::string(name) : "";
  };
  add(scene.telemetry.attitude_every > 0, "rt/<spacecraft>/attitude");
  add(scene.telemetry.momentum_every > 0, "rt/<spacecraft>/angular_momentum");
  add(scene.telemetry.attitude_every > 0 && scene.ros2->tf, "rt/tf");
  add(scene.ros2->clock, "rt/clock");
  return text.empty() ? "nothing" : text;
}

}  // namespace

std::string ros2_report(const scene::Scene& scene) {
  if (!scene.ros2) {
    return {};
  }
  std::string text = fmt::format("ros2 (ROS_DOMAIN_ID={}), {} of {} spacecraft\n  publishes {}\n",
                                 scene.dds.domain, counted(scene.telemetry.watched.size()),
                                 counted(scene.spacecraft.size()), published(scene));
  if (!scene.ros2->torque_validity_ns) {
    return text + "  hears no torques\n";
  }
  text += fmt::format(
      "  hears rt/<spacecraft>/torque, each message in force for {} or until the next\n",
      scene::format_duration(*scene.ros2->torque_validity_ns));
  std::map<std::string, std::size_t> alike;
  for (const std::uint32_t index : scene.telemetry.watched) {
    ++alike[moved_by(scene.spacecraft[index])];
  }
  for (const auto& [what, count] : alike) {
    text += fmt::format("    {} spacecraft: {}\n", counted(count), what);
  }
  return text;
}

}  // namespace adstar::report
