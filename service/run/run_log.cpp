#include "service/run/run_log.hpp"

#include <algorithm>

namespace adstar::run {

using runtime::JournalRecord;

RunLog::RunLog(const RunDirectory& directory, const scene::Scene& scene, std::uint64_t fingerprint,
               runtime::HotJournal& hot, const Flight& start, std::uint64_t next_number,
               std::uint64_t last_in_files, bool from_start)
    : directory_(directory),
      fingerprint_(fingerprint),
      hot_(hot),
      verdicts_(std::make_unique<runtime::VerdictRing>()),
      answers_(std::make_unique<runtime::ControlAnswerRing>()),
      gate_(scene.spacecraft, *verdicts_),
      controls_(*answers_),
      flight_{gate_, controls_, nullptr, start.step_ns, start.at},
      next_number_(next_number),
      last_in_files_(last_in_files),
      journal_count_(directory.journals().empty() ? 1 : directory.journals().back().number + 1),
      journal_(directory.journal_path(journal_count_), directory.facts().run),
      from_start_(from_start) {
  gate_.load(start.gate.save());
  controls_.load(start.controls.save());
  for (const Numbered& file : directory.checkpoints()) {
    next_checkpoint_ = std::max(next_checkpoint_, file.number + 1);
    try {
      kept_.push_front({file.path, checkpoint_from(read_bytes(file.path)).first_journal});
    } catch (const RunError&) {
      // Refused when the run was resumed; left there for whoever wants to look at it.
    }
  }
}

bool RunLog::move_records() {
  const std::size_t count = hot_.ring.size();
  std::vector<JournalRecord> records;
  for (std::size_t i = 0; i < count; ++i) {
    const JournalRecord& record = hot_.ring.peek(i);
    if (!is_heard(record.kind) || record.number > last_in_files_) {
      records.push_back(record);
    }
  }
  journal_.append(records);
  hot_.ring.release(count);
  for (const JournalRecord& record : records) {
    last_in_files_ = std::max(last_in_files_, record.number);
    if (is_heard(record.kind) && record.number >= next_number_) {
      unheard_.push_back(record);
    }
  }
  return !records.empty();
}

void RunLog::note_hash(const Instant& at, std::uint64_t hash) {
  const JournalRecord record =
      make_journal_record(runtime::JournalKind::state_hash, last_in_files_, at.step,
                          static_cast<std::uint32_t>(at.resets), hash);
  journal_.append(std::span(&record, 1));
}

void RunLog::write_checkpoint(const Instant& at, const runtime::FleetState& fleet,
                              bool keep_all_journals) {
  const std::vector<JournalRecord> records(unheard_.begin(), unheard_.end());
  const std::size_t heard = carry_on(flight_, records, at);
  unheard_.erase(unheard_.begin(), unheard_.begin() + static_cast<std::ptrdiff_t>(heard));
  next_number_ += heard;
  verdicts_->skip_all();

  // What was moved but belongs to later beats stands in the present file.
  const std::uint64_t first_journal = journal_count_ + (unheard_.empty() ? 1 : 0);
  const Checkpoint checkpoint{directory_.facts().run,
                              fingerprint_,
                              at,
                              next_number_,
                              keep_all_journals ? 1 : first_journal,
                              fleet,
                              gate_.save(),
                              controls_.save()};
  const std::filesystem::path path = directory_.checkpoint_path(next_checkpoint_);
  journal_.sync();
  replace_file(path, to_bytes(checkpoint));
  ++next_checkpoint_;
  kept_.push_back({path, checkpoint.first_journal});
  if (!keep_all_journals) {
    journal_ = JournalFile(directory_.journal_path(journal_count_ + 1), directory_.facts().run);
    ++journal_count_;
  }
  remove_old();
}

void RunLog::remove_old() {
  constexpr std::size_t kCheckpoints = 3;
  while (kept_.size() > kCheckpoints) {
    std::filesystem::remove(kept_.front().path);
    kept_.pop_front();
  }
  if (from_start_ && kept_.size() < kCheckpoints) {
    return;
  }
  for (const Numbered& journal : directory_.journals()) {
    if (journal.number < kept_.front().first_journal) {
      std::filesystem::remove(journal.path);
    }
  }
}

}  // namespace adstar::run
