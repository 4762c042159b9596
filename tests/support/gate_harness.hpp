#pragma once
// A gate and its fleet without a tick: the test says which beat it is, hands in commands and reads
// the verdicts.

#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <ostream>
#include <string>
#include <tuple>
#include <vector>

#include "service/runtime/fleet.hpp"
#include "service/runtime/gate.hpp"
#include "service/runtime/records.hpp"
#include "service/scene/scene.hpp"

namespace adstar::runtime {

inline bool operator==(const VerdictRecord& a, const VerdictRecord& b) {
  const auto all = [](const VerdictRecord& v) {
    return std::tuple(v.commander.high, v.commander.low, v.sequence, v.spacecraft, v.actuator,
                      v.priority, v.verdict, v.reason, v.quantity, v.step, v.time_ns, v.start_ns,
                      v.end_ns, std::bit_cast<std::array<std::uint64_t, 3>>(v.value));
  };
  return all(a) == all(b);
}

inline std::ostream& operator<<(std::ostream& out, const VerdictRecord& v) {
  return out << "{commander " << v.commander.low << " sequence " << v.sequence << " on "
             << v.spacecraft << "/" << v.actuator << ": verdict " << static_cast<int>(v.verdict)
             << " reason " << static_cast<int>(v.reason) << " step " << v.step << " in force ["
             << v.start_ns << ", " << v.end_ns << ") torque " << v.value[0] << " " << v.value[1]
             << " " << v.value[2] << "}";
}

}  // namespace adstar::runtime

namespace adstar::test {

inline constexpr runtime::CommanderId kAlice{0, 1}, kBob{0, 2}, kCarol{0, 3};
inline constexpr std::int64_t kMs = 1'000'000;

inline Eigen::Matrix3d full_inertia() {
  return (Eigen::Matrix3d() << 0.9144, 0.02, -0.03, 0.02, 1.098, 0.05, -0.03, 0.05, 1.66)
      .finished();
}

/// One spacecraft, turning, with that many actuators called a0, a1, ... limited to `limit` per
/// axis.
inline scene::Spacecraft make_craft(int actuators, Frame frame = Frame::body,
                                    const Vec3<double>& limit = {10, 10, 10}) {
  scene::Spacecraft craft;
  craft.name = "sat";
  craft.inertia_body_kg_m2 = full_inertia();
  const RigidBody<double> body(craft.inertia_body_kg_m2);
  const Quat<double> q = normalised(Quat<double>{0.8, 0.1, -0.3, 0.5});
  craft.initial = make_state(q, rotate(q, body.momentum({0.45549, 0.82623, 0.03476})));
  for (int i = 0; i < actuators; ++i) {
    Commanded<double> commanded;
    commanded.frame = frame;
    craft.actuators.push_back({std::string("a").append(std::to_string(i)),
                               scene::ActuatorKind::torque, craft.torques.size(), limit});
    craft.torques.emplace_back(commanded);
  }
  return craft;
}

/// Gives it two wheels: "w0", which its next actuator commands, and "w1", which holds its speed against friction.
inline scene::Spacecraft with_wheels(scene::Spacecraft craft) {
  const RigidBody<double> body(craft.inertia_body_kg_m2);
  Vec3<double> Pi_B = body_momentum(craft.initial);
  const Vec3<double> omega_B = body.angular_velocity(Pi_B);
  for (int i = 0; i < 2; ++i) {
    SpinningWheel<double> spinning;
    Wheel<double>& wheel = spinning.wheel;
    wheel.axis_B = i == 0 ? Vec3<double>{0, 0.6, 0.8} : Vec3<double>{1, 0, 0};
    wheel.spin_inertia_kg_m2 = 0.02;
    wheel.max_torque_n_m = 0.5;
    wheel.max_speed_rad_s = 600;
    wheel.speed_gain_n_m_s_rad = 0.01;
    wheel.viscous_n_m_s_rad = i == 1 ? 1e-4 : 0;
    wheel.coulomb_n_m = i == 1 ? 1e-3 : 0;
    spinning.motor.standing = spinning.order = {i == 1, i == 1 ? 40.0 : 0.0};
    spinning.start_at(i == 1 ? 30.0 : -10.0, omega_B);
    Pi_B = Pi_B + (wheel.spin_inertia_kg_m2 * (i == 1 ? 30.0 : -10.0)) * wheel.axis_B;
    craft.wheels.push_back({i == 0 ? "w0" : "w1", spinning});
  }
  craft.initial = make_state(craft.initial.q_IB, rotate(craft.initial.q_IB, Pi_B));
  craft.actuators.push_back({"w0", scene::ActuatorKind::wheel, 0, {0.5, 0, 0}, 600});
  return craft;
}

/// Gives it an orbit in the Earth's field, lagging coils called "coils" and a thruster called "jet".
inline scene::Spacecraft in_space(scene::Spacecraft craft) {
  FieldOnOrbit<double> field;
  field.orbit = make_orbit<double>({6.9e6, 0.01, 1.2, 0.3, 0.2, 0.1});
  Coils<double> coils;
  coils.limit_A_m2 = {20, 20, 20};
  coils.step_A_m2 = {0.01, 0.01, 0.01};
  coils.lag_s = 0.03;
  coils.field = field;
  craft.orbit = field.orbit;
  craft.target = scene::PointingTarget{true, {}};
  Magnetorquer<double> magnetorquer;
  magnetorquer.coils = std::make_shared<const Coils<double>>(coils);
  craft.actuators.push_back(
      {"coils", scene::ActuatorKind::magnetorquer, craft.torques.size(), {20, 20, 20}});
  craft.torques.emplace_back(magnetorquer);
  Thruster<double> jet;
  jet.torque_n_m = {0, 0.05, -0.02};
  jet.minimum_on_ns = 15 * kMs;
  craft.actuators.push_back(
      {"jet", scene::ActuatorKind::thruster, craft.torques.size(), {1, 0, 0}, 0, 15 * kMs});
  craft.torques.emplace_back(jet);
  craft.torques.emplace_back(ResidualDipole<double>{
      {0.1, -0.2, 0.3}, std::make_shared<const FieldOnOrbit<double>>(field)});
  return craft;
}

/// A final verdict ends a command's story; accepted alone does not.
inline bool is_final(runtime::Verdict verdict) { return verdict != runtime::Verdict::accepted; }

class GateHarness {
 public:
  explicit GateHarness(const std::vector<scene::Spacecraft>& spacecraft = {make_craft(1)},
                       std::int64_t step_ns = 10 * kMs, std::size_t pool = 16384)
      : verdicts_(std::make_unique<runtime::VerdictRing>()),
        fleet_(spacecraft, "coadjoint_rk4", StepLimits{}),
        gate_(spacecraft, *verdicts_, pool),
        step_ns_(step_ns) {}

  runtime::Beat now() const {
    return {step_, static_cast<std::int64_t>(step_) * step_ns_, step_ns_};
  }
  std::int64_t now_ns() const { return now().t_ns; }

  void receive(const runtime::CommandRecord& command) { gate_.receive(command, now()); }

  /// Judges, and returns what was answered at once, and nothing else.
  std::vector<runtime::VerdictRecord> ask(const runtime::CommandRecord& command) {
    take();
    receive(command);
    return take();
  }

  /// begin_step and the step itself; returns what was answered since verdicts were last taken.
  std::vector<runtime::VerdictRecord> beat() {
    gate_.begin_step(now(), fleet_);
    fleet_.step(now().t_ns, step_ns_);
    ++step_;
    return take();
  }

  /// Beats until simulation time `until_ns`; everything answered on the way.
  std::vector<runtime::VerdictRecord> run_until(std::int64_t until_ns) {
    std::vector<runtime::VerdictRecord> all;
    while (now_ns() < until_ns) {
      const auto some = beat();
      all.insert(all.end(), some.begin(), some.end());
    }
    return all;
  }

  std::vector<runtime::VerdictRecord> take() {
    std::vector<runtime::VerdictRecord> all;
    while (const auto verdict = verdicts_->pop()) {
      all.push_back(*verdict);
    }
    return all;
  }

  /// What the last begun step had in its window.
  const Commanded<double>& window(std::size_t spacecraft = 0, std::size_t torque = 0) const {
    return std::get<Commanded<double>>(fleet_.vehicles()[spacecraft].torques[torque]);
  }

  runtime::Fleet& fleet() { return fleet_; }
  const runtime::GateCounters& counters() const { return gate_.counters(); }
  runtime::VerdictRing& ring() { return *verdicts_; }

 private:
  std::unique_ptr<runtime::VerdictRing> verdicts_;
  runtime::Fleet fleet_;
  runtime::CommandGate gate_;
  std::int64_t step_ns_;
  std::uint64_t step_ = 0;
};

}  // namespace adstar::test
