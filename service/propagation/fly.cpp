#include "service/propagation/fly.hpp"

#include <algorithm>
#include <chrono>

namespace adstar::propagation {
namespace {

/// A hundred times a second and oftener, whatever a step costs: the clock is asked at looks alone, since asking it costs
/// as much as some steps.
class Lookout {
 public:
  bool is_due(std::uint64_t done) {
    if (done < next_) {
      return false;
    }
    const Clock::time_point now = Clock::now();
    auto took = now - last_;
    if (took < kOften) {
      // No more: the steps to come may cost a thousand times as much.
      stretch_ = std::min(2 * stretch_, kLongest);
    }
    for (; took >= kOften && stretch_ > 1; took /= 2) {
      stretch_ /= 2;
    }
    last_ = now;
    next_ = done + stretch_;
    return true;
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kOften{10};
  static constexpr std::uint64_t kLongest = 4096;

  std::uint64_t stretch_ = 1, next_ = 1;
  Clock::time_point last_ = Clock::now();
};

}  // namespace

std::uint64_t rows_of(const Plan& plan) {
  if (plan.every == 0 || plan.steps == 0) {
    return plan.steps == 0 ? 1 : 2;
  }
  return 1 + plan.steps / plan.every + (plan.steps % plan.every == 0 ? 0 : 1);
}

Unresolved fly(runtime::Fleet& fleet, const Plan& plan, const Listener& listener) {
  Unresolved unresolved(fleet.vehicles().size());
  listener.row(0, 0);
  Lookout lookout;
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
    if (lookout.is_due(done)) {
      listener.look(done, end_ns);
    }
  }
  return unresolved;
}

}  // namespace adstar::propagation
