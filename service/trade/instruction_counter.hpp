#pragma once
// Instructions that this thread retires, where the machine and its owner let us count them
// (perf_event_open; virtual machines often have no counters).

#include <cstdint>
#include <optional>

namespace adstar::trade {

class InstructionCounter {
 public:
  InstructionCounter();
  InstructionCounter(const InstructionCounter&) = delete;
  InstructionCounter& operator=(const InstructionCounter&) = delete;
  ~InstructionCounter();

  void start();
  /// Since start(); none where it cannot be counted.
  std::optional<std::uint64_t> stop();

 private:
  int fd_;
};

}  // namespace adstar::trade
