#pragma once
// Between the records that cross the shared memory and the samples that cross the network. Names
// are characters of fixed length there: always terminated, and what does not fit is reported, not
// overrun.

#include <algorithm>
#include <command.h>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <health.h>
#include <optional>
#include <run.h>
#include <span>
#include <string_view>
#include <telemetry.h>

#include "service/runtime/records.hpp"

namespace adstar::dds {

/// Copies and terminates; false when the text was cut.
template <std::size_t N>
bool set_text(char (&target)[N], std::string_view text) noexcept {
  const std::size_t length = text.size() < N ? text.size() : N - 1;
  std::fill(std::copy_n(text.data(), length, target), target + N, '\0');
  return length == text.size();
}

/// Up to the terminator, or all of it when there is none.
template <std::size_t N>
std::string_view text_of(const char (&source)[N]) noexcept {
  return {source, strnlen(source, N)};
}

/// Client to service. Spacecraft and actuator are the caller's to resolve.
runtime::CommandRecord to_record(const adstar_TorqueCommand& sample, std::uint32_t spacecraft,
                                 std::uint32_t actuator) noexcept;

runtime::CommandRecord to_record(const adstar_WheelTorqueCommand& sample, std::uint32_t spacecraft,
                                 std::uint32_t actuator) noexcept;
runtime::CommandRecord to_record(const adstar_WheelSpeedCommand& sample, std::uint32_t spacecraft,
                                 std::uint32_t actuator) noexcept;
runtime::CommandRecord to_record(const adstar_DipoleCommand& sample, std::uint32_t spacecraft,
                                 std::uint32_t actuator) noexcept;
runtime::CommandRecord to_record(const adstar_JointTorqueCommand& sample, std::uint32_t spacecraft,
                                 std::uint32_t actuator) noexcept;
runtime::CommandRecord to_record(const adstar_ThrusterCommand& sample, std::uint32_t spacecraft,
                                 std::uint32_t actuator) noexcept;

/// The daemon's decision, on the wire.
adstar_CommandStatus to_sample(const runtime::VerdictRecord& record, std::string_view spacecraft,
                               std::string_view actuator, std::string_view service) noexcept;

/// Client to service. An action that this program does not know stays one; which spacecraft is the caller's.
runtime::StepRequestRecord to_record(const adstar_StepRequest& sample) noexcept;
runtime::ControlRecord to_record(const adstar_RunControl& sample) noexcept;

adstar_StepReply to_sample(const runtime::StepReplyRecord& record,
                           std::string_view service) noexcept;
adstar_RunControlStatus to_sample(const runtime::ControlAnswerRecord& record,
                                  std::string_view service) noexcept;

adstar_AttitudeState to_attitude(const runtime::TelemetryRecord& record,
                                 std::string_view spacecraft, std::string_view service) noexcept;
adstar_MomentumState to_momentum(const runtime::TelemetryRecord& record,
                                 std::string_view spacecraft, std::string_view service) noexcept;
adstar_WheelState to_sample(const runtime::WheelRecord& record, std::string_view spacecraft,
                            std::string_view wheel, std::string_view service) noexcept;
adstar_BodyState to_sample(const runtime::BodyRecord& record, std::string_view spacecraft,
                           std::string_view body, std::string_view service) noexcept;
adstar_JointState to_sample(const runtime::JointRecord& record, std::string_view spacecraft,
                            std::string_view joint, std::string_view service) noexcept;
adstar_PointingState to_sample(const runtime::PointingRecord& record, std::string_view spacecraft,
                               std::string_view service) noexcept;
adstar_FleetMember to_member(const runtime::FleetRecord& record) noexcept;
adstar_StepTiming to_sample(const runtime::TimingRecord& record, std::string_view service) noexcept;

/// What of ServiceStatus never changes during a run.
struct ServiceFacts {
  std::string_view service;
  runtime::CommanderId instance;  ///< 128 random bits, as those of a commander
  std::int64_t started_utc_ns = 0;
  std::int64_t step_length_ns = 0;
  std::string_view pace;
  std::string_view scheme;
  std::uint32_t spacecraft = 0;
};
adstar_ServiceStatus to_sample(const runtime::StatusRecord& record,
                               const ServiceFacts& facts) noexcept;

/// Nothing when the enumerator is one that this program does not know.
std::optional<runtime::Verdict> verdict_of(const adstar_CommandStatus& sample) noexcept;
std::optional<runtime::Reason> reason_of(const adstar_CommandStatus& sample) noexcept;
std::optional<runtime::StepOutcome> outcome_of(const adstar_StepReply& sample) noexcept;
std::optional<runtime::StepRefusal> refusal_of(const adstar_StepReply& sample) noexcept;
std::optional<runtime::ControlRefusal> refusal_of(const adstar_RunControlStatus& sample) noexcept;

}  // namespace adstar::dds
