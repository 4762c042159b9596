// [ros2]: topics for ROS 2 nodes, whose names allow less than ours do.

#include <algorithm>

#include <fmt/format.h>

#include "service/scene/duration_key.hpp"
#include "service/scene/sections.hpp"

namespace adstar::scene {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_ros_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || is_digit(c) || c == '_';
}

/// One part of a topic's name, between slashes.
bool is_ros_name(std::string_view name) {
  return !is_digit(name.front()) && std::all_of(name.begin(), name.end(), is_ros_character) &&
         name.find("__") == std::string_view::npos;
}

std::string as_ros_name(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !is_ros_character(c); }, '_');
  const auto both = [](char a, char b) { return a == '_' && b == '_'; };
  name.erase(std::unique(name.begin(), name.end(), both), name.end());
  return is_digit(name.front()) ? "sat" + name : name;
}

void refuse_names(const Value& enabled, const std::vector<std::string>& names,
                  const Telemetry& telemetry) {
  const std::string* first = nullptr;
  std::size_t count = 0;
  for (const std::uint32_t index : telemetry.watched) {
    if (!is_ros_name(names[index])) {
      first = first == nullptr ? &names[index] : first;
      ++count;
    }
  }
  if (first != nullptr) {
    enabled.refuse_as(
        fmt::format("true, with a spacecraft {}{}", in_quotes(*first),
                    count > 1 ? fmt::format(" (and {} others like it)", count - 1) : ""),
        "names out of A-Z a-z 0-9 _ that begin with no digit and have no __: topics of ROS 2 allow "
        "no others",
        fmt::format("the name {}, or a [telemetry] spacecraft without it",
                    in_quotes(as_ros_name(*first))));
  }
}

}  // namespace

std::optional<Ros2> read_ros2(Keys& root, const std::vector<std::string>& names,
                              const Telemetry& telemetry, const Dds& dds) {
  const Value section = root.optional("ros2");
  if (!section) {
    return std::nullopt;
  }
  Keys keys(section, "[ros2] on a line of its own");
  const Value enabled = keys.optional("enabled");
  const bool on = read_flag(enabled, "true").value_or(false);
  Ros2 ros2;
  read_duration_or_off(keys.optional("torque_validity"), "500ms", ros2.torque_validity_ns);
  ros2.clock = read_flag(keys.optional("clock"), "true").value_or(ros2.clock);
  ros2.tf = read_flag(keys.optional("tf"), "true").value_or(ros2.tf);
  keys.refuse_unknown();
  if (!on) {
    return std::nullopt;
  }
  refuse_names(enabled, names, telemetry);
  if (!dds.partition.empty()) {
    enabled.refuse_as("true, beside partition = " + in_quotes(dds.partition),
                      "the default partition, the only one where ROS 2 nodes are",
                      "no partition in [dds]; another domain keeps runs apart too");
  }
  return ros2;
}

}  // namespace adstar::scene
