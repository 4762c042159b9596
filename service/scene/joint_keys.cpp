#include "service/scene/joint_keys.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace adstar::scene {
namespace {

using multibody::CoordinateLaw;
using multibody::JointKind;

constexpr std::string_view kPoint = "[0.5, 0.0, 0.0]";
constexpr double kHalfTurn = 3.141592653589793;

/// Of any length whose square is a number.
std::optional<Vec3<double>> read_direction(const Value& value, std::string_view example) {
  const auto given = read_vector(value, example);
  if (given && !(norm(*given) > 1e-100 && norm(*given) < 1e100)) {
    value.refuse("a direction: of a length between 1e-100 and 1e100", example);
    return std::nullopt;
  }
  return given;
}

/// The joint's axes in the body on its near side: z along `axis`, of a universal joint x. The far side has the same, so
/// that both bodies are parallel at zero.
Quat<double> axes_along(JointKind kind, const Vec3<double>& axis) {
  const Quat<double> q_BF = multibody::frame_about<double>({}, axis).q_BF;
  constexpr double kHalf = 0.70710678118654752;  // √½: a quarter turn about y takes x to z
  return kind == JointKind::universal ? normalised(q_BF * Quat<double>{kHalf, 0, -kHalf, 0}) : q_BF;
}

std::optional<JointKind> read_kind(Keys& keys) {
  constexpr std::array<std::string_view, 5> kKinds{"fixed", "revolute", "universal", "spherical",
                                                   "prismatic"};
  const auto kind = read_choice(
      keys.required("kind",
                    {"one of fixed, revolute, universal, spherical, prismatic", "\"revolute\""}),
      kKinds);
  return kind ? std::optional(static_cast<JointKind>(*kind)) : std::nullopt;
}

/// One number for each free coordinate: a number where there is one, else a list.
std::array<double, 3> read_coordinates(const Value& value, int count, std::string_view expected) {
  std::array<double, 3> all{};
  if (!value) {
    return all;
  }
  if (count == 1 && value.node().is_number()) {
    all[0] = read_number(value, {expected, "0.0"}).value_or(0);
    return all;
  }
  if (!value.is(Node::Kind::array) ||
      value.node().items.size() != static_cast<std::size_t>(count)) {
    value.refuse(count == 1 ? "a number" : "a number for each free coordinate, in a list",
                 count == 1   ? "0.0"
                 : count == 2 ? "[0.0, 0.0]"
                              : "[0.0, 0.0, 0.0]");
    return all;
  }
  for (int k = 0; k < count; ++k) {
    all[static_cast<std::size_t>(k)] =
        read_number(value.item(static_cast<std::size_t>(k)), {expected, "0.0"}).value_or(0);
  }
  return all;
}

double read_not_negative(Keys& keys, std::string_view key, std::string_view expected) {
  return read_number(keys.optional(key), NumberRange{.least = 0.0}, {expected, "0.0"}).value_or(0);
}

/// Spring, damper and stops: alike for all free coordinates but the rest and the stops.
void read_laws(Keys& keys, int count, std::array<CoordinateLaw<double>, 3>& laws) {
  CoordinateLaw<double> law;
  law.stiffness = read_not_negative(keys, "stiffness", "a stiffness of at least 0");
  law.damping = read_not_negative(keys, "damping", "a damping of at least 0");
  const std::array<double, 3> rest =
      read_coordinates(keys.optional("rest"), count, "where the spring rests");
  const Value lower_value = keys.optional("stop_lower"), upper_value = keys.optional("stop_upper");
  const std::array<double, 3> lower = read_coordinates(lower_value, count, "a lower stop");
  const std::array<double, 3> upper = read_coordinates(upper_value, count, "an upper stop");
  const Want stiff{"a stiffness of the stops above 0", "1e3"};
  const Value stiffness_value = keys.optional("stop_stiffness");
  law.stop_stiffness = read_positive(stiffness_value, stiff).value_or(0);
  law.stop_dissipation =
      read_not_negative(keys, "stop_dissipation", "a dissipation of the stops of at least 0");
  law.stops = lower_value && upper_value;
  if (static_cast<bool>(lower_value) != static_cast<bool>(upper_value)) {
    (lower_value ? lower_value : upper_value)
        .refuse_as("one stop without the other", "stop_lower and stop_upper", "both of them");
  }
  if (law.stops && !stiffness_value) {
    keys.miss("stop_stiffness", stiff);
  }
  for (int k = 0; k < count; ++k) {
    const auto i = static_cast<std::size_t>(k);
    laws[i] = law;
    laws[i].rest = rest[i];
    laws[i].lower = lower[i];
    laws[i].upper = upper[i];
    if (law.stops && !(lower[i] < upper[i])) {
      upper_value.refuse("an upper stop above the lower one", "0.5");
    }
  }
}

}  // namespace

std::optional<JointRead> read_joint_keys(Keys& keys) {
  JointRead read;
  const auto kind = read_kind(keys);
  if (!kind) {
    return std::nullopt;
  }
  read.joint.kind = *kind;
  const int count = multibody::shape_of(*kind).coordinates;
  read.joint.a.point_B =
      read_vector(
          keys.required("point_from_body_m",
                        {"3 numbers: from the centre of mass of the body it leads from", kPoint}),
          kPoint)
          .value_or(Vec3<double>{});
  read.joint.b.point_B =
      read_vector(
          keys.required("point_to_body_m",
                        {"3 numbers: from the centre of mass of the body it leads to", kPoint}),
          kPoint)
          .value_or(Vec3<double>{});
  const bool has_axis = *kind == JointKind::revolute || *kind == JointKind::prismatic ||
                        *kind == JointKind::universal;
  const Want axis_want{"3 numbers: its axis in the body it leads from", "[0.0, 1.0, 0.0]"};
  const Value axis_value =
      has_axis ? keys.required("axis_body", axis_want) : keys.optional("axis_body");
  if (!has_axis && axis_value) {
    axis_value.refuse("no axis of a joint that has none", "removing it");
  }
  if (has_axis) {
    const auto axis = read_direction(axis_value, axis_want.example);
    if (axis) {
      read.joint.a.q_BF = read.joint.b.q_BF = axes_along(*kind, *axis);
    }
  }
  read.coordinate = keys.optional("coordinate");
  read.rate = keys.optional("rate");
  read.start.q =
      read_coordinates(read.coordinate, count, "where it stands at the start [rad], or [m]");
  read.start.rate = read_coordinates(read.rate, count, "its rate at the start [rad/s], or [m/s]");
  const auto& [x, y, z] = read.start.q;
  if (*kind == multibody::JointKind::spherical && !(norm(Vec3<double>{x, y, z}) < kHalfTurn)) {
    read.coordinate.refuse("a rotation vector of less than half a turn", "[0.0, 0.0, 1.0]");
  }
  read_laws(keys, count, read.joint.laws);
  const Value limit = keys.optional("max_motor_torque");
  read.limit =
      read_positive(limit, {"a torque above 0 N m, or a force above 0 N", "0.5"}).value_or(0);
  const Value torque = keys.optional("motor_torque");
  const std::array<double, 3> standing =
      read_coordinates(torque, count, "a torque [N m], or a force [N]");
  const Value commanded = keys.optional("commanded");
  read.commanded = read_flag(commanded, "true").value_or(false);
  if ((limit || torque || commanded) && count == 0) {
    (limit    ? limit
     : torque ? torque
              : commanded)
        .refuse("no motor in a joint that does not move", "removing it");
    return std::nullopt;
  }
  if (read.commanded && !limit) {
    keys.miss("max_motor_torque", {"what a command may ask for", "0.5"});
  }
  for (int k = 0; limit && k < count; ++k) {
    if (std::abs(standing[static_cast<std::size_t>(k)]) > read.limit) {
      torque.refuse("no more than max_motor_torque", "0.1");
      break;
    }
  }
  if (limit || torque) {
    read.standing.assign(standing.begin(), standing.begin() + count);
  }
  return read;
}

}  // namespace adstar::scene
