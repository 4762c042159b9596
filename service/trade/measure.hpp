#pragma once
// One point of the trade: a scheme at a step, its errors against the truth and what it costs here.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "service/scene/scene.hpp"
#include "service/trade/truth.hpp"

namespace adstar::trade {

struct Errors {
  double attitude_rad = 0;       ///< largest angle to the truth
  double momentum_relative = 0;  ///< largest |H_I - true H_I| / |true H_I|
  double energy_relative = 0;    ///< largest |E - true E| / true E
  bool resolved = true;          ///< no step said that it could not follow
};

/// Of the processor's time, for one second of simulated time, all spacecraft of the scene.
struct Cost {
  double median_us = 0, least_us = 0, most_us = 0;
  std::optional<double> instructions;  ///< where this machine lets us count them
};

struct Measured {
  std::string scheme;
  int order = 0;
  std::int64_t step_ns = 0;
  Errors errors;
  Cost cost;
  bool on_front = false;  ///< nothing is both cheaper and closer

  /// Of one step of the whole scene.
  double step_cost_us() const { return cost.median_us * static_cast<double>(step_ns) * 1e-9; }
};

/// Largest errors over the truth's instants, each a multiple of `step_ns`.
Errors find_errors(const std::vector<scene::Spacecraft>& spacecraft, const std::string& scheme,
                   const StepLimits& limits, std::int64_t step_ns, const Truth& truth,
                   const Progress& progress);

struct Effort {
  int repeats = 5;
  double at_least_s = 2e-3;               ///< a repeat is made longer until it takes this
  std::uint64_t at_most_steps = 100'000;  ///< of a repeat: what a run costs shows in its beginning
};

Cost find_cost(const std::vector<scene::Spacecraft>& spacecraft, const std::string& scheme,
               const StepLimits& limits, std::int64_t step_ns, std::int64_t horizon_ns,
               const Effort& effort);

}  // namespace adstar::trade
