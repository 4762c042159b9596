// The tick and those who hold its clock: standing still, step requests, run control.

#include "service/runtime/tick.hpp"
#include "service/runtime/tick_parts.hpp"

namespace adstar::runtime {

bool Tick::stands() const noexcept {
  const bool held = pace_ == scene::Pace::lockstep || paused();
  return halted() || (held && step_requests_.allowed() == 0);
}

Beat Tick::now() const noexcept {
  const std::uint64_t n = step();
  return {n, static_cast<std::int64_t>(n) * step_ns_, step_ns_, stands()};
}

ClockFace Tick::face() const noexcept { return {step(), time_ns(), stands(), halted()}; }

bool Tick::answers_wait() const noexcept {
  return segment_->step_replies.size() > 0 || segment_->control_answers.size() > 0;
}

/// Commands are judged (or, halted, refused), requests answered, snapshots served, until the clock may
/// go on.
void Tick::stand(const std::atomic<bool>& stop) noexcept {
  constexpr int kLook_ms = 10;  // for `stop`, and for what a bridge pushed as it died
  const bool waits = pace_ == scene::Pace::lockstep && !halted();
  report_.waiting.store(waits ? 1 : 0, std::memory_order_relaxed);
  hand_over_rest();
  while (!stop.load(std::memory_order_relaxed) && stands()) {
    add(report_.turns, 1);
    const std::uint32_t seen = segment_->push_count.load(std::memory_order_seq_cst);
    const std::int64_t begun = monotonic_ns();
    take_commands(now(), begun);
    serve_requests(begun);
    publish_counters();
    if (segment_->snapshot_requested.exchange(0, std::memory_order_relaxed) != 0 || !told_) {
      told_ = true;
      publish(step(), true, true);
    } else if (segment_->verdicts.size() > 0 || answers_wait()) {
      wake_bridge(*segment_);
    }
    if (stands()) {
      sleep_until_pushed(*segment_, seen, kLook_ms);
    }
  }
  report_.waiting.store(0, std::memory_order_relaxed);
}

void Tick::serve_requests(std::int64_t now_ns) noexcept {
  for (int taken = 0; taken < kRequestsPerBeat; ++taken) {
    const std::optional<ControlRecord> record = segment_->controls.pop();
    if (!record) {
      break;
    }
    if (!is_stale(record->received_ns, now_ns)) {
      control(*record);
    }
  }
  for (int taken = 0; taken < kRequestsPerBeat; ++taken) {
    const std::optional<StepRequestRecord> request = segment_->step_requests.pop();
    if (!request) {
      break;
    }
    report_.asked_ns.store(now_ns, std::memory_order_relaxed);
    if (!is_stale(request->received_ns, now_ns)) {
      step_requests_.receive(*request, face());
    }
  }
}

void Tick::control(const ControlRecord& record) noexcept {
  ControlAnswerRecord answer = blank_answer(record);
  answer.step = step();
  answer.time_ns = time_ns();
  if (controls_.repeated(record, answer)) {
    return;
  }
  answer.refusal = objection(record.action);
  if (answer.refusal == ControlRefusal::none) {
    const std::uint64_t at = step();
    const bool written = journal_ != nullptr && changes_the_fleet(record.action);
    answer = apply_control(record, fleet_);
    if (written) {
      if (record.action == ControlAction::reset) {
        journal_->reached(0);
      }
      journal_->write(JournalKind::control, at, static_cast<std::uint32_t>(answer.refusal), record);
    }
    if (answer.refusal == ControlRefusal::none) {
      follow(record.action);
    }
    answer.step = step();
    answer.time_ns = time_ns();
  }
  controls_.conclude(answer);
}

ControlRefusal Tick::objection(ControlAction action) const noexcept {
  if (!obeys_run_control_) {
    return ControlRefusal::not_allowed;
  }
  if (journal_ != nullptr && changes_the_fleet(action) && !journal_->has_room()) {
    return ControlRefusal::not_recorded;
  }
  const bool nothing_to_resume = action == ControlAction::resume && pace_ == scene::Pace::lockstep;
  return halted() || nothing_to_resume ? ControlRefusal::not_now : ControlRefusal::none;
}

/// What the clock does about an action that the fleet has taken.
void Tick::follow(ControlAction action) noexcept {
  told_ = false;
  switch (action) {
    case ControlAction::pause:
      step_requests_.interrupt(face());
      report_.paused.store(pace_ == scene::Pace::lockstep ? 0 : 1, std::memory_order_relaxed);
      break;
    case ControlAction::resume:
      step_requests_.interrupt(face());
      restart_clock_ = restart_clock_ || paused();
      report_.paused.store(0, std::memory_order_relaxed);
      break;
    case ControlAction::reset:
      hand_over_rest();
      step_requests_.interrupt(face());
      gate_.reset(now());
      report_.step.store(0, std::memory_order_relaxed);
      add(report_.run, 1);
      restart_clock_ = true;
      break;
    case ControlAction::set_state:
    case ControlAction::set_inertia:
    case ControlAction::set_target:
      break;
  }
}

/// In lock-step no beat is due, so that the bridge can be given time to take what it has. Returns when
/// the step may begin.
std::int64_t Tick::await_room(std::int64_t ended_ns) noexcept {
  constexpr std::size_t kFull = decltype(SharedSegment::telemetry)::kCapacity / 2;
  constexpr std::int64_t kPatience_ns = kSecond / 10, kLook_ns = kSecond / 5000;
  if (pace_ != scene::Pace::lockstep || segment_->telemetry.size() <= kFull) {
    return ended_ns;
  }
  std::int64_t now_ns = monotonic_ns();
  while (segment_->telemetry.size() > kFull && now_ns - ended_ns < kPatience_ns) {
    wake_bridge(*segment_);
    sleep_until(now_ns + kLook_ns);
    now_ns = monotonic_ns();
  }
  return now_ns;
}

}  // namespace adstar::runtime
