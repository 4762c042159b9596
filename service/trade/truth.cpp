#include "service/trade/truth.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include <fmt/format.h>

#include "adstar/gyrostat.hpp"
#include "service/trade/widened.hpp"

namespace adstar::trade {
namespace {

using WideWheels = std::vector<SpinningWheel<Wide>>;

TrueState true_state(const RigidBody<Wide>& hub, const WideWheels& wheels,
                     const State<Wide>& state) {
  return {state.q_IB, state.H_I.value(), energy(hub, std::span(wheels), body_momentum(state))};
}

std::vector<TrueState> in_closed_form(const scene::Spacecraft& craft,
                                      const std::vector<std::int64_t>& times_ns) {
  const RigidBody<Wide> body = widened_body(craft);
  std::vector<TrueState> states;
  for (const std::int64_t t_ns : times_ns) {
    states.push_back(true_state(body, {}, trade::in_closed_form(craft, t_ns)));
  }
  return states;
}

/// `steps` between one instant and the next.
std::vector<TrueState> by_small_steps(const scene::Spacecraft& craft,
                                      const std::vector<std::int64_t>& times_ns, std::int64_t h_ns,
                                      const std::function<void(std::int64_t)>& look) {
  constexpr std::int64_t kLookEvery = 256;
  WideWheels wheels = widened_wheels(craft);
  const RigidBody<Wide> hub =
      hub_of(widened_body(craft), std::span<const SpinningWheel<Wide>>(wheels));
  const std::vector<Torque<Wide>> torques = widened(craft.torques);
  State<Wide> state = widened_start(craft);
  std::vector<TrueState> states;
  std::int64_t t_ns = 0, n = 0;
  StepLimits limits;
  limits.substeps = 1'000'000;
  limits.edges = 1'000'000;
  for (const std::int64_t end_ns : times_ns) {
    while (t_ns < end_ns) {
      const std::int64_t part_ns = std::min(h_ns, end_ns - t_ns);
      const std::span<const Torque<Wide>> all(torques);
      if (wheels.empty()) {
        advance<CoadjointFehlberg8>(hub, state, all, t_ns, part_ns, limits);
      } else {
        advance<CoadjointFehlberg8, Wide>(hub, state, wheels, all, t_ns, part_ns, limits);
      }
      t_ns += part_ns;
      if (++n % kLookEvery == 0) {
        look(t_ns);
      }
    }
    states.push_back(true_state(hub, wheels, state));
  }
  return states;
}

/// The same of linked bodies: the hub's attitude, the momentum and energy of the whole.
std::vector<TrueState> linked_by_small_steps(const scene::Spacecraft& craft,
                                             const std::vector<std::int64_t>& times_ns,
                                             std::int64_t h_ns,
                                             const std::function<void(std::int64_t)>& look) {
  constexpr std::int64_t kLookEvery = 16;
  multibody::LinkedFlight<Wide> flight = widened_flight(craft);
  const std::vector<Torque<Wide>> torques = widened(craft.torques);
  multibody::AssemblyLimits limits;
  limits.substeps = 1'000'000;
  std::vector<TrueState> states;
  std::int64_t t_ns = 0, n = 0;
  for (const std::int64_t end_ns : times_ns) {
    while (t_ns < end_ns) {
      const std::int64_t part_ns = std::min(h_ns, end_ns - t_ns);
      bool edges_left = false;
      multibody::advance<CoadjointFehlberg8::Nodes>(flight, std::span<const Torque<Wide>>(torques),
                                                    t_ns, part_ns, limits, 1'000'000, edges_left);
      t_ns += part_ns;
      if (++n % kLookEvery == 0) {
        look(t_ns);
      }
    }
    states.push_back({flight.state.bodies.front().q_IB,
                      multibody::total_momentum(flight.assembly, flight.state).H_I.value(),
                      multibody::energy(flight.assembly, flight.state).total()});
  }
  return states;
}

double largest_angle(const std::vector<TrueState>& a, const std::vector<TrueState>& b) {
  Wide largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Wide angle = angle_between(a[i].q_IB, b[i].q_IB);
    if (!(angle <= largest)) {
      largest = angle;
    }
  }
  return static_cast<double>(largest);
}

/// A step at which order 8 is near the goal already: a tenth of a radian a step.
std::int64_t first_step_ns(const scene::Spacecraft& craft, std::int64_t horizon_ns) {
  const RigidBody<double> body(craft.inertia_body_kg_m2);
  const double speed =
      std::sqrt(angular_speed_bound_squared(body, body_momentum(craft.initial), 0.0));
  const double h_s = speed > 0 ? 0.1 / speed : seconds<double>(horizon_ns);
  const double h_ns = std::min(h_s * 1e9, static_cast<double>(horizon_ns));
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(h_ns));
}

}  // namespace

Truth find_truth(const std::vector<scene::Spacecraft>& spacecraft,
                 const std::vector<std::int64_t>& times_ns, double goal_rad,
                 const Progress& progress) {
  constexpr int kHalvings = 6;
  const auto say = [&](double done) {
    if (!progress(done)) {
      throw Interrupted{};
    }
  };
  Truth truth{times_ns, {}, 0, {}};
  std::size_t free = 0;
  const auto fleet = static_cast<double>(spacecraft.size());
  for (const scene::Spacecraft& craft : spacecraft) {
    const double before = static_cast<double>(truth.spacecraft.size()) / fleet;
    say(before);
    if (craft.torques.empty() && craft.wheels.empty() && !craft.linked) {
      truth.spacecraft.push_back(in_closed_form(craft, times_ns));
      ++free;
      continue;
    }
    const std::int64_t horizon_ns = times_ns.back();
    std::int64_t h_ns = first_step_ns(craft, horizon_ns);
    const auto look = [&](std::int64_t) { say(before); };
    const auto run = [&](std::int64_t step_ns) {
      return craft.linked ? linked_by_small_steps(craft, times_ns, step_ns, look)
                          : by_small_steps(craft, times_ns, step_ns, look);
    };
    std::vector<TrueState> coarse = run(h_ns);
    double apart = 0;
    for (int halving = 0; halving < kHalvings && h_ns > 1; ++halving) {
      h_ns = (h_ns + 1) / 2;
      std::vector<TrueState> fine = run(h_ns);
      apart = largest_angle(coarse, fine);
      coarse = std::move(fine);
      if (apart <= goal_rad) {
        break;
      }
    }
    truth.uncertainty_rad = std::max(truth.uncertainty_rad, apart);
    truth.spacecraft.push_back(std::move(coarse));
  }
  if (free == spacecraft.size()) {
    truth.how = "closed form in 64-bit-mantissa arithmetic";
  } else {
    truth.how = fmt::format(
        "coadjoint_fehlberg8 in 64-bit-mantissa arithmetic, the step halved until two runs agree "
        "within {:.1e} rad{}",
        truth.uncertainty_rad, free > 0 ? "; closed form where free" : "");
  }
  return truth;
}

}  // namespace adstar::trade
