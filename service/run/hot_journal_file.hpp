#pragma once
// The part of the journal that lives in memory, a file of a tmpfs by the name of its run: it outlives the
// process that writes it, not the machine's restart.

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "service/run/run_directory.hpp"
#include "service/runtime/journal.hpp"

namespace adstar::run {

/// Of a directory that is to hold it; empty when all is well.
std::string why_not_in_memory(const std::string& directory);

class HotJournalFile {
 public:
  /// Makes a new one, in place of one of that name. Throws std::system_error.
  static HotJournalFile create(const RunFacts& facts);
  /// The one that a run left behind; nothing when there is none, or one in which nothing was written yet. Throws RunError
  /// when it is of another version of adstar, std::system_error when it is there and cannot be read.
  static std::optional<HotJournalFile> open(const RunFacts& facts);
  /// Forgets it: the run ended in good order.
  static void remove(const RunFacts& facts) noexcept;

  HotJournalFile(HotJournalFile&& other) noexcept : hot_(std::exchange(other.hot_, nullptr)) {}
  HotJournalFile(const HotJournalFile&) = delete;
  HotJournalFile& operator=(const HotJournalFile&) = delete;
  HotJournalFile& operator=(HotJournalFile&& other) noexcept {
    std::swap(hot_, other.hot_);
    return *this;
  }
  ~HotJournalFile();

  runtime::HotJournal& operator*() const noexcept { return *hot_; }
  runtime::HotJournal* operator->() const noexcept { return hot_; }

 private:
  explicit HotJournalFile(runtime::HotJournal* hot) : hot_(hot) {}
  runtime::HotJournal* hot_ = nullptr;
};

}  // namespace adstar::run
