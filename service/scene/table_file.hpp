#pragma once
// A torque over time from a CSV file:
//
//   # comment
//   time_s,torque_x_n_m,torque_y_n_m,torque_z_n_m
//   0.0,0.0,0.0,0.01
//
// Times are decimal seconds of simulation time, exact to the nanosecond, rising.

#include <filesystem>
#include <vector>

#include "service/scene/keys.hpp"

namespace adstar::scene {

struct TableKnots {
  std::vector<std::int64_t> time_ns;
  std::vector<Vec3<double>> torque_n_m;
};

/// `value` names the file, beside the scene `scene_file`. Complaints carry the place in the CSV.
std::optional<TableKnots> read_table_file(const Value& value,
                                          const std::filesystem::path& scene_file);

}  // namespace adstar::scene
