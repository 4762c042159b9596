#include "service/run/resume.hpp"

#include <algorithm>
#include <deque>
#include <memory>

#include <fmt/format.h>

#include "service/run/journal_file.hpp"
#include "service/runtime/step_digests.hpp"

namespace adstar::run {
namespace {

using runtime::JournalKind;
using runtime::JournalRecord;

/// Into its place, or, when one before it is missing, nowhere.
void add(RunRecords& all, const JournalRecord& record) {
  if (!is_heard(record.kind)) {
    // It was made when all up to its number had been heard.
    all.highest = std::max(all.highest, record.number);
    if (record.number >= all.next_number && all.gap.empty()) {
      all.gap = fmt::format("records {} to {} of the journal are missing", all.next_number,
                            record.number);
    }
    (record.kind == JournalKind::state_hash ? all.hashes : all.digests).push_back(record);
    return;
  }
  all.highest = std::max(all.highest, record.number);
  if (record.number < all.next_number) {
    return;  // in two places: moved to the file, not yet let go of
  }
  if (record.number > all.next_number || !all.gap.empty()) {
    if (all.gap.empty()) {
      all.gap = fmt::format("records {} to {} of the journal are missing", all.next_number,
                            record.number - 1);
    }
    return;
  }
  all.heard.push_back(record);
  ++all.next_number;
}

/// The verdicts that are young enough to be said again.
class LastVerdicts {
 public:
  explicit LastVerdicts(runtime::VerdictRing& ring) : ring_(ring) {}

  void collect() {
    while (const auto verdict = ring_.pop()) {
      last_.push_back(*verdict);
      if (last_.size() > kMost) {
        last_.pop_front();
      }
    }
  }
  void say_again(std::int64_t now_ns) {
    for (const runtime::VerdictRecord& verdict : last_) {
      if (now_ns - verdict.time_ns <= kYoung_ns) {
        ring_.push(verdict);
      }
    }
  }

 private:
  static constexpr std::int64_t kYoung_ns = 2'000'000'000;
  static constexpr std::size_t kMost = runtime::VerdictRing::kCapacity / 2;
  runtime::VerdictRing& ring_;
  std::deque<runtime::VerdictRecord> last_;
};

/// How far the run had come since its last reset, for all that is known.
std::uint64_t last_known_step(const RunRecords& records, const runtime::HotJournal* hot,
                              const Instant& at) {
  std::uint64_t step = at.step;
  if (hot != nullptr) {
    step = std::max(step, hot->step.load(std::memory_order_acquire));
  }
  for (const JournalRecord& hash : records.hashes) {
    step = hash.note == at.resets ? std::max(step, hash.step) : step;
  }
  for (const JournalRecord& record : records.digests) {
    const std::uint64_t count = runtime::digests_of(record).count;
    if (record.note == at.resets && count > 0) {
      step = std::max(step, record.step + count - 1);
    }
  }
  return step;
}

/// What may be missing though no record says so: files of another version, for one, or all of them changed.
std::string unknown_part(const RunDirectory& directory, bool has_checkpoint,
                         const RunRecords& records) {
  if (!records.unreadable.empty()) {
    return fmt::format("{} cannot be read", records.unreadable);
  }
  const std::vector<Numbered> journals = directory.journals();
  const bool from_the_start = !journals.empty() && journals.front().number == 1;
  return !has_checkpoint && !directory.checkpoints().empty() && !from_the_start
             ? "none of its checkpoints can be read, and its journal does not reach back to its "
               "beginning"
             : "";
}

}  // namespace

RunRecords read_records(const RunDirectory& directory, const runtime::HotJournal* hot,
                        std::uint64_t from) {
  RunRecords all;
  all.next_number = from;
  for (const Numbered& file : directory.journals()) {
    const JournalText text = journal_from(read_bytes(file.path));
    if (!text.unreadable) {
      all.unreadable.clear();  // the numbers in later files tell what is missing
    } else if (all.unreadable.empty()) {
      all.unreadable = file.path.string();
    }
    if (!text.damage.empty()) {
      all.damage.push_back(file.path.string() + " " + text.damage);
    } else if (text.run != directory.facts().run) {
      all.damage.push_back(file.path.string() + " belongs to another run");
      continue;
    }
    for (const JournalRecord& record : text.records) {
      if (is_heard(record.kind)) {
        all.last_in_files = std::max(all.last_in_files, record.number);
      }
      add(all, record);
    }
  }
  if (hot != nullptr) {
    for (std::size_t i = 0; i < hot->ring.size(); ++i) {
      add(all, hot->ring.peek(i));
    }
  }
  return all;
}

std::optional<Checkpoint> newest_checkpoint(const RunDirectory& directory,
                                            const scene::Scene& scene, std::uint64_t fingerprint,
                                            std::vector<std::string>& refused) {
  for (const Numbered& file : directory.checkpoints()) {
    try {
      Checkpoint checkpoint = checkpoint_from(read_bytes(file.path));
      if (checkpoint.run != directory.facts().run) {
        throw RunError("belongs to another run");
      }
      if (checkpoint.fingerprint != fingerprint) {
        throw std::invalid_argument(fmt::format(
            "{} was made by another scene: a table that {} names has changed since; put "
            "it back, or begin another run",
            file.path.string(), directory.facts().scene_file.string()));
      }
      const auto verdicts = std::make_unique<runtime::VerdictRing>();
      const auto answers = std::make_unique<runtime::ControlAnswerRing>();
      runtime::CommandGate gate(scene.spacecraft, *verdicts);
      runtime::ControlMemory controls(*answers);
      if (!fits(checkpoint, scene) || !gate.load(checkpoint.gate) ||
          !controls.load(checkpoint.controls)) {
        throw RunError("does not fit its scene");
      }
      return checkpoint;
    } catch (const std::invalid_argument& error) {
      throw RunError(error.what());
    } catch (const RunError& error) {
      refused.push_back(fmt::format("{} {}", file.path.string(), error.what()));
    }
  }
  return std::nullopt;
}

bool set_to(Flight& flight, const Checkpoint& checkpoint) {
  flight.at = checkpoint.at;
  if (!flight.gate.load(checkpoint.gate) || !flight.controls.load(checkpoint.controls)) {
    return false;
  }
  return flight.fleet == nullptr || restore(*flight.fleet, checkpoint.fleet);
}

bool fits(const Checkpoint& checkpoint, const scene::Scene& scene) {
  std::size_t wheels = 0, words = 0;
  for (const scene::Spacecraft& craft : scene.spacecraft) {
    wheels += craft.wheels.size();
    words += runtime::memory_words(craft);
  }
  return checkpoint.fleet.vehicles.size() == scene.spacecraft.size() &&
         checkpoint.fleet.wheel_momenta.size() == wheels && checkpoint.fleet.memory.size() == words;
}

Resumed resume(const RunDirectory& directory, const runtime::HotJournal* hot,
               const scene::Scene& scene, std::uint64_t fingerprint, bool accept_loss,
               Flight& flight, runtime::VerdictRing& verdicts) {
  Resumed resumed;
  const std::optional<Checkpoint> checkpoint =
      newest_checkpoint(directory, scene, fingerprint, resumed.notes);
  for (std::string& note : resumed.notes) {
    note += checkpoint ? "; an older one is used" : "";
  }
  if (checkpoint) {
    set_to(flight, *checkpoint);
  }
  resumed.checkpoint = flight.at;
  resumed.records = read_records(directory, hot, checkpoint ? checkpoint->next_number : 1);
  const RunRecords& records = resumed.records;
  if (records.gap.empty()) {
    resumed.records.gap = unknown_part(directory, checkpoint.has_value(), records);
  }
  resumed.notes.insert(resumed.notes.end(), records.damage.begin(), records.damage.end());
  if (!records.gap.empty()) {
    std::string what = fmt::format("{}: {}", directory.path().string(), records.gap);
    for (const std::string& note : resumed.notes) {
      what += "; " + note;
    }
    if (!accept_loss) {
      throw RunError(fmt::format(
          "{}; the run cannot go on as it was. --accept-loss goes on from step {}, where what is "
          "known ends",
          what, records.heard.empty() ? flight.at.step : records.heard.back().step));
    }
    resumed.notes.push_back(what + "; the run goes on without them");
    // What is written from now on must not be taken for what is missing.
    resumed.records.next_number = resumed.records.highest + 1;
    resumed.records.last_in_files = resumed.records.highest;
  }
  LastVerdicts last(verdicts);
  std::span<const JournalRecord> left(records.heard);
  const auto carry_on_to = [&](std::uint64_t step) {
    const std::uint64_t resets = flight.at.resets;
    while (flight.at.resets == resets && flight.at.step < step) {
      // A beat at a time: the ring of verdicts is bounded.
      left = left.subspan(carry_on(flight, left, {resets, flight.at.step + 1}));
      last.collect();
    }
    left = left.subspan(hear(flight, left));
    last.collect();
  };
  while (!left.empty()) {
    carry_on_to(left.front().step);
  }
  if (records.gap.empty()) {
    carry_on_to(last_known_step(records, hot, flight.at));
  }
  last.say_again(static_cast<std::int64_t>(flight.at.step) * flight.step_ns);
  return resumed;
}

}  // namespace adstar::run
