#pragma once
// What a run leaves on disk while it flies. Not the tick's: a thread of its own calls this.
//
// Checkpoints need the gate's state at the fleet's step, and the tick has no time to copy it. But the gate
// is a function of the commands alone: a second one, carried on from the journal, has it.

#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

#include "service/run/flight.hpp"
#include "service/run/journal_file.hpp"
#include "service/run/resume.hpp"
#include "service/run/run_directory.hpp"
#include "service/runtime/fleet_snapshot.hpp"

namespace adstar::run {

class RunLog {
 public:
  /// `start`: as the tick is when it starts, with record `next_number`. `last_in_files`: of the
  /// records that need not be written again. `from_start`: whether journals tell how it came there. Throws RunError, as all of these do when a file cannot
  /// be written; then nothing is lost, and the same call may be made again.
  RunLog(const RunDirectory& directory, const scene::Scene& scene, std::uint64_t fingerprint,
         runtime::HotJournal& hot, const Flight& start, std::uint64_t next_number,
         std::uint64_t last_in_files, bool from_start);

  /// Moves what is in memory to the file; true when there was something.
  bool move_records();
  void sync() { journal_.sync(); }

  /// After move_records(): the hash of the fleet's state there.
  void note_hash(const Instant& at, std::uint64_t hash);

  /// A checkpoint of the fleet there, all of whose commands were moved. The three newest are kept; of
  /// the journal what they need, or all of it. While there are fewer, the start of the run is one of them.
  void write_checkpoint(const Instant& at, const runtime::FleetState& fleet,
                        bool keep_all_journals);

 private:
  struct Kept {
    std::filesystem::path path;
    std::uint64_t first_journal = 0;
  };
  void remove_old();

  const RunDirectory& directory_;
  std::uint64_t fingerprint_;
  runtime::HotJournal& hot_;
  // What the second gate and the second memory would say goes nowhere.
  std::unique_ptr<runtime::VerdictRing> verdicts_;
  std::unique_ptr<runtime::ControlAnswerRing> answers_;
  runtime::CommandGate gate_;
  runtime::ControlMemory controls_;
  Flight flight_;
  std::uint64_t next_number_;  ///< of the first record that flight_ has not heard
  std::uint64_t last_in_files_;
  std::deque<runtime::JournalRecord> unheard_;
  std::uint64_t journal_count_;
  JournalFile journal_;
  bool from_start_;
  std::uint64_t next_checkpoint_ = 1;
  std::deque<Kept> kept_;  ///< checkpoints, oldest first
};

}  // namespace adstar::run
