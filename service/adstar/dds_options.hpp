#pragma once
// Where the bus is: options of every verb that speaks DDS, with the defaults of a scene.

#include <string>

#include "service/dds/participant.hpp"

namespace CLI {
class App;
}

namespace adstar::cli {

void add_dds_options(CLI::App& verb, dds::ParticipantOptions& options);

/// "domain 0, interface lo, default partition"
std::string place_of(const dds::ParticipantOptions& options);

/// DDS's own warnings go to stderr, under the verb's name.
void log_to_stderr(const std::string& verb);

}  // namespace adstar::cli
