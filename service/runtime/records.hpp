#pragma once
// What crosses between adstard and adstar-bridge: plain records in SI units, frames as in
// include/adstar/notation.md. Spacecraft and actuators are indices into the scene.

#include <array>
#include <cstdint>
#include <limits>

namespace adstar::runtime {

/// 128 random bits, drawn once per commanding process.
struct CommanderId {
  std::uint64_t high = 0;
  std::uint64_t low = 0;
  friend bool operator==(const CommanderId&, const CommanderId&) = default;
};

/// CommandRecord::start_ns that asks for "from the next beat".
inline constexpr std::int64_t kStartAtNextBeat = -std::numeric_limits<std::int64_t>::max();

/// What the numbers of a command are.
enum class Quantity : std::uint32_t {
  torque,  ///< [N m] in the actuator's frame; of a motor about its axis: x; of one along it: [N]
  wheel_speed,  ///< x: relative to the body [rad/s]
  dipole,       ///< of a magnetorquer, in B [A m²]
  thrust        ///< x: 1, the thruster is on
};

/// One command of any actuator, names resolved to indices. Not yet judged.
struct CommandRecord {
  CommanderId commander;
  std::uint64_t sequence = 0;
  std::uint32_t spacecraft = 0;
  std::uint32_t actuator = 0;
  std::int32_t priority = 0;
  Quantity quantity = Quantity::torque;
  std::int64_t start_ns = kStartAtNextBeat;  ///< simulation time
  std::int64_t end_ns = 0;                   ///< simulation time, exclusive; 0 with a duration
  std::int64_t duration_ns = 0;              ///< from the effective start; 0 with an end
  std::array<double, 3> value{};             ///< of `quantity`
  std::int64_t received_ns = 0;              ///< monotonic clock, by the bridge; 0: not stamped
};

/// Same values and order as Verdict in idl/command.idl.
enum class Verdict : std::uint32_t {
  accepted,      ///< waits for its start; a final verdict follows
  applied,       ///< final
  applied_late,  ///< final: its start was past, its end was not
  clamped,       ///< final: applied, scaled to the actuator's limit
  superseded,    ///< final: displaced by a newer command before it began
  expired,       ///< final: wholly past
  outranked,     ///< final: a higher priority holds the actuator
  refused        ///< final: see Reason
};

/// Same values and order as RefusalReason in idl/command.idl.
enum class Reason : std::uint32_t {
  none,
  unknown_spacecraft,
  unknown_actuator,
  not_finite,
  bad_interval,
  old_sequence,
  no_authority,
  schedule_full,
  capacity,
  halted,
  not_recorded
};

/// The answer to one command.
struct VerdictRecord {
  CommanderId commander;
  std::uint64_t sequence = 0;
  std::uint32_t spacecraft = 0;
  std::uint32_t actuator = 0;
  std::int32_t priority = 0;
  Verdict verdict = Verdict::refused;
  Reason reason = Reason::none;
  Quantity quantity = Quantity::torque;  ///< as in the command
  std::uint64_t step = 0;                ///< decided at; when applied: the first step it acts in
  std::int64_t time_ns = 0;              ///< simulation time of that step's beginning
  std::int64_t start_ns = 0;             ///< in force from
  std::int64_t end_ns = 0;               ///< in force until, exclusive
  std::array<double, 3> value{};         ///< as applied
};

/// Which topics a TelemetryRecord goes to, bit by bit.
inline constexpr std::uint32_t kTopicAttitude = 1;
inline constexpr std::uint32_t kTopicMomentum = 2;

/// Flags of a motion sample; same values as in idl/telemetry.idl.
inline constexpr std::uint32_t kFlagUnresolvedAngle = 1;
inline constexpr std::uint32_t kFlagUnresolvedEdges = 2;
inline constexpr std::uint32_t kFlagFinal = 4;
inline constexpr std::uint32_t kFlagUnresolvedDamping = 8;
// Beside kFlagUnresolvedAngle, what it speaks of where it is not the turn alone.
inline constexpr std::uint32_t kFlagLightAxis = 16;
inline constexpr std::uint32_t kFlagSeparatrix = 32;
inline constexpr std::uint32_t kFlagAttitudeLost = 64;
inline constexpr std::uint32_t kFlagJointOpen = 128;

/// One spacecraft at one step.
struct TelemetryRecord {
  std::uint32_t spacecraft = 0;
  std::uint32_t topics = 0;
  std::uint32_t flags = 0;
  std::uint32_t reserved = 0;
  std::uint64_t step = 0;
  std::int64_t time_ns = 0;
  std::array<double, 4> q_IB{};  ///< w, x, y, z
  std::array<double, 3> omega_B_rad_s{};
  std::array<double, 3> H_I_n_m_s{};
  std::array<double, 3> Pi_B_n_m_s{};
  double rotational_energy_j = 0;
  double work_j = 0;
  double energy_residual_j = 0;
  std::array<double, 3> momentum_residual_I_n_m_s{};
};

/// Flags of a WheelRecord, beside kFlagFinal; same values as in idl/telemetry.idl.
inline constexpr std::uint32_t kWheelTorqueLimited = 1;
inline constexpr std::uint32_t kWheelSpeedLimited = 2;

/// One wheel at one step.
struct WheelRecord {
  std::uint32_t spacecraft = 0;
  std::uint32_t wheel = 0;
  std::uint32_t flags = 0;
  std::uint32_t reserved = 0;
  std::uint64_t step = 0;
  std::int64_t time_ns = 0;
  double speed_rad_s = 0;
  double momentum_n_m_s = 0;
  double motor_torque_n_m = 0;
  double friction_torque_n_m = 0;
};

/// One of the linked bodies of a spacecraft at one step, about the common centre of mass.
struct BodyRecord {
  std::uint32_t spacecraft = 0;
  std::uint32_t body = 0;
  std::uint32_t flags = 0;  ///< kFlag...
  std::uint32_t reserved = 0;
  std::uint64_t step = 0;
  std::int64_t time_ns = 0;
  std::array<double, 4> q_IB{};  ///< w, x, y, z
  std::array<double, 3> omega_B_rad_s{};
  std::array<double, 3> position_I_m{};
  std::array<double, 3> velocity_I_m_s{};
};

/// One joint of theirs: coordinates in the order of its kind, what it carries to the body that it leads to.
struct JointRecord {
  std::uint32_t spacecraft = 0;
  std::uint32_t joint = 0;
  std::uint32_t flags = 0;
  std::uint32_t coordinates = 0;  ///< how many are free
  std::uint64_t step = 0;
  std::int64_t time_ns = 0;
  std::array<double, 3> coordinate{};    ///< [rad] or [m]
  std::array<double, 3> rate{};          ///< [rad/s] or [m/s]
  std::array<double, 3> motor_torque{};  ///< [N m] or [N]
  std::array<double, 3> force_I_n{};     ///< constraint, spring, damper, stops and motor together
  std::array<double, 3> couple_I_n_m{};
};

/// Flags of a PointingRecord, beside kFlagFinal; same values as in idl/telemetry.idl.
inline constexpr std::uint32_t kPointingOrbit = 1;
inline constexpr std::uint32_t kPointingTarget = 2;

/// One spacecraft at one step, against its orbit and the attitude that it should have.
struct PointingRecord {
  std::uint32_t spacecraft = 0;
  std::uint32_t flags = 0;  ///< what is there; the rest is zero
  std::uint64_t step = 0;
  std::int64_t time_ns = 0;
  std::array<double, 3> position_I_m{};
  std::array<double, 3> velocity_I_m_s{};
  std::array<double, 4> q_OB{};                  ///< body to orbital frame: w, x, y, z
  std::array<double, 3> omega_B_to_O_B_rad_s{};  ///< of B relative to O, in B
  std::array<double, 3> error_B_rad{};  ///< rotation vector from the target to the body, in B
};

/// One spacecraft in the fleet snapshot.
struct FleetRecord {
  std::array<double, 4> q_IB{};
  std::array<double, 3> omega_B_rad_s{};
  std::array<double, 3> H_I_n_m_s{};
  double rotational_energy_j = 0;
  double energy_residual_j = 0;
  std::uint64_t flags = 0;
};

/// Header of the fleet snapshot; the FleetRecords follow it in the same slot.
struct FleetHeader {
  std::uint64_t step = 0;
  std::int64_t time_ns = 0;
  std::uint64_t members = 0;
};

/// Same values and order as ServiceState in idl/health.idl.
enum class RunState : std::uint64_t { running, stopped, halted, waiting, paused, standby };

/// Counts, once a second and at the end: becomes ServiceStatus.
struct StatusRecord {
  std::uint64_t step = 0;
  std::int64_t time_ns = 0;
  std::uint64_t state = 0;  ///< RunState
  std::uint64_t unresolved_spacecraft = 0;
  double worst_momentum_residual_relative = 0;
  std::uint64_t commands_received = 0;
  std::uint64_t commands_refused = 0;
  std::uint64_t commands_lost = 0;
  std::uint64_t verdicts_lost = 0;
  std::uint64_t telemetry_lost = 0;
  std::uint64_t bridge_restarts = 0;
  std::uint64_t state_hash = 0;       ///< of every spacecraft's state at state_hash_step
  std::uint64_t state_hash_step = 0;  ///< 0: none yet
  std::uint64_t run = 0;              ///< how often it was set back to the scene's start
};

struct QuantilesRecord {
  std::uint64_t count = 0;
  std::int64_t p50_ns = 0;
  std::int64_t p99_ns = 0;
  std::int64_t p99_9_ns = 0;
  std::int64_t max_ns = 0;
};

/// The parts of a beat.
enum class Phase : std::uint32_t { wake_up, commands, step, hand_over };
inline constexpr std::size_t kPhases = 4;

/// How often a time fell between two edges: below the first, 2^8 ns; then four counts an octave; the last is of 2^30 ns or more.
inline constexpr std::size_t kQuarterOctaves = 90;
using QuarterOctaveCounts = std::array<std::uint64_t, kQuarterOctaves>;

/// In an octave that begins at 32 of anything: the whole numbers next to 32·2^(i/4), a fifth apart at most.
inline constexpr std::array<std::int64_t, 4> kQuarterEdges{32, 38, 45, 54};

/// What the times of count `i` are below, of all but the last.
constexpr std::int64_t quarter_octave_edge_ns(std::size_t i) noexcept {
  return kQuarterEdges[i % 4] << (3 + i / 4);
}

struct PhaseRecord {
  QuantilesRecord took;
  std::uint64_t sum_ns = 0;
  QuarterOctaveCounts quarter_octaves{};
  std::int64_t budget_ns = 0;  ///< 0: none
  std::uint64_t over_budget = 0;
};

/// What the system did to the tick's thread, and the most that waited in each ring.
struct TickAccount {
  std::uint64_t minor_faults = 0;
  std::uint64_t major_faults = 0;
  std::uint64_t involuntary_switches = 0;  ///< taken off the processor with work left
  std::uint64_t most_commands = 0;
  std::uint64_t most_verdicts = 0;
  std::uint64_t most_telemetry = 0;
};

/// Becomes StepTiming.
struct TimingRecord {
  std::uint64_t state = 0;  ///< RunState
  std::uint64_t step = 0;
  std::int64_t time_ns = 0;
  std::array<PhaseRecord, kPhases> phases;  ///< by Phase
  QuantilesRecord tick_body;
  std::uint64_t late_beats = 0;        ///< begun a period late or more
  std::uint64_t late_after_work = 0;   ///< of those: a beat worked for longer than the period
  std::uint64_t late_after_loss = 0;   ///< of those: within a beat the processor was taken away
  std::uint64_t late_after_sleep = 0;  ///< of those: the system woke the tick late
  std::uint64_t overruns = 0;
  std::uint64_t missed_beats = 0;
  std::uint64_t caught_up_beats = 0;
  std::int64_t behind_ns = 0;           ///< of the wall clock, now
  std::uint64_t phase_disciplined = 0;  ///< 1: by the clock that the scene names
  std::int64_t phase_error_ns = 0;      ///< of the beats on it, now
  TickAccount account;
  std::uint64_t fifo_scheduling = 0;
  std::uint64_t memory_locked = 0;
  std::uint64_t cpu_pinned = 0;
};

/// How far a primary is: what its standby may compute up to.
struct StandbyBeatRecord {
  std::uint64_t step = 0;         ///< the next beat to be computed
  std::uint64_t next_number = 1;  ///< of the journal record that would come next
  std::int64_t received_ns = 0;   ///< monotonic clock of the standby's bridge; 0: never
  std::uint64_t ended = 0;        ///< 1: it ends in good order, and computes no more
};

/// One StepRequest: so many steps are to be taken while the clock stands. Not yet judged.
struct StepRequestRecord {
  CommanderId requester;
  std::uint64_t sequence = 0;
  std::uint64_t steps = 0;
  std::int64_t received_ns = 0;  ///< monotonic clock, by the bridge; 0: not stamped
};

/// Same values and order as StepOutcome in idl/run.idl.
enum class StepOutcome : std::uint32_t {
  accepted,     ///< under way; the answer follows
  done,         ///< the clock stands where it was asked to
  ended,        ///< the run is over: its duration is reached
  interrupted,  ///< the clock was paused, reset, halted or stopped before all steps were taken
  refused       ///< see StepRefusal
};

/// Same values and order as StepRefusal in idl/run.idl.
enum class StepRefusal : std::uint32_t {
  none,
  old_sequence,
  busy,
  too_many_steps,
  not_standing,
  halted
};

/// The answer to one StepRequest.
struct StepReplyRecord {
  CommanderId requester;
  std::uint64_t sequence = 0;
  StepOutcome outcome = StepOutcome::refused;
  StepRefusal refusal = StepRefusal::none;
  std::uint64_t step = 0;    ///< reached
  std::int64_t time_ns = 0;  ///< simulation time there
};

/// Same values and order as ControlAction in idl/run.idl.
enum class ControlAction : std::uint32_t {
  pause,
  resume,
  reset,
  set_state,
  set_inertia,
  set_target
};

/// The others are of the clock and the whole fleet.
constexpr bool is_of_one_spacecraft(ControlAction action) noexcept {
  return action == ControlAction::set_state || action == ControlAction::set_inertia ||
         action == ControlAction::set_target;
}

/// One RunControl, its name resolved to an index. Not yet judged.
struct ControlRecord {
  CommanderId commander;
  std::uint64_t sequence = 0;
  ControlAction action = ControlAction::pause;
  std::uint32_t spacecraft = 0;  ///< where the action is of one
  /// w, x, y, z; of any length but zero. Of set_state q_IB, of set_target that in the target's frame.
  std::array<double, 4> attitude{};
  std::array<double, 3> omega_B_rad_s{};
  std::array<double, 6> inertia_body_kg_m2{};  ///< xx, yy, zz, xy, xz, yz
  std::int64_t received_ns = 0;                ///< monotonic clock, by the bridge; 0: not stamped
};

/// Same values and order as ControlRefusal in idl/run.idl.
enum class ControlRefusal : std::uint32_t {
  none,  ///< it was done
  not_allowed,
  unknown_spacecraft,
  bad_state,
  bad_inertia,
  not_now,
  old_sequence,
  unknown_action,
  not_recorded,
  no_target
};

/// The answer to one RunControl.
struct ControlAnswerRecord {
  CommanderId commander;
  std::uint64_t sequence = 0;
  ControlAction action = ControlAction::pause;
  std::uint32_t spacecraft = 0;
  ControlRefusal refusal = ControlRefusal::none;
  std::uint32_t reserved = 0;
  std::uint64_t step = 0;    ///< the clock's, afterwards
  std::int64_t time_ns = 0;  ///< simulation time there
};

}  // namespace adstar::runtime
