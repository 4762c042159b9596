#pragma once
// Between whoever takes samples off the bus and whoever writes them: a bounded queue. What does not
// fit is counted and dropped; offer() waits for a swap of two vectors at most, never for the disk.

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

namespace adstar::bag {

/// Messages one after another, their bytes in one block.
struct Batch {
  struct Entry {
    std::size_t topic = 0;
    std::int64_t received_ns = 0;
    std::size_t begin = 0, size = 0;  ///< in `bytes`
  };
  std::vector<Entry> entries;
  std::vector<std::byte> bytes;

  std::span<const std::byte> payload(const Entry& entry) const {
    return std::span(bytes).subspan(entry.begin, entry.size);
  }
  void clear() {
    entries.clear();
    bytes.clear();
  }
};

class Intake {
 public:
  Intake(std::size_t topics, std::size_t most_bytes) : most_bytes_(most_bytes), lost_(topics, 0) {}

  /// False: it did not fit, or nobody writes any more; it is counted.
  bool offer(std::size_t topic, std::int64_t received_ns, std::span<const std::byte> payload);
  /// Nothing is taken any more; the writer gets what waits, then false.
  void close();

  /// For the writer: `batch` (cleared) becomes what waits. Returns after `patience` with nothing when nothing
  /// came; false when it is closed and empty.
  bool swap_in(Batch& batch, std::chrono::milliseconds patience);

  /// By topic.
  std::vector<std::uint64_t> lost() const;

 private:
  mutable std::mutex mutex_;
  std::condition_variable filled_;
  std::size_t most_bytes_;
  Batch waiting_;
  std::vector<std::uint64_t> lost_;
  bool closed_ = false;
};

}  // namespace adstar::bag
