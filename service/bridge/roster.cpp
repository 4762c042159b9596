#include "service/bridge/roster.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "service/dds/convert.hpp"

namespace adstar::bridge {
namespace {

// The sample borrows these strings and vectors; Cyclone only reads them.
adstar_RosterEntry entry_of(const scene::Spacecraft& spacecraft, std::vector<char*>& actuators) {
  for (const scene::Actuator& actuator : spacecraft.actuators) {
    actuators.push_back(const_cast<char*>(actuator.name.c_str()));
  }
  adstar_RosterEntry entry{};
  dds::set_text(entry.name, spacecraft.name);
  entry.actuators._length = entry.actuators._maximum = static_cast<std::uint32_t>(actuators.size());
  entry.actuators._buffer = actuators.data();
  return entry;
}

}  // namespace

void write_roster(dds::Writer<adstar_ServiceRoster>& writer, const scene::Scene& scene,
                  const Options& options) {
  const std::size_t chunks = chunks_of(scene.spacecraft.size());
  for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
    const std::size_t first = chunk * kChunk;
    const std::size_t count = std::min(kChunk, scene.spacecraft.size() - first);
    std::vector<std::vector<char*>> actuators(count);
    std::vector<adstar_RosterEntry> entries;
    entries.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      entries.push_back(entry_of(scene.spacecraft[first + i], actuators[i]));
    }
    adstar_ServiceRoster sample{};
    dds::set_text(sample.service, options.service);
    sample.instance_high = options.instance.high;
    sample.instance_low = options.instance.low;
    sample.chunk = static_cast<std::uint32_t>(chunk);
    sample.chunks = static_cast<std::uint32_t>(chunks);
    sample.started_utc_ns = options.started_utc_ns;
    sample.first_spacecraft = static_cast<std::uint32_t>(first);
    sample.spacecraft._length = sample.spacecraft._maximum = static_cast<std::uint32_t>(count);
    sample.spacecraft._buffer = entries.data();
    if (!writer.write(sample)) {
      throw dds::Error(
          "dds_write on topic 'adstar/service_roster' failed: the send window is full");
    }
  }
}

}  // namespace adstar::bridge
