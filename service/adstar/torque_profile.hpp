#pragma once
// A torque profile from a CSV file: rows are held until the next one, the last row ends it.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace adstar::cli {

struct ProfileRow {
  std::int64_t start_ns = 0;  ///< since the profile's start
  std::int64_t end_ns = 0;    ///< exclusive
  std::array<double, 3> torque_n_m{};
};

/// Throws Failure (usage) with every complaint about the file, a line each.
std::vector<ProfileRow> read_profile(const std::string& file);

}  // namespace adstar::cli
