#pragma once
// The spacecraft of a scene in flight: what each needs for a step, and one step of all of them.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "adstar/bodies/gyrostat.hpp"
#include "adstar/bodies/rigid_body.hpp"
#include "adstar/multibody/forced.hpp"
#include "adstar/propagator.hpp"
#include "service/runtime/records.hpp"
#include "service/scene/scene.hpp"

namespace adstar::runtime {

/// The wheels of a vehicle that has some.
struct Wheels {
  RigidBody<double> hub;  ///< J_r: the body without what turns freely
  std::vector<SpinningWheel<double>> spinning;

  std::span<const SpinningWheel<double>> all() const noexcept { return spinning; }
};

/// What an attitude is told against; at least one of the two.
struct Reference {
  std::optional<Orbit<double>> orbit;
  std::optional<scene::PointingTarget> target;
};

/// What every step touches stands first, in three cache lines.
struct alignas(64) Vehicle {
  State<double> state;
  std::vector<Torque<double>> torques;   ///< only the models that its scene names
  std::uint32_t flags = 0;               ///< kFlagUnresolved... of the last step
  RigidBody<double> body;                ///< wheels locked
  Vec3<double> H_0;                      ///< inertial momentum at t = 0 [N m s]
  double E_0 = 0;                        ///< rotational energy at t = 0 [J]
  std::unique_ptr<Wheels> wheels;        ///< null: none
  std::unique_ptr<Reference> reference;  ///< null: none
  std::unique_ptr<multibody::LinkedFlight<double>>
      linked;  ///< null: one body; else it has the hub too
};

/// The accounts of linked bodies are the vehicle's: impulse and work since they were opened.
inline void share_accounts(Vehicle& vehicle) noexcept {
  if (vehicle.linked != nullptr) {
    vehicle.linked->state.impulse_I = vehicle.state.impulse_I;
    vehicle.linked->state.work = vehicle.state.work;
  }
}

/// omega_B [rad/s]; of linked bodies the hub's
Vec3<double> angular_velocity_of(const Vehicle& vehicle) noexcept;
/// Of the body and the wheels [J].
double energy_of(const Vehicle& vehicle) noexcept;

/// Some of a fleet, one beside the other. By its ends: a span would be divided into a size and multiplied out again.
struct Vehicles {
  Vehicle* first = nullptr;
  Vehicle* last = nullptr;
  Vehicle* begin() const noexcept { return first; }
  Vehicle* end() const noexcept { return last; }
};

/// Steps all vehicles with one scheme within limits that do not change; keeps what that scheme prepares once for each body.
class Stepper {
 public:
  virtual ~Stepper() = default;
  /// Over [t_ns, t_ns + h_ns]; returns how many could not be resolved.
  virtual std::size_t step(Vehicles vehicles, std::int64_t t_ns, std::int64_t h_ns) noexcept = 0;
  /// Prepares one body anew. Between steps; never allocates.
  virtual void replace_body(std::size_t vehicle, const RigidBody<double>& body) noexcept = 0;
};

/// How the vehicles of a fleet are stepped; the bits are the same. `automatic`: the widest
/// instruction set that this processor has and the fleet fills.
enum class Lanewise { automatic, alone, sse2, avx2, avx512 };

class Fleet {
 public:
  /// `scheme` and `limits` are the scene's. Throws std::invalid_argument for an unknown scheme, and
  /// for lanes that this processor or the scheme does not have. `threads`: of a step, at most.
  Fleet(const std::vector<scene::Spacecraft>& spacecraft, std::string_view scheme,
        const StepLimits& limits, Lanewise lanewise = Lanewise::automatic, std::size_t threads = 1);

  /// Steps every vehicle over [t_ns, t_ns + h_ns]. Never throws, never allocates.
  /// Returns how many could not be resolved.
  std::size_t step(std::int64_t t_ns, std::int64_t h_ns) noexcept {
    const std::size_t unresolved =
        stepper_->step({vehicles_.data(), vehicles_.data() + vehicles_.size()}, t_ns, h_ns);
    for (const Lagging& lagging : lagging_) {
      std::get<Magnetorquer<double>>(vehicles_[lagging.vehicle].torques[lagging.torque])
          .carry_to(t_ns + h_ns);
    }
    return unresolved;
  }

  /// From now on it moves from this attitude (of any length but zero) and momentum; its accounts
  /// begin anew. Between steps, like the two below.
  void set_state(std::size_t vehicle, const Quat<double>& q_IB, const Vec3<double>& H_I) noexcept;

  /// The same of any vehicle, by its rate: wheels keep their speeds. Of linked bodies the rate is the hub's: the whole
  /// turns, and its joints keep their coordinates and rates. False, and nothing is changed, when that is a motion
  /// beyond the range of double.
  bool set_motion(std::size_t vehicle, const Quat<double>& q_IB,
                  const Vec3<double>& omega_B) noexcept;

  /// Another mass distribution, wheels locked: all momenta and the attitude keep their bits, the rate changes.
  /// The accounts begin anew.
  void set_body(std::size_t vehicle, const RigidBody<double>& body) noexcept;
  /// Whether it leaves a body beside the wheels, and a motion within the range of double.
  bool can_have_body(std::size_t vehicle, const RigidBody<double>& body) const noexcept;

  /// From now on pointing() is told against this attitude (of any length but zero), in the frame of the target
  /// that it has. False when it has none. Between steps.
  bool set_target(std::size_t vehicle, const Quat<double>& attitude) noexcept;

  /// Keeps a copy of what the vehicles are now, for reset().
  void keep_start();
  /// Back to what keep_start() found, no torque commanded. False when it was never called.
  bool reset() noexcept;

  std::vector<Vehicle>& vehicles() noexcept { return vehicles_; }
  const std::vector<Vehicle>& vehicles() const noexcept { return vehicles_; }

 private:
  struct Start {
    State<double> state;
    RigidBody<double> body;
    Vec3<double> H_0;
    double E_0 = 0;
    std::vector<Sum<double>> wheel_momenta;
    std::vector<std::uint64_t> memory;
  };
  struct Lagging {
    std::size_t vehicle = 0, torque = 0;
  };

  std::vector<Vehicle> vehicles_;
  std::vector<Start> start_;
  std::vector<Lagging> lagging_;  ///< magnetorquers whose past is carried on
  std::unique_ptr<Stepper> stepper_;
};

/// Everything that is said of one vehicle at one instant; spacecraft, topics, step and time are the
/// caller's.
TelemetryRecord sample(const Vehicle& vehicle) noexcept;

/// The same of a wheel of a vehicle that turns at omega_B.
WheelRecord sample(const SpinningWheel<double>& spinning, const Vec3<double>& omega_B) noexcept;

/// Its attitude against its reference, which it has, at t_s.
PointingRecord pointing(const Vehicle& vehicle, double t_s) noexcept;

/// One of its linked bodies, and one of their joints, which the workspace was made to observe().
BodyRecord sample_body(const Vehicle& vehicle, std::size_t body) noexcept;
JointRecord sample_joint(const Vehicle& vehicle, std::size_t joint) noexcept;

/// Works out accelerations and joint loads as they are at t_ns: before sample_joint().
void observe(Vehicle& vehicle, std::int64_t t_ns) noexcept;

/// |H_I - H_0 - impulse| / max(|H_I|, |impulse|); 0 at rest, NaN when the momentum is no number.
double momentum_residual_relative(const Vehicle& vehicle) noexcept;

}  // namespace adstar::runtime
