#pragma once
// One step of one vehicle on its own, and what its flags say afterwards.

#include "adstar/propagator.hpp"
#include "service/runtime/fleet.hpp"

namespace adstar::runtime {

/// Sets the flags; returns whether the step was resolved.
[[gnu::always_inline]] inline bool note(Vehicle& vehicle, const StepReport& report) noexcept {
  vehicle.flags = 0;
  if (report.resolved()) [[likely]] {
    return true;
  }
  vehicle.flags = (report.unresolved_angle ? kFlagUnresolvedAngle : 0U) |
                  (report.unresolved_edges ? kFlagUnresolvedEdges : 0U) |
                  (report.unresolved_damping ? kFlagUnresolvedDamping : 0U) |
                  (report.at_light_axis ? kFlagLightAxis : 0U) |
                  (report.at_separatrix ? kFlagSeparatrix : 0U) |
                  (report.attitude_lost ? kFlagAttitudeLost : 0U);
  return false;
}

/// The same after one step.
template <class Scheme>
bool step_vehicle(const BodyOf<Scheme, double>& body, Vehicle& vehicle, std::int64_t t_ns,
                  std::int64_t h_ns, const StepLimits& limits) noexcept {
  return note(vehicle,
              advance<Scheme, double>(body, vehicle.state, vehicle.torques, t_ns, h_ns, limits));
}

/// The same of one that names no torque; what is alike for all such is worked out before: h, and limits_for<Scheme>().
template <class Scheme>
[[gnu::always_inline]] inline bool step_free_vehicle(const BodyOf<Scheme, double>& body,
                                                     Vehicle& vehicle, const double& h_s,
                                                     const StepLimits& limits) noexcept {
  return note(vehicle,
              adstar::detail::advance_free<Scheme, double>(body, vehicle.state, h_s, limits));
}

}  // namespace adstar::runtime
