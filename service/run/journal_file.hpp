#pragma once
// The journal in files: a header, then records, each with its checksum.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "service/run/files.hpp"
#include "service/runtime/journal.hpp"

namespace adstar::run {

/// A file that grows. A record that could not be written whole is cut off again.
class JournalFile {
 public:
  /// A new one, in place of a file of that name. Throws RunError, as all of these do.
  JournalFile(const std::filesystem::path& path, std::uint64_t run);

  void append(std::span<const runtime::JournalRecord> records);
  void sync() const { file_.sync(); }

 private:
  File file_;
  std::uint64_t length_ = 0;  ///< of what is whole
  bool torn_ = false;         ///< more than that may stand there
  Bytes bytes_;               ///< kept for its memory
};

struct JournalText {
  std::uint64_t run = 0;
  std::vector<runtime::JournalRecord> records;  ///< those that are whole
  std::string damage;       ///< what was wrong first, and is not among them; empty: nothing
  bool unreadable = false;  ///< nothing is known of what it holds
};

/// Never throws: what can be believed of the bytes.
JournalText journal_from(std::span<const std::byte> bytes);

}  // namespace adstar::run
