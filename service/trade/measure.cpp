#include "service/trade/measure.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "service/runtime/fleet.hpp"
#include "service/trade/instruction_counter.hpp"

namespace adstar::trade {
namespace {

Quat<Wide> widened(const Quat<double>& q) { return {q.w, q.x, q.y, q.z}; }
Vec3<Wide> widened(const Vec3<double>& v) { return {v.x, v.y, v.z}; }

Wide relative(const Wide& difference, const Wide& size) {
  return size > 0 ? difference / size : difference;
}

/// Not max(): a NaN must not look like a small error.
void take_larger(double& largest, const Wide& candidate) {
  if (!(candidate <= largest)) {
    largest = static_cast<double>(candidate);
  }
}

void compare(Errors& errors, const runtime::Vehicle& vehicle, const TrueState& truth) {
  const State<double>& state = vehicle.state;
  const Quat<Wide> q = normalised(widened(state.q_IB));
  take_larger(errors.attitude_rad, angle_between(truth.q_IB, q));
  take_larger(errors.momentum_relative,
              relative(norm(widened(state.H_I.value()) - truth.H_I), norm(truth.H_I)));
  const Wide energy = runtime::energy_of(vehicle);
  take_larger(errors.energy_relative, relative(std::fabs(energy - truth.energy_j), truth.energy_j));
}

}  // namespace

Errors find_errors(const std::vector<scene::Spacecraft>& spacecraft, const std::string& scheme,
                   const StepLimits& limits, std::int64_t step_ns, const Truth& truth,
                   const Progress& progress) {
  constexpr std::uint64_t kLookEvery = 4096;
  runtime::Fleet fleet(spacecraft, scheme, limits);
  Errors errors;
  std::size_t instant = 0;
  const auto steps = static_cast<std::uint64_t>(truth.times_ns.back() / step_ns);
  for (std::uint64_t n = 0; n < steps; ++n) {
    const std::int64_t t_ns = static_cast<std::int64_t>(n) * step_ns;
    errors.resolved = fleet.step(t_ns, step_ns) == 0 && errors.resolved;
    if (t_ns + step_ns == truth.times_ns[instant]) {
      for (std::size_t i = 0; i < spacecraft.size(); ++i) {
        compare(errors, fleet.vehicles()[i], truth.spacecraft[i][instant]);
      }
      ++instant;
    }
    if (n % kLookEvery == 0 && !progress(static_cast<double>(n) / static_cast<double>(steps))) {
      throw Interrupted{};
    }
  }
  return errors;
}

Cost find_cost(const std::vector<scene::Spacecraft>& spacecraft, const std::string& scheme,
               const StepLimits& limits, std::int64_t step_ns, std::int64_t horizon_ns,
               const Effort& effort) {
  using Clock = std::chrono::steady_clock;
  runtime::Fleet fleet(spacecraft, scheme, limits);
  fleet.keep_start();
  const auto steps = std::clamp<std::uint64_t>(
      static_cast<std::uint64_t>(horizon_ns / step_ns), 1,
      std::max<std::uint64_t>(1, effort.at_most_steps / spacecraft.size()));
  const auto run = [&] {
    fleet.reset();
    for (std::uint64_t n = 0; n < steps; ++n) {
      fleet.step(static_cast<std::int64_t>(n) * step_ns, step_ns);
    }
  };
  const auto seconds_of = [&](std::uint64_t runs) {
    const Clock::time_point begun = Clock::now();
    for (std::uint64_t i = 0; i < runs; ++i) {
      run();
    }
    return std::chrono::duration<double>(Clock::now() - begun).count();
  };
  std::uint64_t runs = 1;  // the first also warms the caches
  for (double took = seconds_of(1); took < effort.at_least_s; took = seconds_of(runs)) {
    runs *= 2;
  }
  const double simulated_s = static_cast<double>(runs * steps) * seconds<double>(step_ns);
  std::vector<double> costs;
  for (int i = 0; i < effort.repeats; ++i) {
    costs.push_back(seconds_of(runs) * 1e6 / simulated_s);
  }
  std::sort(costs.begin(), costs.end());
  Cost cost{costs[costs.size() / 2], costs.front(), costs.back(), {}};
  InstructionCounter counter;
  counter.start();
  seconds_of(runs);
  if (const auto count = counter.stop()) {
    cost.instructions = static_cast<double>(*count) / simulated_s;
  }
  return cost;
}

}  // namespace adstar::trade
