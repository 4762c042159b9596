#include "service/propagation/side_rows.hpp"

#include <array>

namespace adstar::propagation {
namespace {

using report::Fields;

void wheels(const scene::Scene& scene, runtime::Fleet& fleet, std::uint64_t step,
            std::int64_t time_ns, const HearsRow& hears) {
  Fields row;
  for (std::size_t i = 0; i < scene.spacecraft.size(); ++i) {
    const scene::Spacecraft& craft = scene.spacecraft[i];
    const runtime::Vehicle& vehicle = fleet.vehicles()[i];
    if (vehicle.wheels == nullptr) {
      continue;
    }
    const Vec3<double> omega_B = runtime::angular_velocity_of(vehicle);
    for (std::size_t k = 0; k < vehicle.wheels->spinning.size(); ++k) {
      const runtime::WheelRecord w = runtime::sample(vehicle.wheels->spinning[k], omega_B);
      row.clear();
      row.word(craft.name).word(craft.wheels[k].name).count(step).seconds(time_ns);
      row.number(w.speed_rad_s).number(w.momentum_n_m_s);
      row.number(w.motor_torque_n_m).number(w.friction_torque_n_m);
      hears(row);
    }
  }
}

void pointing(const scene::Scene& scene, runtime::Fleet& fleet, std::uint64_t step,
              std::int64_t time_ns, const HearsRow& hears) {
  Fields row;
  for (std::size_t i = 0; i < scene.spacecraft.size(); ++i) {
    const runtime::Vehicle& vehicle = fleet.vehicles()[i];
    if (vehicle.reference == nullptr) {
      continue;
    }
    const runtime::PointingRecord p = runtime::pointing(vehicle, seconds<double>(time_ns));
    const bool orbit = (p.flags & runtime::kPointingOrbit) != 0;
    row.clear();
    row.word(scene.spacecraft[i].name).count(step).seconds(time_ns);
    row.numbers(p.position_I_m, orbit).numbers(p.velocity_I_m_s, orbit);
    row.numbers(p.q_OB, orbit).numbers(p.omega_B_to_O_B_rad_s, orbit);
    row.numbers(p.error_B_rad, (p.flags & runtime::kPointingTarget) != 0);
    hears(row);
  }
}

void bodies(const scene::Scene& scene, runtime::Fleet& fleet, std::uint64_t step,
            std::int64_t time_ns, const HearsRow& hears) {
  Fields row;
  for (std::size_t i = 0; i < scene.spacecraft.size(); ++i) {
    const runtime::Vehicle& vehicle = fleet.vehicles()[i];
    const std::size_t count = vehicle.linked ? vehicle.linked->assembly.bodies().size() : 0;
    for (std::size_t k = 0; k < count; ++k) {
      const runtime::BodyRecord b = runtime::sample_body(vehicle, k);
      row.clear();
      row.word(scene.spacecraft[i].name).word(vehicle.linked->assembly.bodies()[k].name);
      row.count(step).seconds(time_ns).numbers(b.q_IB).numbers(b.omega_B_rad_s);
      row.numbers(b.position_I_m).numbers(b.velocity_I_m_s);
      hears(row);
    }
  }
}

void joints(const scene::Scene& scene, runtime::Fleet& fleet, std::uint64_t step,
            std::int64_t time_ns, const HearsRow& hears) {
  Fields row;
  for (std::size_t i = 0; i < scene.spacecraft.size(); ++i) {
    runtime::Vehicle& vehicle = fleet.vehicles()[i];
    if (vehicle.linked == nullptr) {
      continue;
    }
    runtime::observe(vehicle, time_ns);
    for (std::size_t k = 0; k < vehicle.linked->assembly.joints().size(); ++k) {
      const runtime::JointRecord j = runtime::sample_joint(vehicle, k);
      row.clear();
      row.word(scene.spacecraft[i].name).word(vehicle.linked->assembly.joints()[k].name);
      row.count(step).seconds(time_ns);
      for (const auto& numbers : {j.coordinate, j.rate, j.motor_torque}) {
        const std::span<const double> all(numbers);
        row.numbers(all.first(j.coordinates)).numbers(all.subspan(j.coordinates), false);
      }
      row.numbers(j.force_I_n).numbers(j.couple_I_n_m);
      hears(row);
    }
  }
}

constexpr const char* kNoneLinked = "no spacecraft of the scene has linked bodies";
constexpr std::array<SideTable, 4> kTables{
    {{"wheels", kWheelColumns, scene::first_with_wheels, "the scene has no wheels", wheels},
     {"pointing", kPointingColumns, scene::first_with_reference,
      "no spacecraft of the scene has an orbit or a target", pointing},
     {"bodies", kBodyColumns, scene::first_linked, kNoneLinked, bodies},
     {"joints", kJointColumns, scene::first_linked, kNoneLinked, joints}}};

}  // namespace

std::span<const SideTable> side_tables() { return kTables; }

}  // namespace adstar::propagation
