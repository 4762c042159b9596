#pragma once
// What a service says of its clock, in words.

#include <health.h>
#include <string>

#include "service/adstar/services.hpp"

namespace adstar::cli {

/// "running", "paused", ...
const char* state_text(adstar_ServiceState state);
/// One word of it, for programs.
const char* state_word(adstar_ServiceState state);

/// One clause for every service whose clock does not run: "'fly' is paused"; empty when all do.
std::string standing_clocks(const Services& services);

}  // namespace adstar::cli
