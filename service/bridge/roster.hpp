#pragma once
// Tells the network which spacecraft and actuators this daemon flies.

#include <cstddef>

#include "service/bridge/options.hpp"
#include "service/dds/writer.hpp"
#include "service/scene/scene.hpp"

namespace adstar::bridge {

/// Entries in one ServiceRoster, members in one FleetState: what one datagram carries.
inline constexpr std::size_t kChunk = 500;

constexpr std::size_t chunks_of(std::size_t members) { return (members + kChunk - 1) / kChunk; }

/// All chunks. Throws dds::Error.
void write_roster(dds::Writer<adstar_ServiceRoster>& writer, const scene::Scene& scene,
                  const Options& options);

}  // namespace adstar::bridge
