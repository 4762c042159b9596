#pragma once
// Commands that wait for the beat that hears them: a queue whose memory is made at construction.

#include <cstddef>
#include <vector>

#include "service/runtime/journal.hpp"

namespace adstar::runtime {

class HeldCommands {
 public:
  explicit HeldCommands(std::size_t room) : records_(room) {}

  bool has_room() const noexcept { return count_ < records_.size(); }
  bool empty() const noexcept { return count_ == 0; }
  std::size_t size() const noexcept { return count_; }

  /// Only while it has room.
  void push(const JournalRecord& record) noexcept {
    records_[(first_ + count_) % records_.size()] = record;
    ++count_;
  }
  const JournalRecord& front() const noexcept { return records_[first_]; }
  const JournalRecord& back() const noexcept {
    return records_[(first_ + count_ - 1) % records_.size()];
  }
  void pop() noexcept {
    first_ = (first_ + 1) % records_.size();
    --count_;
  }

 private:
  std::vector<JournalRecord> records_;
  std::size_t first_ = 0, count_ = 0;
};

}  // namespace adstar::runtime
