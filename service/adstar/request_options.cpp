#include "service/adstar/request_options.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "service/adstar/dds_options.hpp"
#include "service/adstar/usage.hpp"
#include "service/adstar/verdict_sentence.hpp"

namespace adstar::cli {

void add_request_options(CLI::App& verb, RequestOptions& options) {
  add_duration(verb, "--timeout", options.timeout_ns,
               "Give up when no answer comes for that long (default: 5s)");
  add_name(verb, "--service", options.service, "Which daemon (default: the only one on the bus)");
  add_dds_options(verb, options.place);
}

std::chrono::nanoseconds timeout_of(const RequestOptions& options) {
  constexpr std::int64_t kDefault_ns = 5'000'000'000;
  return std::chrono::nanoseconds(options.timeout_ns.value_or(kDefault_ns));
}

std::string no_reply_sentence(bool heard_by_anyone, const RequestOptions& options) {
  return no_answer_sentence(heard_by_anyone, timeout_of(options).count(), options.place,
                            options.service);
}

std::string unknown_answer_sentence(const std::string& service) {
  return fmt::format(
      "service '{}' gave an answer that this program does not know; use the adstar of the "
      "service's "
      "version",
      service);
}

}  // namespace adstar::cli
