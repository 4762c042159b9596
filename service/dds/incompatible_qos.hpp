#pragma once
// A peer whose QoS cannot match ours is otherwise simply silent: say which topic and which policy.

#include <memory>

#include <dds/dds.h>

namespace adstar::dds {

using ListenerHandle = std::unique_ptr<dds_listener_t, decltype(&dds_delete_listener)>;

/// For a participant: reports the incompatible-QoS status of every reader and writer beneath it.
ListenerHandle make_incompatible_qos_listener();

/// "RELIABILITY", "PARTITION", ...
const char* policy_name(std::uint32_t policy_id) noexcept;

}  // namespace adstar::dds
