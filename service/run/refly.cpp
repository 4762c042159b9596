#include "service/run/refly.hpp"

#include <algorithm>
#include <cstring>
#include <map>
#include <memory>

#include <fmt/format.h>

#include "service/run/checkpoint.hpp"
#include "service/run/flight.hpp"
#include "service/run/hot_journal_file.hpp"
#include "service/run/resume.hpp"

namespace adstar::run {
namespace {

using runtime::VehicleState;

bool same_bits(const VehicleState& a, const VehicleState& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

std::vector<VehicleState> states_of(const runtime::Fleet& fleet) {
  std::vector<VehicleState> states;
  for (const runtime::Vehicle& vehicle : fleet.vehicles()) {
    states.push_back(runtime::state_of(vehicle));
  }
  return states;
}

/// Whole ones, by step.
std::map<std::uint64_t, Checkpoint> whole_checkpoints(const RunDirectory& directory,
                                                      const scene::Scene& scene,
                                                      std::uint64_t fingerprint,
                                                      std::vector<std::string>& notes) {
  std::map<std::uint64_t, Checkpoint> whole;
  for (const Numbered& file : directory.checkpoints()) {
    try {
      Checkpoint checkpoint = checkpoint_from(read_bytes(file.path));
      if (checkpoint.fingerprint != fingerprint || checkpoint.run != directory.facts().run ||
          checkpoint.vehicles.size() != scene.spacecraft.size()) {
        throw RunError("does not belong to this run and its scene");
      }
      whole.emplace(checkpoint.step, std::move(checkpoint));
    } catch (const RunError& error) {
      notes.push_back(fmt::format("{} {}", file.path.string(), error.what()));
    }
  }
  return whole;
}

/// What a checkpoint holds that the flight does not; empty: nothing.
std::string difference(const Checkpoint& checkpoint, const std::vector<VehicleState>& states,
                       const runtime::CommandGate& gate, const scene::Scene& scene) {
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (!same_bits(checkpoint.vehicles[i], states[i])) {
      return "the state of spacecraft '" + scene.spacecraft[i].name + "'";
    }
  }
  return gate.save() == checkpoint.gate ? "" : "the schedule of commands";
}

}  // namespace

Reflight refly(const RunDirectory& directory, const scene::Scene& scene, std::uint64_t fingerprint,
               const std::function<bool(double)>& progress) {
  Reflight result;
  const auto hot = HotJournalFile::open(directory.facts().run);
  const auto checkpoints = whole_checkpoints(directory, scene, fingerprint, result.notes);
  const auto ring = std::make_unique<runtime::VerdictRing>();
  runtime::Fleet fleet(scene.spacecraft, scene.simulation.scheme, scene.simulation.limits);
  runtime::CommandGate gate(scene.spacecraft, *ring);
  Flight flight{gate, &fleet, scene.simulation.step_ns, 0};

  RunRecords records = read_records(directory, hot ? &**hot : nullptr, 1);
  const std::uint64_t heard_by_the_newest =
      checkpoints.empty() ? 1 : checkpoints.rbegin()->second.next_number;
  if (!records.gap.empty() || records.next_number < heard_by_the_newest) {
    if (checkpoints.empty()) {
      throw RunError(fmt::format("{}: {}, and no checkpoint can be read: nothing to fly",
                                 directory.path().string(), records.gap));
    }
    const Checkpoint& oldest = checkpoints.begin()->second;
    set_to(flight, oldest);
    records = read_records(directory, hot ? &**hot : nullptr, oldest.next_number);
  }
  result.notes.insert(result.notes.end(), records.damage.begin(), records.damage.end());
  if (!records.gap.empty()) {
    result.notes.push_back(records.gap + ": compared up to there");
  }
  result.from_step = result.same_until = flight.step;

  std::map<std::uint64_t, std::uint64_t> hashes;
  for (const runtime::JournalRecord& record : records.hashes) {
    hashes[record.step] = record.payload[0];
  }
  std::uint64_t last = flight.step;
  last = std::max(last, checkpoints.empty() ? 0 : checkpoints.rbegin()->first);
  last = std::max(last, hashes.empty() ? 0 : hashes.rbegin()->first);
  if (!records.gap.empty() && !records.commands.empty()) {
    last = std::min(last, records.commands.back().step);
  }

  std::span<const runtime::JournalRecord> left(records.commands);
  while (flight.step < last && !result.differs_at) {
    const auto next_hash = hashes.upper_bound(flight.step);
    const auto next_checkpoint = checkpoints.upper_bound(flight.step);
    std::uint64_t until = last;
    until = next_hash == hashes.end() ? until : std::min(until, next_hash->first);
    until = next_checkpoint == checkpoints.end() ? until : std::min(until, next_checkpoint->first);
    const std::size_t taken = carry_on(flight, left, until);
    left = left.subspan(taken);
    result.commands += taken;
    ring->skip_all();
    const std::vector<VehicleState> states = states_of(fleet);
    if (const auto hash = hashes.find(until); hash != hashes.end()) {
      ++result.hashes;
      if (hash->second != state_hash(until, states)) {
        result.differs_at = until;
      }
    }
    if (const auto checkpoint = checkpoints.find(until); checkpoint != checkpoints.end()) {
      ++result.checkpoints;
      if (const std::string what = difference(checkpoint->second, states, gate, scene);
          !what.empty()) {
        result.differs_at = until;
        result.differs_in = what;
      }
    }
    if (!result.differs_at) {
      result.same_until = until;
    }
    if (!progress(static_cast<double>(flight.step - result.from_step) /
                  static_cast<double>(std::max<std::uint64_t>(1, last - result.from_step)))) {
      break;
    }
  }
  result.to_step = flight.step;
  return result;
}

}  // namespace adstar::run
