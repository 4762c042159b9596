#pragma once
// Options of the verbs that ask something of one service's clock.

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "service/dds/participant.hpp"

namespace CLI {
class App;
}

namespace adstar::cli {

struct RequestOptions {
  std::string service;  ///< empty: the only one
  std::optional<std::int64_t> timeout_ns;
  dds::ParticipantOptions place;
};

/// --timeout, --service and where the bus is.
void add_request_options(CLI::App& verb, RequestOptions& options);

std::chrono::nanoseconds timeout_of(const RequestOptions& options);

/// Why nothing came, as far as can be told.
std::string no_reply_sentence(bool heard_by_anyone, const RequestOptions& options);

/// The service is of a newer version.
std::string unknown_answer_sentence(const std::string& service);

}  // namespace adstar::cli
