#include "service/adstar/torque_profile.hpp"

#include <fmt/format.h>

#include "service/adstar/failure.hpp"
#include "service/report/numbers.hpp"
#include "service/scene/files.hpp"
#include "service/scene/table_file.hpp"

namespace adstar::cli {

std::vector<ProfileRow> read_profile(const std::string& file) {
  const scene::FileText text = scene::read_file(file);
  if (!text.error.empty()) {
    throw Failure(kUsage, fmt::format("cannot read '{}': {}; try {}", file, text.error,
                                      scene::nearest_file(file, ".csv")));
  }
  // The same file as a scene's table torque: one reader, the same messages.
  scene::Complaints complaints(file);
  scene::Node name;
  name.kind = scene::Node::Kind::string;
  name.text = file;
  const auto knots = scene::read_table_file({name, "--profile", complaints}, {});
  if (!knots) {
    std::string lines = "the profile is wrong:";
    for (const std::string& line : complaints.lines()) {
      lines += '\n' + line;
    }
    throw Failure(kUsage, lines);
  }
  const auto& times = knots->time_ns;
  if (times.size() < 2 || times.front() < 0) {
    throw Failure(
        kUsage,
        times.size() < 2
            ? fmt::format("'{}' has one row, expected two or more: the last one only ends the "
                          "profile; add a row with the time of its end",
                          file)
            : fmt::format("'{}' begins at {} s, expected 0 or later: times count from the "
                          "profile's start; shift them",
                          file, report::seconds_text(times.front())));
  }
  std::vector<ProfileRow> rows;
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
    const Vec3<double>& torque = knots->torque_n_m[i];
    rows.push_back({times[i], times[i + 1], {torque.x, torque.y, torque.z}});
  }
  return rows;
}

}  // namespace adstar::cli
