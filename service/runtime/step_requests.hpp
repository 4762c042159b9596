#pragma once
// Beats from elsewhere: while the clock stands, a StepRequest lets it take so many steps, and is
// answered when they are taken. One request at a time.
//
// Judges, counts and answers; never waits or allocates. The rules: service/pages/timing.md, "Lock-step".

#include <cstdint>

#include "service/runtime/records.hpp"
#include "service/runtime/request_memory.hpp"
#include "service/runtime/ring.hpp"

namespace adstar::runtime {

using StepReplyRing = SpscRing<StepReplyRecord, 256>;

/// Where the clock is.
struct ClockFace {
  std::uint64_t step = 0;
  std::int64_t time_ns = 0;
  bool standing = false;  ///< waits for requests
  bool halted = false;
};

class StepRequests {
 public:
  static constexpr std::uint64_t kMostSteps = 1'000'000'000;

  explicit StepRequests(StepReplyRing& replies) : replies_(replies) {}

  /// Judges one request: answers it now, or allows its steps.
  void receive(const StepRequestRecord& request, const ClockFace& now) noexcept;

  /// Steps that the request under way may still take.
  std::uint64_t allowed() const noexcept { return allowed_; }

  /// One of them was taken; `ended`: there are no more in this run.
  void stepped(const ClockFace& now, bool ended) noexcept;

  /// Ends the request under way, if there is one, where the clock is.
  void interrupt(const ClockFace& now) noexcept;

 private:
  void conclude(StepOutcome outcome, const ClockFace& now) noexcept;

  StepReplyRing& replies_;
  RequestMemory<StepReplyRecord> memory_;
  std::uint64_t allowed_ = 0;  ///< above 0: a request is under way
  CommanderId requester_;      ///< whose
  std::uint64_t sequence_ = 0;
};

}  // namespace adstar::runtime
