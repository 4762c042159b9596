#include "service/bag/intake.hpp"

#include <algorithm>
#include <utility>

namespace adstar::bag {

bool Intake::fits(std::size_t size) const {
  return !waiting_.empty() && waiting_.back().entries.size() < kBatchEntries &&
         waiting_.back().bytes.capacity() - waiting_.back().bytes.size() >= size;
}

bool Intake::add_batch(std::size_t size) {
  if (size > kBatchPayload_bytes) {
    held_bytes_ -= spare_.memory_bytes();
    spare_ = {};
  }
  if (spare_.memory_bytes() == 0) {
    const std::size_t payload_bytes = std::max(size, kBatchPayload_bytes);
    if (held_bytes_ + kBatchEntries * sizeof(Batch::Entry) + payload_bytes > most_bytes_) {
      return false;
    }
    spare_.entries.reserve(kBatchEntries);
    spare_.bytes.reserve(payload_bytes);
    held_bytes_ += spare_.memory_bytes();
  }
  waiting_.push_back(std::exchange(spare_, {}));
  return true;
}

bool Intake::offer(std::size_t topic, std::int64_t received_ns,
                   std::span<const std::byte> payload) {
  bool first = false;
  {
    const std::lock_guard lock(mutex_);
    first = waiting_.empty();
    if (closed_ || (!fits(payload.size()) && !add_batch(payload.size()))) {
      ++lost_.at(topic);
      return false;
    }
    Batch& batch = waiting_.back();
    batch.entries.push_back({topic, received_ns, batch.bytes.size(), payload.size()});
    batch.bytes.insert(batch.bytes.end(), payload.begin(), payload.end());
  }
  if (first) {
    filled_.notify_one();
  }
  return true;
}

void Intake::close() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  filled_.notify_all();
}

bool Intake::take(Batch& batch, std::chrono::milliseconds patience) {
  Batch done = std::exchange(batch, {});
  done.entries.clear();
  done.bytes.clear();
  std::unique_lock lock(mutex_);
  if (spare_.memory_bytes() == 0 && done.bytes.capacity() == kBatchPayload_bytes) {
    spare_ = std::exchange(done, {});
  } else {
    held_bytes_ -= done.memory_bytes();
  }
  filled_.wait_for(lock, patience, [&] { return closed_ || !waiting_.empty(); });
  if (waiting_.empty()) {
    return !closed_;
  }
  batch = std::move(waiting_.front());
  waiting_.pop_front();
  return true;
}

std::vector<std::uint64_t> Intake::lost() const {
  const std::lock_guard lock(mutex_);
  return lost_;
}

}  // namespace adstar::bag
