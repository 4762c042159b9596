#include "service/adstar/run_control.hpp"

#include <fmt/format.h>

#include "service/adstar/chosen_service.hpp"
#include "service/adstar/dds_options.hpp"
#include "service/adstar/inquiry.hpp"
#include "service/dds/refusal_text.hpp"
#include "service/report/numbers.hpp"

namespace adstar::cli {

int control_run(const char* verb, const adstar_RunControl& request, const RequestOptions& options) {
  log_to_stderr(verb);
  catch_stop_signals();
  const dds::Participant participant(options.place);
  const std::chrono::nanoseconds timeout = timeout_of(options);
  ControlInquiry inquiry(participant, chosen_service(participant, options.service, timeout));
  const auto status =
      inquiry.ask(request, timeout, [](const adstar_RunControlStatus&) { return true; });
  if (!status) {
    throw Failure(kNoAnswer, no_reply_sentence(inquiry.heard_by_anyone(), options));
  }
  const std::string service(dds::text_of(status->service));
  const auto refusal = dds::refusal_of(*status);
  if (!refusal) {
    throw Failure(kFailed, unknown_answer_sentence(service));
  }
  const std::string where =
      fmt::format("at step {} ({} s)", status->step, report::seconds_text(status->time_ns));
  if (*refusal == runtime::ControlRefusal::none) {
    fmt::print("done by '{}' {}\n", service, where);
    return kDone;
  }
  fmt::print("refused by '{}' {}: {}: {}\n", service, where, dds::refusal_name(*refusal),
             dds::refusal_text(*refusal));
  return kRefused;
}

}  // namespace adstar::cli
