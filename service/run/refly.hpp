#pragma once
// Flying a recorded run again, and comparing: same bits, or where they part.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "service/run/flight.hpp"
#include "service/run/run_directory.hpp"
#include "service/scene/scene.hpp"

namespace adstar::run {

struct Reflight {
  Instant from, to;
  std::uint64_t heard = 0;                    ///< commands and run controls
  std::uint64_t hashes = 0, checkpoints = 0;  ///< compared, all equal unless differs_at
  Instant same_until;                         ///< the last where they were compared and equal
  std::optional<Instant> differs_at;          ///< the first where they were not
  std::string differs_in;                     ///< what of it, where that is known
  std::vector<std::string> notes;             ///< what could not be read
};

/// Flies it from its beginning, or from the oldest checkpoint whose journal is whole. `progress` is
/// given the share done now and then, and stops it by false. Throws RunError when there is nothing to fly.
Reflight refly(const RunDirectory& directory, const scene::Scene& scene, std::uint64_t fingerprint,
               const std::function<bool(double)>& progress);

}  // namespace adstar::run
