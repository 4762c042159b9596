#include "service/runtime/fleet.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "adstar/integrators/all.hpp"
#include "service/runtime/batch_stepper.hpp"
#include "service/runtime/threaded_stepper.hpp"
#include "service/runtime/vehicle_step.hpp"

namespace adstar::runtime {
namespace {

Vec3<double> momentum_residual(const Vehicle& vehicle) noexcept {
  return (vehicle.state.H_I.value() - vehicle.H_0) - vehicle.state.impulse_I.value();
}

template <std::size_t N>
void assign(std::array<double, N>& target, const Vec3<double>& v) noexcept {
  target = {v.x, v.y, v.z};
}

/// What the residuals are measured from: here and now.
void open_accounts(Vehicle& vehicle) noexcept {
  vehicle.state.impulse_I = {};
  vehicle.state.work = {};
  vehicle.H_0 = vehicle.state.H_I.value();
  vehicle.E_0 = vehicle.body.energy(body_momentum(vehicle.state));
}

template <class Scheme>
class SchemeStepper final : public Stepper {
 public:
  explicit SchemeStepper(std::span<const Vehicle> vehicles) {
    bodies_.reserve(vehicles.size());
    for (const Vehicle& vehicle : vehicles) {
      bodies_.emplace_back(vehicle.body);
    }
  }

  std::size_t step(std::span<Vehicle> vehicles, std::int64_t t_ns, std::int64_t h_ns,
                   const StepLimits& limits) noexcept override {
    std::size_t unresolved = 0;
    for (std::size_t i = 0; i < vehicles.size(); ++i) {
      unresolved += step_vehicle<Scheme>(bodies_[i], vehicles[i], t_ns, h_ns, limits) ? 0 : 1;
    }
    return unresolved;
  }

  void replace_body(std::size_t vehicle, const RigidBody<double>& body) noexcept override {
    bodies_[vehicle] = BodyOf<Scheme, double>(body);
  }

 private:
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

std::unique_ptr<Stepper> make_stepper(std::span<const Vehicle> vehicles, std::string_view scheme,
                                      Lanewise lanewise) {
  if (const auto set = chosen(lanewise, scheme, vehicles.size())) {
    return make_batch_stepper(vehicles, scheme, *set);
  }
  std::unique_ptr<Stepper> stepper;
  if (!with_scheme(scheme, [&](auto s) {
        stepper = std::make_unique<SchemeStepper<decltype(s)>>(vehicles);
      })) {
    throw std::invalid_argument("unknown scheme '" + std::string(scheme) + "'");
  }
  return stepper;
}

}  // namespace

Fleet::Fleet(const std::vector<scene::Spacecraft>& spacecraft, std::string_view scheme,
             const StepLimits& limits, Lanewise lanewise, std::size_t threads)
    : limits_(limits) {
  vehicles_.reserve(spacecraft.size());
  for (const scene::Spacecraft& craft : spacecraft) {
    Vehicle vehicle{
        craft.initial, craft.torques, 0, RigidBody<double>(craft.inertia_body_kg_m2), {}};
    open_accounts(vehicle);
    vehicles_.push_back(std::move(vehicle));
  }
  stepper_ = make_threaded_stepper(vehicles_, threads, [&](std::span<const Vehicle> part) {
    return make_stepper(part, scheme, lanewise);
  });
}

void Fleet::set_state(std::size_t vehicle, const Quat<double>& q_IB,
                      const Vec3<double>& H_I) noexcept {
  vehicles_[vehicle].state = make_state(q_IB, H_I);
  open_accounts(vehicles_[vehicle]);
}

void Fleet::set_body(std::size_t vehicle, const RigidBody<double>& body) noexcept {
  vehicles_[vehicle].body = body;
  stepper_->replace_body(vehicle, body);
  open_accounts(vehicles_[vehicle]);
}

void Fleet::keep_start() {
  start_.reserve(vehicles_.size());
  for (const Vehicle& vehicle : vehicles_) {
    start_.push_back({vehicle.state, vehicle.body, vehicle.H_0, vehicle.E_0});
  }
}

bool Fleet::reset() noexcept {
  if (start_.size() != vehicles_.size()) {
    return false;
  }
  for (std::size_t i = 0; i < vehicles_.size(); ++i) {
    Vehicle& vehicle = vehicles_[i];
    const Start& start = start_[i];
    vehicle.state = start.state;
    vehicle.flags = 0;
    vehicle.H_0 = start.H_0;
    vehicle.E_0 = start.E_0;
    vehicle.body = start.body;
    stepper_->replace_body(i, start.body);
    for (Torque<double>& torque : vehicle.torques) {
      if (auto* const commanded = std::get_if<Commanded<double>>(&torque)) {
        commanded->intervals = 0;
      }
    }
  }
  return true;
}

TelemetryRecord sample(const Vehicle& vehicle) noexcept {
  TelemetryRecord record;
  const State<double>& state = vehicle.state;
  const Vec3<double> Pi_B = body_momentum(state);
  record.flags = vehicle.flags;
  record.q_IB = {state.q_IB.w, state.q_IB.x, state.q_IB.y, state.q_IB.z};
  assign(record.omega_B_rad_s, vehicle.body.angular_velocity(Pi_B));
  assign(record.H_I_n_m_s, state.H_I.value());
  assign(record.Pi_B_n_m_s, Pi_B);
  record.rotational_energy_j = vehicle.body.energy(Pi_B);
  record.work_j = state.work.value;
  record.energy_residual_j = (record.rotational_energy_j - vehicle.E_0) - record.work_j;
  assign(record.momentum_residual_I_n_m_s, momentum_residual(vehicle));
  return record;
}

double momentum_residual_relative(const Vehicle& vehicle) noexcept {
  const double scale =
      std::max(norm(vehicle.state.H_I.value()), norm(vehicle.state.impulse_I.value()));
  return scale == 0 ? 0 : norm(momentum_residual(vehicle)) / scale;
}

}  // namespace adstar::runtime
