#include "service/run/flight.hpp"

#include <algorithm>

namespace adstar::run {
namespace {

using runtime::ControlRefusal;
using runtime::JournalKind;
using runtime::JournalRecord;

runtime::Beat beat_of(const Flight& flight) {
  const std::uint64_t step = flight.at.step;
  return {step, static_cast<std::int64_t>(step) * flight.step_ns, flight.step_ns};
}

/// True when it set the clock back.
bool control(Flight& flight, const JournalRecord& record) {
  const auto asked = runtime::payload_of<runtime::ControlRecord>(record);
  if (flight.fleet != nullptr) {
    runtime::apply_control(asked, *flight.fleet);
  }
  const auto refusal = static_cast<ControlRefusal>(record.note);
  const bool reset =
      asked.action == runtime::ControlAction::reset && refusal == ControlRefusal::none;
  if (reset) {
    flight.gate.reset(beat_of(flight));
    flight.at = {flight.at.resets + 1, 0};
  }
  runtime::ControlAnswerRecord answer = runtime::blank_answer(asked);
  answer.refusal = refusal;
  answer.step = flight.at.step;
  answer.time_ns = beat_of(flight).t_ns;
  flight.controls.hear_again(answer);
  return reset;
}

}  // namespace

std::size_t hear(Flight& flight, std::span<const JournalRecord> records) {
  for (std::size_t heard = 0; heard < records.size(); ++heard) {
    const JournalRecord& record = records[heard];
    if (record.step > flight.at.step) {
      return heard;
    }
    if (record.kind == JournalKind::command) {
      flight.gate.receive(runtime::payload_of<runtime::CommandRecord>(record), beat_of(flight));
    } else if (record.kind == JournalKind::control && control(flight, record)) {
      return heard + 1;
    }
  }
  return records.size();
}

std::size_t carry_on(Flight& flight, std::span<const JournalRecord> records, const Instant& until) {
  std::size_t taken = 0;
  while (flight.at < until) {
    const std::uint64_t resets = flight.at.resets;
    taken += hear(flight, records.subspan(taken));
    if (flight.at.resets != resets) {
      continue;  // the clock was set back: this is another beat
    }
    const bool last_run = taken == records.size();
    if (last_run && flight.at.resets < until.resets) {
      break;  // nothing is known of how it got there
    }
    const runtime::Beat beat = beat_of(flight);
    if (flight.fleet != nullptr) {
      flight.gate.begin_step(beat, *flight.fleet);
      flight.fleet->step(beat.t_ns, beat.h_ns);
    } else if (!flight.gate.idle()) {
      flight.gate.begin_step(beat);
    } else {
      // Nothing happens at the gate before the next record.
      const std::uint64_t next = last_run ? until.step : records[taken].step;
      const bool same_run = flight.at.resets == until.resets;
      flight.at.step = std::max(flight.at.step + 1, same_run ? std::min(until.step, next) : next);
      continue;
    }
    ++flight.at.step;
  }
  return taken;
}

}  // namespace adstar::run
