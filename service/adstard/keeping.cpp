#include "service/adstard/keeping.hpp"

#include <algorithm>
#include <cerrno>
#include <sys/random.h>
#include <system_error>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "service/adstard/scene_text.hpp"
#include "service/run/resume.hpp"

namespace adstar::adstard {
namespace {

std::uint64_t random_word() {
  std::uint64_t word = 0;
  if (getrandom(&word, sizeof word, 0) != sizeof word) {
    throw std::system_error(errno, std::generic_category(), "getrandom");
  }
  return word;
}

}  // namespace

Plan make_plan(Options options) {
  Plan plan;
  if (options.resume.empty()) {
    plan.file = options.scene_file;
    plan.text = read_text(plan.file);
  } else {
    plan.run = run::RunDirectory::open(options.resume, run::RunDirectory::Use::fly);
    const run::RunFacts& facts = plan.run->facts();
    plan.file = facts.scene_file.string();
    plan.text = facts.scene_text;
    options.service = options.service.empty() ? facts.service : options.service;
    options.duration = options.duration.empty() ? facts.duration : options.duration;
  }
  plan.scene = scene::parse(plan.text, plan.file);
  apply(options, plan.scene);
  return plan;
}

void begin_run(Plan& plan, const Options& options) {
  const std::string directory = options.run.empty() ? plan.scene.run.directory : options.run;
  if (options.standby && !plan.scene.standby) {
    throw run::RunError(
        fmt::format("--standby: {} has no [standby]; add one, for both daemons", plan.file));
  }
  if (plan.scene.standby && !plan.run && directory.empty()) {
    throw run::RunError(
        "a scene with [standby] needs a run on disk, from which a standby gets its state; add "
        "--run "
        "DIRECTORY");
  }
  if (!plan.run && !directory.empty()) {
    plan.run = run::RunDirectory::create(
        directory, {random_word(), plan.text, plan.file, options.service, options.duration,
                    options.standby, std::filesystem::absolute(options.memory)});
  }
}

Keeping::Keeping(Plan& plan, const Options& options, runtime::Tick& tick,
                 runtime::MappedSegment& segment, const run::Checkpoint* state)
    : plan_(plan) {
  const scene::Scene& scene = plan.scene;
  std::unique_ptr<run::RunLog> log;
  run::Flight flight{tick.gate(), tick.controls(), &tick.fleet(), scene.simulation.step_ns, {}};
  if (plan.run) {
    const std::uint64_t fingerprint = run::scene_fingerprint(scene, plan.text);
    if (!options.resume.empty()) {
      go_on(plan, options.accept_loss, fingerprint, flight, segment->verdicts);
    } else if (state != nullptr) {
      begin_at(plan, fingerprint, *state, flight);
    }
    tick.go_on_from(flight.at);
    if (!hot_) {
      run::HotJournalFile::remove(plan.run->facts());  // it is not gone on with
      plan.run->move_memory_to(std::filesystem::absolute(options.memory));
      hot_ = run::HotJournalFile::create(plan.run->facts());
    }
    log = std::make_unique<run::RunLog>(*plan.run, scene, fingerprint, **hot_, flight, next_number_,
                                        last_in_files_, !begins_with_checkpoint_);
    if (begins_with_checkpoint_ || scene.standby) {
      log->write_checkpoint(flight.at, runtime::state_of(tick.fleet()), scene.run.whole_history);
    }
    writer_.emplace(**hot_, next_number_);
    writer_->reached(flight.at.step);
    tick.record_in(&*writer_);
  }
  const std::int64_t every = scene.run.checkpoint_every_ns / scene.simulation.step_ns;
  recorder_ = std::make_unique<Recorder>(
      tick.snapshot(), std::move(log), flight.at,
      static_cast<std::uint64_t>(std::max<std::int64_t>(1, every)), scene.run.whole_history);
}

void Keeping::go_on(const Plan& plan, bool accept_loss, std::uint64_t fingerprint,
                    run::Flight& flight, runtime::VerdictRing& verdicts) {
  if (plan.run->facts().standby && plan.run->checkpoints().empty()) {
    throw run::RunError(fmt::format(
        "{} is a standby's that had no state yet: there is nothing to go on with; go on with the "
        "run of its primary, or begin another standby",
        plan.run->path().string()));
  }
  hot_ = what_was_in_memory(accept_loss);
  const run::Resumed resumed = run::resume(*plan.run, hot_ ? &**hot_ : nullptr, plan.scene,
                                           fingerprint, accept_loss, flight, verdicts);
  for (const std::string& note : resumed.notes) {
    spdlog::warn("{}", note);
  }
  if (!resumed.records.gap.empty()) {
    hot_.reset();  // it may hold what comes after the gap
    begins_with_checkpoint_ = true;
  }
  plan.run->forget_good_end();
  next_number_ = resumed.records.next_number;
  last_in_files_ = resumed.records.last_in_files;
  spdlog::info("the run goes on at step {}: checkpoint of step {}, {} commands since",
               flight.at.step, resumed.checkpoint.step, resumed.records.heard.size());
}

std::optional<run::HotJournalFile> Keeping::what_was_in_memory(bool accept_loss) const {
  try {
    std::optional<run::HotJournalFile> hot = run::HotJournalFile::open(plan_.run->facts());
    if (!hot && !plan_.run->ended_well()) {
      spdlog::warn(
          "what the run had in memory is gone (the machine was started anew?): beats and commands "
          "since the last sync are lost, and nothing before");
    }
    return hot;
  } catch (const run::RunError& error) {
    if (!accept_loss) {
      throw run::RunError(fmt::format(
          "{}; go on with the version that flew it. --accept-loss goes on without", error.what()));
    }
    spdlog::warn("{}; the run goes on without", error.what());
    return std::nullopt;
  }
}

void Keeping::begin_at(const Plan& plan, std::uint64_t fingerprint, const run::Checkpoint& state,
                       run::Flight& flight) {
  if (state.fingerprint != fingerprint) {
    throw run::RunError(fmt::format(
        "the primary flies another scene than {}: give both daemons the same files", plan.file));
  }
  if (!set_to(flight, state)) {
    throw run::RunError("the primary's state does not fit the scene that it names");
  }
  next_number_ = state.next_number;
  last_in_files_ = next_number_ - 1;
  begins_with_checkpoint_ = true;
  spdlog::info("follows from step {}", flight.at.step);
}

void Keeping::finish(const runtime::Tick& tick) {
  const runtime::Instant at{tick.report().run.load(std::memory_order_relaxed),
                            tick.report().step.load(std::memory_order_relaxed)};
  if (recorder_->finish(tick.fleet(), at) && hot_) {
    try {
      plan_.run->note_good_end();
    } catch (const run::RunError& error) {
      spdlog::warn("{}; the next start will say that memory is gone, which it is not",
                   error.what());
    }
    run::HotJournalFile::remove(plan_.run->facts());
  }
}

}  // namespace adstar::adstard
