#include "service/adstar/telemetry_feed.hpp"

#include <algorithm>
#include <thread>

#include "service/dds/convert.hpp"

namespace adstar::cli {
namespace {

using namespace std::chrono_literals;

/// Fleets are looked at only when rosters and the topics of single spacecraft had time to come.
constexpr auto kIntroduction = 300ms;

}  // namespace

TelemetryFeed::TelemetryFeed(const dds::Participant& participant, std::set<std::string> wanted)
    : wanted_(std::make_move_iterator(wanted.begin()), std::make_move_iterator(wanted.end())),
      services_(participant),
      attitudes_(participant),
      momenta_(participant),
      fleets_(participant),
      wait_set_(participant) {
  services_.attach_to(wait_set_);
  wait_set_.attach(attitudes_);
  wait_set_.attach(momenta_);
}

std::vector<report::Row> TelemetryFeed::next(std::chrono::nanoseconds patience) {
  // Fleets come once a second and are not waited for: until their roster is known they stay where
  // they are, and a waiting sample would keep the wait set awake.
  wait_set_.wait(std::min<std::chrono::nanoseconds>(patience, 50ms));
  services_.take();
  while (attitudes_.take([&](const adstar_AttitudeState& sample, const dds_sample_info_t&) {
    if (wants(dds::text_of(sample.spacecraft))) {
      joiner_.add(sample);
    }
  }) > 0) {}
  while (momenta_.take([&](const adstar_MomentumState& sample, const dds_sample_info_t&) {
    if (wants(dds::text_of(sample.spacecraft))) {
      joiner_.add(sample);
    }
  }) > 0) {}
  if (Clock::now() - begun_ > kIntroduction) {
    take_fleets();
  }
  return joiner_.end_round();
}

void TelemetryFeed::take_fleets() {
  while (fleets_.take([&](const adstar_FleetState& fleet, const dds_sample_info_t&) {
    const ListedService* service = services_.named(printable(dds::text_of(fleet.service)));
    for (std::uint32_t i = 0; service != nullptr && i < fleet.members._length; ++i) {
      const ListedSpacecraft* spacecraft = service->at(fleet.first_spacecraft + i);
      if (spacecraft != nullptr && wants(spacecraft->name)) {
        joiner_.add(spacecraft->name, fleet, fleet.members._buffer[i]);
      }
    }
  }) > 0) {}
}

bool TelemetryFeed::wants(std::string_view spacecraft) const {
  return wanted_.empty() || wanted_.contains(spacecraft);
}

bool TelemetryFeed::heard() const {
  return !services_.empty() || attitudes_.matched() > 0 || momenta_.matched() > 0;
}

}  // namespace adstar::cli
