#pragma once
// Rows off the bus: the topics of single spacecraft joined, and fleets for those that have none of
// their own. Readers keep the newest sample only, so that a slow terminal never slows the bus.

#include <chrono>
#include <set>
#include <string>
#include <vector>

#include "service/adstar/services.hpp"
#include "service/dds/participant.hpp"
#include "service/dds/reader.hpp"
#include "service/dds/wait_set.hpp"
#include "service/samples/joiner.hpp"

namespace adstar::cli {

class TelemetryFeed {
 public:
  /// `wanted`: names; empty: every spacecraft.
  TelemetryFeed(const dds::Participant& participant, std::set<std::string> wanted);

  /// Waits at most `patience` for something to come; returns what is ready.
  std::vector<report::Row> next(std::chrono::nanoseconds patience);
  /// At the end: halves that still wait for their other half.
  std::vector<report::Row> rest() { return joiner_.rest(); }

  /// Some daemon is on the bus.
  bool heard() const;
  const Services& services() const { return services_; }

 private:
  using Clock = std::chrono::steady_clock;

  bool wants(std::string_view spacecraft) const;
  void take_fleets();

  std::set<std::string, std::less<>> wanted_;
  Clock::time_point begun_ = Clock::now();
  samples::Joiner joiner_;
  Services services_;
  dds::Reader<adstar_AttitudeState> attitudes_;
  dds::Reader<adstar_MomentumState> momenta_;
  dds::Reader<adstar_FleetState> fleets_;
  dds::WaitSet wait_set_;
};

}  // namespace adstar::cli
