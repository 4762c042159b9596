#include "service/dds/convert.hpp"

#include <array>
#include <limits>

namespace adstar::dds {

using runtime::ControlAction;
using runtime::ControlRefusal;
using runtime::Reason;
using runtime::StepOutcome;
using runtime::StepRefusal;
using runtime::Verdict;

static_assert(static_cast<int>(Verdict::accepted) == adstar_VERDICT_ACCEPTED);
static_assert(static_cast<int>(Verdict::applied) == adstar_VERDICT_APPLIED);
static_assert(static_cast<int>(Verdict::applied_late) == adstar_VERDICT_APPLIED_LATE);
static_assert(static_cast<int>(Verdict::clamped) == adstar_VERDICT_CLAMPED);
static_assert(static_cast<int>(Verdict::superseded) == adstar_VERDICT_SUPERSEDED);
static_assert(static_cast<int>(Verdict::expired) == adstar_VERDICT_EXPIRED);
static_assert(static_cast<int>(Verdict::outranked) == adstar_VERDICT_OUTRANKED);
static_assert(static_cast<int>(Verdict::refused) == adstar_VERDICT_REFUSED);
static_assert(static_cast<int>(Reason::none) == adstar_REASON_NONE);
static_assert(static_cast<int>(Reason::unknown_spacecraft) == adstar_REASON_UNKNOWN_SPACECRAFT);
static_assert(static_cast<int>(Reason::unknown_actuator) == adstar_REASON_UNKNOWN_ACTUATOR);
static_assert(static_cast<int>(Reason::not_finite) == adstar_REASON_NOT_FINITE);
static_assert(static_cast<int>(Reason::bad_interval) == adstar_REASON_BAD_INTERVAL);
static_assert(static_cast<int>(Reason::old_sequence) == adstar_REASON_OLD_SEQUENCE);
static_assert(static_cast<int>(Reason::no_authority) == adstar_REASON_NO_AUTHORITY);
static_assert(static_cast<int>(Reason::schedule_full) == adstar_REASON_SCHEDULE_FULL);
static_assert(static_cast<int>(Reason::capacity) == adstar_REASON_CAPACITY);
static_assert(static_cast<int>(Reason::not_recorded) == adstar_REASON_NOT_RECORDED);
static_assert(static_cast<int>(runtime::RunState::running) == adstar_SERVICE_RUNNING);
static_assert(static_cast<int>(runtime::RunState::stopped) == adstar_SERVICE_STOPPED);
static_assert(static_cast<int>(runtime::RunState::halted) == adstar_SERVICE_HALTED);
static_assert(static_cast<int>(runtime::RunState::waiting) == adstar_SERVICE_WAITING);
static_assert(static_cast<int>(runtime::RunState::paused) == adstar_SERVICE_PAUSED);
static_assert(static_cast<int>(runtime::RunState::standby) == adstar_SERVICE_STANDBY);
static_assert(static_cast<int>(StepOutcome::accepted) == adstar_STEP_ACCEPTED);
static_assert(static_cast<int>(StepOutcome::done) == adstar_STEP_DONE);
static_assert(static_cast<int>(StepOutcome::ended) == adstar_STEP_ENDED);
static_assert(static_cast<int>(StepOutcome::interrupted) == adstar_STEP_INTERRUPTED);
static_assert(static_cast<int>(StepOutcome::refused) == adstar_STEP_REFUSED);
static_assert(static_cast<int>(StepRefusal::none) == adstar_STEP_REFUSAL_NONE);
static_assert(static_cast<int>(StepRefusal::old_sequence) == adstar_STEP_REFUSAL_OLD_SEQUENCE);
static_assert(static_cast<int>(StepRefusal::busy) == adstar_STEP_REFUSAL_BUSY);
static_assert(static_cast<int>(StepRefusal::too_many_steps) == adstar_STEP_REFUSAL_TOO_MANY_STEPS);
static_assert(static_cast<int>(StepRefusal::not_standing) == adstar_STEP_REFUSAL_NOT_STANDING);
static_assert(static_cast<int>(StepRefusal::halted) == adstar_STEP_REFUSAL_HALTED);
static_assert(static_cast<int>(ControlAction::pause) == adstar_CONTROL_PAUSE);
static_assert(static_cast<int>(ControlAction::resume) == adstar_CONTROL_RESUME);
static_assert(static_cast<int>(ControlAction::reset) == adstar_CONTROL_RESET);
static_assert(static_cast<int>(ControlAction::set_state) == adstar_CONTROL_SET_STATE);
static_assert(static_cast<int>(ControlAction::set_inertia) == adstar_CONTROL_SET_INERTIA);
static_assert(static_cast<int>(ControlAction::set_target) == adstar_CONTROL_SET_TARGET);
static_assert(static_cast<int>(ControlRefusal::none) == adstar_CONTROL_REFUSAL_NONE);
static_assert(static_cast<int>(ControlRefusal::not_allowed) == adstar_CONTROL_REFUSAL_NOT_ALLOWED);
static_assert(static_cast<int>(ControlRefusal::unknown_spacecraft) ==
              adstar_CONTROL_REFUSAL_UNKNOWN_SPACECRAFT);
static_assert(static_cast<int>(ControlRefusal::bad_state) == adstar_CONTROL_REFUSAL_BAD_STATE);
static_assert(static_cast<int>(ControlRefusal::bad_inertia) == adstar_CONTROL_REFUSAL_BAD_INERTIA);
static_assert(static_cast<int>(ControlRefusal::not_now) == adstar_CONTROL_REFUSAL_NOT_NOW);
static_assert(static_cast<int>(ControlRefusal::old_sequence) ==
              adstar_CONTROL_REFUSAL_OLD_SEQUENCE);
static_assert(static_cast<int>(ControlRefusal::not_recorded) ==
              adstar_CONTROL_REFUSAL_NOT_RECORDED);
static_assert(static_cast<int>(ControlRefusal::no_target) == adstar_CONTROL_REFUSAL_NO_TARGET);
static_assert(runtime::kStartAtNextBeat == adstar_START_AT_NEXT_BEAT);

namespace {

adstar_Vector3 vector(const std::array<double, 3>& v) noexcept { return {v[0], v[1], v[2]}; }

adstar_Quantiles quantiles(const runtime::QuantilesRecord& q) noexcept {
  return {q.count, q.p50_ns, q.p99_ns, q.p99_9_ns, q.max_ns};
}

adstar_PhaseTiming phase(const runtime::TimingRecord& record, runtime::Phase which) noexcept {
  const runtime::PhaseRecord& p = record.phases[static_cast<std::size_t>(which)];
  adstar_PhaseTiming timing{quantiles(p.took), p.sum_ns, {}, p.budget_ns, p.over_budget};
  static_assert(std::size(decltype(timing.quarter_octaves){}) == runtime::kQuarterOctaves);
  std::copy(p.quarter_octaves.begin(), p.quarter_octaves.end(), timing.quarter_octaves);
  return timing;
}

// Read as a number: the value may lie outside the enumeration.
template <class Enumeration>
std::uint32_t number(const Enumeration& value) noexcept {
  static_assert(sizeof value == sizeof(std::uint32_t));
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

/// The enumerator of that number, up to the last one known.
template <class Known, class Enumeration>
std::optional<Known> known(const Enumeration& value, Known last) noexcept {
  const std::uint32_t bits = number(value);
  return bits <= static_cast<std::uint32_t>(last) ? std::optional(static_cast<Known>(bits))
                                                  : std::nullopt;
}

std::uint32_t clip32(std::uint64_t count) noexcept {
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
  return static_cast<std::uint32_t>(count < kMost ? count : kMost);
}

}  // namespace

namespace {

/// All but what is commanded.
template <class Command>
runtime::CommandRecord header_of(const Command& sample, std::uint32_t spacecraft,
                                 std::uint32_t actuator) noexcept {
  runtime::CommandRecord record;
  record.commander = {sample.commander.high, sample.commander.low};
  record.sequence = sample.sequence_number;
  record.spacecraft = spacecraft;
  record.actuator = actuator;
  record.priority = sample.priority;
  record.start_ns = sample.start_time_ns;
  record.end_ns = sample.end_time_ns;
  record.duration_ns = sample.duration_ns;
  return record;
}

}  // namespace

runtime::CommandRecord to_record(const adstar_TorqueCommand& sample, std::uint32_t spacecraft,
                                 std::uint32_t actuator) noexcept {
  runtime::CommandRecord record = header_of(sample, spacecraft, actuator);
  record.value = {sample.torque_n_m.x, sample.torque_n_m.y, sample.torque_n_m.z};
  return record;
}

runtime::CommandRecord to_record(const adstar_WheelTorqueCommand& sample, std::uint32_t spacecraft,
                                 std::uint32_t actuator) noexcept {
  runtime::CommandRecord record = header_of(sample, spacecraft, actuator);
  record.value = {sample.motor_torque_n_m, 0, 0};
  return record;
}

runtime::CommandRecord to_record(const adstar_WheelSpeedCommand& sample, std::uint32_t spacecraft,
                                 std::uint32_t actuator) noexcept {
  runtime::CommandRecord record = header_of(sample, spacecraft, actuator);
  record.quantity = runtime::Quantity::wheel_speed;
  record.value = {sample.speed_rad_s, 0, 0};
  return record;
}

runtime::CommandRecord to_record(const adstar_DipoleCommand& sample, std::uint32_t spacecraft,
                                 std::uint32_t actuator) noexcept {
  const adstar_Vector3& m = sample.dipole_body_a_m2;
  runtime::CommandRecord record = header_of(sample, spacecraft, actuator);
  record.quantity = runtime::Quantity::dipole;
  record.value = {m.x, m.y, m.z};
  return record;
}

runtime::CommandRecord to_record(const adstar_JointTorqueCommand& sample, std::uint32_t spacecraft,
                                 std::uint32_t actuator) noexcept {
  runtime::CommandRecord record = header_of(sample, spacecraft, actuator);
  record.value = {sample.motor_torque_n_m, 0, 0};
  return record;
}

runtime::CommandRecord to_record(const adstar_ThrusterCommand& sample, std::uint32_t spacecraft,
                                 std::uint32_t actuator) noexcept {
  runtime::CommandRecord record = header_of(sample, spacecraft, actuator);
  record.quantity = runtime::Quantity::thrust;
  record.value = {1, 0, 0};
  return record;
}

adstar_CommandStatus to_sample(const runtime::VerdictRecord& record, std::string_view spacecraft,
                               std::string_view actuator, std::string_view service) noexcept {
  adstar_CommandStatus sample{};
  set_text(sample.spacecraft, spacecraft);
  set_text(sample.actuator, actuator);
  sample.commander = {record.commander.high, record.commander.low};
  set_text(sample.service, service);
  sample.sequence_number = record.sequence;
  sample.step = record.step;
  sample.time_ns = record.time_ns;
  sample.verdict = static_cast<adstar_Verdict>(record.verdict);
  sample.reason = static_cast<adstar_RefusalReason>(record.reason);
  sample.priority = record.priority;
  sample.effective_start_time_ns = record.start_ns;
  sample.effective_end_time_ns = record.end_ns;
  switch (record.quantity) {
    case runtime::Quantity::torque:
      sample.torque_applied_n_m = vector(record.value);
      break;
    case runtime::Quantity::wheel_speed:
      sample.speed_applied_rad_s = record.value[0];
      break;
    case runtime::Quantity::dipole:
      sample.dipole_applied_a_m2 = vector(record.value);
      break;
    case runtime::Quantity::thrust:
      break;  // the interval says it all
  }
  return sample;
}

runtime::StepRequestRecord to_record(const adstar_StepRequest& sample) noexcept {
  runtime::StepRequestRecord record;
  record.requester = {sample.requester.high, sample.requester.low};
  record.sequence = sample.sequence_number;
  record.steps = sample.steps;
  return record;
}

runtime::ControlRecord to_record(const adstar_RunControl& sample) noexcept {
  const adstar_Vector3& omega = sample.angular_velocity_body_rad_s;
  const adstar_InertiaTensor& J = sample.inertia_body_kg_m2;
  runtime::ControlRecord record;
  record.commander = {sample.commander.high, sample.commander.low};
  record.sequence = sample.sequence_number;
  record.action = static_cast<ControlAction>(number(sample.action));
  const adstar_Quaternion& q = record.action == ControlAction::set_target
                                   ? sample.attitude_body_to_frame
                                   : sample.attitude_body_to_inertial;
  record.attitude = {q.w, q.x, q.y, q.z};
  record.omega_B_rad_s = {omega.x, omega.y, omega.z};
  record.inertia_body_kg_m2 = {J.xx, J.yy, J.zz, J.xy, J.xz, J.yz};
  return record;
}

adstar_StepReply to_sample(const runtime::StepReplyRecord& record,
                           std::string_view service) noexcept {
  adstar_StepReply sample{};
  set_text(sample.service, service);
  sample.requester = {record.requester.high, record.requester.low};
  sample.sequence_number = record.sequence;
  sample.outcome = static_cast<adstar_StepOutcome>(record.outcome);
  sample.refusal = static_cast<adstar_StepRefusal>(record.refusal);
  sample.step = record.step;
  sample.time_ns = record.time_ns;
  return sample;
}

adstar_RunControlStatus to_sample(const runtime::ControlAnswerRecord& record,
                                  std::string_view service) noexcept {
  adstar_RunControlStatus sample{};
  set_text(sample.service, service);
  sample.commander = {record.commander.high, record.commander.low};
  sample.sequence_number = record.sequence;
  sample.action = static_cast<adstar_ControlAction>(record.action);
  sample.refusal = static_cast<adstar_ControlRefusal>(record.refusal);
  sample.step = record.step;
  sample.time_ns = record.time_ns;
  return sample;
}

adstar_StepTiming to_sample(const runtime::TimingRecord& record,
                            std::string_view service) noexcept {
  adstar_StepTiming sample{};
  set_text(sample.service, service);
  sample.state = static_cast<adstar_ServiceState>(record.state);
  sample.step = record.step;
  sample.time_ns = record.time_ns;
  sample.wake_up_lateness = phase(record, runtime::Phase::wake_up);
  sample.command_phase = phase(record, runtime::Phase::commands);
  sample.step_phase = phase(record, runtime::Phase::step);
  sample.hand_over_phase = phase(record, runtime::Phase::hand_over);
  sample.tick_body = quantiles(record.tick_body);
  sample.late_beats = record.late_beats;
  sample.late_after_work = record.late_after_work;
  sample.late_after_loss = record.late_after_loss;
  sample.late_after_sleep = record.late_after_sleep;
  sample.overruns = record.overruns;
  sample.missed_beats = record.missed_beats;
  sample.caught_up_beats = record.caught_up_beats;
  sample.behind_wall_ns = record.behind_ns;
  sample.phase_disciplined = record.phase_disciplined != 0;
  sample.phase_error_ns = record.phase_error_ns;
  sample.minor_page_faults = record.account.minor_faults;
  sample.major_page_faults = record.account.major_faults;
  sample.involuntary_switches = record.account.involuntary_switches;
  sample.most_commands_waiting = clip32(record.account.most_commands);
  sample.most_verdicts_waiting = clip32(record.account.most_verdicts);
  sample.most_telemetry_waiting = clip32(record.account.most_telemetry);
  sample.fifo_scheduling = record.fifo_scheduling != 0;
  sample.memory_locked = record.memory_locked != 0;
  sample.cpu_pinned = record.cpu_pinned != 0;
  return sample;
}

adstar_ServiceStatus to_sample(const runtime::StatusRecord& record,
                               const ServiceFacts& facts) noexcept {
  adstar_ServiceStatus sample{};
  set_text(sample.service, facts.service);
  sample.instance_high = facts.instance.high;
  sample.instance_low = facts.instance.low;
  sample.started_utc_ns = facts.started_utc_ns;
  // The record comes from the shared memory of this program's own parent: its state is in range.
  sample.state = static_cast<adstar_ServiceState>(record.state);
  sample.step = record.step;
  sample.time_ns = record.time_ns;
  sample.step_length_ns = facts.step_length_ns;
  set_text(sample.pace, facts.pace);
  set_text(sample.scheme, facts.scheme);
  sample.spacecraft = facts.spacecraft;
  sample.unresolved_spacecraft = clip32(record.unresolved_spacecraft);
  sample.worst_momentum_residual_relative = record.worst_momentum_residual_relative;
  sample.commands_received = record.commands_received;
  sample.commands_refused = record.commands_refused;
  sample.commands_lost = record.commands_lost;
  sample.verdicts_lost = record.verdicts_lost;
  sample.telemetry_lost = record.telemetry_lost;
  sample.bridge_restarts = clip32(record.bridge_restarts);
  sample.state_hash = record.state_hash;
  sample.state_hash_step = record.state_hash_step;
  sample.run = clip32(record.run);
  return sample;
}

std::optional<Verdict> verdict_of(const adstar_CommandStatus& sample) noexcept {
  return known(sample.verdict, Verdict::refused);
}

std::optional<Reason> reason_of(const adstar_CommandStatus& sample) noexcept {
  return known(sample.reason, Reason::not_recorded);
}

std::optional<StepOutcome> outcome_of(const adstar_StepReply& sample) noexcept {
  return known(sample.outcome, StepOutcome::refused);
}

std::optional<StepRefusal> refusal_of(const adstar_StepReply& sample) noexcept {
  return known(sample.refusal, StepRefusal::halted);
}

std::optional<ControlRefusal> refusal_of(const adstar_RunControlStatus& sample) noexcept {
  return known(sample.refusal, ControlRefusal::no_target);
}

}  // namespace adstar::dds
