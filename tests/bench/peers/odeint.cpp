#include <array>

#include <boost/numeric/odeint.hpp>

#include "tests/bench/peers/method.hpp"

namespace adstar::peers {
namespace {

namespace odeint = boost::numeric::odeint;
using Y = std::array<double, 7>;

template <class Stepper>
Method fixed_step(const char* name) {
  return {name, false, false, [](const Case& the_case, int steps) {
            Stepper stepper;
            Y y{1,
                0,
                0,
                0,
                the_case.omega_B_rad_s.x,
                the_case.omega_B_rad_s.y,
                the_case.omega_B_rad_s.z};
            const auto rate = [&](const Y& at, Y& dydt, double t) {
              plain_rate(the_case, at.data(), dydt.data(), t);
            };
            const double h = the_case.horizon_s / steps;
            for (int n = 0; n < steps; ++n) {
              stepper.do_step(rate, y, n * h, h);
            }
            return end_of(the_case, y.data());
          }};
}

}  // namespace

std::vector<Method> odeint_methods() {
  return {fixed_step<odeint::runge_kutta4<Y>>("odeint_runge_kutta4"),
          fixed_step<odeint::runge_kutta_dopri5<Y>>("odeint_dopri5"),
          fixed_step<odeint::runge_kutta_fehlberg78<Y>>("odeint_fehlberg78")};
}

}  // namespace adstar::peers
