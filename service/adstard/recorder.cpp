#include "service/adstard/recorder.hpp"

#include <chrono>
#include <vector>

#include <spdlog/spdlog.h>

#include "service/run/checkpoint.hpp"

namespace adstar::adstard {
namespace {

constexpr std::chrono::milliseconds kLook{20};

}  // namespace

Recorder::Recorder(runtime::FleetSnapshot& snapshot, std::unique_ptr<run::RunLog> log,
                   const runtime::Instant& start, std::uint64_t checkpoint_every_steps,
                   bool keep_all_journals)
    : snapshot_(snapshot),
      log_(std::move(log)),
      checkpoint_every_steps_(checkpoint_every_steps),
      next_checkpoint_{start.resets, start.step + checkpoint_every_steps},
      keep_all_journals_(keep_all_journals),
      thread_([this] { work(); }) {}

Recorder::~Recorder() { stop_thread(); }

void Recorder::stop_thread() {
  if (thread_.joinable()) {
    {
      const std::lock_guard lock(mutex_);
      ending_ = true;
    }
    ended_.notify_one();
    thread_.join();
  }
}

StateHash Recorder::newest_hash() const {
  const std::lock_guard lock(mutex_);
  return newest_;
}

void Recorder::work() {
  std::unique_lock lock(mutex_);
  while (!ended_.wait_for(lock, kLook, [this] { return ending_; })) {
    lock.unlock();
    keep_up();
    lock.lock();
  }
}

/// What fails is tried again at the next look: until it succeeds the tick's part stays in memory.
void Recorder::keep_up() {
  try {
    if (log_ != nullptr) {
      if (unsynced_) {
        log_->sync();
      }
      unsynced_ = log_->move_records();
    }
    if (snapshot_.ready()) {
      take_snapshot();
    }
    if (failing_ && !owes_checkpoint_) {
      failing_ = false;
      spdlog::info("the run is recorded again; nothing was lost");
    }
  } catch (const std::exception& error) {
    if (!failing_) {
      failing_ = true;
      spdlog::error(
          "the run cannot be recorded: {}; the tick goes on, commands are refused once {} of them "
          "wait to be written",
          error.what(), runtime::HotJournal::Ring::kCapacity);
    }
  }
}

void Recorder::take_snapshot() {
  const runtime::Instant at = snapshot_.at();
  const runtime::FleetState state = snapshot_.state();
  snapshot_.done();
  const std::uint64_t hash = run::state_hash(at.step, state);
  {
    const std::lock_guard lock(mutex_);
    newest_ = {hash, at.step};
  }
  if (log_ == nullptr) {
    return;
  }
  log_->move_records();
  log_->note_hash(at, hash);
  unsynced_ = true;
  if (at >= next_checkpoint_) {
    owes_checkpoint_ = true;  // the next snapshot is in time for it
    log_->write_checkpoint(at, state, keep_all_journals_);
    owes_checkpoint_ = false;
    next_checkpoint_ = {at.resets, at.step + checkpoint_every_steps_};
  }
}

bool Recorder::finish(const runtime::Fleet& fleet, const runtime::Instant& at) {
  stop_thread();
  keep_up();  // what came since its last look
  const runtime::FleetState state = runtime::state_of(fleet);
  const std::uint64_t hash = run::state_hash(at.step, state);
  newest_ = {hash, at.step};
  if (log_ == nullptr) {
    return true;
  }
  try {
    log_->move_records();
    log_->note_hash(at, hash);
    log_->write_checkpoint(at, state, keep_all_journals_);
    return true;
  } catch (const std::exception& error) {
    spdlog::error(
        "the end of the run cannot be recorded: {}; its last part is still in memory, go on "
        "with --resume once there is room",
        error.what());
    return false;
  }
}

}  // namespace adstar::adstard
