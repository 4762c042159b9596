#include "service/adstar/order_run.hpp"

#include <chrono>
#include <cstdio>

#include <fmt/format.h>

#include "service/adstar/dds_options.hpp"
#include "service/adstar/stop_signal.hpp"
#include "service/adstar/usage.hpp"
#include "service/adstar/verdict_sentence.hpp"

namespace adstar::cli {

using namespace std::chrono_literals;

Order OrderOptions::order() const {
  Order order;
  order.priority = priority;
  order.start_ns = at_ns.value_or(runtime::kStartAtNextBeat);
  order.duration_ns = for_ns.value_or(0);
  order.end_ns = until_ns.value_or(0);
  return order;
}

void add_order_options(CLI::App& verb, OrderOptions& options) {
  add_name(verb, "spacecraft", options.target.spacecraft, "Which spacecraft")
      ->type_name("SPACECRAFT")
      ->required();
  add_duration(verb, "--for", options.for_ns, "How long, from the effective start");
  add_duration(verb, "--until", options.until_ns, "Until that simulation time");
  add_duration(verb, "--at", options.at_ns, "From that simulation time (default: the next step)",
               true);
  verb.add_option("--priority", options.priority, "The higher one holds the actuator")
      ->type_name("N")
      ->capture_default_str();
  verb.add_flag("--wait", options.wait, "Wait for the final verdict of what is to begin later");
  add_duration(verb, "--timeout", options.timeout_ns,
               "Give up when no answer comes for that long (default: 5s)");
  add_name(verb, "--service", options.target.service, "Hear only the daemon of that name");
  add_dds_options(verb, options.place);
}

void require_an_end(const OrderOptions& options) {
  if (options.for_ns.has_value() == options.until_ns.has_value()) {
    throw Failure(kUsage, "expected one of --for and --until; try --for 5s");
  }
}

ExitCode run_order(Commander& commander, const Order& order, const OrderOptions& options) {
  const std::uint64_t sequence = commander.give(order);
  bool said_accepted = false;
  while (true) {
    commander.work(50ms);
    const auto& dispatch = commander.at(sequence);
    const bool waits = dispatch.answer && (options.at_ns || commander.waits(sequence));
    if (dispatch.ended() || (waits && !options.wait)) {
      fmt::print("{}\n", verdict_sentence(*dispatch.answer, order));
      return exit_code_of(*dispatch.answer);
    }
    if (dispatch.answer && options.wait && !said_accepted) {
      said_accepted = true;
      fmt::print("{}\n", verdict_sentence(*dispatch.answer, order));
      std::fflush(stdout);
    }
    if (stop_requested()) {
      throw Failure(kFailed, "interrupted; a command that was accepted still runs");
    }
    if (commander.silent(sequence, std::chrono::nanoseconds(options.timeout()))) {
      return kNoAnswer;
    }
  }
}

ExitCode send_order(const char* verb, const Order& order, const OrderOptions& options) {
  log_to_stderr(verb);
  catch_stop_signals();
  const dds::Participant participant(options.place);
  Commander commander(participant, options.target);
  return answered(run_order(commander, order, options), commander, options);
}

std::string order_footer(const char* example) {
  return fmt::format(
      "Times are simulation time since the scene's start.\n"
      "Exit code: 0 done, 3 refused, expired, outranked or superseded, 4 no answer.\n"
      "Example:\n"
      "  {}",
      example);
}

ExitCode answered(ExitCode code, const Commander& commander, const OrderOptions& options) {
  if (code == kNoAnswer) {
    throw Failure(kNoAnswer, no_answer_sentence(commander.heard_by_anyone(), options.timeout(),
                                                options.place, options.target.service));
  }
  return code;
}

}  // namespace adstar::cli
