#include "service/bridge/other_services.hpp"

#include <spdlog/spdlog.h>

#include "service/dds/convert.hpp"
#include "service/dds/rate_limit.hpp"

namespace adstar::bridge {
namespace {

// Whoever can write to the domain could otherwise fill our memory with rosters.
constexpr std::size_t kMostServices = 256;
constexpr std::uint32_t kMostPerRoster = 10'000;

}  // namespace

OtherServices::OtherServices(const dds::Participant& participant, const Directory& directory,
                             const Options& options)
    : reader_(participant),
      directory_(directory),
      self_(options.started_utc_ns, options.instance.high, options.instance.low),
      service_(options.service) {}

std::optional<Rival> OtherServices::poll() {
  std::optional<Rival> rival;
  // Bounded: a flood of rosters must not keep the telemetry waiting.
  for (int batch = 0; batch < 16; ++batch) {
    const std::size_t taken = reader_.take(
        [&](const adstar_ServiceRoster& roster, const dds_sample_info_t& info) {
          if (info.instance_state == DDS_IST_ALIVE) {
            learn(roster, rival);
          }
        },
        [&](const adstar_ServiceRoster& key, const dds_sample_info_t&) { forget(key); });
    if (taken == 0) {
      break;
    }
  }
  return rival;
}

void OtherServices::learn(const adstar_ServiceRoster& roster, std::optional<Rival>& rival) {
  const Instance instance(roster.started_utc_ns, roster.instance_high, roster.instance_low);
  if (roster.instance_high == std::get<1>(self_) && roster.instance_low == std::get<2>(self_)) {
    return;  // ourselves, or the bridge that ran here before
  }
  if (tolerates_namesakes_ && dds::text_of(roster.service) == service_) {
    return;
  }
  const std::lock_guard lock(mutex_);
  if (spacecraft_.size() >= kMostServices && !spacecraft_.contains(instance)) {
    return;
  }
  auto& names = spacecraft_[instance];
  if (names.empty() && dds::text_of(roster.service) == service_) {
    static dds::RateLimit limit(1);
    if (limit.admit()) {
      spdlog::warn(
          "another daemon is called '{}' too, so their status and fleet samples mix; give one "
          "another [service] name",
          service_);
    }
  }
  const bool older = instance < self_;
  for (std::uint32_t i = 0; i < roster.spacecraft._length && i < kMostPerRoster; ++i) {
    const std::string_view name = dds::text_of(roster.spacecraft._buffer[i].name);
    names.emplace(name);
    if (directory_.spacecraft(name) && (!rival || (older && !rival->older))) {
      rival = Rival{std::string(dds::text_of(roster.service)), std::string(name), older};
    }
  }
}

void OtherServices::forget(const adstar_ServiceRoster& key) {
  // A disposed sample carries its key only, so the start time is unknown here.
  const std::lock_guard lock(mutex_);
  std::erase_if(spacecraft_, [&](const auto& entry) {
    return std::get<1>(entry.first) == key.instance_high &&
           std::get<2>(entry.first) == key.instance_low;
  });
}

bool OtherServices::flies(std::string_view spacecraft) const {
  const std::string name(spacecraft);
  const std::lock_guard lock(mutex_);
  for (const auto& [instance, names] : spacecraft_) {
    if (names.contains(name)) {
      return true;
    }
  }
  return false;
}

}  // namespace adstar::bridge
