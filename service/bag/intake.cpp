#include "service/bag/intake.hpp"

#include <utility>

namespace adstar::bag {

bool Intake::offer(std::size_t topic, std::int64_t received_ns,
                   std::span<const std::byte> payload) {
  bool first = false;
  {
    const std::lock_guard lock(mutex_);
    if (closed_ || waiting_.bytes.size() + payload.size() > most_bytes_) {
      ++lost_.at(topic);
      return false;
    }
    first = waiting_.entries.empty();
    waiting_.entries.push_back({topic, received_ns, waiting_.bytes.size(), payload.size()});
    waiting_.bytes.insert(waiting_.bytes.end(), payload.begin(), payload.end());
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

bool Intake::swap_in(Batch& batch, std::chrono::milliseconds patience) {
  batch.clear();
  std::unique_lock lock(mutex_);
  filled_.wait_for(lock, patience, [&] { return closed_ || !waiting_.entries.empty(); });
  std::swap(batch, waiting_);
  return !(closed_ && batch.entries.empty());
}

std::vector<std::uint64_t> Intake::lost() const {
  const std::lock_guard lock(mutex_);
  return lost_;
}

}  // namespace adstar::bag
