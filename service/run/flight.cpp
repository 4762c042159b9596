#include "service/run/flight.hpp"

#include <algorithm>

namespace adstar::run {
namespace {

runtime::Beat beat_of(const Flight& flight) {
  return {flight.step, static_cast<std::int64_t>(flight.step) * flight.step_ns, flight.step_ns};
}

}  // namespace

std::size_t hear(Flight& flight, std::span<const runtime::JournalRecord> records) {
  std::size_t heard = 0;
  for (; heard < records.size() && records[heard].step <= flight.step; ++heard) {
    if (records[heard].kind == runtime::JournalKind::command) {
      flight.gate.receive(runtime::payload_of<runtime::CommandRecord>(records[heard]),
                          beat_of(flight));
    }
  }
  return heard;
}

std::size_t carry_on(Flight& flight, std::span<const runtime::JournalRecord> records,
                     std::uint64_t until) {
  std::size_t taken = 0;
  while (flight.step < until) {
    taken += hear(flight, records.subspan(taken));
    const runtime::Beat beat = beat_of(flight);
    if (flight.fleet != nullptr) {
      flight.gate.begin_step(beat, *flight.fleet);
      flight.fleet->step(beat.t_ns, beat.h_ns);
    } else if (!flight.gate.idle()) {
      flight.gate.begin_step(beat);
    } else {
      // Nothing happens at the gate before the next record.
      const std::uint64_t next = taken < records.size() ? records[taken].step : until;
      flight.step = std::min(until, std::max(next, flight.step + 1));
      continue;
    }
    ++flight.step;
  }
  return taken;
}

}  // namespace adstar::run
