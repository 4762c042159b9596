#include "service/runtime/judge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "adstar/torques/frame.hpp"

namespace adstar::runtime {
namespace {

constexpr double kHuge = std::numeric_limits<double>::max();

bool all_finite(const std::array<double, 3>& v) noexcept {
  return std::all_of(v.begin(), v.end(), [](double x) { return std::isfinite(x); });
}

/// The effective interval; false when the command does not state one.
bool interval(const CommandRecord& command, std::int64_t now_ns, Judgement& result) noexcept {
  const bool at_once = command.start_ns == kStartAtNextBeat;
  const std::int64_t asked_start = at_once ? now_ns : command.start_ns;
  result.start_ns = std::max(asked_start, now_ns);
  const bool by_duration = command.duration_ns != 0;
  if (by_duration == (command.end_ns != 0)) {
    return false;  // both or neither
  }
  if (by_duration) {
    if (command.duration_ns < 0 || command.duration_ns > kNever - result.start_ns) {
      return false;
    }
    result.end_ns = result.start_ns + command.duration_ns;
    return true;
  }
  result.end_ns = command.end_ns;
  return at_once || command.end_ns > asked_start;
}

/// Scales the whole vector to its limits.
void clamp(std::array<double, 3>& value, const std::array<double, 3>& limits,
           double largest) noexcept {
  // Unit length first: limit / 1e308 would be a subnormal number, too coarse to scale by.
  double scale = kHuge;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    value[axis] /= largest;
    if (value[axis] != 0) {
      scale = std::min(scale, limits[axis] / std::fabs(value[axis]));
    }
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // The product may round one unit past the limit.
    value[axis] = std::clamp(scale * value[axis], -limits[axis], limits[axis]);
  }
}

}  // namespace

Judgement judge(const CommandRecord& command, const Vec3<double>& limit,
                std::int64_t now_ns) noexcept {
  Judgement result;
  if (!all_finite(command.value)) {
    result.reason = Reason::not_finite;
    return result;
  }
  result.value = command.value;
  if (!interval(command, now_ns, result)) {
    result.reason = Reason::bad_interval;
    return result;
  }
  if (result.end_ns <= now_ns) {
    result.verdict = Verdict::expired;
    return result;
  }
  const std::array<double, 3> limits{limit.x, limit.y, limit.z};
  double largest = 0;
  bool beyond = false;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double asked = std::fabs(command.value[axis]);
    if (asked > 0 && limits[axis] == 0) {
      result.reason = Reason::no_authority;
      return result;
    }
    largest = std::max(largest, asked);
    beyond = beyond || asked > limits[axis];
  }
  const bool late = command.start_ns != kStartAtNextBeat && command.start_ns < now_ns;
  result.verdict = late ? Verdict::applied_late : Verdict::applied;
  if (beyond) {
    result.verdict = Verdict::clamped;
    clamp(result.value, limits, largest);
  }
  return result;
}

}  // namespace adstar::runtime
