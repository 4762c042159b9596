// Any bytes as a scene: either a SceneError that says something, or a scene that keeps its promises.

#include <cmath>
#include <string_view>
#include <variant>

#include "service/scene/scene.hpp"
#include "tests/fuzz/byte_stream.hpp"

namespace {

using namespace adstar;

void require(bool holds, const char* what) {
  if (!holds) {
    fuzz::found(what);
  }
}

void check_spacecraft(const scene::Spacecraft& craft) {
  require(!craft.name.empty() && craft.name.size() <= 63, "a name is empty or too long");
  require(craft.inertia_body_kg_m2.allFinite(), "an inertia is not finite");
  require(craft.inertia_body_kg_m2.diagonal().minCoeff() > 0, "a moment is not positive");
  require(std::isfinite(norm(craft.initial.H_I.value())), "a momentum is not finite");
  const Quat<double>& q = craft.initial.q_IB;
  require(std::fabs(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1) < 1e-9,
          "an attitude is not a rotation");
  for (const scene::NamedWheel& named : craft.wheels) {
    const Wheel<double>& wheel = named.at_start.wheel;
    require(std::fabs(norm(wheel.axis_B) - 1) < 1e-9, "a wheel's axis is no unit vector");
    require(wheel.spin_inertia_kg_m2 > 0, "a wheel has no inertia");
    require(std::isfinite(named.at_start.h.value), "a wheel's momentum is not finite");
  }
  for (const scene::Actuator& actuator : craft.actuators) {
    require(norm(actuator.limit) < INFINITY, "an actuator has no limit");
    if (actuator.kind == scene::ActuatorKind::wheel) {
      require(actuator.index < craft.wheels.size(), "an actuator is no wheel");
      continue;
    }
    if (actuator.kind == scene::ActuatorKind::joint) {
      require(craft.linked != nullptr && actuator.index < craft.linked->motors.size(),
              "an actuator is no motor");
      continue;
    }
    require(actuator.index < craft.torques.size(), "an actuator is no model");
    const Torque<double>& torque = craft.torques[actuator.index];
    const bool right = actuator.kind == scene::ActuatorKind::torque
                           ? std::holds_alternative<Commanded<double>>(torque)
                       : actuator.kind == scene::ActuatorKind::magnetorquer
                           ? std::holds_alternative<Magnetorquer<double>>(torque)
                           : std::holds_alternative<Thruster<double>>(torque);
    require(right, "an actuator is another kind of model");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const scene::Scene scene = scene::parse(text, "fuzz.toml", scene::Tables::skip);
    require(scene.simulation.step_ns > 0, "the step is not positive");
    require(!scene.simulation.duration_ns ||
                (*scene.simulation.duration_ns > 0 &&
                 *scene.simulation.duration_ns % scene.simulation.step_ns == 0),
            "the duration is not whole steps");
    require(scene::beat_ns(scene.simulation) > 0, "a beat takes no time");
    require(!scene.spacecraft.empty(), "there is no spacecraft");
    for (const scene::Spacecraft& craft : scene.spacecraft) {
      check_spacecraft(craft);
    }
    for (const std::uint32_t index : scene.telemetry.watched) {
      require(index < scene.spacecraft.size(), "a spacecraft is watched that does not exist");
    }
  } catch (const scene::SceneError& error) {
    require(*error.what() != '\0', "a refusal says nothing");
  }
  return 0;
}
