#pragma once
// Which service a request is for, when the user need not say because there is only one.

#include <chrono>
#include <string>

#include "service/dds/participant.hpp"

namespace adstar::cli {

/// `named` itself, or the name of the only running service on the bus. Throws Failure: none within
/// `timeout`, or several.
std::string chosen_service(const dds::Participant& participant, const std::string& named,
                           std::chrono::nanoseconds timeout);

}  // namespace adstar::cli
