#include "service/trade/grid.hpp"

#include <algorithm>
#include <cmath>

#include "adstar/bodies/rigid_body.hpp"
#include "adstar/integrators/guard.hpp"

namespace adstar::trade {

std::vector<std::int64_t> instants_of(std::int64_t horizon_ns) {
  constexpr std::int64_t kInstants = 10;
  std::int64_t parts = std::min(kInstants, horizon_ns);
  while (horizon_ns % parts != 0) {
    --parts;
  }
  std::vector<std::int64_t> instants;
  for (std::int64_t i = 1; i <= parts; ++i) {
    instants.push_back(i * (horizon_ns / parts));
  }
  return instants;
}

double fastest_rad_s(const std::vector<scene::Spacecraft>& spacecraft) {
  double fastest = 0;
  for (const scene::Spacecraft& craft : spacecraft) {
    const RigidBody<double> body(craft.inertia_body_kg_m2);
    fastest = std::max(
        fastest, std::sqrt(angular_speed_bound_squared(body, body_momentum(craft.initial), 0.0)));
  }
  return fastest;
}

std::vector<std::int64_t> steps_of(const std::vector<scene::Spacecraft>& spacecraft,
                                   const std::vector<std::int64_t>& instants_ns) {
  constexpr double kLeastTurn = 3e-3, kMostTurn = 6;
  constexpr std::int64_t kDigits[] = {800, 500, 400, 250, 200, 125, 100};
  const std::int64_t stretch_ns = instants_ns.front();
  const double fastest = fastest_rad_s(spacecraft);
  if (fastest == 0) {
    return {std::max<std::int64_t>(1, stretch_ns / 10)};
  }
  std::vector<std::int64_t> steps;
  constexpr std::int64_t kLargestDecade = 10'000'000'000'000'000;
  for (std::int64_t decade = kLargestDecade; decade > 0; decade /= 10) {
    for (const std::int64_t digits : kDigits) {
      if (decade * digits % 100 != 0) {
        continue;
      }
      const std::int64_t h_ns = decade * digits / 100;
      const double turn = fastest * static_cast<double>(h_ns) * 1e-9;
      if (turn >= kLeastTurn && turn <= kMostTurn && h_ns <= stretch_ns && stretch_ns % h_ns == 0) {
        steps.push_back(h_ns);
      }
    }
  }
  return steps;
}

}  // namespace adstar::trade
