#include "service/runtime/fleet.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "adstar/integrators/all.hpp"
#include "service/runtime/batch_stepper.hpp"
#include "service/runtime/linked_stepper.hpp"
#include "service/runtime/model_memory.hpp"
#include "service/runtime/threaded_stepper.hpp"
#include "service/runtime/vehicle_step.hpp"
#include "service/runtime/wheel_stepper.hpp"

namespace adstar::runtime {
namespace {

/// What the residuals are measured from: here and now.
void open_accounts(Vehicle& vehicle) noexcept {
  vehicle.state.impulse_I = {};
  vehicle.state.work = {};
  share_accounts(vehicle);
  vehicle.H_0 = vehicle.state.H_I.value();
  vehicle.E_0 = energy_of(vehicle);
}

/// The scene's own condition for a motion: its energy and momentum are finite.
bool can_turn(const RigidBody<double>& body, const Vec3<double>& Pi_B) noexcept {
  return std::isfinite(angular_speed_bound_squared(body, Pi_B, 0.0));
}

/// No moment of inertia of the whole is larger [kg m²].
double moment_bound(const multibody::LinkedFlight<double>& flight) noexcept {
  double sum = 0;
  for (std::size_t i = 0; i < flight.state.bodies.size(); ++i) {
    const multibody::Body<double>& body = flight.assembly.bodies()[i];
    sum += body.mass * squared_norm(flight.state.bodies[i].x_I.value()) + body.rigid.moments()[2];
  }
  return sum;
}

template <class Scheme>
class SchemeStepper final : public Stepper {
 public:
  SchemeStepper(std::span<const Vehicle> vehicles, const StepLimits& limits)
      : limits_(limits_for<Scheme>(limits)) {
    bodies_.reserve(vehicles.size());
    for (const Vehicle& vehicle : vehicles) {
      bodies_.emplace_back(vehicle.body);
    }
  }

  std::size_t step(Vehicles vehicles, std::int64_t t_ns, std::int64_t h_ns) noexcept override {
    const double h_s = seconds<double>(h_ns);
    std::size_t unresolved = 0;
    const BodyOf<Scheme, double>* body = bodies_.data();
    for (Vehicle& vehicle : vehicles) {
      const bool resolved = vehicle.torques.empty()
                                ? step_free_vehicle<Scheme>(*body, vehicle, h_s, limits_)
                                : step_vehicle<Scheme>(*body, vehicle, t_ns, h_ns, limits_);
      unresolved += resolved ? 0 : 1;
      ++body;
    }
    return unresolved;
  }

  void replace_body(std::size_t vehicle, const RigidBody<double>& body) noexcept override {
    bodies_[vehicle] = BodyOf<Scheme, double>(body);
  }

 private:
  StepLimits limits_;
  std::vector<BodyOf<Scheme, double>> bodies_;
};

/// The instruction set asked for; none to step each vehicle alone.
std::optional<batch::InstructionSet> chosen(Lanewise lanewise, std::string_view scheme,
                                            std::size_t vehicles) {
  if (lanewise == Lanewise::alone) {
    return std::nullopt;
  }
  if (lanewise == Lanewise::automatic) {
    return batch::best_for(scheme, vehicles);
  }
  const batch::InstructionSet set = lanewise == Lanewise::sse2   ? batch::InstructionSet::sse2
                                    : lanewise == Lanewise::avx2 ? batch::InstructionSet::avx2
                                                                 : batch::InstructionSet::avx512;
  if (!batch::runs_here(set) || batch::find_kernels(scheme, set) == nullptr) {
    throw std::invalid_argument(std::string(batch::name_of(set)) + " lanes of scheme '" +
                                std::string(scheme) + "' do not run here");
  }
  return set;
}

std::unique_ptr<Stepper> make_plain_stepper(std::span<const Vehicle> vehicles,
                                            std::string_view scheme, const StepLimits& limits,
                                            Lanewise lanewise) {
  if (const auto set = chosen(lanewise, scheme, vehicles.size())) {
    return make_batch_stepper(vehicles, scheme, limits, *set);
  }
  std::unique_ptr<Stepper> stepper;
  if (!with_scheme(scheme, [&](auto s) {
        stepper = std::make_unique<SchemeStepper<decltype(s)>>(vehicles, limits);
      })) {
    throw std::invalid_argument("unknown scheme '" + std::string(scheme) + "'");
  }
  return stepper;
}

enum class Kind { plain, wheels, linked };

Kind kind_of(const Vehicle& vehicle) noexcept {
  return vehicle.linked != nullptr   ? Kind::linked
         : vehicle.wheels != nullptr ? Kind::wheels
                                     : Kind::plain;
}

/// Neighbours of one kind by a stepper of their own: plain ones fill lanes as ever.
class RunsStepper final : public Stepper {
 public:
  RunsStepper(std::span<const Vehicle> vehicles, std::string_view scheme, const StepLimits& limits,
              Lanewise lanewise) {
    for (std::size_t first = 0; first < vehicles.size();) {
      std::size_t end = first + 1;
      const Kind kind = kind_of(vehicles[first]);
      while (end < vehicles.size() && kind_of(vehicles[end]) == kind) {
        ++end;
      }
      const std::span<const Vehicle> run = vehicles.subspan(first, end - first);
      runs_.push_back({first, run.size(),
                       kind == Kind::linked   ? make_linked_stepper(scheme, limits)
                       : kind == Kind::wheels ? make_wheel_stepper(scheme, limits)
                                              : make_plain_stepper(run, scheme, limits, lanewise)});
      first = end;
    }
  }

  std::size_t step(Vehicles vehicles, std::int64_t t_ns, std::int64_t h_ns) noexcept override {
    std::size_t unresolved = 0;
    for (Run& run : runs_) {
      Vehicle* const first = vehicles.first + run.first;
      unresolved += run.stepper->step({first, first + run.count}, t_ns, h_ns);
    }
    return unresolved;
  }

  void replace_body(std::size_t vehicle, const RigidBody<double>& body) noexcept override {
    for (Run& run : runs_) {
      if (vehicle - run.first < run.count) {
        run.stepper->replace_body(vehicle - run.first, body);
      }
    }
  }

 private:
  struct Run {
    std::size_t first = 0, count = 0;
    std::unique_ptr<Stepper> stepper;
  };
  std::vector<Run> runs_;
};

std::unique_ptr<Stepper> make_stepper(std::span<const Vehicle> vehicles, std::string_view scheme,
                                      const StepLimits& limits, Lanewise lanewise) {
  const bool plain = std::none_of(vehicles.begin(), vehicles.end(),
                                  [](const Vehicle& v) { return kind_of(v) != Kind::plain; });
  return plain ? make_plain_stepper(vehicles, scheme, limits, lanewise)
               : std::make_unique<RunsStepper>(vehicles, scheme, limits, lanewise);
}

std::unique_ptr<Wheels> make_wheels(const scene::Spacecraft& craft) {
  if (craft.wheels.empty()) {
    return nullptr;
  }
  std::vector<SpinningWheel<double>> spinning = scene::spinning_wheels(craft);
  const RigidBody<double> hub =
      hub_of(RigidBody<double>(craft.inertia_body_kg_m2), std::span(std::as_const(spinning)));
  return std::make_unique<Wheels>(Wheels{hub, std::move(spinning)});
}

std::unique_ptr<Reference> make_reference(const scene::Spacecraft& craft) {
  return craft.orbit || craft.target
             ? std::make_unique<Reference>(Reference{craft.orbit, craft.target})
             : nullptr;
}

}  // namespace

Vec3<double> angular_velocity_of(const Vehicle& vehicle) noexcept {
  if (vehicle.linked != nullptr) {
    return multibody::angular_velocity(vehicle.linked->assembly, vehicle.linked->state, 0);
  }
  const Vec3<double> Pi_B = body_momentum(vehicle.state);
  return vehicle.wheels == nullptr
             ? vehicle.body.angular_velocity(Pi_B)
             : angular_velocity(vehicle.wheels->hub, vehicle.wheels->all(), Pi_B);
}

double energy_of(const Vehicle& vehicle) noexcept {
  if (vehicle.linked != nullptr) {
    return multibody::energy(vehicle.linked->assembly, vehicle.linked->state).total();
  }
  const Vec3<double> Pi_B = body_momentum(vehicle.state);
  return vehicle.wheels == nullptr ? vehicle.body.energy(Pi_B)
                                   : energy(vehicle.wheels->hub, vehicle.wheels->all(), Pi_B);
}

Fleet::Fleet(const std::vector<scene::Spacecraft>& spacecraft, std::string_view scheme,
             const StepLimits& limits, Lanewise lanewise, std::size_t threads) {
  vehicles_.reserve(spacecraft.size());
  for (const scene::Spacecraft& craft : spacecraft) {
    Vehicle vehicle{craft.initial,
                    craft.torques,
                    0,
                    RigidBody<double>(craft.inertia_body_kg_m2),
                    {},
                    0,
                    make_wheels(craft),
                    make_reference(craft),
                    make_linked(craft)};
    if (vehicle.linked != nullptr) {
      mirror(vehicle);
    }
    open_accounts(vehicle);
    for (std::size_t k = 0; k < vehicle.torques.size(); ++k) {
      if (std::holds_alternative<Magnetorquer<double>>(vehicle.torques[k])) {
        lagging_.push_back({vehicles_.size(), k});
      }
    }
    vehicles_.push_back(std::move(vehicle));
  }
  stepper_ = make_threaded_stepper(vehicles_, threads, [&](std::span<const Vehicle> part) {
    return make_stepper(part, scheme, limits, lanewise);
  });
}

void Fleet::set_state(std::size_t vehicle, const Quat<double>& q_IB,
                      const Vec3<double>& H_I) noexcept {
  vehicles_[vehicle].state = make_state(q_IB, H_I);
  open_accounts(vehicles_[vehicle]);
}

bool Fleet::set_motion(std::size_t vehicle, const Quat<double>& q_IB,
                       const Vec3<double>& omega_B) noexcept {
  Vehicle& moved = vehicles_[vehicle];
  if (moved.linked != nullptr) {
    if (!can_turn(moved.body, moved.body.momentum(omega_B)) ||
        !std::isfinite(moment_bound(*moved.linked) * squared_norm(omega_B))) {
      return false;
    }
    turn_to(moved.linked->assembly, moved.linked->state, normalised(q_IB), omega_B);
    mirror(moved);
    open_accounts(moved);
    return true;
  }
  Wheels* const wheels = moved.wheels.get();
  const Vec3<double> rates = wheels == nullptr ? omega_B : angular_velocity_of(moved);
  Vec3<double> Pi_B = moved.body.momentum(omega_B);
  if (wheels != nullptr) {
    for (const SpinningWheel<double>& spinning : wheels->spinning) {
      Pi_B = Pi_B +
             (spinning.wheel.spin_inertia_kg_m2 * spinning.speed(rates)) * spinning.wheel.axis_B;
    }
  }
  if (!can_turn(moved.body, Pi_B)) {
    return false;
  }
  if (wheels != nullptr) {
    for (SpinningWheel<double>& spinning : wheels->spinning) {
      spinning.keep_speed(rates, omega_B);
    }
  }
  set_state(vehicle, q_IB, rotate(normalised(q_IB), Pi_B));
  return true;
}

bool Fleet::can_have_body(std::size_t vehicle, const RigidBody<double>& body) const noexcept {
  const Vehicle& asked = vehicles_[vehicle];
  return asked.linked == nullptr && can_turn(body, body_momentum(asked.state)) &&
         (asked.wheels == nullptr || is_body_beside_wheels(hub_of(body, asked.wheels->all())));
}

void Fleet::set_body(std::size_t vehicle, const RigidBody<double>& body) noexcept {
  Vehicle& changed = vehicles_[vehicle];
  changed.body = body;
  if (changed.wheels != nullptr) {
    changed.wheels->hub = hub_of(body, changed.wheels->all());
  }
  for (Torque<double>& torque : changed.torques) {
    if (auto* const gravity = std::get_if<GravityGradient<double>>(&torque)) {
      gravity->act_on(body);
    }
  }
  stepper_->replace_body(vehicle, body);
  open_accounts(changed);
}

bool Fleet::set_target(std::size_t vehicle, const Quat<double>& attitude) noexcept {
  Reference* const reference = vehicles_[vehicle].reference.get();
  if (reference == nullptr || !reference->target) {
    return false;
  }
  reference->target->attitude = normalised(attitude);
  return true;
}

void Fleet::keep_start() {
  start_.reserve(vehicles_.size());
  for (const Vehicle& vehicle : vehicles_) {
    std::vector<Sum<double>> momenta;
    if (vehicle.wheels != nullptr) {
      for (const SpinningWheel<double>& spinning : vehicle.wheels->spinning) {
        momenta.push_back(spinning.h);
      }
    }
    std::vector<std::uint64_t> memory(memory_words(vehicle));
    save_memory(vehicle, memory.data());
    start_.push_back({vehicle.state, vehicle.body, vehicle.H_0, vehicle.E_0, std::move(momenta),
                      std::move(memory)});
  }
}

bool Fleet::reset() noexcept {
  if (start_.size() != vehicles_.size()) {
    return false;
  }
  for (std::size_t i = 0; i < vehicles_.size(); ++i) {
    Vehicle& vehicle = vehicles_[i];
    const Start& start = start_[i];
    vehicle.flags = 0;
    if (start.body.inertia() != vehicle.body.inertia()) {
      set_body(i, start.body);
    }
    vehicle.state = start.state;
    for (std::size_t k = 0; k < start.wheel_momenta.size(); ++k) {
      SpinningWheel<double>& spinning = vehicle.wheels->spinning[k];
      spinning.h = start.wheel_momenta[k];
      spinning.motor.intervals = 0;
      spinning.order = spinning.motor.standing;
    }
    if (vehicle.linked != nullptr) {
      for (multibody::CoordinateMotor<double>& motor : vehicle.linked->motors) {
        motor.window.intervals = 0;
      }
    }
    vehicle.H_0 = start.H_0;
    vehicle.E_0 = start.E_0;
    for (Torque<double>& torque : vehicle.torques) {
      std::visit(
          [](auto& model) {
            if constexpr (requires { model.intervals; }) {
              model.intervals = 0;
            }
          },
          torque);
    }
    load_memory(vehicle, start.memory.data());
    share_accounts(vehicle);
  }
  return true;
}

}  // namespace adstar::runtime
