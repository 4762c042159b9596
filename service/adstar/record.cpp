// adstar record: every topic as it comes, to a directory that rosbag2 reads.

#include <algorithm>
#include <chrono>
#include <ctime>
#include <list>
#include <memory>
#include <optional>
#include <set>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "service/adstar/dds_options.hpp"
#include "service/adstar/failure.hpp"
#include "service/adstar/stop_signal.hpp"
#include "service/adstar/usage.hpp"
#include "service/adstar/verbs.hpp"
#include "service/bag/recorder.hpp"
#include "service/bag/size.hpp"
#include "service/dds/raw_reader.hpp"
#include "service/dds/wait_set.hpp"
#include "service/report/numbers.hpp"
#include "service/samples/recorded_topics.hpp"
#include "service/scene/nearest.hpp"
#include "service/scene/scene.hpp"

namespace adstar::cli {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

struct Options {
  std::string directory;  ///< empty: named after the time
  std::vector<std::string> topics;
  std::optional<std::int64_t> for_ns, max_duration_ns;
  std::optional<std::uint64_t> max_bytes;
  dds::ParticipantOptions place;
};

std::int64_t now_utc_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

std::string directory_of(const Options& options) {
  return options.directory.empty()
             ? fmt::format("recording_{:%Y_%m_%d-%H_%M_%S}", fmt::gmtime(std::time(nullptr)))
             : options.directory;
}

/// All, or those named: "attitude_state" and "adstar/attitude_state" are the same. Throws Failure.
std::vector<samples::RecordedTopic> chosen_topics(const std::vector<std::string>& named) {
  constexpr std::string_view kPrefix = "adstar/";
  std::vector<samples::RecordedTopic> all = samples::recorded_topics();
  std::set<std::string> wanted;
  for (const std::string& name : named) {
    wanted.insert(name.starts_with(kPrefix) ? name : std::string(kPrefix) + name);
  }
  std::vector<std::string_view> known;
  known.reserve(all.size());
  for (const samples::RecordedTopic& topic : all) {
    known.push_back(std::string_view(topic.name).substr(kPrefix.size()));
  }
  for (const std::string& name : wanted) {
    const std::string_view bare = std::string_view(name).substr(kPrefix.size());
    if (std::find(known.begin(), known.end(), bare) == known.end()) {
      const auto near = scene::nearest_plausible(bare, known);
      throw Failure(kUsage, fmt::format("--topic: there is no topic '{}'; {}", bare,
                                        near ? fmt::format("did you mean '{}'?", *near)
                                             : "expected one of " + scene::joined(known)));
    }
  }
  if (!wanted.empty()) {
    std::erase_if(
        all, [&](const samples::RecordedTopic& topic) { return !wanted.contains(topic.name); });
  }
  return all;
}

/// The readers of all topics that this participant may read; `topics` becomes those.
std::list<dds::RawReader> make_readers(const dds::Participant& participant,
                                       std::vector<samples::RecordedTopic>& topics) {
  std::list<dds::RawReader> readers;
  std::string refused;
  std::erase_if(topics, [&](const samples::RecordedTopic& topic) {
    try {
      readers.emplace_back(participant, *topic.descriptor, topic.name.c_str(), topic.reader);
      return false;
    } catch (const dds::NotAllowed&) {
      refused += (refused.empty() ? "" : ", ") + topic.name;
      return true;
    }
  });
  if (topics.empty()) {
    throw Failure(kRefused,
                  "the permissions of this client allow it none of these topics; see "
                  "deploy/security/README.md");
  }
  if (!refused.empty()) {
    fmt::print(stderr, "adstar record: left out, not permitted to this client: {}\n", refused);
  }
  return readers;
}

class Session {
 public:
  Session(const Options& options, std::string directory)
      : options_(options),
        directory_(std::move(directory)),
        topics_(chosen_topics(options.topics)),
        participant_(options.place),
        readers_(make_readers(participant_, topics_)),
        wait_set_(participant_),
        recorder_(bag::RollingWriter(directory_, infos(topics_),
                                     {options.max_bytes, options.max_duration_ns}),
                  topics_.size(), bag::Recorder::kMostWaiting_bytes) {
    for (const dds::RawReader& reader : readers_) {
      wait_set_.attach(reader);
    }
  }

  void run() {
    fmt::print(
        stderr, "adstar record: {} of {} to '{}'; Ctrl-C ends it\n",
        topics_.size() == 1 ? topics_.front().name : fmt::format("{} topics", topics_.size()),
        place_of(options_.place), directory_);
    const auto begun = Clock::now();
    bool complained = false;
    while (
        !stop_requested() && !recorder_.failed() &&
        !(options_.for_ns && Clock::now() - begun >= std::chrono::nanoseconds(*options_.for_ns))) {
      wait_set_.wait(50ms);
      take();
      if (taken_ == 0 && !complained && Clock::now() - begun > 2s) {
        complained = true;
        fmt::print(
            stderr,
            "adstar record: nothing heard on {} so far; waiting. Is adstard running, and are "
            "domain, interface and partition those of its scene?\n",
            place_of(options_.place));
      }
    }
    take();
  }

  void finish() {
    const bag::Metadata* metadata = nullptr;
    try {
      metadata = &recorder_.finish();
    } catch (const bag::Error& error) {
      throw Failure(kFailed, fmt::format("{}. What was committed until then is in '{}'",
                                         error.what(), directory_));
    }
    fmt::print("{}\n", summary(*metadata));
    say_losses();
  }

 private:
  static std::vector<bag::TopicInfo> infos(const std::vector<samples::RecordedTopic>& topics) {
    std::vector<bag::TopicInfo> list;
    list.reserve(topics.size());
    for (const samples::RecordedTopic& topic : topics) {
      list.push_back(topic.info);
    }
    return list;
  }

  void take() {
    const std::int64_t now_ns = now_utc_ns();
    std::size_t topic = 0;
    for (dds::RawReader& reader : readers_) {
      while (reader.take([&](std::span<const std::byte> payload, const dds_sample_info_t&) {
        recorder_.offer(topic, now_ns, payload);
        ++taken_;
      }) > 0) {}
      ++topic;
    }
  }

  std::string summary(const bag::Metadata& metadata) const {
    const auto told = static_cast<std::size_t>(
        std::count_if(metadata.topics.begin(), metadata.topics.end(),
                      [](const bag::TopicCount& t) { return t.messages > 0; }));
    return fmt::format(
        "recorded {} samples of {} topics in {} s, {} {}, '{}'",
        report::counted(metadata.messages()), told,
        report::seconds_text((metadata.last_ns() - metadata.first_ns()) / 1'000'000 * 1'000'000),
        metadata.files.size(), metadata.files.size() == 1 ? "file" : "files", directory_);
  }

  void say_losses() const {
    const std::vector<std::uint64_t> dropped = recorder_.lost();
    std::size_t topic = 0;
    for (const dds::RawReader& reader : readers_) {
      if (dropped[topic] > 0) {
        fmt::print(stderr,
                   "adstar record: {}: {} samples lost, the disk was slower than the bus; record "
                   "fewer topics (--topic), or to a faster disk\n",
                   topics_[topic].name, report::counted(dropped[topic]));
      }
      if (reader.lost() > 0) {
        fmt::print(stderr, "adstar record: {}: {} samples lost on the way here\n",
                   topics_[topic].name, report::counted(reader.lost()));
      }
      ++topic;
    }
  }

  const Options& options_;
  std::string directory_;
  std::vector<samples::RecordedTopic> topics_;
  dds::Participant participant_;
  std::list<dds::RawReader> readers_;
  dds::WaitSet wait_set_;
  bag::Recorder recorder_;
  std::uint64_t taken_ = 0;
};

int record(const Options& options) {
  log_to_stderr("record");
  catch_stop_signals();
  std::optional<Session> session;
  try {
    session.emplace(options, directory_of(options));
  } catch (const bag::Error& error) {
    throw Failure(kUsage, error.what());
  }
  session->run();
  session->finish();
  return kDone;
}

}  // namespace

Verb add_record(CLI::App& program) {
  const auto options = std::make_shared<Options>();
  CLI::App* verb =
      program.add_subcommand("record", "Write every topic to disk, as rosbag2 keeps it (.db3)");
  verb->add_option("directory", options->directory,
                   "Directory to make (default: recording_ and the time, UTC)")
      ->type_name("DIR");
  verb->add_option("--topic", options->topics, "This topic, and others given so (default: all)")
      ->type_name("TOPIC")
      ->take_all()
      ->allow_extra_args(false);
  verb->add_option_function<std::string>(
          "--max-size",
          [options](const std::string& text) { options->max_bytes = bag::parse_size(text); },
          "Begin a new file when one has that size")
      ->type_name("SIZE")
      ->check(CLI::Validator(
          [](std::string& text) {
            constexpr std::uint64_t kLeast =
                100'000;  // tables and index of an empty file take half of it
            const auto bytes = bag::parse_size(text);
            return bytes && *bytes >= kLeast
                       ? std::string()
                       : fmt::format("got '{}', expected a size of 100kB or more; try 100MB", text);
          },
          ""));
  add_duration(*verb, "--max-duration", options->max_duration_ns,
               "Begin a new file when one spans that long");
  add_duration(*verb, "--for", options->for_ns, "Stop after that long, on the wall clock");
  add_dds_options(*verb, options->place);
  verb->footer(
      "Files DIR/DIR_0.db3, DIR_1.db3, ... (SQLite, payloads in CDR) and metadata.yaml. After kill "
      "-9\n"
      "all but the last second is there. Read it with `adstar export`, `adstar plot` or rosbag2's "
      "tools.\n"
      "Ctrl-C ends it with 0. Example:\n"
      "  adstar record runs/monday --max-size 500MB");
  return {verb, [options] { return record(*options); }};
}

}  // namespace adstar::cli
