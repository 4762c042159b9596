// adstar timing: how a daemon keeps its beat, live on a terminal, a block or a line a second in a pipe.

#include <algorithm>
#include <chrono>
#include <limits>
#include <map>
#include <memory>
#include <unistd.h>

#include <fmt/format.h>

#include "service/adstar/dds_options.hpp"
#include "service/adstar/failure.hpp"
#include "service/adstar/live_table.hpp"
#include "service/adstar/output.hpp"
#include "service/adstar/stop_signal.hpp"
#include "service/adstar/timing_text.hpp"
#include "service/adstar/usage.hpp"
#include "service/adstar/verbs.hpp"
#include "service/dds/convert.hpp"
#include "service/dds/reader.hpp"
#include "service/dds/wait_set.hpp"
#include "service/scene/scene.hpp"

namespace adstar::cli {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

struct Options {
  std::string service;  ///< empty: all
  bool json = false;
  std::optional<std::int64_t> for_ns, timeout_ns;
  std::optional<std::uint64_t> samples;
  dds::ParticipantOptions place;
};

constexpr std::int64_t kDefaultTimeout_ns = 3'000'000'000;

/// Where the blocks go: in place on a terminal, one after the other elsewhere.
class Display {
 public:
  explicit Display(bool json) : json_(json) {
    if (!json && isatty(STDOUT_FILENO) == 1) {
      screen_ = std::make_unique<Screen>();
    }
  }
  void show(const adstar_StepTiming& timing) {
    if (screen_ == nullptr) {
      output_.buffer() += json_ ? timing_json(timing) : timing_table(timing);
      output_.flush();
      return;
    }
    latest_[std::string(dds::text_of(timing.service))] = timing;
    std::string text;
    for (const auto& [name, last] : latest_) {
      text += timing_table(last);
    }
    screen_->draw(text);
  }

 private:
  bool json_;
  Output output_ = Output::to_stdout();
  std::unique_ptr<Screen> screen_;  ///< null in a pipe
  std::map<std::string, adstar_StepTiming> latest_;
};

int timing(const Options& options) {
  log_to_stderr("timing");
  catch_stop_signals();
  const dds::Participant participant(options.place);
  dds::Reader<adstar_StepTiming> reader(participant);
  dds::WaitSet wait_set(participant);
  wait_set.attach(reader);
  Display display(options.json);
  const std::int64_t timeout_ns = options.timeout_ns.value_or(kDefaultTimeout_ns);
  const auto begun = Clock::now();
  const auto passed = [&](std::int64_t ns) {
    return Clock::now() - begun >= std::chrono::nanoseconds(ns);
  };
  std::uint64_t heard = 0;
  while (!stop_requested() && heard < options.samples.value_or(~std::uint64_t{0}) &&
         !(options.for_ns && passed(*options.for_ns))) {
    wait_set.wait(50ms);
    reader.take([&](const adstar_StepTiming& sample, const dds_sample_info_t&) {
      if (options.service.empty() || dds::text_of(sample.service) == options.service) {
        display.show(sample);
        ++heard;
      }
    });
    if (heard == 0 && passed(timeout_ns)) {
      throw Failure(kNoAnswer,
                    fmt::format("no timing of {} within {} on {}; see `adstar list`",
                                options.service.empty() ? "any service" : options.service,
                                scene::format_duration(timeout_ns), place_of(options.place)));
    }
  }
  return kDone;
}

}  // namespace

Verb add_timing(CLI::App& program) {
  const auto options = std::make_shared<Options>();
  CLI::App* verb = program.add_subcommand(
      "timing", "How a daemon keeps its beat: each part against its budget, once a second");
  add_name(*verb, "service", options->service, "Which daemon (default: all)");
  verb->add_flag("--json", options->json, "A line of JSON a second, durations in nanoseconds");
  add_duration(*verb, "--for", options->for_ns, "Stop after that long, on the wall clock");
  verb->add_option("--samples", options->samples, "Stop after that many")
      ->type_name("N")
      ->check(whole_number(1, std::numeric_limits<std::uint64_t>::max()));
  add_duration(*verb, "--timeout", options->timeout_ns,
               "Give up when nothing came for that long (default: 3s)");
  add_dds_options(*verb, options->place);
  verb->footer(
      "Exit code: 4 when nothing came within --timeout; Ctrl-C ends it with 0.\n"
      "Example:\n"
      "  adstar timing --samples 1");
  return {verb, [options] { return timing(*options); }};
}

}  // namespace adstar::cli
