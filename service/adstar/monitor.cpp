// adstar monitor: telemetry as it comes, a live table on a terminal, lines in a pipe.

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <limits>
#include <memory>
#include <thread>
#include <unistd.h>

#include <fmt/format.h>

#include "service/adstar/dds_options.hpp"
#include "service/adstar/failure.hpp"
#include "service/adstar/live_table.hpp"
#include "service/adstar/output.hpp"
#include "service/adstar/service_state.hpp"
#include "service/adstar/stop_signal.hpp"
#include "service/adstar/telemetry_feed.hpp"
#include "service/adstar/usage.hpp"
#include "service/adstar/verbs.hpp"
#include "service/scene/nearest.hpp"
#include "service/scene/scene.hpp"

namespace adstar::cli {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

struct Options {
  std::vector<std::string> spacecraft;
  std::string format;  ///< empty: a table on a terminal, else CSV
  std::optional<std::int64_t> for_ns, timeout_ns;
  std::optional<std::uint64_t> samples;
  dds::ParticipantOptions place;
};

/// When to stop, and what to say meanwhile.
class Watch {
 public:
  explicit Watch(const Options& options) : options_(options) {}

  void count(std::size_t rows) { rows_ += rows; }
  bool heard() const { return rows_ > 0; }
  std::uint64_t still_wanted() const {
    return options_.samples ? *options_.samples - std::min(rows_, *options_.samples)
                            : ~std::uint64_t{0};
  }
  bool over() const { return stop_requested() || still_wanted() == 0 || passed(options_.for_ns); }
  /// Throws Failure when nothing came in the time that the user gives it.
  void check_timeout() const {
    if (rows_ == 0 && passed(options_.timeout_ns)) {
      throw Failure(kNoAnswer, fmt::format("nothing came within {} on {}; see `adstar list`",
                                           scene::format_duration(*options_.timeout_ns),
                                           place_of(options_.place)));
    }
  }
  /// Once, after two silent seconds; else empty.
  std::string complaint(const TelemetryFeed& feed) {
    if (rows_ > 0 || said_ || Clock::now() - begun_ < 2s) {
      return {};
    }
    said_ = true;
    if (!feed.heard()) {
      return fmt::format(
          "no daemon heard on {}; waiting. Is adstard running, and are domain, interface and "
          "partition those of its scene?",
          place_of(options_.place));
    }
    return fmt::format("daemons are there, but no telemetry of {}; waiting.{}",
                       options_.spacecraft.empty() ? "any spacecraft" : named(), suggestion(feed));
  }

 private:
  bool passed(const std::optional<std::int64_t>& ns) const {
    return ns && Clock::now() - begun_ >= std::chrono::nanoseconds(*ns);
  }
  std::string named() const {
    return scene::joined(
        std::vector<std::string_view>(options_.spacecraft.begin(), options_.spacecraft.end()));
  }
  std::string suggestion(const TelemetryFeed& feed) const {
    std::vector<std::string_view> known;
    for (const ListedService* service : feed.services().all()) {
      for (const auto& [first, members] : service->chunks) {
        for (const ListedSpacecraft& spacecraft : members) {
          known.push_back(spacecraft.name);
        }
      }
    }
    for (const std::string& name : options_.spacecraft) {
      const auto near = scene::nearest_plausible(name, known);
      if (near && *near != name) {
        return fmt::format(" Did you mean '{}'?", *near);
      }
    }
    return " Are its rates 0 in the scene's [telemetry]? See `adstar list`.";
  }

  const Options& options_;
  Clock::time_point begun_ = Clock::now();
  std::uint64_t rows_ = 0;
  bool said_ = false;
};

void print_lines(TelemetryFeed& feed, Watch& watch, bool json) {
  Output output = Output::to_stdout();
  const auto print = [&](std::vector<report::Row> rows) {
    rows.resize(std::min<std::uint64_t>(rows.size(), watch.still_wanted()));
    for (const report::Row& row : rows) {
      json ? report::append_json(output.buffer(), row) : report::append_csv(output.buffer(), row);
      output.flush_if_full();
    }
    watch.count(rows.size());
    output.flush();
  };
  if (!json) {
    report::append_csv_header(output.buffer());
    output.flush();
  }
  while (!watch.over()) {
    print(feed.next(50ms));
    watch.check_timeout();
    if (const std::string complaint = watch.complaint(feed); !complaint.empty()) {
      fmt::print(stderr, "adstar monitor: {}\n", complaint);
    }
  }
  print(feed.rest());
}

void draw_table(TelemetryFeed& feed, Watch& watch, const dds::ParticipantOptions& place) {
  constexpr auto kFrameTime = 100ms;
  LiveTable table("adstar monitor on " + place_of(place));
  Screen screen;
  auto next_frame = Clock::now();
  while (!watch.over()) {
    const std::vector<report::Row> rows = feed.next(50ms);
    const auto now = Clock::now();
    for (const report::Row& row : rows) {
      table.update(row, now);
    }
    watch.count(rows.size());
    watch.check_timeout();
    if (const std::string complaint = watch.complaint(feed); !complaint.empty()) {
      table.set_note(complaint);
    } else if (watch.heard()) {
      table.set_note(standing_clocks(feed.services()));
    }
    if (now >= next_frame) {
      screen.draw(table.text(Screen::size(), now));
      next_frame = now + kFrameTime;
    }
    std::this_thread::sleep_until(std::min(next_frame, now + 20ms));
  }
  screen.draw(table.text(Screen::size(), Clock::now()));
}

int monitor(const Options& options) {
  log_to_stderr("monitor");
  catch_stop_signals();
  const dds::Participant participant(options.place);
  TelemetryFeed feed(participant, {options.spacecraft.begin(), options.spacecraft.end()});
  Watch watch(options);
  if (options.format.empty() && isatty(STDOUT_FILENO) == 1) {
    draw_table(feed, watch, options.place);
  } else {
    print_lines(feed, watch, options.format == "json");
  }
  return kDone;
}

}  // namespace

Verb add_monitor(CLI::App& program) {
  const auto options = std::make_shared<Options>();
  CLI::App* verb = program.add_subcommand(
      "monitor", "Show telemetry: a live table on a terminal, lines in a pipe");
  verb->add_option("spacecraft", options->spacecraft, "Which spacecraft (default: all)")
      ->type_name("SPACECRAFT");
  verb->add_option("--format", options->format, "Lines instead of a table (default in a pipe: csv)")
      ->type_name("csv|json")
      ->check(CLI::Validator(
          [](std::string& format) {
            return format == "csv" || format == "json"
                       ? std::string()
                       : fmt::format("got '{}', expected csv or json; try csv", format);
          },
          ""));
  add_duration(*verb, "--for", options->for_ns, "Stop after that long, on the wall clock");
  verb->add_option("--samples", options->samples, "Stop after that many lines")
      ->type_name("N")
      ->check(whole_number(1, std::numeric_limits<std::uint64_t>::max()));
  add_duration(*verb, "--timeout", options->timeout_ns,
               "Give up when nothing came for that long (default: wait)");
  add_dds_options(*verb, options->place);
  verb->footer(
      "Exit code: 4 when nothing came within --timeout; Ctrl-C ends it with 0.\n"
      "Example:\n"
      "  adstar monitor sat1 --format json --for 10s");
  return {verb, [options] { return monitor(*options); }};
}

}  // namespace adstar::cli
