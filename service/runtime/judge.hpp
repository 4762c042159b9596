#pragma once
// What can be said of a command without knowing what else is scheduled: pure arithmetic on one
// record.

#include <array>
#include <cstdint>

#include "adstar/vec3.hpp"
#include "service/runtime/records.hpp"

namespace adstar::runtime {

struct Judgement {
  Verdict verdict = Verdict::refused;  ///< refused, expired, or else what it becomes when it begins
  Reason reason = Reason::none;
  std::int64_t start_ns = 0;  ///< effective
  std::int64_t end_ns = 0;
  std::array<double, 3> value{};  ///< after the clamp
};

/// `now_ns`: simulation time at which the coming step begins. Finite, interval, age, authority,
/// clamp, in this order. The clamp scales the whole vector, so that the direction stays.
Judgement judge(const CommandRecord& command, const Vec3<double>& limit,
                std::int64_t now_ns) noexcept;

}  // namespace adstar::runtime
