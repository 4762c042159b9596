#include "service/report/torque_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

#include "adstar/earth/atmosphere.hpp"
#include "adstar/earth/dipole.hpp"

namespace adstar::report {
namespace {

/// Side and mass of the cube that has such an inertia: J = m s²/6, m = ρ s³.
struct Cube {
  double side_m = 0, mass_kg = 0;
};

Cube cube_of(double moment_kg_m2) {
  constexpr double kDensity_kg_m3 = 300;
  const double side = std::pow(6 * moment_kg_m2 / kDensity_kg_m3, 0.2);
  return {side, kDensity_kg_m3 * side * side * side};
}

template <class Model>
const Model* find(const scene::Spacecraft& craft) {
  for (const Torque<double>& torque : craft.torques) {
    if (const auto* const model = std::get_if<Model>(&torque)) {
      return model;
    }
  }
  return nullptr;
}

double turn_of(double torque_n_m, double least_moment, double horizon_s) {
  return std::min(std::numbers::pi, 0.5 * torque_n_m / least_moment * horizon_s * horizon_s);
}

}  // namespace

double horizon_of(const scene::Simulation& simulation, const scene::Spacecraft& craft) {
  constexpr double kHour_s = 3600;
  if (simulation.duration_ns) {
    return seconds<double>(*simulation.duration_ns);
  }
  if (!craft.orbit) {
    return kHour_s;
  }
  const double r = least_distance(*craft.orbit);
  return 2 * std::numbers::pi * std::sqrt(r / gravity_of(*craft.orbit)) * r;
}

std::vector<TorqueEstimate> estimates_of(const scene::Spacecraft& craft, double horizon_s) {
  const RigidBody<double> body(craft.inertia_body_kg_m2);
  const auto& moments = body.moments();
  const Cube cube = cube_of((moments[0] + moments[1] + moments[2]) / 3);
  constexpr double kOffset = 0.1, kDrag = 2.2, kDipole_a_m2_kg = 3e-3, kReflection = 1.5;
  const double lever_area = kOffset * cube.side_m * cube.side_m * cube.side_m;
  std::optional<double> r;
  if (craft.orbit) {
    r = least_distance(*craft.orbit);
  }
  std::vector<TorqueEstimate> all;
  const auto add = [&](const char* name, const auto* model, auto guess) {
    TorqueEstimate estimate{name, model != nullptr, std::nullopt, 0};
    if (model != nullptr) {
      estimate.torque_n_m = model->bound();
    } else if (r) {
      estimate.torque_n_m = guess();
    }
    if (estimate.torque_n_m) {
      estimate.turn_rad = turn_of(*estimate.torque_n_m, moments[0], horizon_s);
    }
    all.push_back(estimate);
  };
  add(GravityGradient<double>::kName, find<GravityGradient<double>>(craft),
      [&] { return 1.5 * gravity_of(*craft.orbit) / *r / *r / *r * (moments[2] - moments[0]); });
  add(ResidualDipole<double>::kName, find<ResidualDipole<double>>(craft),
      [&] { return kDipole_a_m2_kg * cube.mass_kg * DipoleField<double>{}.bound(*r); });
  add(Aerodynamic<double>::kName, find<Aerodynamic<double>>(craft), [&] {
    const double v = greatest_speed(*craft.orbit);
    return 0.5 * air_density(*r - kEarthRadius_m) * v * v * kDrag * lever_area;
  });
  add(SolarPressure<double>::kName, find<SolarPressure<double>>(craft),
      [&] { return kSolarPressure_N_m2 * kReflection * lever_area; });
  return all;
}

}  // namespace adstar::report
