#include "adstar/integrators/all.hpp"
#include "service/runtime/fleet.hpp"
#include "service/scene/scene.hpp"
#include "tests/bench/peers/body_of_case.hpp"

namespace adstar::peers {

scene::Spacecraft spacecraft_of(const Case& the_case) {
  constexpr double kHalfPi = 1.5707963267948966;
  const double s = the_case.torque_scale;
  scene::Spacecraft craft;
  craft.name = the_case.name;
  craft.inertia_body_kg_m2 = to_eigen(the_case.moments_kg_m2).asDiagonal();
  const RigidBody<double> body(craft.inertia_body_kg_m2);
  craft.initial = make_state(Quat<double>{}, body.momentum(the_case.omega_B_rad_s));
  if (s != 0) {
    craft.torques.emplace_back(
        Harmonic<double>{Frame::body, {s * 0.02, s * 0.015, 0}, {0.5, 0.3, 0}, {0, kHalfPi, 0}});
    craft.torques.emplace_back(Constant<double>{Frame::body, {0, 0, s * 0.01}});
  }
  return craft;
}

std::vector<Method> own_schemes() {
  std::vector<Method> methods;
  for (const std::string_view name : scheme_names()) {
    bool exact = false;
    with_scheme(name, [&](auto scheme) { exact = decltype(scheme)::kOrder == kExactOrder; });
    methods.push_back({std::string(name), claims_of(name).free_only, exact,
                       [name](const Case& the_case, int steps) {
                         runtime::Fleet fleet({spacecraft_of(the_case)}, name, StepLimits{});
                         const auto h_ns =
                             static_cast<std::int64_t>(the_case.horizon_s * 1e9) / steps;
                         for (int n = 0; n < steps; ++n) {
                           fleet.step(n * h_ns, h_ns);
                         }
                         const State<double>& state = fleet.vehicles().front().state;
                         return End{normalised(state.q_IB), body_momentum(state)};
                       }});
  }
  return methods;
}

}  // namespace adstar::peers
