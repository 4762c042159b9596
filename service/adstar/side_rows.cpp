#include "service/adstar/side_rows.hpp"

#include <fmt/format.h>

#include "service/report/numbers.hpp"

namespace adstar::cli {
namespace {

/// "" for each where `known` is false.
template <class Numbers>
void append_all(std::string& text, const Numbers& numbers, bool known) {
  for (const double value : numbers) {
    text += ',';
    if (known) {
      report::append_number(text, value);
    }
  }
}

}  // namespace

void write_wheels(Output& output, const scene::Scene& scene, const runtime::Fleet& fleet,
                  std::uint64_t step, std::int64_t time_ns) {
  for (std::size_t i = 0; i < scene.spacecraft.size(); ++i) {
    const runtime::Vehicle& vehicle = fleet.vehicles()[i];
    if (vehicle.wheels == nullptr) {
      continue;
    }
    const Vec3<double> omega_B = runtime::angular_velocity_of(vehicle);
    for (std::size_t k = 0; k < vehicle.wheels->spinning.size(); ++k) {
      const runtime::WheelRecord w = runtime::sample(vehicle.wheels->spinning[k], omega_B);
      std::string& text = output.buffer();
      fmt::format_to(std::back_inserter(text), "{},{},{},", scene.spacecraft[i].name,
                     scene.spacecraft[i].wheels[k].name, step);
      report::append_seconds(text, time_ns);
      for (const double value :
           {w.speed_rad_s, w.momentum_n_m_s, w.motor_torque_n_m, w.friction_torque_n_m}) {
        text += ',';
        report::append_number(text, value);
      }
      text += '\n';
      output.flush_if_full();
    }
  }
}

void write_pointing(Output& output, const scene::Scene& scene, const runtime::Fleet& fleet,
                    std::uint64_t step, std::int64_t time_ns) {
  for (std::size_t i = 0; i < scene.spacecraft.size(); ++i) {
    const runtime::Vehicle& vehicle = fleet.vehicles()[i];
    if (vehicle.reference == nullptr) {
      continue;
    }
    const runtime::PointingRecord p = runtime::pointing(vehicle, seconds<double>(time_ns));
    const bool orbit = (p.flags & runtime::kPointingOrbit) != 0;
    std::string& text = output.buffer();
    fmt::format_to(std::back_inserter(text), "{},{},", scene.spacecraft[i].name, step);
    report::append_seconds(text, time_ns);
    append_all(text, p.position_I_m, orbit);
    append_all(text, p.velocity_I_m_s, orbit);
    append_all(text, p.q_OB, orbit);
    append_all(text, p.omega_B_to_O_B_rad_s, orbit);
    append_all(text, p.error_B_rad, (p.flags & runtime::kPointingTarget) != 0);
    text += '\n';
    output.flush_if_full();
  }
}

}  // namespace adstar::cli
