#pragma once
// The run on disk, if the scene or the command line asks for one: begun, or gone on with.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "service/adstard/options.hpp"
#include "service/adstard/recorder.hpp"
#include "service/run/checkpoint.hpp"
#include "service/run/hot_journal_file.hpp"
#include "service/run/run_directory.hpp"
#include "service/runtime/shared_segment.hpp"
#include "service/runtime/tick.hpp"

namespace adstar::adstard {

/// What is to be flown: of a scene file, or of a run that is gone on with.
struct Plan {
  std::string text;  ///< of the scene
  std::string file;  ///< where that was read
  scene::Scene scene;
  std::optional<run::RunDirectory> run;
};

/// Opens the run that is to be gone on with; a new one is not begun yet. Throws SceneError, RunError.
Plan make_plan(Options options);

/// Makes the directory of a new run, if one is asked for. Throws RunError.
void begin_run(Plan& plan, const Options& options);

/// Keeps the run while it lives. Without a directory it only hashes the state.
class Keeping {
 public:
  /// `plan` outlives it. Before tick.run(): begins the new run, or brings the tick to where a run was that is gone on with, or
  /// to the `state` of a primary. Throws RunError.
  Keeping(Plan& plan, const Options& options, runtime::Tick& tick, runtime::MappedSegment& segment,
          const run::Checkpoint* state = nullptr);

  StateHash newest_hash() const { return recorder_->newest_hash(); }

  /// After tick.run().
  void finish(const runtime::Tick& tick);

 private:
  void go_on(const Plan& plan, bool accept_loss, std::uint64_t fingerprint, run::Flight& flight,
             runtime::VerdictRing& verdicts);
  /// Throws RunError when it cannot be read, unless `accept_loss`.
  std::optional<run::HotJournalFile> what_was_in_memory(bool accept_loss) const;
  void begin_at(const Plan& plan, std::uint64_t fingerprint, const run::Checkpoint& state,
                run::Flight& flight);

  const Plan& plan_;
  std::uint64_t next_number_ = 1, last_in_files_ = 0;
  bool begins_with_checkpoint_ = false;  ///< its journal does not tell how it came there
  std::optional<run::HotJournalFile> hot_;
  std::optional<runtime::JournalWriter> writer_;
  std::unique_ptr<Recorder> recorder_;
};

}  // namespace adstar::adstard
