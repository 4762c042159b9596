#pragma once
// A scene from its start to the end of the plan, as fast as the machine allows: the same steps for everyone
// who propagates one.

#include <cstdint>
#include <functional>

#include "service/propagation/plan.hpp"
#include "service/propagation/unresolved.hpp"
#include "service/runtime/fleet.hpp"

namespace adstar::propagation {

struct Listener {
  /// At the start, then as often as the plan says, and at the end.
  std::function<void(std::uint64_t step, std::int64_t time_ns)> row;
  /// After steps that took some 10 ms, after each that takes longer: what it throws ends the flight.
  std::function<void(std::uint64_t done, std::int64_t time_ns)> look;
};

/// How often it calls row().
std::uint64_t rows_of(const Plan& plan);

/// `fleet` is the plan's, at its start. Returns whom no sub-step could follow.
Unresolved fly(runtime::Fleet& fleet, const Plan& plan, const Listener& listener);

}  // namespace adstar::propagation
