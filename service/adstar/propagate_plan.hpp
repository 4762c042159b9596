#pragma once
// From a scene and the command line to whole steps.

#include <cstdint>
#include <optional>
#include <string>

#include "service/scene/scene.hpp"

namespace adstar::cli {

struct PropagateRequest {
  std::optional<std::int64_t> duration_ns;
  std::optional<std::int64_t> step_ns;
  std::optional<std::int64_t> every_ns;
  std::optional<std::string> scheme;
};

struct PropagatePlan {
  std::int64_t step_ns = 0;
  std::uint64_t steps = 0;
  std::uint64_t every = 0;  ///< steps between rows; 0: first and last only
  std::string scheme;
};

/// Throws Failure (usage) for a scheme that there is not, or that the scene's torques rule out.
void require_scheme(const std::string& name, const char* option, const scene::Scene& scene);

/// Throws Failure (usage) for what does not come out in whole steps, naming the nearest that does.
PropagatePlan make_plan(const scene::Scene& scene, const PropagateRequest& request);

}  // namespace adstar::cli
