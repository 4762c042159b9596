// adstar replay: fly a recorded run again, and say whether the bits are the same.

#include <memory>

#include <fmt/format.h>

#include "service/adstar/failure.hpp"
#include "service/adstar/output.hpp"
#include "service/adstar/progress_bar.hpp"
#include "service/adstar/reflight_text.hpp"
#include "service/adstar/stop_signal.hpp"
#include "service/adstar/usage.hpp"
#include "service/adstar/verbs.hpp"
#include "service/run/refly.hpp"

namespace adstar::cli {
namespace {

int replay(const std::string& directory) {
  try {
    const auto recorded = run::RunDirectory::open(directory, run::RunDirectory::Use::look);
    const run::RunFacts& facts = recorded.facts();
    const scene::Scene scene = scene::parse(facts.scene_text, facts.scene_file);
    catch_stop_signals();
    constexpr std::uint64_t kWhole = 1000;
    ProgressBar progress(kWhole);
    const run::Reflight flight = run::refly(
        recorded, scene, run::scene_fingerprint(scene, facts.scene_text), [&](double share) {
          progress.show(static_cast<std::uint64_t>(share * kWhole));
          return !stop_requested();
        });
    for (const std::string& note : flight.notes) {
      fmt::print(stderr, "adstar replay: {}\n", note);
    }
    Output output = Output::to_stdout();
    output.buffer() = reflight_text(flight);
    output.flush();
    if (flight.differs_at || stop_requested()) {
      return kFailed;
    }
    return flight.hashes + flight.checkpoints == 0 ? kNoAnswer : kDone;
  } catch (const run::RunError& error) {
    throw Failure(kUsage, error.what());
  }
}

}  // namespace

Verb add_replay(CLI::App& program) {
  const auto directory = std::make_shared<std::string>();
  CLI::App* verb =
      program.add_subcommand("replay", "Fly a recorded run again and compare: same bits?");
  verb->add_option("RUN", *directory, "Directory of the run, as adstard --run was given it")
      ->type_name("FILE")
      ->required();
  verb->footer(
      "Exit code 1 when the bits differ, 4 when there is nothing to compare with.\n"
      "Example:\n  adstar replay runs/monday");
  return {verb, [directory] { return replay(*directory); }};
}

}  // namespace adstar::cli
