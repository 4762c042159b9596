#include "service/trade/step_truth.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "adstar/propagator.hpp"
#include "service/trade/widened.hpp"

namespace adstar::trade {
namespace {

using TrueScheme = QuaternionRk<Fehlberg8, false>;

/// How many times the damping's own time goes into the step.
double decay_over(const scene::Spacecraft& craft, std::int64_t h_ns) {
  const RigidBody<double> body(craft.inertia_body_kg_m2);
  const auto segment =
      adstar::detail::make_segment(std::span<const Torque<double>>(craft.torques), 0);
  return decay_rate(body, segment.damping) * seconds<double>(h_ns);
}

/// In parts of `angle_rad` at most, of the turn and of the damping.
Quat<Wide> run(const scene::Spacecraft& craft, std::int64_t h_ns, double angle_rad) {
  constexpr std::int64_t kPlenty = 10'000'000;
  const RigidBody<Wide> body = widened_body(craft);
  const std::vector<Torque<Wide>> torques = widened(craft.torques);
  State<Wide> state = widened_start(craft);
  const double pieces = std::ceil(decay_over(craft, h_ns) / angle_rad);
  const std::int64_t piece_ns = std::max<std::int64_t>(
      1, h_ns / std::max<std::int64_t>(1, static_cast<std::int64_t>(pieces)));
  for (std::int64_t t_ns = 0; t_ns < h_ns; t_ns += piece_ns) {
    advance<TrueScheme>(body, state, std::span<const Torque<Wide>>(torques), t_ns,
                        std::min(piece_ns, h_ns - t_ns), {angle_rad, kPlenty, kPlenty});
  }
  return normalised(state.q_IB);
}

}  // namespace

StepTruth find_step_truth(const scene::Spacecraft& craft, std::int64_t h_ns, double goal_rad) {
  if (craft.torques.empty()) {
    return {in_closed_form(craft, h_ns).q_IB, 0};
  }
  constexpr int kHalvings = 4;
  double angle_rad = 1.0 / 8;
  StepTruth truth{run(craft, h_ns, angle_rad), 0};
  for (int i = 0; i < kHalvings; ++i) {
    angle_rad *= 0.5;
    const Quat<Wide> finer = run(craft, h_ns, angle_rad);
    truth = {finer, static_cast<double>(angle_between(truth.q_IB, finer))};
    if (truth.uncertainty_rad <= goal_rad) {
      break;
    }
  }
  return truth;
}

}  // namespace adstar::trade
