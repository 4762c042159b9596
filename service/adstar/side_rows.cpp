#include "service/adstar/side_rows.hpp"

#include <span>

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

void begin_row(std::string& text, const std::string& spacecraft, const std::string& part,
               std::uint64_t step, std::int64_t time_ns) {
  fmt::format_to(std::back_inserter(text), "{},{},{},", spacecraft, part, step);
  report::append_seconds(text, time_ns);
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
      begin_row(text, scene.spacecraft[i].name, scene.spacecraft[i].wheels[k].name, step, time_ns);
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

void write_bodies(Output& output, const scene::Scene& scene, const runtime::Fleet& fleet,
                  std::uint64_t step, std::int64_t time_ns) {
  for (std::size_t i = 0; i < scene.spacecraft.size(); ++i) {
    const runtime::Vehicle& vehicle = fleet.vehicles()[i];
    const std::size_t bodies = vehicle.linked ? vehicle.linked->assembly.bodies().size() : 0;
    for (std::size_t k = 0; k < bodies; ++k) {
      const runtime::BodyRecord b = runtime::sample_body(vehicle, k);
      std::string& text = output.buffer();
      begin_row(text, scene.spacecraft[i].name, vehicle.linked->assembly.bodies()[k].name, step,
                time_ns);
      append_all(text, b.q_IB, true);
      append_all(text, b.omega_B_rad_s, true);
      append_all(text, b.position_I_m, true);
      append_all(text, b.velocity_I_m_s, true);
      text += '\n';
      output.flush_if_full();
    }
  }
}

void write_joints(Output& output, const scene::Scene& scene, runtime::Fleet& fleet,
                  std::uint64_t step, std::int64_t time_ns) {
  for (std::size_t i = 0; i < scene.spacecraft.size(); ++i) {
    runtime::Vehicle& vehicle = fleet.vehicles()[i];
    if (vehicle.linked == nullptr) {
      continue;
    }
    runtime::observe(vehicle, time_ns);
    for (std::size_t k = 0; k < vehicle.linked->assembly.joints().size(); ++k) {
      const runtime::JointRecord j = runtime::sample_joint(vehicle, k);
      std::string& text = output.buffer();
      begin_row(text, scene.spacecraft[i].name, vehicle.linked->assembly.joints()[k].name, step,
                time_ns);
      for (const auto& numbers : {j.coordinate, j.rate, j.motor_torque}) {
        const std::span<const double> all(numbers);
        append_all(text, all.first(j.coordinates), true);
        append_all(text, all.subspan(j.coordinates), false);
      }
      append_all(text, j.force_I_n, true);
      append_all(text, j.couple_I_n_m, true);
      text += '\n';
      output.flush_if_full();
    }
  }
}

}  // namespace adstar::cli
