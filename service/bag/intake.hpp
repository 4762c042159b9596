#pragma once
// Between whoever takes samples off the bus and whoever writes them: a queue of bounded memory. What does not
// fit is counted and dropped; offer() waits for a batch to change hands at most, never for the disk.

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <span>
#include <vector>

namespace adstar::bag {

/// Messages one after another, their bytes in one block. Its memory is reserved once, and does not grow.
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
  std::size_t memory_bytes() const { return entries.capacity() * sizeof(Entry) + bytes.capacity(); }
};

class Intake {
 public:
  /// A batch has room for so much; a larger message has one of its own.
  static constexpr std::size_t kBatchEntries = 1024, kBatchPayload_bytes = std::size_t{224} << 10U;
  static constexpr std::size_t kBatch_bytes =
      kBatchEntries * sizeof(Batch::Entry) + kBatchPayload_bytes;

  /// `most_bytes` is the memory of what waits and of what is being written, together.
  Intake(std::size_t topics, std::size_t most_bytes) : most_bytes_(most_bytes), lost_(topics, 0) {}

  /// False: it did not fit, or nobody writes any more; it is counted.
  bool offer(std::size_t topic, std::int64_t received_ns, std::span<const std::byte> payload);
  /// Nothing is taken any more; the writer gets what waits, then false.
  void close();

  /// For the writer: `batch`, done with, becomes the next one that waits. Returns after `patience` with an empty one when
  /// nothing came; false when it is closed and nothing is left.
  bool take(Batch& batch, std::chrono::milliseconds patience);

  /// By topic.
  std::vector<std::uint64_t> lost() const;

 private:
  bool fits(std::size_t size) const;
  bool add_batch(std::size_t size);

  mutable std::mutex mutex_;
  std::condition_variable filled_;
  std::size_t most_bytes_, held_bytes_ = 0;
  std::deque<Batch> waiting_;  ///< none of them empty
  Batch spare_;  ///< from the writer, so that memory need not be asked for again and again
  std::vector<std::uint64_t> lost_;
  bool closed_ = false;
};

}  // namespace adstar::bag
