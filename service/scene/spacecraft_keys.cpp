// [[spacecraft]]: a block is read into a plan, and the plan makes each spacecraft of its fleet.

#include <array>
#include <cmath>
#include <unordered_map>
#include <unordered_set>

#include "adstar/bodies/rigid_body.hpp"
#include "adstar/integrators/guard.hpp"
#include "service/scene/attitude_keys.hpp"
#include "service/scene/body_keys.hpp"
#include "service/scene/facet_keys.hpp"
#include "service/scene/inertia.hpp"
#include "service/scene/orbit_keys.hpp"
#include "service/scene/sections.hpp"
#include "service/scene/torque_keys.hpp"
#include "service/scene/wheel_keys.hpp"

namespace adstar::scene {
namespace {

constexpr std::int64_t kLargestFleet = 1'000'000;

enum class Motion { at_rest, omega_B, Pi_B, H_I };

struct Plan {
  std::int64_t count = 1;
  std::uint64_t seed = 0;
  std::vector<std::string> names;
  Value name, inertia_value;
  std::optional<Inertia> inertia;
  std::optional<Quat<double>> q_IB;  ///< none: drawn
  Motion motion = Motion::at_rest;
  Value motion_value;
  RangedVector motion_vector;
  std::vector<TorquePlan> torques;
  std::optional<Orbit<double>> orbit;
  std::optional<PointingTarget> target;
  Value wheels_value;
  std::vector<WheelPlan> wheels;
  std::unique_ptr<LinkedPlan> linked;  ///< null: one body
};

void read_names(Keys& keys, bool fleet, Plan& plan) {
  plan.name = keys.required("name", {kNameRule, fleet ? "\"sat{}\"" : "\"sat1\""});
  if (fleet) {
    if (const auto pattern = read_name_pattern(plan.name, plan.count)) {
      for (std::int64_t i = 0; i < plan.count; ++i) {
        plan.names.push_back(pattern->name(static_cast<std::uint64_t>(i)));
      }
    }
  } else if (plan.name.is(Node::Kind::string) &&
             plan.name.node().text.find('{') != std::string::npos) {
    plan.name.refuse("a count beside a name with a pattern", "count = 10 in this block");
  } else if (auto name = read_name(plan.name, "\"sat1\"")) {
    plan.names.push_back(std::move(*name));
  }
}

void read_motion(Keys& keys, Plan& plan) {
  struct Choice {
    std::string_view key;
    Motion motion;
    std::string_view example;
  };
  constexpr std::array<Choice, 3> kChoices{
      {{"angular_velocity_body_rad_s", Motion::omega_B, "[0.45549, 0.82623, 0.03476]"},
       {"angular_momentum_body_n_m_s", Motion::Pi_B, "[0.0, 0.0, 1.0]"},
       {"angular_momentum_inertial_n_m_s", Motion::H_I, "[0.0, 0.0, 1.0]"}}};
  std::string_view first;
  for (const Choice& choice : kChoices) {
    const Value value = keys.optional(choice.key);
    const auto vector = read_ranged_vector(value, choice.example);
    if (!value) {
      continue;
    }
    if (!first.empty()) {
      value.refuse_as("a second initial motion beside " + std::string(first),
                      "an angular velocity or one angular momentum", "removing one of the two");
      continue;
    }
    first = choice.key;
    plan.motion = choice.motion;
    plan.motion_value = value;
    plan.motion_vector = vector.value_or(RangedVector{});
  }
}

/// Whoever draws must say from which seed.
void read_seed(Keys& keys, bool drawn, Plan& plan) {
  const Want seed{"an integer, for what this block draws at random", "1"};
  const Value value = keys.optional("seed");
  plan.seed = static_cast<std::uint64_t>(read_integer(value, {}, seed).value_or(0));
  if (drawn && !value) {
    keys.miss("seed", seed);
  }
}

Plan read_plan(Keys& keys, TorqueContext context) {
  Plan plan;
  const Value count = keys.optional("count");
  const Want want_count{"an integer from 1 to 1000000", "10"};
  plan.count = read_integer(count, {1, kLargestFleet}, want_count).value_or(1);
  read_names(keys, static_cast<bool>(count), plan);
  const Want want_inertia{"3 principal moments or a 3x3 tensor in kg m^2", "[0.9144, 1.098, 1.66]"};
  plan.inertia_value = keys.required("inertia_body_kg_m2", want_inertia);
  plan.inertia = read_inertia(plan.inertia_value);
  bool drawn = plan.inertia && plan.inertia->principal.drawn;
  plan.q_IB = read_attitude(keys.optional("attitude_body_to_inertial"), drawn);
  read_motion(keys, plan);
  drawn = drawn || plan.motion_vector.drawn;
  const Value orbit = keys.optional("orbit");
  plan.orbit = read_orbit(
      orbit, {context.scene_file, context.tables, context.earth ? &context.earth->epoch : nullptr});
  context.has_orbit = static_cast<bool>(orbit);
  context.facets = read_facets(keys);
  plan.linked = read_linked(keys, context.facets);
  context.linked = plan.linked.get();
  constexpr std::int64_t kMostLinked = 100'000;
  if (plan.linked &&
      plan.count * static_cast<std::int64_t>(plan.linked->linked.bodies.size()) > kMostLinked) {
    count.refuse("at most 100,000 linked bodies in a fleet", "fewer spacecraft");
  }
  if (plan.linked && (plan.motion == Motion::Pi_B || plan.motion == Motion::H_I)) {
    plan.motion_value.refuse_as("a momentum of a spacecraft of several bodies",
                                "the angular velocity of its hub",
                                "angular_velocity_body_rad_s = [0.0, 0.0, 0.01]");
  }
  context.orbit = &plan.orbit;
  plan.target = read_target(keys.optional("pointing"), context.has_orbit);
  plan.torques = read_torques(keys.optional("torque"), context);
  for (const TorquePlan& torque : plan.torques) {
    drawn = drawn || torque.drawn;
  }
  std::vector<std::string> actuators, motors;
  if (plan.linked) {
    for (const Actuator& motor : plan.linked->actuators) {
      motors.push_back(motor.name);
    }
  }
  for (const TorquePlan& torque : plan.torques) {
    if (!torque.actuator) {
      continue;
    }
    if (std::find(motors.begin(), motors.end(), torque.actuator->name) != motors.end()) {
      plan.linked->where.refuse_as(
          "a motor called " + in_quotes(torque.actuator->name) + " beside an actuator of that name",
          "a name of its own for each", "another name for one of them");
    }
    actuators.push_back(torque.actuator->name);
  }
  actuators.insert(actuators.end(), motors.begin(), motors.end());
  plan.wheels_value = keys.optional("wheel");
  plan.wheels = read_wheels(plan.wheels_value, std::move(actuators));
  if (plan.linked && plan.wheels_value) {
    plan.wheels_value.refuse_as("wheels in a spacecraft of several bodies",
                                "one of the two: linked bodies carry no wheels yet",
                                "a body on a revolute joint with a motor");
  }
  read_seed(keys, drawn, plan);
  keys.refuse_unknown();
  return plan;
}

State<double> initial_state(const Plan& plan, const RigidBody<double>& body, Draws& draws) {
  const Quat<double> q_IB = plan.q_IB ? *plan.q_IB : draw_rotation(draws);
  const Quat<double> unit = normalised(q_IB);
  const Vec3<double> v = plan.motion_vector.value(draws);
  const auto with_wheels = [&](const Vec3<double>& Pi_B) {
    return plan.wheels.empty() ? Pi_B : Pi_B + momentum_relative_to_body(plan.wheels);
  };
  switch (plan.motion) {
    case Motion::omega_B:
      return make_state(q_IB, rotate(unit, with_wheels(body.momentum(v))));
    case Motion::Pi_B:
      return make_state(q_IB, rotate(unit, v));
    case Motion::H_I:
      return make_state(q_IB, v);
    case Motion::at_rest:
      break;
  }
  return make_state(q_IB, rotate(unit, with_wheels({})));
}

/// A spacecraft of the plan that cannot be, and how many more of them there are.
struct Refused {
  std::optional<Flaw> flaw;
  std::string name;
  std::int64_t count = 0;

  void note(const std::string& spacecraft, const Flaw& why) {
    if (count++ == 0) {
      flaw = why;
      name = spacecraft;
    }
  }
  void report(const Value& value, bool fleet) const {
    if (count == 0) {
      return;
    }
    std::string got = flaw->got;
    if (fleet) {
      got += " for " + in_quotes(name);
      got += count > 1 ? " (and " + std::to_string(count - 1) + " others that cannot be)" : "";
    }
    value.refuse_as(got, flaw->expected, flaw->remedy);
  }
};

/// Of linked bodies body by body, and gravity on each.
void add_torques(const Plan& plan, const RigidBody<double>& body, Draws& draws,
                 Spacecraft& spacecraft) {
  const std::size_t bodies = spacecraft.linked ? spacecraft.linked->bodies.size() : 1;
  std::vector<std::vector<std::pair<Torque<double>, const TorquePlan*>>> of_body(bodies);
  for (const TorquePlan& torque : plan.torques) {
    const Torque<double> made = torque.make(draws);
    if (const auto* const gravity = std::get_if<GravityGradient<double>>(&made)) {
      for (std::size_t i = 0; i < bodies; ++i) {
        GravityGradient<double> own = *gravity;
        own.act_on(i == 0 ? body : RigidBody<double>(spacecraft.linked->bodies[i].inertia_B));
        of_body[i].emplace_back(own, &torque);
      }
    } else {
      of_body[torque.body].emplace_back(made, &torque);
    }
  }
  for (const auto& own : of_body) {
    if (spacecraft.linked) {
      spacecraft.first_torque.push_back(spacecraft.torques.size());
    }
    for (const auto& [torque, from] : own) {
      if (from->actuator) {
        const ActuatorPlan& actuator = *from->actuator;
        spacecraft.actuators.push_back({actuator.name, actuator.kind, spacecraft.torques.size(),
                                        actuator.limit.value(draws), 0, actuator.least_on_ns});
      }
      spacecraft.torques.push_back(torque);
    }
  }
  if (spacecraft.linked) {
    spacecraft.first_torque.push_back(spacecraft.torques.size());
  }
}

Spacecraft make_spacecraft(const Plan& plan, std::size_t index, Refused& inertias, Refused& motions,
                           Refused& wheels) {
  Draws draws(plan.seed, index);
  Spacecraft spacecraft;
  spacecraft.name = plan.names[index];
  spacecraft.inertia_body_kg_m2 = plan.inertia->value(draws);
  if (plan.inertia->principal.drawn) {
    if (const auto flaw = flaw_of_inertia(spacecraft.inertia_body_kg_m2)) {
      inertias.note(spacecraft.name, *flaw);
      return spacecraft;
    }
  }
  const RigidBody<double> body(spacecraft.inertia_body_kg_m2);
  spacecraft.initial = initial_state(plan, body, draws);
  const double speed_squared =
      angular_speed_bound_squared(body, body_momentum(spacecraft.initial), 0.0);
  if (!std::isfinite(speed_squared)) {
    motions.note(spacecraft.name, {"a rotation beyond the range of double",
                                   "one whose energy and momentum are finite", "a smaller vector"});
  }
  if (plan.linked) {
    spacecraft.linked =
        place_linked(*plan.linked, spacecraft.inertia_body_kg_m2, spacecraft.initial.q_IB,
                     body.angular_velocity(body_momentum(spacecraft.initial)));
    if (!spacecraft.linked) {
      return spacecraft;
    }
    spacecraft.initial = make_state(spacecraft.initial.q_IB, momentum_of(*spacecraft.linked));
    spacecraft.actuators = plan.linked->actuators;
  }
  add_torques(plan, body, draws, spacecraft);
  spacecraft.orbit = plan.orbit;
  spacecraft.target = plan.target;
  if (!plan.wheels.empty()) {
    if (!leaves_a_body(plan.wheels, body)) {
      wheels.note(spacecraft.name,
                  {"wheels as heavy as the body about an axis",
                   "inertia_body_kg_m2 with the wheels in it, and something left beside them",
                   "a smaller spin_inertia_kg_m2"});
      return spacecraft;
    }
    const Vec3<double> omega_B = body.angular_velocity(body_momentum(spacecraft.initial) -
                                                       momentum_relative_to_body(plan.wheels));
    add_wheels(plan.wheels, omega_B, spacecraft);
  }
  return spacecraft;
}

void make_fleet(const Plan& plan, std::vector<Spacecraft>& all) {
  Refused inertias, motions, wheels;
  for (std::size_t i = 0; i < plan.names.size(); ++i) {
    all.push_back(make_spacecraft(plan, i, inertias, motions, wheels));
  }
  const bool fleet = plan.count > 1;
  inertias.report(plan.inertia_value, fleet);
  motions.report(plan.motion_value ? plan.motion_value : plan.inertia_value, fleet);
  wheels.report(plan.wheels_value, fleet);
}

/// One complaint a block: two fleets of one pattern collide in every name.
void refuse_duplicate_names(const std::vector<Plan>& plans) {
  std::unordered_map<std::string_view, Place> seen;
  for (const Plan& plan : plans) {
    for (const std::string& name : plan.names) {
      seen.emplace(name, plan.name.node().place);
    }
  }
  const auto taken = [&seen](const std::string& name) { return seen.count(name) > 0; };
  std::unordered_set<std::string_view> before;
  for (const Plan& plan : plans) {
    bool said = false;
    for (const std::string& name : plan.names) {
      if (!before.insert(name).second && !said) {
        said = true;
        plan.name.refuse_as(
            in_quotes(name) + " again (line " + std::to_string(seen.at(name).line) + " has it)",
            "a name of its own for each spacecraft",
            plan.count > 1 ? "another pattern" : in_quotes(free_name(name, taken)));
      }
    }
  }
}

}  // namespace

Spacecrafts read_spacecraft(Keys& root, const std::filesystem::path& file, Tables tables,
                            const Earth* earth) {
  Spacecrafts result;
  constexpr std::string_view kExpected = "at least one [[spacecraft]]";
  const Value value = root.optional("spacecraft");
  if (!value) {
    root.complaints().add(root.place(), "spacecraft", "nothing", kExpected,
                          "[[spacecraft]] with a name and inertia_body_kg_m2");
    result.every_name_known = false;
    return result;
  }
  if (!value.is(Node::Kind::array) || value.node().items.empty()) {
    value.refuse(kExpected, "[[spacecraft]], in double brackets");
    result.every_name_known = false;
    return result;
  }
  const TorqueContext context{file, tables, earth};
  std::vector<Plan> plans;
  for (std::size_t i = 0; i < value.node().items.size(); ++i) {
    const std::size_t complaints = root.complaints().count();
    Keys keys(value.item(i), "[[spacecraft]] blocks");
    Plan plan = read_plan(keys, context);
    if (plan.names.empty()) {
      result.every_name_known = false;
    }
    if (root.complaints().count() == complaints) {
      make_fleet(plan, result.spacecraft);
    }
    plans.push_back(std::move(plan));
  }
  refuse_duplicate_names(plans);
  for (Plan& plan : plans) {
    for (std::string& name : plan.names) {
      result.names.push_back(std::move(name));
    }
  }
  return result;
}

}  // namespace adstar::scene
