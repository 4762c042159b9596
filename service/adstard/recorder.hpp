#pragma once
// A thread beside the tick: the hash of the fleet's state, and, when the run is kept, its journal and
// checkpoints on disk. A disk that is slow or full holds up nobody but this thread.

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "service/run/run_log.hpp"
#include "service/runtime/tick.hpp"

namespace adstar::adstard {

struct StateHash {
  std::uint64_t hash = 0;
  std::uint64_t step = 0;  ///< 0: none yet
};

class Recorder {
 public:
  /// `log` may be null: then only hashes. Starts the thread.
  Recorder(runtime::FleetSnapshot& snapshot, std::unique_ptr<run::RunLog> log,
           const runtime::Instant& start, std::uint64_t checkpoint_every_steps,
           bool keep_all_journals);
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Of the newest snapshot.
  StateHash newest_hash() const;

  /// After the tick has ended: everything that is left, and a last checkpoint. False when that could not
  /// be written; it was said why.
  bool finish(const runtime::Fleet& fleet, const runtime::Instant& at);

 private:
  void work();
  void keep_up();
  void take_snapshot();
  void stop_thread();

  runtime::FleetSnapshot& snapshot_;
  std::unique_ptr<run::RunLog> log_;
  std::uint64_t checkpoint_every_steps_;
  runtime::Instant next_checkpoint_;
  bool keep_all_journals_;
  bool failing_ = false;
  bool unsynced_ = false;
  bool owes_checkpoint_ = false;
  mutable std::mutex mutex_;  ///< of the three below; the tick never comes near it
  std::condition_variable ended_;
  bool ending_ = false;
  StateHash newest_;
  std::thread thread_;
};

}  // namespace adstar::adstard
