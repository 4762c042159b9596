#include "service/runtime/linked_stepper.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "adstar/integrators/all.hpp"

namespace adstar::runtime {
namespace {

std::uint32_t flags_of(const multibody::AssemblyReport<double>& report, bool edges_left) noexcept {
  const bool angle = report.unresolved_angle || report.unresolved_gap || report.at_dead_point;
  return (angle || report.lost ? kFlagUnresolvedAngle : 0U) |
         (report.lost ? kFlagAttitudeLost : 0U) |
         (report.unresolved_stiffness ? kFlagUnresolvedDamping : 0U) |
         (report.unresolved_gap || report.at_dead_point ? kFlagJointOpen : 0U) |
         (edges_left ? kFlagUnresolvedEdges : 0U);
}

template <class Tableau>
class LinkedStepper final : public Stepper {
 public:
  explicit LinkedStepper(const StepLimits& limits) : edges_(limits.edges) {
    limits_.substep_angle_rad = limits.substep_angle_rad;
    limits_.substeps = limits.substeps;
  }

  std::size_t step(Vehicles vehicles, std::int64_t t_ns, std::int64_t h_ns) noexcept override {
    std::size_t unresolved = 0;
    for (Vehicle& vehicle : vehicles) {
      bool edges_left = false;
      const auto report = multibody::advance<Tableau>(
          *vehicle.linked, std::span<const Torque<double>>(vehicle.torques), t_ns, h_ns, limits_,
          edges_, edges_left);
      vehicle.flags = flags_of(report, edges_left);
      unresolved += vehicle.flags == 0 ? 0 : 1;
      mirror(vehicle);
    }
    return unresolved;
  }

  /// The hub is the vehicle's own.
  void replace_body(std::size_t, const RigidBody<double>&) noexcept override {}

 private:
  multibody::AssemblyLimits limits_;
  std::int64_t edges_;
};

}  // namespace

std::unique_ptr<multibody::LinkedFlight<double>> make_linked(const scene::Spacecraft& craft) {
  if (!craft.linked) {
    return nullptr;
  }
  const scene::LinkedBodies& linked = *craft.linked;
  auto flight = std::make_unique<multibody::LinkedFlight<double>>(
      multibody::Assembly<double>(linked.bodies, linked.joints, {linked.formulation, {}}));
  count_from(flight->assembly, flight->state,
             std::span<const std::array<double, 3>>(linked.start_coordinates));
  flight->motors = linked.motors;
  flight->first_torque = craft.first_torque;
  const bool gravity =
      std::any_of(craft.torques.begin(), craft.torques.end(), [](const Torque<double>& torque) {
        return std::holds_alternative<GravityGradient<double>>(torque);
      });
  if (gravity) {
    flight->tide = {*craft.orbit};
  }
  return flight;
}

void mirror(Vehicle& vehicle) noexcept {
  const multibody::LinkedFlight<double>& flight = *vehicle.linked;
  vehicle.state.q_IB = flight.state.bodies.front().q_IB;
  vehicle.state.H_I = multibody::total_momentum(flight.assembly, flight.state).H_I;
  vehicle.state.impulse_I = flight.state.impulse_I;
  vehicle.state.work = flight.state.work;
}

std::unique_ptr<Stepper> make_linked_stepper(std::string_view scheme, const StepLimits& limits) {
  std::unique_ptr<Stepper> stepper;
  with_scheme(scheme, [&](auto s) {
    if constexpr (multibody::LinksBodies<decltype(s)>) {
      stepper = std::make_unique<LinkedStepper<typename decltype(s)::Nodes>>(limits);
    }
  });
  if (stepper == nullptr) {
    throw std::invalid_argument("scheme '" + std::string(scheme) + "' does not step linked bodies");
  }
  return stepper;
}

}  // namespace adstar::runtime
