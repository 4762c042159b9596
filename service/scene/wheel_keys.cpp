#include "service/scene/wheel_keys.hpp"

#include <algorithm>
#include <cmath>

#include "adstar/bodies/gyrostat.hpp"

namespace adstar::scene {
namespace {

constexpr std::size_t kMostWheels = 64;

std::optional<Vec3<double>> read_axis(Keys& keys) {
  constexpr std::string_view kExample = "[1.0, 0.0, 0.0]";
  const Value value =
      keys.required("axis_body", {"3 numbers: the direction in the body", kExample});
  const auto given = read_vector(value, kExample);
  if (!given) {
    return std::nullopt;
  }
  const double largest = std::max({std::fabs(given->x), std::fabs(given->y), std::fabs(given->z)});
  if (largest == 0) {
    value.refuse("a direction, not all zeros", kExample);
    return std::nullopt;
  }
  const Vec3<double> a{given->x / largest, given->y / largest, given->z / largest};
  const double length = norm(a);
  return Vec3<double>{a.x / length, a.y / length, a.z / length};
}

double read_not_negative(Keys& keys, std::string_view key, std::string_view expected) {
  const Value value = keys.optional(key);
  return read_number(value, NumberRange{.least = 0.0}, {expected, "0.0"}).value_or(0);
}

/// How fast it may turn: said as a speed, or as a momentum.
double read_speed_limit(Keys& keys, double spin_inertia) {
  const Value speed = keys.optional("max_speed_rad_s");
  const Value momentum = keys.optional("max_momentum_n_m_s");
  const auto fastest = read_positive(speed, {"a speed above 0 rad/s", "600.0"});
  const auto most = read_positive(momentum, {"a momentum above 0 N m s", "12.0"});
  if (speed && momentum) {
    momentum.refuse_as("a second limit beside max_speed_rad_s",
                       "max_speed_rad_s or max_momentum_n_m_s", "removing one of the two");
  }
  return fastest ? *fastest : most ? *most / spin_inertia : 0;
}

/// What its motor does while nobody commands it.
MotorOrder<double> read_standing_order(Keys& keys, const Wheel<double>& wheel) {
  const Value torque = keys.optional("motor_torque_n_m");
  const Value speed = keys.optional("hold_speed_rad_s");
  const auto u = read_number(torque, {"a torque in N m", "0.01"});
  const auto Omega = read_number(speed, {"a speed in rad/s", "100.0"});
  if (torque && speed) {
    speed.refuse_as("a second order beside motor_torque_n_m",
                    "motor_torque_n_m or hold_speed_rad_s", "removing one of the two");
  }
  if (u && std::fabs(*u) > wheel.max_torque_n_m) {
    torque.refuse("no more than max_torque_n_m = " + number_text(wheel.max_torque_n_m),
                  number_text(std::copysign(wheel.max_torque_n_m, *u)));
  }
  if (Omega && std::fabs(*Omega) > wheel.max_speed_rad_s) {
    speed.refuse("no more than max_speed_rad_s = " + number_text(wheel.max_speed_rad_s),
                 number_text(std::copysign(wheel.max_speed_rad_s, *Omega)));
  }
  return speed ? MotorOrder<double>{true, Omega.value_or(0)}
               : MotorOrder<double>{false, u.value_or(0)};
}

void read_motor(Keys& keys, WheelPlan& plan) {
  Wheel<double>& wheel = plan.wheel;
  const Value max_torque = keys.optional("max_torque_n_m");
  wheel.max_torque_n_m = read_positive(max_torque, {"a torque above 0 N m", "0.1"}).value_or(0);
  wheel.max_speed_rad_s = read_speed_limit(keys, wheel.spin_inertia_kg_m2);
  const Value gain = keys.optional("speed_gain_n_m_s_rad");
  const auto given = read_positive(gain, {"a gain above 0 N m s/rad", "0.01"});
  const Value commanded = keys.optional("commanded");
  plan.commanded = read_flag(commanded, "true").value_or(false);
  if (max_torque) {
    if (wheel.max_speed_rad_s == 0) {
      keys.miss("max_speed_rad_s", {"the speed at which the motor gives no more torque", "600.0"});
      return;
    }
    constexpr double kFullTorqueAt = 0.05;  // of max_speed, off the ordered speed
    wheel.speed_gain_n_m_s_rad =
        given.value_or(wheel.max_torque_n_m / (kFullTorqueAt * wheel.max_speed_rad_s));
    plan.standing = read_standing_order(keys, wheel);
    if (const Value speed = keys.optional("speed_rad_s");
        speed && std::fabs(plan.speed_rad_s) > wheel.max_speed_rad_s) {
      speed.refuse("no more than max_speed_rad_s = " + number_text(wheel.max_speed_rad_s),
                   number_text(std::copysign(wheel.max_speed_rad_s, plan.speed_rad_s)));
    }
    return;
  }
  // Nothing of a motor without one.
  for (const std::string_view key :
       {"max_speed_rad_s", "max_momentum_n_m_s", "speed_gain_n_m_s_rad", "motor_torque_n_m",
        "hold_speed_rad_s", "commanded"}) {
    if (const Value value = keys.optional(key)) {
      value.refuse_as("a motor's key without a motor", "max_torque_n_m beside it",
                      "max_torque_n_m = 0.1");
    }
  }
}

std::optional<WheelPlan> read_wheel(const Value& value) {
  Keys keys(value, "[[spacecraft.wheel]] blocks");
  const std::size_t complaints = value.complaints().count();
  WheelPlan plan;
  plan.name =
      read_name(keys.required("name", {kNameRule, "\"wheel1\""}), "\"wheel1\"").value_or("");
  Wheel<double>& wheel = plan.wheel;
  wheel.axis_B = read_axis(keys).value_or(Vec3<double>{1, 0, 0});
  const Want inertia{"a moment of inertia about its axis above 0 kg m^2", "0.02"};
  wheel.spin_inertia_kg_m2 =
      read_positive(keys.required("spin_inertia_kg_m2", inertia), inertia).value_or(1);
  plan.speed_rad_s =
      read_number(keys.optional("speed_rad_s"), {"a speed in rad/s", "100.0"}).value_or(0);
  const Value constant = keys.optional("constant_speed");
  wheel.constant_speed = read_flag(constant, "true").value_or(false);
  if (!wheel.constant_speed) {
    read_motor(keys, plan);
    wheel.viscous_n_m_s_rad = read_not_negative(
        keys, "viscous_friction_n_m_s_rad", "a friction, which takes energy: at least 0 N m s/rad");
    wheel.coulomb_n_m = read_not_negative(keys, "coulomb_friction_n_m",
                                          "a friction, which takes energy: at least 0 N m");
    wheel.coulomb_speed_rad_s =
        read_positive(keys.optional("coulomb_speed_rad_s"),
                      {"the speed over which dry friction turns its sign, above 0 rad/s", "1.0"})
            .value_or(1);
  }
  keys.refuse_unknown();
  return value.complaints().count() == complaints ? std::optional(plan) : std::nullopt;
}

}  // namespace

std::vector<WheelPlan> read_wheels(const Value& value, std::vector<std::string> taken) {
  std::vector<WheelPlan> plans;
  if (!value) {
    return plans;
  }
  if (!value.is(Node::Kind::array)) {
    value.refuse("an array of tables", "[[spacecraft.wheel]], in double brackets");
    return plans;
  }
  const std::size_t count = value.node().items.size();
  if (count > kMostWheels) {
    value.refuse("at most " + std::to_string(kMostWheels) + " wheels", "fewer of them");
  }
  for (std::size_t i = 0; i < std::min(count, kMostWheels); ++i) {
    const Value item = value.item(i);
    std::optional<WheelPlan> plan = read_wheel(item);
    if (!plan) {
      continue;
    }
    const auto is_taken = [&](const std::string& name) {
      return std::find(taken.begin(), taken.end(), name) != taken.end();
    };
    if (is_taken(plan->name)) {
      item.refuse_as(in_quotes(plan->name) + " again",
                     "a name of its own for each wheel and actuator of a spacecraft",
                     in_quotes(free_name(plan->name, is_taken)));
      continue;
    }
    taken.push_back(plan->name);
    plans.push_back(std::move(*plan));
  }
  return plans;
}

Vec3<double> momentum_relative_to_body(const std::vector<WheelPlan>& plan) {
  Vec3<double> sum;
  for (const WheelPlan& each : plan) {
    sum = sum + (each.wheel.spin_inertia_kg_m2 * each.speed_rad_s) * each.wheel.axis_B;
  }
  return sum;
}

bool leaves_a_body(const std::vector<WheelPlan>& plan, const RigidBody<double>& body) {
  std::vector<SpinningWheel<double>> wheels(plan.size());
  for (std::size_t i = 0; i < plan.size(); ++i) {
    wheels[i].wheel = plan[i].wheel;
  }
  return is_body_beside_wheels(hub_of(body, std::span<const SpinningWheel<double>>(wheels)));
}

void add_wheels(const std::vector<WheelPlan>& plan, const Vec3<double>& omega_B,
                Spacecraft& spacecraft) {
  for (const WheelPlan& each : plan) {
    SpinningWheel<double> spinning;
    spinning.wheel = each.wheel;
    spinning.motor.standing = spinning.order = each.standing;
    spinning.start_at(each.speed_rad_s, omega_B);
    if (each.commanded) {
      spacecraft.actuators.push_back({each.name,
                                      ActuatorKind::wheel,
                                      spacecraft.wheels.size(),
                                      {each.wheel.max_torque_n_m, 0, 0},
                                      each.wheel.max_speed_rad_s});
    }
    spacecraft.wheels.push_back({each.name, spinning});
  }
}

}  // namespace adstar::scene
