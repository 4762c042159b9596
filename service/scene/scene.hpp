#pragma once
// A validated scene: plain structs, SI units, frames as in include/adstar/notation.md. Whatever is in
// here is good; what was wrong with the file was said, all at once, in a SceneError.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "adstar/bodies/wheel.hpp"
#include "adstar/integrators/guard.hpp"
#include "adstar/multibody/forced.hpp"
#include "adstar/multibody/placement.hpp"
#include "adstar/orbit/orbit.hpp"
#include "adstar/state.hpp"
#include "adstar/torques/all.hpp"
#include "service/scene/security_files.hpp"

namespace adstar::scene {

enum class Pace {
  clock,    ///< the wall clock, times a rate
  free,     ///< as fast as it can
  lockstep  ///< a step for every one that a StepRequest asks for
};

/// Whose whole periods the beats fall on.
enum class PhaseReference {
  none,      ///< they begin when the daemon does
  realtime,  ///< CLOCK_REALTIME, as NTP or PTP keeps it
  tai        ///< CLOCK_TAI: no leap seconds, where the system knows how many there were
};

/// "clock", "free", "lockstep"
const char* name_of(Pace pace);

struct Simulation {
  std::int64_t step_ns = 0;
  std::string scheme = "coadjoint_rk4";
  std::optional<std::int64_t> duration_ns;  ///< whole steps; none: endless
  Pace pace = Pace::clock;
  PhaseReference phase_reference = PhaseReference::none;
  double rate = 1.0;  ///< simulated seconds per second of wall clock
  /// Under Pace::lockstep: a silence of the requesters worth a warning; none: never.
  std::optional<std::int64_t> lockstep_timeout_ns = 10'000'000'000;
  std::optional<std::string> epoch;    ///< ISO 8601 with its scale, e.g. "2026-01-01T00:00:00 UTC"
  std::optional<double> accuracy_rad;  ///< the attitude accuracy that the user states
  StepLimits limits;
};

/// What follows when the beat cannot be kept.
enum class Overrun {
  skip,      ///< missed beats are counted and left out: simulation time falls behind the wall
  catch_up,  ///< they are worked off as fast as it goes, up to catch_up_beats; older ones are skipped
  halt       ///< the clock stops at the first beat over its budget; telemetry is still served
};

/// How long the parts of a beat may take [ns]; 0: counted, not judged. Under Pace::clock only.
struct Budget {
  std::int64_t wake_up_ns = 0;  ///< lateness of a beat's beginning
  std::int64_t commands_ns = 0;
  std::int64_t step_ns = 0;
  std::int64_t hand_over_ns = 0;
  Overrun on_overrun = Overrun::skip;
  std::int64_t catch_up_beats = 100;
  bool refuse_at_start = true;  ///< a scene whose step was measured not to fit
};

enum class ActuatorKind {
  torque,        ///< Spacecraft::torques[index] is its adstar::Commanded
  wheel,         ///< the motor of Spacecraft::wheels[index]
  magnetorquer,  ///< Spacecraft::torques[index] is its adstar::Magnetorquer
  thruster,      ///< Spacecraft::torques[index] is its adstar::Thruster
  joint          ///< LinkedBodies::motors[index]
};

/// What can be commanded.
struct Actuator {
  std::string name;
  ActuatorKind kind = ActuatorKind::torque;
  std::size_t index = 0;
  Vec3<double>
      limit;  ///< of a torque [N m]; of a wheel's motor, x [N m]; of a dipole in B [A m²]; of a thruster 1 in x
  double max_speed_rad_s = 0;    ///< of a wheel
  std::int64_t least_on_ns = 0;  ///< of a thruster: a shorter command is lengthened
};

struct NamedWheel {
  std::string name;
  SpinningWheel<double> at_start;
};

/// The attitude that a spacecraft should have: against it its error is told.
struct PointingTarget {
  bool orbital = false;     ///< in the orbital frame, which turns; else in I
  Quat<double> attitude{};  ///< of the body in that frame, unit
};

/// What a spacecraft of several bodies is made of, placed: the common centre of mass at rest in the origin.
struct LinkedBodies {
  std::vector<multibody::BodySpec<double>> bodies;  ///< the first is the hub, "hub"
  std::vector<multibody::Joint<double>> joints;
  std::vector<std::array<double, 3>> start_coordinates;  ///< by joint, through whole turns
  multibody::Formulation formulation = multibody::Formulation::se3;
  std::vector<multibody::CoordinateMotor<double>> motors;
};

struct Spacecraft {
  std::string name;
  Eigen::Matrix3d inertia_body_kg_m2;  ///< wheels locked
  State<double> initial;               ///< q_IB and H_I at t = 0, wheels included
  std::vector<Torque<double>> torques;
  std::vector<Actuator> actuators;
  std::vector<NamedWheel> wheels;
  std::shared_ptr<const LinkedBodies> linked;  ///< null: one body
  std::vector<std::size_t>
      first_torque;  ///< of linked bodies: of each among the torques, and their end
  std::optional<PointingTarget> target;  ///< none: no error is told
  std::optional<Orbit<double>> orbit;    ///< none: none is modelled
};

/// Publication periods in whole steps; 0: not published.
struct Telemetry {
  std::uint64_t attitude_every = 0;
  std::uint64_t momentum_every = 0;
  std::uint64_t fleet_every = 0;
  std::vector<std::uint32_t>
      watched;                     ///< spacecraft with AttitudeState and MomentumState of their own
  std::uint64_t wheel_every = 0;   ///< WheelState of theirs
  std::uint64_t linked_every = 0;  ///< BodyState and JointState of linked ones
  std::uint64_t pointing_every = 0;  ///< PointingState of those with an orbit or a target
};

/// What a run leaves on disk.
struct Run {
  std::string directory;                              ///< empty: nothing is kept
  std::int64_t checkpoint_every_ns = 10'000'000'000;  ///< simulation time
  bool whole_history =
      false;  ///< keep all of the journal, not only what the newest checkpoints need
  bool hashes_every_step =
      false;  ///< not only once a second: `adstar replay` names the first that differs
};

/// A second daemon that goes on when this one is gone.
struct Standby {
  std::uint64_t lead_steps =
      0;  ///< from a command's coming to its hearing: the standby has it by then
  std::int64_t lease_ns = 0;  ///< a primary silent for so long is gone; wall clock
};

struct Service {
  std::string name;          ///< default: the host name
  int priority = 80;         ///< SCHED_FIFO, 1 to 99; 0: ordinary scheduling
  std::optional<int> cpu;    ///< pin the tick here
  bool run_control = false;  ///< RunControl is obeyed
};

struct Dds {
  std::uint32_t domain = 0;
  std::string partition;
  std::string interface = "lo";
  std::optional<SecurityFiles> security;  ///< none: whoever reaches the interface is trusted
};

/// Topics as ROS 2 nodes have them, beside our own, of Telemetry::watched.
struct Ros2 {
  std::optional<std::int64_t> torque_validity_ns = 500'000'000;  ///< none: no torques from there
  bool clock = true;                                             ///< rt/clock
  bool tf = true;                                                ///< rt/tf
};

struct Log {
  std::string level = "info";
  std::string file;  ///< empty: stderr
};

struct Scene {
  Simulation simulation;
  std::vector<Spacecraft> spacecraft;
  Telemetry telemetry;
  Budget budget;
  Run run;
  std::optional<Standby> standby;  ///< none: the scene is for one daemon alone
  Service service;
  Dds dds;
  std::optional<Ros2> ros2;  ///< none: no such topics
  Log log;
};

/// Wall time from one beat to the next under Pace::clock [ns].
std::int64_t beat_ns(const Simulation& simulation);

/// Its wheels as they are at t = 0.
std::vector<SpinningWheel<double>> spinning_wheels(const Spacecraft& spacecraft);

/// The first spacecraft that has wheels; null when none has.
const Spacecraft* first_with_wheels(const std::vector<Spacecraft>& spacecraft);

/// The first spacecraft of linked bodies; null when all are one body.
const Spacecraft* first_linked(const std::vector<Spacecraft>& spacecraft);

/// The first spacecraft that has an orbit or a target; null when none has.
const Spacecraft* first_with_reference(const std::vector<Spacecraft>& spacecraft);

/// Its first commanded torque that is given in that frame; of linked bodies, of the hub. Null: there is none.
const Actuator* first_commanded_torque(const Spacecraft& spacecraft, Frame frame);

/// The first spacecraft that names a torque; null when all are free.
const Spacecraft* first_forced(const std::vector<Spacecraft>& spacecraft);

/// Every complaint about one file, a line each: "file:line:col: key: got X, expected Y; try Z".
class SceneError : public std::runtime_error {
 public:
  explicit SceneError(const std::vector<std::string>& complaints);
};

enum class Tables { read, skip };

/// The text of a scene file; throws SceneError when it cannot be read.
std::string text_of(const std::filesystem::path& file);

/// Reads and validates; throws SceneError. Tables are looked up beside the scene file.
Scene load(const std::filesystem::path& file);

/// The same from text. `file` serves messages and the place of tables; Tables::skip leaves them
/// empty and unread.
Scene parse(std::string_view text, const std::filesystem::path& file, Tables tables = Tables::read);

/// "10ms", "2h", "1.5s", "250us", "100ns", "1min", "1d" to nanoseconds; nothing when it is none, or
/// not whole nanoseconds.
std::optional<std::int64_t> parse_duration(std::string_view text);

/// Nanoseconds in the largest unit that keeps it short: "10ms", "1.5s".
std::string format_duration(std::int64_t ns);

}  // namespace adstar::scene
