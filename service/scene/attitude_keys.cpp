#include "service/scene/attitude_keys.hpp"

#include <array>

namespace adstar::scene {
namespace {

constexpr std::string_view kAttitudeExample = "{ w = 1.0, x = 0.0, y = 0.0, z = 0.0 }";

}  // namespace

std::optional<Quat<double>> read_attitude(const Value& value, bool& drawn) {
  if (!value) {
    return Quat<double>{};
  }
  if (value.is(Node::Kind::string) && value.node().text == "uniform") {
    drawn = true;
    return std::nullopt;
  }
  if (!value.is(Node::Kind::table)) {
    value.refuse("{ w, x, y, z }, or \"uniform\" to draw one",
                 value.is(Node::Kind::string) ? "\"uniform\"" : kAttitudeExample);
    return std::nullopt;
  }
  Keys keys(value, kAttitudeExample);
  const Want component{"a finite number", "0.0"};
  std::array<std::optional<double>, 4> q;
  constexpr std::array<std::string_view, 4> kComponents{"w", "x", "y", "z"};
  for (std::size_t i = 0; i < q.size(); ++i) {
    q[i] = read_number(keys.required(kComponents[i], component), component);
  }
  keys.refuse_unknown();
  if (!q[0] || !q[1] || !q[2] || !q[3]) {
    return std::nullopt;
  }
  const Quat<double> given{*q[0], *q[1], *q[2], *q[3]};
  if (given == Quat<double>{0.0, 0.0, 0.0, 0.0}) {
    value.refuse_as("a quaternion of norm 0", "one that can be normalised", kAttitudeExample);
    return std::nullopt;
  }
  return given;
}

std::optional<PointingTarget> read_target(const Value& value, bool has_orbit) {
  if (!value) {
    return std::nullopt;
  }
  Keys keys(value, "frame = \"orbital\" in [spacecraft.pointing]");
  constexpr std::array<std::string_view, 2> kFrames{"orbital", "inertial"};
  const Value frame_value = keys.required(
      "frame", {"one of orbital, inertial", has_orbit ? "\"orbital\"" : "\"inertial\""});
  const auto frame = read_choice(frame_value, kFrames);
  bool drawn = false;
  const Value attitude_value = keys.optional("attitude_body_to_frame");
  const auto attitude = read_attitude(attitude_value, drawn);
  if (drawn) {
    attitude_value.refuse("{ w, x, y, z }: a target is not drawn", kAttitudeExample);
  }
  if (frame == 0U && !has_orbit) {
    frame_value.refuse("an orbit of the spacecraft beside it",
                       "[spacecraft.orbit] with semi_major_axis_m = 6.9e6");
  }
  keys.refuse_unknown();
  return frame && attitude ? std::optional(PointingTarget{*frame == 0, normalised(*attitude)})
                           : std::nullopt;
}

}  // namespace adstar::scene
