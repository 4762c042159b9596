#include "service/dashboard/server/bus.hpp"

#include "service/dds/convert.hpp"

namespace adstar::dashboard {
namespace {

/// Everything that waits, each to the board.
template <class T, class OnSample, class OnGone>
void take_all(dds::Reader<T>& reader, OnSample&& on_sample, OnGone&& on_gone) {
  while (reader.take([&](const T& sample, const dds_sample_info_t&) { on_sample(sample); },
                     [&](const T& key, const dds_sample_info_t&) { on_gone(key); }) > 0) {}
}

}  // namespace

Bus::Bus(const dds::Participant& participant)
    : attitudes_(participant),
      momenta_(participant),
      fleets_(participant),
      statuses_(participant),
      timings_(participant),
      rosters_(participant),
      verdicts_(participant),
      wait_set_(participant) {
  wait_set_.attach(attitudes_);
  wait_set_.attach(momenta_);
  wait_set_.attach(fleets_);
  wait_set_.attach(statuses_);
  wait_set_.attach(timings_);
  wait_set_.attach(rosters_);
  wait_set_.attach(verdicts_);
}

void Bus::listen(std::chrono::nanoseconds patience) {
  wait_set_.wait(patience);
  const std::unique_lock lock(mutex_);
  const auto now = Clock::now();
  const auto stays = [](const auto&) {};
  const auto learn = [&](const auto& sample) { board_.learn(sample, now); };
  take_all(
      rosters_, [&](const auto& roster) { board_.learn(roster); },
      [&](const adstar_ServiceRoster& key) {
        board_.forget_roster(dds::text_of(key.service), key.instance_high, key.instance_low);
      });
  take_all(statuses_, learn, [&](const adstar_ServiceStatus& key) {
    board_.forget_service(dds::text_of(key.service), now);
  });
  take_all(timings_, learn, stays);
  take_all(attitudes_, learn, [&](const adstar_AttitudeState& key) {
    board_.forget_spacecraft(dds::text_of(key.spacecraft));
  });
  take_all(momenta_, learn, stays);
  take_all(fleets_, learn, [&](const adstar_FleetState& key) {
    board_.forget_fleet(dds::text_of(key.service), key.chunk);
  });
  take_all(
      verdicts_, [&](const auto& verdict) { board_.learn(verdict); }, stays);
}

}  // namespace adstar::dashboard
