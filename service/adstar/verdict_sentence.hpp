#pragma once
// A verdict as one sentence, and what it means for the exit code.

#include <string>

#include "service/adstar/commander.hpp"
#include "service/adstar/failure.hpp"

namespace adstar::cli {

/// "applied by 'adstard': step 120, from 1.2 s to 6.2 s, torque [0, 0, 0.05] N m"
std::string verdict_sentence(const Answer& answer, const Order& asked);

ExitCode exit_code_of(const Answer& answer);

/// Why nobody may have answered in that time, and what to look at.
std::string no_answer_sentence(bool heard_by_anyone, std::int64_t timeout_ns,
                               const dds::ParticipantOptions& place, const std::string& service);

}  // namespace adstar::cli
