#pragma once
// A recording read back: every message in the order of its reception, over all files. That order is the
// rows'; timestamps run back where the clock is set back. The files are what counts; a metadata.yaml that a
// killed recorder left unwritten is made from them. What it tells of and they
// do not have is lost: that metadata.yaml is the proof, and stays.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "service/bag/metadata.hpp"

namespace adstar::bag {

struct Message {
  const std::string& topic;
  std::int64_t received_ns;
  std::span<const std::byte> payload;  ///< CDR with its encapsulation header; lent for the call
};

class Recording {
 public:
  /// Throws Error when there is no recording, or a .db3 file of something else: that is left as it is.
  explicit Recording(const std::filesystem::path& directory);

  /// From now on for_each() tells which part of the files it has been through: 0 first, 1 last, and now and then
  /// in between. What the watcher throws ends it.
  void watch(std::function<void(double part)> watcher) { watcher_ = std::move(watcher); }

  /// Of the topics named, those that are in it; throws Error on a file that cannot be read.
  void for_each(const std::vector<std::string>& topics,
                const std::function<void(const Message&)>& use) const;

  /// Counted from the files.
  Metadata count() const;

  enum class Ending {
    ended,
    still_recorded,
    incomplete,  ///< files, or a part of them, are no longer there: lost() says which
    cut_off,     ///< no metadata.yaml, or one that tells of less than the files have
  };
  /// Where nobody holds it, files that were left with a log (somebody read them as they were ended, or their recorder was
  /// killed) become plain ones, if they may be written: who may not write there can only read those.
  Ending ending() const;
  /// What is incomplete, for the user, and what to do; empty when nothing is known to be lost.
  std::string lost() const;
  /// Writes metadata.yaml of a recording that was cut off from what the files have; false when it cannot be written there,
  /// or is not to be: its recorder's, or the proof of what was lost.
  bool mend() const;

 private:
  void leave_logs() const;
  Metadata messages_by_file() const;  ///< names and messages alone

  std::filesystem::path directory_;
  std::vector<std::filesystem::path> files_;  ///< those that are laid out
  std::function<void(double)> watcher_ = [](double /*part*/) {};
};

}  // namespace adstar::bag
