#pragma once
// From a scene and what was asked for to whole steps.

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>

#include "service/scene/scene.hpp"

namespace adstar::propagation {

struct Request {
  std::optional<std::int64_t> duration_ns;
  std::optional<std::int64_t> step_ns;
  std::optional<std::int64_t> every_ns;
  std::optional<std::string> scheme;
};

struct Plan {
  std::int64_t step_ns = 0;
  std::uint64_t steps = 0;
  std::uint64_t every = 0;  ///< steps between rows; 0: first and last only
  std::string scheme;
};

/// What whoever asked calls the parts of a request: messages speak of them so.
struct Words {
  const char* duration;
  const char* step;
  const char* every;
  const char* scheme;
  const char* sets;                   ///< between a name and its value: " ", "="
  std::string (*time)(std::int64_t);  ///< a value in nanoseconds as it is written there
};

/// The request cannot be met; what() says what to ask for instead.
struct Refused : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// Throws Refused for a scheme that there is not, or that the scene's torques rule out.
void require_scheme(const std::string& name, const char* option, const scene::Scene& scene);

/// Throws Refused for what does not come out in whole steps, naming the nearest that does.
Plan make_plan(const scene::Scene& scene, const Request& request, const Words& words);

}  // namespace adstar::propagation
