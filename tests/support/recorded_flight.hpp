#pragma once
// A run that is recorded, without a tick and without threads: beats, the recorder's moves and the end
// come when the test says so. Dropped without finish(), it is a process that was killed.

#include <memory>
#include <optional>
#include <random>
#include <vector>

#include "service/run/hot_journal_file.hpp"
#include "service/run/resume.hpp"
#include "service/run/run_directory.hpp"
#include "service/run/run_log.hpp"
#include "service/runtime/fleet_snapshot.hpp"
#include "service/runtime/step_digests.hpp"
#include "tests/support/gate_harness.hpp"
#include "tests/support/linked_craft.hpp"
#include "tests/support/random_motion.hpp"

namespace adstar::test {

inline scene::Scene recorded_scene() {
  scene::Scene scene;
  scene.simulation.step_ns = 10 * kMs;
  scene.spacecraft = {make_craft(2, Frame::inertial), with_wheels(make_craft(1, Frame::body)),
                      in_space(make_craft(0)), linked_craft()};
  return scene;
}

/// A few commanders, every beat from 0 to 3 commands: of now, of later, late, repeated, not finite.
/// A function of seed and beat.
inline std::vector<runtime::CommandRecord> commands_of_beat(std::uint64_t seed,
                                                            std::uint64_t beat) {
  Generator random(seed * 1'000'003 + beat);
  const auto between = [&](std::int64_t low, std::int64_t high) {
    return std::uniform_int_distribution<std::int64_t>(low, high)(random);
  };
  const std::int64_t now = static_cast<std::int64_t>(beat) * 10 * kMs;
  std::vector<runtime::CommandRecord> commands;
  for (std::int64_t left = between(0, 3); left > 0; --left) {
    runtime::CommandRecord command;
    command.commander = {seed, static_cast<std::uint64_t>(between(1, 3))};
    command.sequence = beat + 1 - static_cast<std::uint64_t>(between(0, 1));
    command.spacecraft = static_cast<std::uint32_t>(between(0, 3));
    command.actuator = static_cast<std::uint32_t>(between(0, 1));
    const bool wheel = command.spacecraft == 1 && command.actuator == 1;
    command.priority = static_cast<std::int32_t>(between(0, 8) / 4);
    command.start_ns = now + between(-20, 300) * kMs / 2;
    command.end_ns = command.start_ns + between(1, 100) * kMs;
    command.value = {1e-3 * static_cast<double>(between(-9, 9)), 2e-3,
                     between(0, 30) == 0 ? std::nan("") : 1e-3};
    if (wheel) {
      command.quantity = static_cast<runtime::Quantity>(between(0, 1));
      command.value = {command.quantity == runtime::Quantity::wheel_speed ? 10.0 : 0.05, 0, 0};
    }
    if (command.spacecraft == 2) {
      const bool jet = command.actuator == 1;
      command.quantity = jet ? runtime::Quantity::thrust : runtime::Quantity::dipole;
      command.value = {jet ? 1.0 : 0.1 * static_cast<double>(between(-99, 99)), 0, 0};
    }
    if (command.spacecraft == 3) {
      command.actuator = 0;
      command.value = {0.1 * static_cast<double>(between(-9, 9)), 0, 0};
    }
    commands.push_back(command);
  }
  return commands;
}

class RecordedFlight {
 public:
  /// Without a record: what it is compared with.
  explicit RecordedFlight(std::uint64_t seed) : seed_(seed) { fleet_.keep_start(); }

  /// Begins a run there.
  RecordedFlight(std::uint64_t seed, const std::filesystem::path& path, std::uint64_t run)
      : seed_(seed) {
    fleet_.keep_start();
    directory_.emplace(run::RunDirectory::create(path, {run, "text", "scene.toml", "", ""}));
    hot_.emplace(run::HotJournalFile::create(directory_->facts()));
    start_log(1, 0);
  }

  /// Goes on with it. `accept_loss` as in resume().
  RecordedFlight(std::uint64_t seed, const std::filesystem::path& path, bool accept_loss = false)
      : seed_(seed) {
    fleet_.keep_start();
    directory_.emplace(run::RunDirectory::open(path, run::RunDirectory::Use::fly));
    hot_ = run::HotJournalFile::open(directory_->facts());
    run::Flight flight{gate_, controls_, &fleet_, scene_.simulation.step_ns, {}};
    resumed =
        run::resume(*directory_, hot_ ? &**hot_ : nullptr, scene_, 7, accept_loss, flight, *ring_);
    at_ = flight.at;
    if (!hot_ || !resumed.records.gap.empty()) {
      hot_.reset();
      hot_.emplace(run::HotJournalFile::create(directory_->facts()));
      (*hot_)->step.store(at_.step);
    }
    start_log(resumed.records.next_number, resumed.records.last_in_files);
    if (!resumed.records.gap.empty()) {
      log_->write_checkpoint(at_, state(), false);
    }
  }

  /// The commands of the present beat, the first `most` of them.
  void hear(std::size_t most = 1000) {
    std::size_t heard = 0;
    for (const runtime::CommandRecord& command : commands_of_beat(seed_, at_.step)) {
      if (heard++ < most) {
        gate_.receive(command, now());
      }
    }
  }
  /// As Tick does it.
  void control(const runtime::ControlRecord& record) {
    if (controls_.repeated(record, runtime::blank_answer(record))) {
      return;
    }
    const runtime::ControlAnswerRecord answer = runtime::apply_control(record, fleet_);
    const bool reset = record.action == runtime::ControlAction::reset;
    if (writer_) {
      if (reset) {
        writer_->reached(0);
      }
      writer_->write(runtime::JournalKind::control, at_.step,
                     static_cast<std::uint32_t>(answer.refusal), record);
    }
    if (reset && answer.refusal == runtime::ControlRefusal::none) {
      gate_.reset(now());
      at_ = {at_.resets + 1, 0};
    }
    controls_.conclude(answer);
  }
  void compute() {
    gate_.begin_step(now(), fleet_);
    fleet_.step(now().t_ns, now().h_ns);
    ring_->skip_all();
  }
  void conclude() {
    ++at_.step;
    if (writer_) {
      writer_->reached(at_.step);
      digests_.add(fleet_.vehicles(), at_);
    }
  }
  void beat() {
    hear();
    compute();
    conclude();
  }
  void run_to(std::uint64_t step) {
    while (at_.step < step) {
      beat();
    }
  }

  /// From now on every step leaves a digest in the journal.
  void digest_every_step() { digests_.write_to(&*writer_); }
  void end_digests() { digests_.flush(); }

  void checkpoint(bool keep_all_journals = false) {
    log_->move_records();
    log_->note_hash(at_, hash());
    log_->write_checkpoint(at_, state(), keep_all_journals);
  }

  runtime::FleetState state() const { return runtime::state_of(fleet_); }
  std::uint64_t hash() const { return run::state_hash(at_.step, state()); }
  std::vector<std::uint64_t> schedule() const { return gate_.save(); }
  std::uint64_t step() const { return at_.step; }
  const runtime::Instant& at() const { return at_; }
  run::RunLog& log() { return *log_; }
  runtime::HotJournal& hot() { return **hot_; }
  runtime::VerdictRing& verdicts() { return *ring_; }
  runtime::CommandGate& gate() { return gate_; }
  runtime::Beat now() const {
    return {at_.step, static_cast<std::int64_t>(at_.step) * 10 * kMs, 10 * kMs};
  }
  run::Resumed resumed;

 private:
  void start_log(std::uint64_t next_number, std::uint64_t last_in_files) {
    const run::Flight flight{gate_, controls_, &fleet_, scene_.simulation.step_ns, at_};
    log_ = std::make_unique<run::RunLog>(*directory_, scene_, 7, **hot_, flight, next_number,
                                         last_in_files, resumed.records.gap.empty());
    writer_.emplace(**hot_, next_number);
    gate_.record_in(&*writer_);
  }

  std::uint64_t seed_;
  scene::Scene scene_ = recorded_scene();
  std::unique_ptr<runtime::VerdictRing> ring_ = std::make_unique<runtime::VerdictRing>();
  runtime::Fleet fleet_{scene_.spacecraft, "coadjoint_rk4", StepLimits{}};
  runtime::CommandGate gate_{scene_.spacecraft, *ring_};
  std::unique_ptr<runtime::ControlAnswerRing> answers_ =
      std::make_unique<runtime::ControlAnswerRing>();
  runtime::ControlMemory controls_{*answers_};
  runtime::Instant at_;
  std::optional<run::RunDirectory> directory_;
  std::optional<run::HotJournalFile> hot_;
  std::optional<runtime::JournalWriter> writer_;
  runtime::StepDigests digests_;
  std::unique_ptr<run::RunLog> log_;
};

}  // namespace adstar::test
