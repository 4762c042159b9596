#include "service/runtime/admission.hpp"

#include <algorithm>
#include <time.h>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "service/runtime/fleet.hpp"

namespace adstar::runtime {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

std::int64_t monotonic_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * kSecond + now.tv_nsec;
}

constexpr Vec3<double> kTurn{0.01, 0.01, 0.01};  // [rad/s]; any will do

/// All of it turns as one, which opens no joint.
std::shared_ptr<scene::LinkedBodies> turning(const scene::LinkedBodies& resting) {
  auto linked = std::make_shared<scene::LinkedBodies>(resting);
  for (multibody::BodySpec<double>& body : linked->bodies) {
    body.omega_B = body.omega_B + rotate_inverse(normalised(body.q_IB), kTurn);
    body.v_I = body.v_I + cross(kTurn, body.x_I);
  }
  return linked;
}

/// Turning, and commanded.
scene::Spacecraft at_its_dearest(scene::Spacecraft craft) {
  const RigidBody<double> body(craft.inertia_body_kg_m2);
  if (craft.linked) {
    craft.linked = turning(*craft.linked);
  } else if (craft.initial.H_I.value() == Vec3<double>{}) {
    craft.initial = make_state(craft.initial.q_IB, body.momentum(kTurn));
  }
  for (const scene::Actuator& actuator : craft.actuators) {
    if (actuator.kind == scene::ActuatorKind::wheel) {
      Motor<double>& motor = craft.wheels[actuator.index].at_start.motor;
      motor.window[0] = {0, kNever, {false, actuator.limit.x}};
      motor.intervals = 1;
      continue;
    }
    if (actuator.kind == scene::ActuatorKind::joint) {
      auto linked = std::make_shared<scene::LinkedBodies>(*craft.linked);
      auto& window = linked->motors[actuator.index].window;
      window.window[0] = {0, kNever, actuator.limit};
      window.intervals = 1;
      craft.linked = std::move(linked);
      continue;
    }
    Torque<double>& torque = craft.torques[actuator.index];
    if (auto* const commanded = std::get_if<Commanded<double>>(&torque)) {
      commanded->window[0] = {0, kNever, actuator.limit};
      commanded->intervals = 1;
    } else if (auto* const coils = std::get_if<Magnetorquer<double>>(&torque)) {
      coils->window[0] = {0, kNever, actuator.limit};
      coils->intervals = 1;
    } else if (auto* const thruster = std::get_if<Thruster<double>>(&torque)) {
      thruster->window[0] = {0, kNever};
      thruster->intervals = 1;
    }
  }
  return craft;
}

}  // namespace

StepCost measure_step(const scene::Scene& scene) {
  constexpr std::size_t kSteps = 2000;
  std::vector<scene::Spacecraft> single, linked;
  for (const scene::Spacecraft& craft : scene.spacecraft) {
    (craft.linked ? linked : single).push_back(at_its_dearest(craft));
  }
  StepLimits limits = scene.simulation.limits;
  limits.substep_angle_rad = 1e-300;  // past the cap for whatever turns at all
  Fleet bodies(single, scene.simulation.scheme, limits);
  // A step of linked bodies is tried in 1, 2, 4, ... parts up to the cap: in all that many.
  limits.substeps = 2 * limits.substeps - 1;
  Fleet links(linked, scene.simulation.scheme, limits);
  std::vector<std::int64_t> took;
  took.reserve(kSteps);
  const std::int64_t ends = monotonic_ns() + 2 * kSecond;
  for (std::int64_t begun = monotonic_ns(); took.size() < kSteps && begun < ends;) {
    const auto n = static_cast<std::int64_t>(took.size());
    for (Fleet* const fleet : {&bodies, &links}) {
      fleet->step(n * scene.simulation.step_ns, scene.simulation.step_ns);
    }
    const std::int64_t ended = monotonic_ns();
    took.push_back(ended - begun);
    begun = ended;
  }
  const std::size_t rank = (took.size() * 99) / 100;
  std::nth_element(took.begin(), took.begin() + static_cast<std::ptrdiff_t>(rank), took.end());
  return {took[rank], took.size()};
}

std::string why_it_does_not_fit(const scene::Scene& scene, const StepCost& cost) {
  const scene::Simulation& simulation = scene.simulation;
  const std::int64_t beat = scene::beat_ns(simulation);
  const std::int64_t allowed = scene.budget.step_ns > 0 ? scene.budget.step_ns : beat;
  if (simulation.pace != scene::Pace::clock || cost.p99_ns <= allowed) {
    return {};
  }
  const double share = static_cast<double>(allowed) / static_cast<double>(cost.p99_ns);
  const auto parts =
      static_cast<std::int64_t>(static_cast<double>(simulation.limits.substeps) * share);
  std::string remedy;
  if (parts >= 1) {
    remedy = fmt::format("simulation.substep_limit = {}, ", parts);
  }
  return fmt::format(
      "the step does not fit: it needs {:.0f} us of a beat of {:.0f} us (p99 of {} steps, every "
      "spacecraft in substep_limit = {} parts), {} allows {:.0f} us; try {}a longer step, fewer "
      "spacecraft, or budget.admission = \"warn\"",
      static_cast<double>(cost.p99_ns) * 1e-3, static_cast<double>(beat) * 1e-3, cost.steps,
      simulation.limits.substeps, scene.budget.step_ns > 0 ? "budget.step" : "the beat",
      static_cast<double>(allowed) * 1e-3, remedy);
}

}  // namespace adstar::runtime
