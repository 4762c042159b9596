#include "service/propagation/fly.hpp"

#include <algorithm>

namespace adstar::propagation {

std::uint64_t rows_of(const Plan& plan) {
  if (plan.every == 0 || plan.steps == 0) {
    return plan.steps == 0 ? 1 : 2;
  }
  return 1 + plan.steps / plan.every + (plan.steps % plan.every == 0 ? 0 : 1);
}

Unresolved fly(runtime::Fleet& fleet, const Plan& plan, const Listener& listener) {
  Unresolved unresolved(fleet.vehicles().size());
  // Asking the clock costs as much as some steps.
  const std::uint64_t look_every = std::max<std::uint64_t>(1, 4096 / fleet.vehicles().size());
  listener.row(0, 0);
  for (std::uint64_t n = 0; n < plan.steps; ++n) {
    const auto t_ns = static_cast<std::int64_t>(n) * plan.step_ns;
    const std::int64_t end_ns = t_ns + plan.step_ns;
    if (fleet.step(t_ns, plan.step_ns) > 0) {
      unresolved.note(fleet, end_ns);
    }
    const std::uint64_t done = n + 1;
    if (done == plan.steps || (plan.every > 0 && done % plan.every == 0)) {
      listener.row(done, end_ns);
    }
    if (done % look_every == 0) {
      listener.look(done, end_ns);
    }
  }
  return unresolved;
}

}  // namespace adstar::propagation
