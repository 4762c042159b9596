#pragma once
// Going on with a run: the newest checkpoint that can be believed, the journal since, and the beats up to
// where the run was.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "service/run/checkpoint.hpp"
#include "service/run/flight.hpp"
#include "service/run/run_directory.hpp"
#include "service/runtime/journal.hpp"

namespace adstar::run {

/// What a run's files and memory hold of its journal.
struct RunRecords {
  std::vector<runtime::JournalRecord> heard;  ///< commands and controls, none missing between
  std::vector<runtime::JournalRecord> hashes;
  std::vector<runtime::JournalRecord> digests;  ///< step by step, where the scene asked for that
  std::uint64_t next_number = 1;                ///< of the record that would come next
  std::uint64_t highest = 0;                    ///< of all numbers, those after a gap too
  std::uint64_t last_in_files = 0;  ///< number of the last that needs no memory to survive
  std::vector<std::string> damage;  ///< a sentence for each file that is not whole
  std::string unreadable;  ///< the first of those at its end of which nothing is known; empty: none
  std::string gap;         ///< what is missing, or may be; empty: nothing
};

/// From record `from` on. `hot` may be null.
RunRecords read_records(const RunDirectory& directory, const runtime::HotJournal* hot,
                        std::uint64_t from);

/// The newest that is whole and of this scene; what is wrong with newer ones goes to `refused`. Nothing:
/// the run begins with its scene. Throws RunError when the scene is not the run's.
std::optional<Checkpoint> newest_checkpoint(const RunDirectory& directory,
                                            const scene::Scene& scene, std::uint64_t fingerprint,
                                            std::vector<std::string>& refused);

/// The flight as the checkpoint has it. Its gate must be new. False when it is of another scene: the flight
/// is to be thrown away.
bool set_to(Flight& flight, const Checkpoint& checkpoint);

/// Whether it is of a fleet of that shape.
bool fits(const Checkpoint& checkpoint, const scene::Scene& scene);

struct Resumed {
  Instant checkpoint;  ///< where it began
  RunRecords records;
  std::vector<std::string> notes;  ///< what was wrong, and what was done about it
};

/// Brings a new flight of `scene` to where the run was. The verdicts of its last two seconds are left in
/// `verdicts`, to be said again. Throws RunError when the run cannot go on with the bits it had, unless
/// `accept_loss`: then it goes on from where they end, and a checkpoint there is to be written at once.
Resumed resume(const RunDirectory& directory, const runtime::HotJournal* hot,
               const scene::Scene& scene, std::uint64_t fingerprint, bool accept_loss,
               Flight& flight, runtime::VerdictRing& verdicts);

}  // namespace adstar::run
