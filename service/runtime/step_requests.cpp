#include "service/runtime/step_requests.hpp"

#include <algorithm>

namespace adstar::runtime {
namespace {

/// Why it cannot be served at all, in the order of the checks.
StepRefusal objection(const StepRequestRecord& request, const ClockFace& now,
                      bool another_under_way) noexcept {
  if (request.steps > StepRequests::kMostSteps) {
    return StepRefusal::too_many_steps;
  }
  if (request.steps == 0) {
    return StepRefusal::none;  // a question
  }
  if (now.halted) {
    return StepRefusal::halted;
  }
  if (another_under_way) {
    return StepRefusal::busy;
  }
  return now.standing ? StepRefusal::none : StepRefusal::not_standing;
}

}  // namespace

// A reply that finds the ring full is lost; the requester repeats and gets it.
void StepRequests::receive(const StepRequestRecord& request, const ClockFace& now) noexcept {
  StepReplyRecord reply;
  reply.requester = request.requester;
  reply.sequence = request.sequence;
  reply.step = now.step;
  reply.time_ns = now.time_ns;
  const bool busy = allowed_ > 0;
  auto& asker = memory_.find(request.requester);
  if (busy && request.requester == requester_ && request.sequence == sequence_) {
    reply.outcome = StepOutcome::accepted;
    replies_.push(reply);
    return;
  }
  if (request.sequence <= asker.last_sequence) {
    const StepReplyRecord* const known = asker.recall(request.sequence);
    reply.refusal = StepRefusal::old_sequence;
    replies_.push(known != nullptr ? *known : reply);
    return;
  }
  asker.last_sequence = request.sequence;
  reply.refusal = objection(request, now, busy);
  if (reply.refusal == StepRefusal::none && request.steps > 0) {
    allowed_ = request.steps;
    requester_ = request.requester;
    sequence_ = request.sequence;
    return;
  }
  reply.outcome = reply.refusal == StepRefusal::none ? StepOutcome::done : StepOutcome::refused;
  asker.remember(reply);
  replies_.push(reply);
}

void StepRequests::stepped(const ClockFace& now, bool ended) noexcept {
  if (allowed_ == 0) {
    return;
  }
  --allowed_;
  if (ended) {
    conclude(StepOutcome::ended, now);
  } else if (allowed_ == 0) {
    conclude(StepOutcome::done, now);
  }
}

void StepRequests::interrupt(const ClockFace& now) noexcept {
  if (allowed_ > 0) {
    conclude(StepOutcome::interrupted, now);
  }
}

void StepRequests::conclude(StepOutcome outcome, const ClockFace& now) noexcept {
  allowed_ = 0;
  StepReplyRecord reply;
  reply.requester = requester_;
  reply.sequence = sequence_;
  reply.outcome = outcome;
  reply.step = now.step;
  reply.time_ns = now.time_ns;
  auto& asker = memory_.find(requester_);
  asker.last_sequence = std::max(asker.last_sequence, sequence_);  // it may have been forgotten
  asker.remember(reply);
  replies_.push(reply);
}

}  // namespace adstar::runtime
