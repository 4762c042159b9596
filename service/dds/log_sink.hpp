#pragma once
// Cyclone's own lines go to our log, at most ten a second: malformed packets otherwise fill a disk.

namespace adstar::dds {

/// Idempotent. Call before the first DDS entity; Participant does.
void install_log_sink();

}  // namespace adstar::dds
