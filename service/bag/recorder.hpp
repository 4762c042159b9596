#pragma once
// Writes on a thread of its own what is offered to it, and commits once a second.

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <span>
#include <thread>
#include <vector>

#include "service/bag/intake.hpp"
#include "service/bag/rolling_writer.hpp"

namespace adstar::bag {

class Recorder {
 public:
  static constexpr std::size_t kMostWaiting_bytes = std::size_t{64} << 20U;

  Recorder(RollingWriter writer, std::size_t topics, std::size_t most_waiting_bytes);
  /// Without finish(): what waits is written, metadata.yaml is not.
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Never waits for the disk. False: lost, and counted.
  bool offer(std::size_t topic, std::int64_t received_ns, std::span<const std::byte> payload) {
    return intake_.offer(topic, received_ns, payload);
  }
  /// Writing has failed: finish() says how.
  bool failed() const { return failed_.load(); }

  /// Writes what waits and metadata.yaml; throws what made writing fail.
  const Metadata& finish();
  /// By topic.
  std::vector<std::uint64_t> lost() const { return intake_.lost(); }

 private:
  void work();

  Intake intake_;
  RollingWriter writer_;
  std::exception_ptr failure_;  ///< the thread's, until it is joined
  std::atomic<bool> failed_{false};
  std::thread thread_;
};

}  // namespace adstar::bag
