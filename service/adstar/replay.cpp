// adstar replay: fly a recorded run again, and say whether the bits are the same.

#include <memory>

#include <fmt/format.h>

#include "service/adstar/failure.hpp"
#include "service/adstar/output.hpp"
#include "service/adstar/progress_bar.hpp"
#include "service/adstar/stop_signal.hpp"
#include "service/adstar/usage.hpp"
#include "service/adstar/verbs.hpp"
#include "service/report/numbers.hpp"
#include "service/run/refly.hpp"

namespace adstar::cli {
namespace {

std::string plural(std::uint64_t count, const char* one, const char* many) {
  return report::counted(count) + " " + (count == 1 ? one : many);
}

std::string text_of(const run::Instant& at) {
  return at.resets == 0 ? fmt::format("step {}", at.step)
                        : fmt::format("step {} after reset {}", at.step, at.resets);
}

std::string said_of(const run::Reflight& flight) {
  std::string text = fmt::format("{} to {}, {}, compared at {} and {}\n", text_of(flight.from),
                                 text_of(flight.to), plural(flight.heard, "command", "commands"),
                                 plural(flight.hashes, "state hash", "state hashes"),
                                 plural(flight.checkpoints, "checkpoint", "checkpoints"));
  if (flight.differs_at) {
    text += fmt::format("differs: the same at {}, not at {}{}\n", text_of(flight.same_until),
                        text_of(*flight.differs_at),
                        flight.differs_in.empty() ? "" : ": " + flight.differs_in);
  } else if (flight.hashes + flight.checkpoints == 0) {
    text += "nothing to compare with: the run ended before its first second\n";
  } else {
    text += "same bits\n";
  }
  return text;
}

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
    output.buffer() = said_of(flight);
    output.flush();
    return flight.differs_at || stop_requested() ? kFailed : kDone;
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
      "Exit code 1 when the bits differ.\n"
      "Example:\n  adstar replay runs/monday");
  return {verb, [directory] { return replay(*directory); }};
}

}  // namespace adstar::cli
