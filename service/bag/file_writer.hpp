#pragma once
// One .db3 file of a recording, as rosbag2's sqlite3 storage lays it out: tables `topics` and
// `messages`, index `timestamp_idx` (rosbag2_storage_default_plugins, sqlite_storage.cpp).
//
// Messages are kept in transactions over a write-ahead log: after kill -9 there is all that was
// committed. close() merges the log, so that what is left is one plain file; where somebody reads it
// just then, the log stays beside it until they close it, and the file is one that wants a log until Recording::ending()
// or mend() makes it plain.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "service/bag/metadata.hpp"
#include "service/bag/sqlite.hpp"

namespace adstar::bag {

class FileWriter {
 public:
  /// Throws Error.
  FileWriter(const std::filesystem::path& file, const std::vector<TopicInfo>& topics);

  /// `topic`: its place in the list given. Begins a transaction when there is none.
  void add(std::size_t topic, std::int64_t received_ns, std::span<const std::byte> payload);
  void commit();
  /// Commits, and leaves one file, whoever reads.
  void close();

  const FileInfo& info() const { return info_; }
  /// Of the file, about: exact at the last commit.
  std::uint64_t size_bytes() const { return committed_bytes_ + pending_bytes_; }

 private:
  std::uint64_t measured_bytes() const;

  Database database_;
  FileInfo info_;
  std::vector<std::int64_t> topic_rows_;
  std::vector<Statement> insert_;  ///< one, until closed
  bool in_transaction_ = false;
  std::uint64_t committed_bytes_ = 0, pending_bytes_ = 0;
};

}  // namespace adstar::bag
