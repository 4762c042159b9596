#include "service/adstar/services.hpp"

#include <algorithm>
#include <numeric>

#include "service/dds/convert.hpp"

namespace adstar::cli {
namespace {

// Whoever can write to the domain could otherwise fill our memory.
constexpr std::size_t kMostServices = 256;
constexpr std::size_t kMostChunks = 10'000;

ListedSpacecraft spacecraft_of(const adstar_RosterEntry& entry) {
  ListedSpacecraft spacecraft{printable(dds::text_of(entry.name)), {}};
  for (std::uint32_t i = 0; i < entry.actuators._length; ++i) {
    spacecraft.actuators.push_back(printable(entry.actuators._buffer[i]));
  }
  return spacecraft;
}

}  // namespace

std::string printable(std::string_view text) {
  std::string clean(text);
  std::replace_if(
      clean.begin(), clean.end(), [](char c) { return c < ' ' || c == '\x7f'; }, '?');
  return clean;
}

std::size_t ListedService::size() const {
  return std::accumulate(
      chunks.begin(), chunks.end(), std::size_t{0},
      [](std::size_t sum, const auto& chunk) { return sum + chunk.second.size(); });
}

const ListedSpacecraft* ListedService::at(std::uint32_t index) const {
  const auto after = chunks.upper_bound(index);
  if (after == chunks.begin()) {
    return nullptr;
  }
  const auto& [first, members] = *std::prev(after);
  return index - first < members.size() ? &members[index - first] : nullptr;
}

bool Services::take() {
  bool any = false;
  while (rosters_.take(
             [&](const adstar_ServiceRoster& roster, const dds_sample_info_t&) { learn(roster); },
             [&](const adstar_ServiceRoster& key, const dds_sample_info_t&) {
               services_.erase(
                   {printable(dds::text_of(key.service)), key.instance_high, key.instance_low});
             }) > 0) {
    any = true;
  }
  while (statuses_.take([&](const adstar_ServiceStatus& status, const dds_sample_info_t&) {
    learn(status);
  }) > 0) {
    any = true;
  }
  return any;
}

void Services::learn(const adstar_ServiceRoster& roster) {
  const Key key{printable(dds::text_of(roster.service)), roster.instance_high, roster.instance_low};
  if (services_.size() >= kMostServices && !services_.contains(key)) {
    return;
  }
  ListedService& service = services_[key];
  service.name = key.name;
  service.started_utc_ns = roster.started_utc_ns;
  service.chunks_expected = roster.chunks;
  if (service.chunks.size() < kMostChunks) {
    auto& members = service.chunks[roster.first_spacecraft];
    members.clear();
    for (std::uint32_t i = 0; i < roster.spacecraft._length; ++i) {
      members.push_back(spacecraft_of(roster.spacecraft._buffer[i]));
    }
  }
}

void Services::learn(const adstar_ServiceStatus& status) {
  const Key key{printable(dds::text_of(status.service)), status.instance_high, status.instance_low};
  if (services_.size() >= kMostServices && !services_.contains(key)) {
    return;
  }
  ListedService& service = services_[key];
  service.name = key.name;
  service.started_utc_ns = status.started_utc_ns;
  service.status = status;
}

std::vector<const ListedService*> Services::all() const {
  std::vector<const ListedService*> list;
  for (const auto& [key, service] : services_) {
    list.push_back(&service);
  }
  std::stable_sort(list.begin(), list.end(), [](const auto* a, const auto* b) {
    return std::pair(a->name, a->started_utc_ns) < std::pair(b->name, b->started_utc_ns);
  });
  return list;
}

const ListedService* Services::named(std::string_view name) const {
  const ListedService* youngest = nullptr;
  for (const auto& [key, service] : services_) {
    if (service.name == name &&
        (youngest == nullptr || service.started_utc_ns > youngest->started_utc_ns)) {
      youngest = &service;
    }
  }
  return youngest;
}

}  // namespace adstar::cli
