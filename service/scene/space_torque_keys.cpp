#include "service/scene/space_torque_keys.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "service/scene/duration_key.hpp"

namespace adstar::scene {
namespace {

constexpr std::string_view kVector = "3 numbers, or { min, max } in a fleet";

/// The spacecraft's orbit; a complaint and null when it names none, null alone when that was refused already.
const Orbit<double>* need_orbit(Keys& keys, const TorqueContext& context, std::string_view model) {
  if (!context.has_orbit) {
    keys.complaints().add(keys.place(), keys.path() + ".model", in_quotes(model),
                          "an orbit of the spacecraft beside it",
                          "[spacecraft.orbit] with semi_major_axis_m = 6.9e6");
    return nullptr;
  }
  return *context.orbit ? &**context.orbit : nullptr;
}

/// The Earth at the scene's epoch.
const Earth* need_earth(Keys& keys, const TorqueContext& context, std::string_view model) {
  if (context.earth == nullptr) {
    keys.complaints().add(keys.place(), keys.path() + ".model", in_quotes(model),
                          "a date in [simulation]: the Earth turns",
                          "epoch_utc = 2026-01-01T00:00:00Z");
  }
  return context.earth;
}

const Facets<double>* need_facets(Keys& keys, const TorqueContext& context,
                                  std::string_view model) {
  if (context.facets == nullptr) {
    const bool one = context.linked == nullptr;
    keys.complaints().add(
        keys.place(), keys.path() + ".model", in_quotes(model),
        one ? "an outside of the spacecraft beside it" : "an outside of the body that it acts on",
        one ? "[spacecraft.box] with size_m = [1.0, 1.0, 2.0]"
            : "box = { size_m = [1.0, 1.0, 2.0] } in that body's own block");
    return nullptr;
  }
  return &context.facets;
}

/// The field along the orbit, and an epoch that it is known for.
std::optional<FieldOnOrbit<double>> need_field(Keys& keys, const TorqueContext& context,
                                               std::string_view model) {
  const Orbit<double>* const orbit = need_orbit(keys, context, model);
  const Earth* const earth = need_earth(keys, context, model);
  if (earth != nullptr && (earth->year < igrf14::kFirstYear || earth->year > igrf14::kLastYear)) {
    keys.complaints().add(keys.place(), keys.path() + ".model", in_quotes(model),
                          "an epoch from 1990 to 2030, which the field's coefficients speak of",
                          "epoch_utc = 2026-01-01T00:00:00Z");
    return std::nullopt;
  }
  if (orbit == nullptr || earth == nullptr) {
    return std::nullopt;
  }
  return FieldOnOrbit<double>{*orbit, earth->field};
}

/// The actuator's name, or the given default.
std::optional<ActuatorPlan> read_actuator(Keys& keys, const Value& name_value, const char* name,
                                          ActuatorKind kind) {
  const auto given =
      name_value ? read_name(name_value, in_quotes(name)) : std::optional<std::string>(name);
  if (!given) {
    return std::nullopt;
  }
  ActuatorPlan actuator;
  actuator.name = *given;
  actuator.name_place = name_value ? name_value.node().place : keys.place();
  actuator.name_path = keys.path() + ".name";
  actuator.kind = kind;
  return actuator;
}

double read_not_negative(Keys& keys, std::string_view key, const Want& want) {
  return read_number(keys.optional(key), NumberRange{.least = 0.0}, want).value_or(0);
}

}  // namespace

/// The body is the spacecraft's: make_spacecraft() gives it.
TorquePlan read_gravity_gradient(Keys& keys, const TorqueContext& context) {
  const Orbit<double>* const orbit = need_orbit(keys, context, GravityGradient<double>::kName);
  if (orbit == nullptr) {
    return {};
  }
  return {[orbit = *orbit](Draws&) -> Torque<double> {
            GravityGradient<double> gravity;
            gravity.orbit = orbit;
            return gravity;
          },
          std::nullopt, false};
}

TorquePlan read_residual_dipole(Keys& keys, const TorqueContext& context) {
  constexpr std::string_view kExample = "[0.0, 0.0, 0.1]";
  const auto dipole =
      read_ranged_vector(keys.required("dipole_body_a_m2", {kVector, kExample}), kExample);
  auto field = need_field(keys, context, ResidualDipole<double>::kName);
  if (!dipole || !field) {
    return {};
  }
  const auto shared = std::make_shared<const FieldOnOrbit<double>>(std::move(*field));
  return {[dipole = *dipole, shared](Draws& draws) -> Torque<double> {
            return ResidualDipole<double>{dipole.value(draws), shared};
          },
          std::nullopt, dipole->drawn};
}

TorquePlan read_magnetorquer(Keys& keys, const TorqueContext& context) {
  constexpr std::string_view kExample = "[10.0, 10.0, 10.0]";
  auto actuator = read_actuator(keys, keys.optional("name"), "coils", ActuatorKind::magnetorquer);
  const Value limit_value = keys.required("max_dipole_a_m2", {kVector, kExample});
  const auto limit = read_ranged_vector(limit_value, kExample);
  const bool positive = limit && refuse_negative(limit_value, "a limit of at least 0 A m^2");
  const double quantum =
      read_not_negative(keys, "dipole_step_a_m2", {"a step of at least 0 A m^2", "0.1"});
  const double lag = read_not_negative(keys, "lag_s", {"a time constant of at least 0 s", "0.05"});
  auto field = need_field(keys, context, Magnetorquer<double>::kName);
  if (!actuator || !positive || !field) {
    return {};
  }
  if (limit->drawn) {
    limit_value.refuse("3 numbers: a fleet's coils are alike", kExample);
    return {};
  }
  Coils<double> coils;
  coils.limit_A_m2 = limit->min;
  coils.step_A_m2 = {quantum, quantum, quantum};
  coils.lag_s = lag;
  coils.field = std::move(*field);
  actuator->limit = *limit;
  return {
      [shared = std::make_shared<const Coils<double>>(std::move(coils))](Draws&) -> Torque<double> {
        Magnetorquer<double> magnetorquer;
        magnetorquer.coils = shared;
        return magnetorquer;
      },
      std::move(actuator), false};
}

TorquePlan read_aerodynamic(Keys& keys, const TorqueContext& context) {
  constexpr const char* kModel = Aerodynamic<double>::kName;
  const double factor = read_positive(keys.optional("density_factor"),
                                      {"a factor above 0 on the density of the table", "1.0"})
                            .value_or(1);
  const Orbit<double>* const orbit = need_orbit(keys, context, kModel);
  const Earth* const earth = need_earth(keys, context, kModel);
  const Facets<double>* const facets = need_facets(keys, context, kModel);
  if (orbit == nullptr || earth == nullptr || facets == nullptr) {
    return {};
  }
  Aerodynamic<double> air;
  air.orbit = *orbit;
  air.rotation = earth->rotation;
  air.facets = *facets;
  air.density_factor = factor;
  return {[air](Draws&) -> Torque<double> { return air; }, std::nullopt, false};
}

TorquePlan read_solar_pressure(Keys& keys, const TorqueContext& context) {
  constexpr const char* kModel = SolarPressure<double>::kName;
  constexpr std::array<std::string_view, 3> kShadows{"none", "cylinder", "cone"};
  const Value shadow_value = keys.optional("shadow");
  const auto shadow = shadow_value ? read_choice(shadow_value, kShadows)
                                   : std::optional(static_cast<std::size_t>(Shadow::cone));
  const Orbit<double>* const orbit = need_orbit(keys, context, kModel);
  const Earth* const earth = need_earth(keys, context, kModel);
  const Facets<double>* const facets = need_facets(keys, context, kModel);
  if (!shadow || orbit == nullptr || earth == nullptr || facets == nullptr) {
    return {};
  }
  SolarPressure<double> light;
  light.orbit = *orbit;
  light.sun.days_since_J2000_at_start = earth->days_since_j2000;
  light.facets = *facets;
  light.shadow = static_cast<Shadow>(*shadow);
  return {[light](Draws&) -> Torque<double> { return light; }, std::nullopt, false};
}

namespace {

/// on = [["1s", "2s"], ["10s", "12s"]]
std::optional<std::vector<OnInterval>> read_on_times(const Value& value) {
  constexpr std::string_view kExpected = "pairs of a beginning and an end";
  constexpr std::string_view kExample = "on = [[\"1s\", \"2s\"], [\"10s\", \"12s\"]]";
  if (!value.is(Node::Kind::array)) {
    value.refuse(kExpected, kExample);
    return std::nullopt;
  }
  std::vector<OnInterval> intervals;
  for (std::size_t i = 0; i < value.node().items.size(); ++i) {
    const Value pair = value.item(i);
    if (!pair.is(Node::Kind::array) || pair.node().items.size() != 2) {
      pair.refuse("a beginning and an end", "[\"1s\", \"2s\"]");
      return std::nullopt;
    }
    const bool at_start = pair.item(0).is(Node::Kind::string) && pair.item(0).node().text == "0s";
    const auto begin =
        at_start ? std::optional<std::int64_t>(0) : read_duration(pair.item(0), "1s");
    const auto end = read_duration(pair.item(1), "2s");
    if (!begin || !end) {
      return std::nullopt;
    }
    if (*end <= *begin) {
      pair.refuse("an end after its beginning", "[\"1s\", \"2s\"]");
      return std::nullopt;
    }
    intervals.push_back({*begin, *end});
  }
  return intervals;
}

}  // namespace

TorquePlan read_thruster(Keys& keys, const TorqueContext&) {
  constexpr std::string_view kExample = "[0.05, 0.0, 0.0]";
  const auto torque =
      read_ranged_vector(keys.required("torque_body_n_m", {kVector, kExample}), kExample);
  const Value least_value = keys.optional("min_on_time");
  const auto least =
      least_value ? read_duration(least_value, "20ms") : std::optional<std::int64_t>(0);
  const Value name = keys.optional("name");
  const Value on = keys.optional("on");
  if (name && on) {
    on.refuse_as("a schedule beside a name to command it by", "one of the two",
                 "removing one of the two");
    return {};
  }
  std::optional<std::vector<OnInterval>> schedule;
  if (on) {
    schedule = read_on_times(on);
  }
  auto actuator = on ? std::nullopt : read_actuator(keys, name, "thruster", ActuatorKind::thruster);
  if (!torque || !least || (on ? !schedule : !actuator)) {
    return {};
  }
  if (actuator) {
    actuator->limit = {{1, 0, 0}, {1, 0, 0}, false};
    actuator->least_on_ns = *least;
  }
  Thruster<double> thruster;
  thruster.minimum_on_ns = *least;
  if (schedule) {
    thruster.schedule = make_on_schedule(std::move(*schedule), *least);
  }
  return {[thruster, torque = *torque](Draws& draws) -> Torque<double> {
            Thruster<double> made = thruster;
            made.torque_n_m = torque.value(draws);
            return made;
          },
          std::move(actuator), torque->drawn};
}

}  // namespace adstar::scene
