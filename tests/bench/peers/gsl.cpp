#include <stdexcept>

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include "tests/bench/peers/method.hpp"

namespace adstar::peers {
namespace {

int rate(double t, const double y[], double dydt[], void* the_case) {
  plain_rate(*static_cast<const Case*>(the_case), y, dydt, t);
  return GSL_SUCCESS;
}

}  // namespace

std::vector<Method> gsl_methods() {
  return {{"gsl_rk8pd", false, false, [](const Case& the_case, int steps) {
             gsl_odeiv2_system system{rate, nullptr, 7, const_cast<Case*>(&the_case)};
             gsl_odeiv2_step* stepper = gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, 7);
             double y[] = {1,
                           0,
                           0,
                           0,
                           the_case.omega_B_rad_s.x,
                           the_case.omega_B_rad_s.y,
                           the_case.omega_B_rad_s.z};
             double error[7];
             const double h = the_case.horizon_s / steps;
             for (int n = 0; n < steps; ++n) {
               if (gsl_odeiv2_step_apply(stepper, n * h, h, y, error, nullptr, nullptr, &system) !=
                   GSL_SUCCESS) {
                 throw std::runtime_error("gsl_odeiv2_step_apply failed");
               }
             }
             gsl_odeiv2_step_free(stepper);
             return end_of(the_case, y);
           }}};
}

}  // namespace adstar::peers
