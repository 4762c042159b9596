#include "service/scene/torque_keys.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>
#include <variant>

#include "service/scene/nearest.hpp"
#include "service/scene/space_torque_keys.hpp"
#include "service/scene/table_file.hpp"

namespace adstar::scene {
namespace {

constexpr std::array<std::string_view, 2> kFrames{"body", "inertial"};
constexpr std::string_view kVector = "3 numbers, or { min, max } in a fleet";

Frame frame_at(std::size_t index) { return index == 0 ? Frame::body : Frame::inertial; }

std::optional<Frame> read_frame(Keys& keys) {
  const auto frame =
      read_choice(keys.required("frame", {"one of body, inertial", "\"body\""}), kFrames);
  return frame ? std::optional(frame_at(*frame)) : std::nullopt;
}

std::optional<RangedVector> read_required_vector(Keys& keys, std::string_view key,
                                                 std::string_view example) {
  return read_ranged_vector(keys.required(key, {kVector, example}), example);
}

TorquePlan read_constant(Keys& keys, const TorqueContext&) {
  const auto frame = read_frame(keys);
  const auto torque = read_required_vector(keys, "torque_n_m", "[0.0, 0.0, 0.01]");
  if (!frame || !torque) {
    return {};
  }
  return {[frame = *frame, torque = *torque](Draws& draws) -> Torque<double> {
            return Constant<double>{frame, torque.value(draws)};
          },
          std::nullopt, torque->drawn};
}

TorquePlan read_harmonic(Keys& keys, const TorqueContext&) {
  const auto frame = read_frame(keys);
  const auto amplitude = read_required_vector(keys, "amplitude_n_m", "[0.02, 0.015, 0.0]");
  const auto frequency = read_required_vector(keys, "angular_frequency_rad_s", "[0.5, 0.3, 0.0]");
  const Value phase_value = keys.optional("phase_rad");
  const auto phase = phase_value ? read_ranged_vector(phase_value, "[0.0, 1.5708, 0.0]")
                                 : std::optional(RangedVector{});
  if (!frame || !amplitude || !frequency || !phase) {
    return {};
  }
  return {[frame = *frame, amplitude = *amplitude, frequency = *frequency,
           phase = *phase](Draws& draws) -> Torque<double> {
            Harmonic<double> harmonic;
            harmonic.frame = frame;
            harmonic.amplitude_n_m = amplitude.value(draws);
            harmonic.angular_frequency_rad_s = frequency.value(draws);
            harmonic.phase_rad = phase.value(draws);
            return harmonic;
          },
          std::nullopt, amplitude->drawn || frequency->drawn || phase->drawn};
}

/// Linear knots are joined by slopes, which must be numbers too.
bool slopes_are_finite(const TableKnots& knots, const Value& file) {
  for (std::size_t i = 1; i < knots.time_ns.size(); ++i) {
    const double length = seconds<double>(knots.time_ns[i] - knots.time_ns[i - 1]);
    const Vec3<double> rise = knots.torque_n_m[i] - knots.torque_n_m[i - 1];
    const Vec3<double> slope = (1.0 / length) * rise;
    if (!std::isfinite(slope.x) || !std::isfinite(slope.y) || !std::isfinite(slope.z)) {
      file.refuse_as("a slope beyond the range of double after knot " + std::to_string(i),
                     "torques that a line can join",
                     "smaller torques, or interpolation = \"hold\"");
      return false;
    }
  }
  return true;
}

TorquePlan read_table(Keys& keys, const TorqueContext& context) {
  constexpr std::array<std::string_view, 2> kInterpolations{"hold", "linear"};
  constexpr std::array<std::string_view, 2> kEnds{"zero", "hold"};
  constexpr Want kFile{"the path of a CSV file, relative to the scene", "\"profile.csv\""};
  const auto frame = read_frame(keys);
  const Value file = keys.required("file", kFile);
  const Value interpolation_value = keys.optional("interpolation");
  const auto interpolation = read_choice(interpolation_value, kInterpolations);
  const Value end_value = keys.optional("after_end");
  const auto end = read_choice(end_value, kEnds);
  const auto path = read_text(file, kFile);
  if (path && path->empty()) {
    file.refuse(kFile.expected, kFile.example);
  }
  std::optional<TableKnots> knots;
  if (path && !path->empty()) {
    knots =
        context.tables == Tables::skip ? TableKnots{} : read_table_file(file, context.scene_file);
  }
  const bool choices_good = (interpolation || !interpolation_value) && (end || !end_value);
  const bool linear = interpolation.value_or(0) == 1;
  if (!frame || !knots || !choices_good || (linear && !slopes_are_finite(*knots, file))) {
    return {};
  }
  Table<double> table{*frame, linear ? Interpolation::linear : Interpolation::hold,
                      end.value_or(0) == 1 ? AfterEnd::hold : AfterEnd::zero,
                      std::move(knots->time_ns), std::move(knots->torque_n_m)};
  return {[table = std::move(table)](Draws&) -> Torque<double> { return table; }, std::nullopt,
          false};
}

}  // namespace

bool refuse_negative(const Value& value, std::string_view expected) {
  bool good = true;
  const auto check = [&](const Value& limits) {
    for (std::size_t i = 0; i < limits.node().items.size(); ++i) {
      if (limits.node().items[i].real < 0.0) {
        limits.item(i).refuse(expected, number_text(-limits.node().items[i].real));
        good = false;
      }
    }
  };
  if (value.is(Node::Kind::table)) {
    Keys keys(value, {});
    check(keys.optional("min"));
  } else {
    check(value);
  }
  return good;
}

namespace {

TorquePlan read_commanded(Keys& keys, const TorqueContext&) {
  const Value name_value = keys.optional("name");
  const auto name =
      name_value ? read_name(name_value, "\"body\"") : std::optional<std::string>("body");
  const Value frame_value = keys.optional("frame");
  const auto frame =
      frame_value ? read_choice(frame_value, kFrames) : std::optional<std::size_t>(0);
  const Value limit_value = keys.required("max_torque_n_m", {kVector, "[1.0, 1.0, 1.0]"});
  const auto limit = read_ranged_vector(limit_value, "[1.0, 1.0, 1.0]");
  const bool positive = limit && refuse_negative(limit_value, "a limit of at least 0 N m");
  if (!name || !frame || !positive) {
    return {};
  }
  ActuatorPlan actuator{*name,
                        name_value ? name_value.node().place : keys.place(),
                        keys.path() + ".name",
                        *limit,
                        ActuatorKind::torque,
                        0};
  return {[frame = frame_at(*frame)](Draws&) -> Torque<double> {
            Commanded<double> commanded;
            commanded.frame = frame;
            return commanded;
          },
          std::move(actuator), limit->drawn};
}

TorquePlan read_damping(Keys& keys, const TorqueContext&) {
  constexpr std::string_view kExample = "[1e-3, 1e-3, 1e-3]";
  const Value value = keys.required("coefficient_body_n_m_s_rad", {kVector, kExample});
  const auto coefficient = read_ranged_vector(value, kExample);
  if (!coefficient ||
      !refuse_negative(value, "a damping, which takes energy: at least 0 N m s/rad")) {
    return {};
  }
  return {[coefficient = *coefficient](Draws& draws) -> Torque<double> {
            return Damping<double>{coefficient.value(draws)};
          },
          std::nullopt, coefficient->drawn};
}

struct Model {
  std::string_view name;
  TorquePlan (*read)(Keys&, const TorqueContext&);
};

constexpr Model kModels[] = {{Constant<double>::kName, read_constant},
                             {Harmonic<double>::kName, read_harmonic},
                             {Table<double>::kName, read_table},
                             {Commanded<double>::kName, read_commanded},
                             {Damping<double>::kName, read_damping},
                             {GravityGradient<double>::kName, read_gravity_gradient},
                             {ResidualDipole<double>::kName, read_residual_dipole},
                             {Magnetorquer<double>::kName, read_magnetorquer},
                             {Aerodynamic<double>::kName, read_aerodynamic},
                             {SolarPressure<double>::kName, read_solar_pressure},
                             {Thruster<double>::kName, read_thruster}};
static_assert(std::size(kModels) == std::variant_size_v<Torque<double>>,
              "every model of adstar/torques/all.hpp has its keys here");

/// Which of the linked bodies; none where the file does not say, or names no body.
std::optional<std::size_t> read_body_name(const Value& value, const LinkedPlan& linked) {
  if (!value) {
    return std::nullopt;
  }
  std::vector<std::string_view> names;
  for (const auto& body : linked.linked.bodies) {
    names.push_back(body.name);
  }
  return read_choice(value, names);
}

/// The same torque for another body's outside; one that was refused, for that body too.
TorquePlan on_outside_of(const TorquePlan& plan, const LinkedPlan& linked, std::size_t body) {
  TorquePlan own = plan;
  own.body = body;
  if (!plan.make) {
    return own;
  }
  own.make = [make = plan.make, outside = linked.outsides[body]](Draws& draws) {
    Torque<double> torque = make(draws);
    std::visit(
        [&](auto& model) {
          if constexpr (requires { model.facets; }) {
            model.facets = outside;
          }
        },
        torque);
    return torque;
  };
  return own;
}

/// What pushes acts on the body that it names, or on every one that has an outside.
std::vector<TorquePlan> read_push(Keys& keys, const Model& model, TorqueContext context) {
  const std::vector<Facets<double>>& outsides = context.linked->outsides;
  std::vector<std::size_t> bodies;
  const Value name = keys.optional("body");
  const auto named = read_body_name(name, *context.linked);
  if (named) {
    bodies = {*named};
  } else {
    for (std::size_t i = 0; i < outsides.size(); ++i) {
      if (outsides[i] != nullptr) {
        bodies.push_back(i);
      }
    }
  }
  context.facets = bodies.empty() ? nullptr : outsides[bodies.front()];
  const TorquePlan plan = model.read(keys, context);
  std::vector<TorquePlan> plans;
  if (name && !named) {
    return plans;  // of no body, which was said
  }
  for (const std::size_t body : bodies) {
    plans.push_back(on_outside_of(plan, *context.linked, body));
  }
  return plans;
}

/// One, but of what acts on several linked bodies.
std::vector<TorquePlan> read_torque(const Value& value, const TorqueContext& context) {
  std::vector<std::string_view> names;
  for (const Model& model : kModels) {
    names.push_back(model.name);
  }
  const std::string choice = "one of " + joined(names);
  Keys keys(value, "[[spacecraft.torque]] blocks");
  const auto model = read_choice(keys.required("model", {choice, "\"constant\""}), names);
  if (!model) {
    return {};
  }
  const std::string_view name = names[*model];
  const bool pushes = name == Aerodynamic<double>::kName || name == SolarPressure<double>::kName;
  std::vector<TorquePlan> plans;
  if (context.linked != nullptr && pushes) {
    plans = read_push(keys, kModels[*model], context);
  } else {
    plans = {kModels[*model].read(keys, context)};
    if (context.linked != nullptr && name != GravityGradient<double>::kName) {
      plans.front().body =
          read_body_name(keys.optional("body"), *context.linked).value_or(0);  // the hub
    }
  }
  keys.refuse_unknown();
  for (TorquePlan& plan : plans) {
    plan.model = name;
    plan.place = keys.place();
    plan.path = keys.path() + ".model";
  }
  return plans;
}

/// What is there once would be counted twice.
void refuse_repeated_surroundings(const std::vector<TorquePlan>& plans, const LinkedPlan* linked,
                                  Complaints& complaints) {
  std::set<std::pair<std::string_view, std::size_t>> seen;
  std::string_view told;
  for (const TorquePlan& plan : plans) {
    const bool once = plan.model == GravityGradient<double>::kName ||
                      plan.model == Aerodynamic<double>::kName ||
                      plan.model == SolarPressure<double>::kName;
    if (!once || seen.emplace(plan.model, plan.body).second || told == plan.path) {
      continue;
    }
    told = plan.path;
    complaints.add(
        plan.place, plan.path,
        in_quotes(plan.model) + " again" +
            (linked == nullptr ? "" : " on " + in_quotes(linked->linked.bodies[plan.body].name)),
        "one of them, for it is there but once",
        linked == nullptr ? "removing it" : "removing it, or another body in each");
  }
}

void refuse_duplicate_actuators(const std::vector<TorquePlan>& plans, Complaints& complaints) {
  std::vector<std::string_view> names;
  for (const TorquePlan& plan : plans) {
    if (plan.actuator) {
      names.push_back(plan.actuator->name);
    }
  }
  std::vector<std::string_view> seen;
  for (const TorquePlan& plan : plans) {
    if (!plan.actuator) {
      continue;
    }
    const std::string_view name = plan.actuator->name;
    if (std::find(seen.begin(), seen.end(), name) != seen.end()) {
      complaints.add(plan.actuator->name_place, plan.actuator->name_path,
                     in_quotes(name) + " again",
                     "a name of its own for each actuator of a spacecraft",
                     in_quotes(free_name(name, [&names](const std::string& other) {
                       return std::find(names.begin(), names.end(), other) != names.end();
                     })));
    }
    seen.push_back(name);
  }
}

}  // namespace

std::vector<TorquePlan> read_torques(const Value& value, const TorqueContext& context) {
  std::vector<TorquePlan> plans;
  if (!value) {
    return plans;
  }
  if (!value.is(Node::Kind::array)) {
    value.refuse("an array of tables", "[[spacecraft.torque]], in double brackets");
    return plans;
  }
  for (std::size_t i = 0; i < value.node().items.size(); ++i) {
    for (TorquePlan& plan : read_torque(value.item(i), context)) {
      plans.push_back(std::move(plan));
    }
  }
  refuse_duplicate_actuators(plans, value.complaints());
  refuse_repeated_surroundings(plans, context.linked, value.complaints());
  return plans;
}

}  // namespace adstar::scene
