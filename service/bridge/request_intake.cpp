#include "service/bridge/request_intake.hpp"

#include <utility>

#include <spdlog/spdlog.h>

#include "service/bridge/staleness.hpp"
#include "service/dds/convert.hpp"

namespace adstar::bridge {
namespace {

/// Whoever asks repeats: a full ring loses nothing but time.
template <class Ring, class Record>
void hand_over(runtime::SharedSegment& segment, Ring& ring, Record record) {
  record.received_ns = clock_ns(CLOCK_MONOTONIC);
  ring.push(record);
  runtime::wake_tick(segment);
}

}  // namespace

RequestIntake::RequestIntake(const dds::Participant& participant, runtime::SharedSegment& segment,
                             const Directory& directory, std::string service)
    : segment_(segment),
      directory_(directory),
      service_(std::move(service)),
      steps_(participant),
      controls_(participant) {}

bool RequestIntake::take_some() {
  const auto take_own = [this](const auto& request, const dds_sample_info_t& info) {
    if (dds::text_of(request.service) == service_ &&
        !is_stale(info, [] { return "a request to the clock"; })) {
      take(request);
    }
  };
  const std::size_t steps = steps_.take(take_own);
  return controls_.take(take_own) + steps > 0;
}

void RequestIntake::take(const adstar_StepRequest& request) {
  hand_over(segment_, segment_.step_requests, dds::to_record(request));
}

void RequestIntake::take(const adstar_RunControl& request) {
  // An index that the scene does not have is refused by adstard under the name of its reason, in the
  // order of its own checks.
  constexpr std::uint32_t kNobody = 0xffff'ffffU;
  runtime::ControlRecord record = dds::to_record(request);
  if (runtime::is_of_one_spacecraft(record.action)) {
    record.spacecraft = directory_.spacecraft(dds::text_of(request.spacecraft)).value_or(kNobody);
  }
  hand_over(segment_, segment_.controls, record);
}

}  // namespace adstar::bridge
