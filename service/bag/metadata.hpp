#pragma once
// What a recording says of itself: metadata.yaml as rosbag2 writes it, version 5 (ROS 2 Humble).
// Source of the layout: rosbag2_storage/include/rosbag2_storage/yaml.hpp of ros2/rosbag2.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace adstar::bag {

struct TopicInfo {
  std::string name;         ///< "/adstar/attitude_state"
  std::string type;         ///< "adstar/msg/AttitudeState"
  std::string offered_qos;  ///< YAML, as rosbag2 keeps it; may be empty
};

struct TopicCount {
  TopicInfo topic;
  std::uint64_t messages = 0;
};

/// Times are those of reception, Unix epoch.
struct FileInfo {
  std::string name;  ///< within the directory
  std::int64_t first_ns = 0;
  std::int64_t last_ns = 0;
  std::uint64_t messages = 0;
};

struct Metadata {
  std::vector<TopicCount> topics;
  std::vector<FileInfo> files;

  std::uint64_t messages() const;
  /// The least and the greatest of the files that have messages; 0 when none has.
  std::int64_t first_ns() const;
  std::int64_t last_ns() const;
};

inline constexpr const char* kMetadataName = "metadata.yaml";

std::string to_yaml(const Metadata& metadata);

/// Appears whole or not at all. Throws Error.
void write_metadata(const Metadata& metadata, const std::filesystem::path& directory);

}  // namespace adstar::bag
