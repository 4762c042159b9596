// adstar export: what `adstar record` wrote, as CSV or as a CCSDS Attitude Ephemeris Message.

#include <algorithm>
#include <array>
#include <chrono>
#include <ctime>
#include <memory>
#include <set>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "service/adstar/failure.hpp"
#include "service/adstar/output.hpp"
#include "service/adstar/recorded_runs.hpp"
#include "service/adstar/recording_input.hpp"
#include "service/adstar/services.hpp"
#include "service/adstar/usage.hpp"
#include "service/adstar/verbs.hpp"
#include "service/bag/sqlite.hpp"
#include "service/dds/convert.hpp"
#include "service/report/aem.hpp"
#include "service/samples/recorded_topics.hpp"
#include "service/samples/topic_rows.hpp"
#include "service/scene/nearest.hpp"
#include "service/scene/time_scales.hpp"

namespace adstar::cli {
namespace {

constexpr const char* kVerb = "export";
constexpr std::string_view kMotion = "motion";

struct Options {
  std::string recording, format, output, topic{kMotion};
  std::vector<std::string> spacecraft;
  std::string epoch_utc, frame = "GCRF", object_id = "UNKNOWN", originator = "ADSTAR";
};

/// Says yes to a spacecraft that was asked for, and knows which there were.
class Wanted {
 public:
  explicit Wanted(const std::vector<std::string>& names) : names_(names.begin(), names.end()) {}
  bool operator()(std::string_view spacecraft) {
    if (!seen_.contains(spacecraft)) {
      seen_.emplace(spacecraft);
    }
    return names_.empty() || names_.contains(spacecraft);
  }
  /// Throws Failure when somebody asked for is not in the recording.
  void require_all_seen() const {
    const std::vector<std::string_view> known(seen_.begin(), seen_.end());
    for (const std::string& name : names_) {
      if (!seen_.contains(name)) {
        throw Failure(kUsage, fmt::format("there is no '{}' in the recording; {}", name,
                                          known.empty() ? "it tells of no spacecraft"
                                                        : "there are " + scene::joined(known)));
      }
    }
  }
  const std::set<std::string, std::less<>>& seen() const { return seen_; }

 private:
  std::set<std::string, std::less<>> names_, seen_;
};

const samples::Table& table_of(const std::string& topic) {
  std::vector<std::string_view> known;
  for (const samples::Table& table : samples::tables()) {
    if (table.name == topic) {
      return table;
    }
    known.push_back(table.name);
  }
  throw Failure(kUsage, fmt::format("--topic: got '{}', expected one of {}; try {}", topic,
                                    scene::joined(known),
                                    scene::nearest_plausible(topic, known).value_or(kMotion)));
}

void export_table(const bag::Recording& recording, const samples::Table& table, Wanted& wanted,
                  Output& output) {
  output.buffer() += table.columns + "\n";
  bool any = false;
  const auto append = [&](const report::Fields& row) {
    any = true;
    report::append_csv(output.buffer(), row);
    output.flush_if_full();
  };
  say_unreadable(samples::for_each_row(recording, table.name, std::ref(wanted), append), kVerb);
  if (!any && table.name == kMotion) {
    require_motion(recording);
  }
}

/// The one asked for, or the only one there is.
std::string only_spacecraft(const bag::Recording& recording, const Runs& runs,
                            const Options& options) {
  if (options.spacecraft.size() > 1) {
    throw Failure(kUsage, "an AEM is about one spacecraft; give one --spacecraft");
  }
  if (runs.empty()) {
    require_motion(recording);
    throw Failure(kUsage, "there is no attitude_state in the recording; " + why_absent(recording));
  }
  Wanted wanted(options.spacecraft);
  for (const auto& [spacecraft, run] : runs) {
    wanted(spacecraft);
  }
  wanted.require_all_seen();
  if (options.spacecraft.empty() && runs.size() > 1) {
    const std::vector<std::string_view> known(wanted.seen().begin(), wanted.seen().end());
    throw Failure(kUsage, fmt::format("an AEM is about one spacecraft, and there are {}; give one "
                                      "--spacecraft",
                                      scene::joined(known)));
  }
  return options.spacecraft.empty() ? runs.begin()->first : options.spacecraft.front();
}

scene::TaiDate epoch_of(const Options& options) {
  constexpr const char* kTry = "try --epoch-utc 2026-01-01T00:00:00Z";
  if (options.epoch_utc.empty()) {
    throw Failure(kUsage,
                  fmt::format("--to aem needs --epoch-utc, the date of simulation time 0 (the "
                              "scene's epoch_utc): recordings do not carry it; {}",
                              kTry));
  }
  const auto date = scene::tai_date(options.epoch_utc, scene::Clock::utc);
  if (!date) {
    throw Failure(
        kUsage,
        fmt::format("--epoch-utc: got '{}', expected a date and time in UTC, of 1972 or later; {}",
                    options.epoch_utc, kTry));
  }
  return *date;
}

void export_aem(const bag::Recording& recording, const Options& options, Output& output) {
  report::AemHeader header;
  header.epoch = epoch_of(options);
  const NewVoices voices = new_voices_in(recording);
  const Runs runs = runs_of<adstar_AttitudeState>(recording, voices);
  header.object_name = only_spacecraft(recording, runs, options);
  header.object_id = options.object_id;
  header.originator = options.originator;
  header.inertial_frame = options.frame;
  header.creation_utc = fmt::format("{:%Y-%m-%dT%H:%M:%S}", fmt::gmtime(std::time(nullptr)));
  const RunSpan run = runs.at(header.object_name).last_run();
  RunReader reader(run);
  try {
    report::AemWriter aem(header, run.first_ns, run.last_ns, output.buffer());
    const auto add = [&](const adstar_AttitudeState& s, std::int64_t /*received_ns*/) {
      if (dds::text_of(s.spacecraft) == header.object_name && reader.takes(s.time_ns)) {
        const adstar_Quaternion& q = s.attitude_body_to_inertial;
        const adstar_Vector3& omega = s.angular_velocity_body_rad_s;
        aem.add({s.time_ns, {q.w, q.x, q.y, q.z}, {omega.x, omega.y, omega.z}});
        output.flush_if_full();
      }
    };
    say_unreadable(samples::for_each_sample<adstar_AttitudeState>(recording, add), kVerb);
    aem.end();
  } catch (const std::invalid_argument& error) {
    throw Failure(kFailed, error.what());
  }
  LeftOut left_out;
  left_out.add(reader);
  say_left_out(left_out, kVerb);
}

/// A value of an AEM is a part of one line: 254 characters of printable ASCII (CCSDS 504.0-B-2, 6.3), not empty (6.8.7).
CLI::Validator aem_value(const char* example) {
  return {[example](std::string& text) {
            constexpr std::size_t kLongest = 200;  // and the keyword before it
            const bool is_ascii =
                std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c <= '~'; });
            const bool is_blank = text.find_first_not_of(' ') == std::string::npos;
            return is_ascii && !is_blank && text.size() <= kLongest
                       ? std::string()
                       : fmt::format(
                             "got '{}', expected 1 to {} characters of printable ASCII; try {}",
                             printable(text), kLongest, example);
          },
          ""};
}

int export_recording(const Options& options) {
  const samples::Table& table = table_of(options.topic);
  if (options.format == "aem") {
    epoch_of(options);  // before the work
    if (options.topic != kMotion) {
      throw Failure(kUsage, "--topic: an AEM is made from attitude_state alone; leave it out");
    }
  }
  if (options.topic == "fleet_state" && !options.spacecraft.empty()) {
    throw Failure(kUsage,
                  "--spacecraft: a row of fleet_state has a spacecraft's index in its scene and no "
                  "name; leave it out, and choose by spacecraft_index");
  }
  const bag::Recording recording = open_recording(options.recording, kVerb);
  Output output = options.output.empty() ? Output::to_stdout() : Output::to_file(options.output);
  Wanted wanted(options.spacecraft);
  try {
    if (options.format == "aem") {
      export_aem(recording, options, output);
    } else {
      export_table(recording, table, wanted, output);
    }
  } catch (const bag::Error& error) {
    throw Failure(kFailed, error.what());
  }
  if (options.format == "csv") {
    wanted.require_all_seen();
  }
  output.commit();
  return kDone;
}

}  // namespace

Verb add_export(CLI::App& program) {
  const auto options = std::make_shared<Options>();
  CLI::App* verb = program.add_subcommand("export", "A recording as CSV or as a CCSDS AEM");
  add_recording(*verb, options->recording);
  verb->add_option("--to", options->format, "Rows, or an Attitude Ephemeris Message 2.0 (KVN)")
      ->type_name("csv|aem")
      ->required()
      ->check(CLI::Validator(
          [](std::string& format) {
            return format == "csv" || format == "aem"
                       ? std::string()
                       : fmt::format("got '{}', expected csv or aem; try csv", format);
          },
          ""));
  verb->add_option("--output", options->output,
                   "Write there, whole or not at all (default: stdout)")
      ->type_name("FILE");
  verb->add_option("--spacecraft", options->spacecraft,
                   "This one, and others given so (default: all; aem: the only one)")
      ->type_name("NAME")
      ->take_all()
      ->allow_extra_args(false);
  std::string topics;
  for (const samples::Table& table : samples::tables()) {
    topics += (topics.empty() ? "" : "|") + table.name;
  }
  verb->add_option("--topic", options->topic,
                   "csv: which rows; motion is attitude and momentum of a step in one")
      ->type_name(topics)
      ->capture_default_str();
  CLI::Option* epoch =
      verb->add_option("--epoch-utc", options->epoch_utc,
                       "aem: the date of simulation time 0, as the scene's epoch_utc")
          ->type_name("DATE");
  CLI::Option* frame =
      verb->add_option("--frame", options->frame, "aem: what I is called (SANA's names of frames)")
          ->type_name("FRAME")
          ->check(aem_value("GCRF"))
          ->capture_default_str();
  CLI::Option* object_id = verb->add_option("--object-id", options->object_id,
                                            "aem: international designator, as 2026-001A")
                               ->type_name("ID")
                               ->check(aem_value("2026-001A"))
                               ->capture_default_str();
  CLI::Option* originator = verb->add_option("--originator", options->originator,
                                             "aem: who made it (SANA's organizations)")
                                ->type_name("NAME")
                                ->check(aem_value("ADSTAR"))
                                ->capture_default_str();
  verb->footer(
      "Example:\n"
      "  adstar export runs/monday --to csv --output monday.csv\n"
      "  adstar export runs/monday --to csv --topic wheel_state --spacecraft sat1\n"
      "  adstar export runs/monday --to aem --epoch-utc 2026-01-01T00:00:00Z --output monday.aem");
  return {verb, [options, of_aem = std::array{epoch, frame, object_id, originator}] {
            for (const CLI::Option* option : of_aem) {
              if (options->format == "csv" && option->count() > 0) {
                throw Failure(kUsage, fmt::format("{}: CSV has no place for it; leave it out, or "
                                                  "give --to aem",
                                                  option->get_name()));
              }
            }
            return export_recording(*options);
          }};
}

}  // namespace adstar::cli
