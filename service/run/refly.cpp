#include "service/run/refly.hpp"

#include <algorithm>
#include <cstring>
#include <map>
#include <memory>
#include <set>
#include <span>

#include <fmt/format.h>

#include "service/run/checkpoint.hpp"
#include "service/run/flight.hpp"
#include "service/run/hot_journal_file.hpp"
#include "service/run/resume.hpp"
#include "service/runtime/step_digests.hpp"

namespace adstar::run {
namespace {

using runtime::VehicleState;

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return std::ranges::equal(std::as_bytes(std::span(a)), std::as_bytes(std::span(b)));
}

std::map<Instant, Checkpoint> whole_checkpoints(const RunDirectory& directory,
                                                const scene::Scene& scene,
                                                std::uint64_t fingerprint,
                                                std::vector<std::string>& notes) {
  std::map<Instant, Checkpoint> whole;
  for (const Numbered& file : directory.checkpoints()) {
    try {
      Checkpoint checkpoint = checkpoint_from(read_bytes(file.path));
      if (checkpoint.fingerprint != fingerprint || checkpoint.run != directory.facts().run ||
          !fits(checkpoint, scene)) {
        throw RunError("does not belong to this run and its scene");
      }
      whole.emplace(checkpoint.at, std::move(checkpoint));
    } catch (const RunError& error) {
      notes.push_back(fmt::format("{} {}", file.path.string(), error.what()));
    }
  }
  return whole;
}

std::map<Instant, std::uint64_t> digests_in(const std::vector<runtime::JournalRecord>& records) {
  std::map<Instant, std::uint64_t> digests;
  for (const runtime::JournalRecord& record : records) {
    const runtime::DigestBlock block = runtime::digests_of(record);
    for (std::uint64_t i = 0; i < block.count; ++i) {
      digests[{record.note, record.step + i}] = block.digests[i];
    }
  }
  return digests;
}

/// What a checkpoint holds that the flight does not; empty: nothing.
std::string difference(const Checkpoint& checkpoint, const runtime::FleetState& state,
                       const runtime::CommandGate& gate, const scene::Scene& scene) {
  for (std::size_t i = 0; i < state.vehicles.size(); ++i) {
    if (std::memcmp(&checkpoint.fleet.vehicles[i], &state.vehicles[i], sizeof(VehicleState)) != 0) {
      return "the state of spacecraft '" + scene.spacecraft[i].name + "'";
    }
  }
  if (!same_bits(checkpoint.fleet.wheel_momenta, state.wheel_momenta)) {
    return "the momentum of a wheel";
  }
  if (!same_bits(checkpoint.fleet.memory, state.memory)) {
    return "what a model remembers";
  }
  return gate.save() == checkpoint.gate ? "" : "the schedule of commands";
}

}  // namespace

Reflight refly(const RunDirectory& directory, const scene::Scene& scene, std::uint64_t fingerprint,
               const std::function<bool(double)>& progress) {
  Reflight result;
  const auto hot = HotJournalFile::open(directory.facts());
  const auto checkpoints = whole_checkpoints(directory, scene, fingerprint, result.notes);
  const auto verdicts = std::make_unique<runtime::VerdictRing>();
  const auto answers = std::make_unique<runtime::ControlAnswerRing>();
  runtime::Fleet fleet(scene.spacecraft, scene.simulation.scheme, scene.simulation.limits);
  fleet.keep_start();
  runtime::CommandGate gate(scene.spacecraft, *verdicts);
  runtime::ControlMemory controls(*answers);
  Flight flight{gate, controls, &fleet, scene.simulation.step_ns, {}};

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
  result.from = result.same_until = flight.at;

  std::map<Instant, std::uint64_t> hashes;
  for (const runtime::JournalRecord& record : records.hashes) {
    hashes[{record.note, record.step}] = record.payload[0];
  }
  const std::map<Instant, std::uint64_t> digests = digests_in(records.digests);
  std::set<Instant> stops;
  for (const auto& [at, hash] : hashes) {
    stops.insert(at);
  }
  for (const auto& [at, digest] : digests) {
    stops.insert(at);
  }
  for (const auto& [at, checkpoint] : checkpoints) {
    stops.insert(at);
  }
  stops.erase(stops.begin(), stops.upper_bound(flight.at));

  std::span<const runtime::JournalRecord> left(records.heard);
  std::size_t done = 0;
  for (const Instant& stop : stops) {
    const std::size_t taken = carry_on(flight, left, stop);
    left = left.subspan(taken);
    result.heard += taken;
    verdicts->skip_all();
    if (flight.at != stop) {
      break;  // beyond a gap
    }
    if (const auto digest = digests.find(stop); digest != digests.end()) {
      ++result.hashes;
      if (digest->second != runtime::digest_of(fleet.vehicles())) {
        result.differs_at = stop;
      }
    }
    if (const auto hash = hashes.find(stop); hash != hashes.end()) {
      ++result.hashes;
      if (hash->second != state_hash(stop.step, runtime::state_of(fleet))) {
        result.differs_at = stop;
      }
    }
    if (const auto checkpoint = checkpoints.find(stop); checkpoint != checkpoints.end()) {
      ++result.checkpoints;
      // One written when the run was gone on with has heard the commands of its beat.
      const auto known = static_cast<std::size_t>(
          std::count_if(left.begin(), left.end(), [&](const runtime::JournalRecord& record) {
            return record.number < checkpoint->second.next_number;
          }));
      const std::size_t heard = hear(flight, left.first(known));
      left = left.subspan(heard);
      result.heard += heard;
      verdicts->skip_all();
      if (const std::string what =
              difference(checkpoint->second, runtime::state_of(fleet), gate, scene);
          !what.empty()) {
        result.differs_at = stop;
        result.differs_in = what;
      }
    }
    if (result.differs_at) {
      break;
    }
    result.same_until = stop;
    if (!progress(static_cast<double>(++done) / static_cast<double>(stops.size()))) {
      break;
    }
  }
  result.to = flight.at;
  return result;
}

}  // namespace adstar::run
