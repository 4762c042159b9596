#pragma once
// What the peers benchmark runs: a way to carry one body through a case in n equal steps.

#include <functional>
#include <string>
#include <vector>

#include "adstar/attitude.hpp"
#include "adstar/vec3.hpp"

namespace adstar::peers {

/// One rigid body with principal moments, from q = 1, under
/// tau_B(t) = scale · (0.02 sin 0.5 t, 0.015 cos 0.3 t, 0.01) N m, or free (scale 0).
struct Case {
  const char* name;
  Vec3<double> moments_kg_m2, omega_B_rad_s;
  double torque_scale;
  double horizon_s;
};

struct End {
  Quat<double> q_IB;
  Vec3<double> Pi_B;  ///< [N m s]
};

struct Method {
  std::string name;
  bool free_only = false;
  bool exact = false;  ///< one step of any length will do
  std::function<End(const Case&, int steps)> run;
};

/// This library's schemes, as `adstar propagate` runs them: scene torques, edges, guard and all.
std::vector<Method> own_schemes();
/// Boost.odeint on (q, omega); the peers that Debian packages, where they were found at build time.
std::vector<Method> odeint_methods();
std::vector<Method> gsl_methods();
std::vector<Method> sundials_methods();

/// The plain equations that all peers integrate: y = (q, omega), omega' = J⁻¹ (J omega × omega +
/// tau), as a user would write them.
void plain_rate(const Case& the_case, const double* y, double* rate, double t_s);

/// From (q, omega).
End end_of(const Case& the_case, const double* y);

}  // namespace adstar::peers
