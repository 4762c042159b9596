#pragma once
// A recording directory: NAME_0.db3, NAME_1.db3, ... and metadata.yaml once it is finished. Its writer
// holds the directory's lock, so that no reader writes a metadata.yaml of its own meanwhile.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "service/bag/directory_lock.hpp"
#include "service/bag/file_writer.hpp"
#include "service/bag/metadata.hpp"

namespace adstar::bag {

/// When a new file begins; nothing: never.
struct Rolling {
  std::optional<std::uint64_t> max_bytes;
  std::optional<std::int64_t> max_duration_ns;  ///< between its first message and the next one
};

class RollingWriter {
 public:
  /// Makes the directory, and those above it; throws Error when it is there already.
  RollingWriter(const std::filesystem::path& directory, std::vector<TopicInfo> topics,
                Rolling rolling);

  void add(std::size_t topic, std::int64_t received_ns, std::span<const std::byte> payload);
  void commit();
  /// Closes the file, writes metadata.yaml and lets go of the directory.
  const Metadata& finish();

 private:
  void begin_file();
  bool is_over(std::int64_t received_ns);

  std::filesystem::path directory_;
  std::vector<TopicInfo> topics_;
  Rolling rolling_;
  std::optional<DirectoryLock> lock_;
  Metadata metadata_;  ///< of the files that are closed, and all counts
  std::unique_ptr<FileWriter> file_;
};

}  // namespace adstar::bag
