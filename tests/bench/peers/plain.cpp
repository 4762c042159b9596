#include <cmath>

#include "tests/bench/peers/method.hpp"

namespace adstar::peers {

void plain_rate(const Case& the_case, const double* y, double* rate, double t_s) {
  const auto& [Jx, Jy, Jz] = the_case.moments_kg_m2;
  const double w = y[0], x = y[1], yy = y[2], z = y[3];
  const double ox = y[4], oy = y[5], oz = y[6];
  double tx = 0, ty = 0, tz = 0;
  if (the_case.torque_scale != 0) {
    tx = the_case.torque_scale * 0.02 * std::sin(0.5 * t_s);
    ty = the_case.torque_scale * 0.015 * std::cos(0.3 * t_s);
    tz = the_case.torque_scale * 0.01;
  }
  rate[0] = -0.5 * (x * ox + yy * oy + z * oz);
  rate[1] = 0.5 * (w * ox + yy * oz - z * oy);
  rate[2] = 0.5 * (w * oy - x * oz + z * ox);
  rate[3] = 0.5 * (w * oz + x * oy - yy * ox);
  rate[4] = ((Jy - Jz) * oy * oz + tx) / Jx;
  rate[5] = ((Jz - Jx) * oz * ox + ty) / Jy;
  rate[6] = ((Jx - Jy) * ox * oy + tz) / Jz;
}

End end_of(const Case& the_case, const double* y) {
  const auto& [Jx, Jy, Jz] = the_case.moments_kg_m2;
  return {normalised(Quat<double>{y[0], y[1], y[2], y[3]}), {Jx * y[4], Jy * y[5], Jz * y[6]}};
}

}  // namespace adstar::peers
