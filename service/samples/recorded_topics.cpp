#include "service/samples/recorded_topics.hpp"

#include <string_view>
#include <tuple>

#include <fmt/format.h>

namespace adstar::samples {
namespace {

/// What may wait in Cyclone for a recorder that is kept from the processor.
constexpr std::int32_t kDepth = 4096;

/// "adstar::AttitudeState" as "adstar/msg/AttitudeState".
std::string ros_type(std::string_view type) {
  const std::size_t colons = type.rfind("::");
  return colons == std::string_view::npos
             ? std::string(type)
             : fmt::format("{}/msg/{}", type.substr(0, colons), type.substr(colons + 2));
}

/// As rosbag2 keeps the profile of a writer: numbers of rmw/types.h, "no limit" as its largest
/// duration.
std::string offered_qos(const dds::Qos& qos) {
  constexpr const char* kForever = "    sec: 9223372036\n    nsec: 854775807\n";
  return fmt::format(
      "- history: 1\n  depth: {}\n  reliability: {}\n  durability: {}\n  deadline:\n{}  "
      "lifespan:\n{}  liveliness: 1\n  liveliness_lease_duration:\n{}  "
      "avoid_ros_namespace_conventions: false",
      qos.depth, qos.reliability == dds::Reliability::reliable ? 1 : 2,
      qos.durability == dds::Durability::transient_local ? 1 : 2, kForever, kForever, kForever);
}

template <class T>
RecordedTopic recorded(const dds::Topic<T>& topic) {
  dds::Qos reader = topic.reader;
  if (reader.reliability == dds::Reliability::reliable) {
    // KEEP_LAST: a reader that falls behind loses what is oldest, and never holds a writer up.
    reader.depth = kDepth;
  }
  return {topic.descriptor,
          topic.name,
          reader,
          {std::string("/") + topic.name, ros_type(topic.descriptor->m_typename),
           offered_qos(topic.writer)}};
}

}  // namespace

std::vector<RecordedTopic> recorded_topics() {
  return std::apply([](const auto&... topic) { return std::vector{recorded(topic)...}; },
                    dds::kTopics);
}

}  // namespace adstar::samples
