#pragma once
// Which spacecraft had a step that the scheme could not follow, and what to do about it.

#include <cstdint>
#include <string>
#include <vector>

#include "service/propagation/plan.hpp"
#include "service/runtime/fleet.hpp"
#include "service/scene/scene.hpp"

namespace adstar::propagation {

class Unresolved {
 public:
  explicit Unresolved(std::size_t spacecraft) : flags_(spacecraft) {}

  /// After a step ending at `time_ns` in which some spacecraft could not be resolved.
  void note(const runtime::Fleet& fleet, std::int64_t time_ns);

  /// One sentence a kind of fault; empty when there was none.
  std::string warning(const scene::Scene& scene, const Plan& plan, const Words& words) const;

 private:
  std::vector<std::uint32_t> flags_;
  std::int64_t first_ns_ = 0;
  bool any_ = false;
};

}  // namespace adstar::propagation
