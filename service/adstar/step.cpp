// adstar step: let a clock that stands take steps, and say where it stands then.

#include <memory>

#include <fmt/format.h>

#include "service/adstar/chosen_service.hpp"
#include "service/adstar/dds_options.hpp"
#include "service/adstar/inquiry.hpp"
#include "service/adstar/request_options.hpp"
#include "service/adstar/usage.hpp"
#include "service/adstar/verbs.hpp"
#include "service/dds/refusal_text.hpp"
#include "service/report/numbers.hpp"

namespace adstar::cli {
namespace {

using runtime::StepOutcome;

constexpr std::uint64_t kMostSteps = 1'000'000'000;

struct Options {
  std::uint64_t steps = 1;
  RequestOptions request;
};

/// Prints what came of it.
ExitCode tell(const adstar_StepReply& reply) {
  const std::string where =
      fmt::format("step {} ({} s)", reply.step, report::seconds_text(reply.time_ns));
  const std::string service(dds::text_of(reply.service));
  const auto outcome = dds::outcome_of(reply);
  const auto refusal = dds::refusal_of(reply);
  if (outcome == StepOutcome::done) {
    fmt::print("'{}' stands at {}\n", service, where);
    return kDone;
  }
  if (outcome == StepOutcome::ended) {
    fmt::print("'{}' has ended its run at {}\n", service, where);
    return kDone;
  }
  if (outcome == StepOutcome::interrupted) {
    fmt::print("'{}' was interrupted at {}: paused, reset, halted or stopped\n", service, where);
    return kRefused;
  }
  if (outcome == StepOutcome::refused && refusal) {
    fmt::print("refused by '{}' at {}: {}: {}\n", service, where, dds::refusal_name(*refusal),
               dds::refusal_text(*refusal));
    return kRefused;
  }
  throw Failure(kFailed, unknown_answer_sentence(service));
}

/// Why no answer came, and what to do about steps that may be under way.
std::string silence_sentence(const StepInquiry& inquiry, const Options& options) {
  std::string text = no_reply_sentence(inquiry.heard_by_anyone(), options.request);
  if (inquiry.heard_by_anyone() && options.steps > 0) {
    text +=
        ". The steps may still be taken: `adstar step --steps 0 --timeout 60s` asks where the "
        "clock stands, `adstar pause` ends them where the scene allows run control";
  }
  return text;
}

int step(const Options& options) {
  log_to_stderr("step");
  catch_stop_signals();
  const dds::Participant participant(options.request.place);
  const std::chrono::nanoseconds timeout = timeout_of(options.request);
  StepInquiry inquiry(participant, chosen_service(participant, options.request.service, timeout));
  adstar_StepRequest request{};
  request.steps = options.steps;
  const auto reply = inquiry.ask(request, timeout, [](const adstar_StepReply& answer) {
    return answer.outcome != adstar_STEP_ACCEPTED;
  });
  if (!reply) {
    throw Failure(kNoAnswer, silence_sentence(inquiry, options));
  }
  return tell(*reply);
}

}  // namespace

Verb add_step(CLI::App& program) {
  const auto options = std::make_shared<Options>();
  CLI::App* verb = program.add_subcommand(
      "step", "Let a daemon in lock-step, or paused, take steps; returns when they are taken");
  verb->add_option("--steps", options->steps, "How many; 0 asks only where the clock stands")
      ->type_name("N")
      ->check(whole_number(0, kMostSteps))
      ->capture_default_str();
  add_request_options(*verb, options->request);
  verb->footer(
      "The scene says pace = \"lockstep\", or the clock was paused (adstar pause).\n"
      "Exit code: 0 the steps are taken or the run has ended, 3 refused or interrupted, 4 no "
      "answer.\n"
      "Example:\n"
      "  adstar step --steps 100");
  return {verb, [options] { return step(*options); }};
}

}  // namespace adstar::cli
