#include "service/report/torque_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

#include <Eigen/Geometry>

#include "adstar/earth/atmosphere.hpp"
#include "adstar/earth/dipole.hpp"

namespace adstar::report {
namespace {

/// What a scene need not say: the mass, and the area that is pushed with its lever about the centre of mass.
struct Guess {
  double mass_kg = 0, area_by_lever_m3 = 0;
};

/// The cube that has such an inertia, J = m s²/6, m = ρ s³; of linked bodies each the cube that has its mass.
Guess guess_of(const scene::Spacecraft& craft, double mean_moment_kg_m2) {
  constexpr double kDensity_kg_m3 = 300, kOffset = 0.1;
  if (!craft.linked) {
    const double side = std::pow(6 * mean_moment_kg_m2 / kDensity_kg_m3, 0.2);
    const double volume = side * side * side;
    return {kDensity_kg_m3 * volume, kOffset * volume};
  }
  Guess all;
  for (const multibody::BodySpec<double>& body : craft.linked->bodies) {
    const double side = std::cbrt(body.mass_kg / kDensity_kg_m3);
    all.mass_kg += body.mass_kg;
    all.area_by_lever_m3 += side * side * (kOffset * side + norm(body.x_I));
  }
  return all;
}

/// What pushes a linked body turns the whole by its arm too, as it is at the start.
double arm_of(const scene::Spacecraft& craft, std::size_t torque) {
  if (!craft.linked) {
    return 0;
  }
  const auto next = std::upper_bound(craft.first_torque.begin(), craft.first_torque.end(), torque);
  const auto body = static_cast<std::size_t>(next - craft.first_torque.begin()) - 1;
  return norm(craft.linked->bodies[body].x_I);
}

/// All that are modelled push the same way, at most. None: there is none of them.
template <class Model>
std::optional<double> bound_of_all(const scene::Spacecraft& craft) {
  std::optional<double> sum;
  for (std::size_t i = 0; i < craft.torques.size(); ++i) {
    if (const auto* const model = std::get_if<Model>(&craft.torques[i])) {
      sum = sum.value_or(0) + model->bound();
      if constexpr (requires { model->force_bound(); }) {
        *sum += model->force_bound() * arm_of(craft, i);
      }
    }
  }
  return sum;
}

/// Of all bodies about their common centre of mass, as they stand at the start.
Eigen::Matrix3d inertia_of_whole(const scene::Spacecraft& craft) {
  if (!craft.linked) {
    return craft.inertia_body_kg_m2;
  }
  Eigen::Matrix3d J = Eigen::Matrix3d::Zero();
  for (const multibody::BodySpec<double>& body : craft.linked->bodies) {
    const Quat<double>& q = body.q_IB;
    const Eigen::Matrix3d R = Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized().matrix();
    const Eigen::Vector3d x(body.x_I.x, body.x_I.y, body.x_I.z);
    J += R * body.inertia_B * R.transpose() +
         body.mass_kg * (x.squaredNorm() * Eigen::Matrix3d::Identity() - x * x.transpose());
  }
  return 0.5 * (J + J.transpose());
}

/// Never less than its bodies have about themselves, which the difference of far larger numbers may say.
double least_moment_of(const scene::Spacecraft& craft, const RigidBody<double>& whole) {
  double of_bodies = 0;
  if (craft.linked) {
    for (const multibody::BodySpec<double>& body : craft.linked->bodies) {
      of_bodies += RigidBody<double>(body.inertia_B).moments()[0];
    }
  }
  return std::max(whole.moments()[0], of_bodies);
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
  if (const auto* const kepler = std::get_if<KeplerOrbit<double>>(&*craft.orbit)) {
    return 2 * std::numbers::pi / kepler->mean_motion_rad_s;
  }
  if (const auto* const secular = std::get_if<SecularOrbit<double>>(&*craft.orbit)) {
    return 2 * std::numbers::pi / secular->anomaly_rate_rad_s;
  }
  const double r = least_distance(*craft.orbit);
  return 2 * std::numbers::pi * std::sqrt(r / gravity_of(*craft.orbit)) * r;
}

std::vector<TorqueEstimate> estimates_of(const scene::Spacecraft& craft, double horizon_s) {
  const RigidBody<double> body(inertia_of_whole(craft));
  const auto& moments = body.moments();
  const double least_moment = least_moment_of(craft, body);
  const Guess guessed = guess_of(craft, (moments[0] + moments[1] + moments[2]) / 3);
  constexpr double kDrag = 2.2, kDipole_a_m2_kg = 3e-3, kReflection = 1.5;
  std::optional<double> r;
  if (craft.orbit) {
    r = least_distance(*craft.orbit);
  }
  std::vector<TorqueEstimate> all;
  const auto add = [&](const char* name, const std::optional<double>& bound, auto guess) {
    TorqueEstimate estimate{name, bound.has_value(), bound, 0};
    if (!bound && r) {
      estimate.torque_n_m = guess();
    }
    if (estimate.torque_n_m) {
      estimate.turn_rad = turn_of(*estimate.torque_n_m, least_moment, horizon_s);
    }
    all.push_back(estimate);
  };
  using Torque_n_m = std::optional<double>;
  const bool earth = r && is_about_the_earth(*craft.orbit);
  const auto gradient = [&]() -> Torque_n_m {
    return 1.5 * gravity_of(*craft.orbit) / *r / *r / *r * (moments[2] - moments[0]);
  };
  // Of linked bodies the tide between them is nearly all of it.
  std::optional<double> modelled = bound_of_all<GravityGradient<double>>(craft);
  if (modelled && craft.linked) {
    modelled = gradient();
  }
  add(GravityGradient<double>::kName, modelled, gradient);
  add(ResidualDipole<double>::kName, bound_of_all<ResidualDipole<double>>(craft),
      [&]() -> Torque_n_m {
        return earth
                   ? Torque_n_m(kDipole_a_m2_kg * guessed.mass_kg * DipoleField<double>{}.bound(*r))
                   : std::nullopt;
      });
  add(Aerodynamic<double>::kName, bound_of_all<Aerodynamic<double>>(craft), [&]() -> Torque_n_m {
    const double v = greatest_speed(*craft.orbit);
    return earth ? Torque_n_m(0.5 * air_density(*r - kEarthRadius_m) * v * v * kDrag *
                              guessed.area_by_lever_m3)
                 : std::nullopt;
  });
  add(SolarPressure<double>::kName, bound_of_all<SolarPressure<double>>(craft),
      [&]() -> Torque_n_m {
        return earth ? Torque_n_m(kSolarPressure_N_m2 * kReflection * guessed.area_by_lever_m3)
                     : std::nullopt;
      });
  return all;
}

}  // namespace adstar::report
