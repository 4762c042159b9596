#include "service/adstar/recording_input.hpp"

#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "service/adstar/failure.hpp"
#include "service/adstar/progress_bar.hpp"
#include "service/adstar/stop_signal.hpp"
#include "service/bag/sqlite.hpp"
#include "service/report/numbers.hpp"
#include "service/samples/recorded_topics.hpp"

namespace adstar::cli {

void add_recording(CLI::App& verb, std::string& directory) {
  verb.add_option("recording", directory, "Directory that `adstar record` made")
      ->type_name("DIR")
      ->required();
}

namespace {

/// A bar for each pass over it; Ctrl-C ends the work.
void show_progress(bag::Recording& recording) {
  static constexpr std::uint64_t kWhole = 1'000'000;
  catch_stop_signals();
  const auto bar = std::make_shared<std::optional<ProgressBar>>();
  recording.watch([bar](double part) {
    if (stop_requested()) {
      throw Failure(kFailed, "interrupted; no output file was written");
    }
    if (part == 0) {
      bar->emplace(kWhole);
    } else if (part == 1) {
      bar->reset();
    } else {
      (*bar)->show(static_cast<std::uint64_t>(part * kWhole));
    }
  });
}

}  // namespace

bag::Recording open_recording(const std::string& directory, const char* verb) {
  try {
    bag::Recording recording(directory);
    switch (recording.ending()) {
      case bag::Recording::Ending::ended:
        break;
      case bag::Recording::Ending::still_recorded:
        fmt::print(stderr,
                   "adstar {}: '{}' is still being recorded; this is what was committed so far\n",
                   verb, directory);
        break;
      case bag::Recording::Ending::incomplete:
        fmt::print(stderr, "adstar {}: {}\n", verb, recording.lost());
        break;
      case bag::Recording::Ending::cut_off:
        fmt::print(stderr,
                   "adstar {}: '{}' was not ended: was its recorder killed? metadata.yaml {}\n",
                   verb, directory,
                   recording.mend() ? "was made from its files"
                                    : "cannot be written there, which does not matter here");
        break;
    }
    show_progress(recording);
    return recording;
  } catch (const bag::Error& error) {
    throw Failure(kUsage, error.what());
  }
}

std::string why_absent(const bag::Recording& recording) {
  return recording.lost().empty() ? "was it left out by --topic?"
                                  : "is it in what the recording has lost?";
}

void require_motion(const bag::Recording& recording) {
  bool has_fleet = false;
  for (const bag::TopicCount& count : recording.count().topics) {
    const std::string& name = count.topic.name;
    if (count.messages == 0) {
      continue;
    }
    if (name == samples::recorded_name<adstar_AttitudeState>() ||
        name == samples::recorded_name<adstar_MomentumState>()) {
      return;
    }
    has_fleet = has_fleet || name == samples::recorded_name<adstar_FleetState>();
  }
  throw Failure(kUsage,
                has_fleet ? "there is no attitude_state or momentum_state in the recording, only "
                            "fleet_state: try `adstar export --to csv --topic fleet_state`; "
                            "spacecraft that the scene names in [telemetry] spacecraft have topics "
                            "of their own"
                          : "there is no attitude_state or momentum_state in the recording; " +
                                why_absent(recording));
}

void say_unreadable(std::uint64_t count, const char* verb) {
  if (count > 0) {
    fmt::print(stderr,
               "adstar {}: {} samples are not of the types that this program knows, and were left "
               "out; was it recorded with another version?\n",
               verb, report::counted(count));
  }
}

}  // namespace adstar::cli
