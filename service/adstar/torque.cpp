// adstar torque: command an actuator, and say what became of the command.

#include <cstdio>
#include <memory>

#include <fmt/format.h>

#include "service/adstar/commander.hpp"
#include "service/adstar/dds_options.hpp"
#include "service/adstar/failure.hpp"
#include "service/adstar/profile_run.hpp"
#include "service/adstar/stop_signal.hpp"
#include "service/adstar/usage.hpp"
#include "service/adstar/verbs.hpp"
#include "service/adstar/verdict_sentence.hpp"

namespace adstar::cli {
namespace {

using namespace std::chrono_literals;

struct Options {
  Commander::Target target{.spacecraft = {}, .actuator = "body", .service = {}};
  std::vector<double> torque_n_m;
  std::optional<std::int64_t> for_ns, until_ns, at_ns, timeout_ns;
  std::int32_t priority = 0;
  std::string profile;
  bool wait = false;
  dds::ParticipantOptions place;
};

constexpr std::int64_t kDefaultTimeout_ns = 5'000'000'000;

void require_consistent(const Options& options) {
  const bool profile = !options.profile.empty();
  if (profile == !options.torque_n_m.empty()) {
    throw Failure(kUsage,
                  "expected one of --torque-n-m and --profile; try --torque-n-m 0 0 0.05 --for 5s");
  }
  const bool has_for = options.for_ns.has_value(), has_until = options.until_ns.has_value();
  if (profile && (has_for || has_until)) {
    throw Failure(kUsage,
                  "--profile takes no --for and no --until: its rows say how long; leave them out");
  }
  if (!profile && has_for == has_until) {
    throw Failure(kUsage, "expected one of --for and --until; try --for 5s");
  }
}

Order order_of(const Options& options) {
  Order order;
  order.priority = options.priority;
  order.start_ns = options.at_ns.value_or(runtime::kStartAtNextBeat);
  order.duration_ns = options.for_ns.value_or(0);
  order.end_ns = options.until_ns.value_or(0);
  order.torque_n_m = {options.torque_n_m[0], options.torque_n_m[1], options.torque_n_m[2]};
  return order;
}

/// One order until its verdict. An immediate one is final within a beat, so that is waited for; where
/// none comes the clock stands, and it begins with the next step.
ExitCode command(Commander& commander, const Options& options, std::int64_t timeout_ns) {
  const Order order = order_of(options);
  const std::uint64_t sequence = commander.give(order);
  constexpr auto kABeat = 500ms;
  using Clock = Commander::Clock;
  std::optional<Clock::time_point> accepted_at;
  bool said_accepted = false;
  while (true) {
    commander.work(50ms);
    const auto& dispatch = commander.at(sequence);
    if (dispatch.answer && !accepted_at) {
      accepted_at = Clock::now();
    }
    const bool waits_long = accepted_at && (options.at_ns || Clock::now() - *accepted_at > kABeat);
    if (dispatch.answer && (dispatch.ended() || (waits_long && !options.wait))) {
      fmt::print("{}\n", verdict_sentence(*dispatch.answer, order.torque_n_m));
      return exit_code_of(*dispatch.answer);
    }
    if (dispatch.answer && options.wait && !said_accepted) {
      said_accepted = true;
      fmt::print("{}\n", verdict_sentence(*dispatch.answer, order.torque_n_m));
      std::fflush(stdout);
    }
    if (stop_requested()) {
      throw Failure(kFailed, "interrupted; a command that was accepted still runs");
    }
    if (commander.silent(sequence, std::chrono::nanoseconds(timeout_ns))) {
      return kNoAnswer;
    }
  }
}

int torque(const Options& options) {
  require_consistent(options);
  std::vector<ProfileRow> rows;
  if (!options.profile.empty()) {
    rows = read_profile(options.profile);
  }
  const std::int64_t timeout_ns = options.timeout_ns.value_or(kDefaultTimeout_ns);
  log_to_stderr("torque");
  catch_stop_signals();
  const dds::Participant participant(options.place);
  Commander commander(participant, options.target);
  const ExitCode code =
      rows.empty() ? command(commander, options, timeout_ns)
                   : ProfileRun(commander, std::move(rows),
                                {options.at_ns, options.priority, options.wait, timeout_ns})
                         .run();
  if (code == kNoAnswer) {
    throw Failure(kNoAnswer, no_answer_sentence(commander.heard_by_anyone(), timeout_ns,
                                                options.place, options.target.service));
  }
  return code;
}

}  // namespace

Verb add_torque(CLI::App& program) {
  const auto options = std::make_shared<Options>();
  CLI::App* verb =
      program.add_subcommand("torque", "Command a torque over DDS and print the verdict");
  add_name(*verb, "spacecraft", options->target.spacecraft, "Which spacecraft")
      ->type_name("SPACECRAFT")
      ->required();
  verb->add_option("--torque-n-m", options->torque_n_m, "Torque in the actuator's frame [N m]")
      ->type_name("X Y Z")
      ->type_size(3)
      ->expected(1);
  add_duration(*verb, "--for", options->for_ns, "How long, from the effective start");
  add_duration(*verb, "--until", options->until_ns, "Until that simulation time");
  add_duration(*verb, "--at", options->at_ns, "From that simulation time (default: the next step)",
               true);
  verb->add_option("--profile", options->profile,
                   "Rows time_s,torque_x_n_m,torque_y_n_m,torque_z_n_m, each held until the next, "
                   "the last one ends it; times count from --at, or from a moment after now")
      ->type_name("FILE");
  add_name(*verb, "--actuator", options->target.actuator, "Which actuator of the spacecraft")
      ->capture_default_str();
  verb->add_option("--priority", options->priority, "The higher one holds the actuator")
      ->type_name("N")
      ->capture_default_str();
  verb->add_flag("--wait", options->wait, "Wait for the final verdict of what is to begin later");
  add_duration(*verb, "--timeout", options->timeout_ns,
               "Give up when no answer comes for that long (default: 5s)");
  add_name(*verb, "--service", options->target.service, "Hear only the daemon of that name");
  add_dds_options(*verb, options->place);
  verb->footer(
      "Times are simulation time since the scene's start.\n"
      "Exit code: 0 done, 3 refused, expired, outranked or superseded, 4 no answer.\n"
      "Example:\n"
      "  adstar torque sat1 --torque-n-m 0 0 0.05 --for 5s");
  return {verb, [options] { return torque(*options); }};
}

}  // namespace adstar::cli
