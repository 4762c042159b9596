#include "service/runtime/run_control.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "service/scene/inertia.hpp"

namespace adstar::runtime {
namespace {

template <std::size_t N>
bool all_finite(const std::array<double, N>& numbers) noexcept {
  return std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
}

/// Nothing where it is no attitude.
std::optional<Quat<double>> attitude_of(const ControlRecord& record) noexcept {
  const auto& q = record.attitude;
  const Quat<double> attitude{q[0], q[1], q[2], q[3]};
  return all_finite(q) && attitude != Quat<double>{0.0, 0.0, 0.0, 0.0} ? std::optional(attitude)
                                                                       : std::nullopt;
}

ControlRefusal set_state(const ControlRecord& record, Fleet& fleet) noexcept {
  const auto q_IB = attitude_of(record);
  if (!q_IB || !all_finite(record.omega_B_rad_s)) {
    return ControlRefusal::bad_state;
  }
  const auto& omega = record.omega_B_rad_s;
  return fleet.set_motion(record.spacecraft, *q_IB, {omega[0], omega[1], omega[2]})
             ? ControlRefusal::none
             : ControlRefusal::bad_state;
}

ControlRefusal set_inertia(const ControlRecord& record, Fleet& fleet) noexcept {
  const auto& j = record.inertia_body_kg_m2;
  if (!all_finite(j) ||
      scene::fault_of_inertia({j[0], j[1], j[2], j[3], j[4], j[5]}) != scene::InertiaFault::none) {
    return ControlRefusal::bad_inertia;
  }
  Eigen::Matrix3d J;
  J << j[0], j[3], j[4], j[3], j[1], j[5], j[4], j[5], j[2];
  const RigidBody<double> body(J);
  if (!fleet.can_have_body(record.spacecraft, body)) {
    return ControlRefusal::bad_inertia;
  }
  fleet.set_body(record.spacecraft, body);
  return ControlRefusal::none;
}

ControlRefusal set_target(const ControlRecord& record, Fleet& fleet) noexcept {
  const auto attitude = attitude_of(record);
  if (!attitude) {
    return ControlRefusal::bad_state;
  }
  return fleet.set_target(record.spacecraft, *attitude) ? ControlRefusal::none
                                                        : ControlRefusal::no_target;
}

ControlRefusal act(const ControlRecord& record, Fleet& fleet) noexcept {
  if (is_of_one_spacecraft(record.action) && record.spacecraft >= fleet.vehicles().size()) {
    return ControlRefusal::unknown_spacecraft;
  }
  switch (record.action) {
    case ControlAction::pause:
    case ControlAction::resume:
      return ControlRefusal::none;
    case ControlAction::reset:
      return fleet.reset() ? ControlRefusal::none : ControlRefusal::not_allowed;
    case ControlAction::set_state:
      return set_state(record, fleet);
    case ControlAction::set_inertia:
      return set_inertia(record, fleet);
    case ControlAction::set_target:
      return set_target(record, fleet);
  }
  return ControlRefusal::unknown_action;
}

}  // namespace

ControlAnswerRecord blank_answer(const ControlRecord& record) noexcept {
  ControlAnswerRecord answer;
  answer.commander = record.commander;
  answer.sequence = record.sequence;
  answer.action = record.action;
  answer.spacecraft = record.spacecraft;
  return answer;
}

ControlAnswerRecord apply_control(const ControlRecord& record, Fleet& fleet) noexcept {
  ControlAnswerRecord answer = blank_answer(record);
  answer.refusal = act(record, fleet);
  return answer;
}

bool ControlMemory::repeated(const ControlRecord& record,
                             const ControlAnswerRecord& blank) noexcept {
  auto& asker = memory_.find(record.commander);
  if (record.sequence > asker.last_sequence) {
    asker.last_sequence = record.sequence;
    return false;
  }
  const ControlAnswerRecord* const known = asker.recall(record.sequence);
  ControlAnswerRecord answer = blank;
  answer.refusal = ControlRefusal::old_sequence;
  answers_.push(known != nullptr ? *known : answer);
  return true;
}

void ControlMemory::hear_again(const ControlAnswerRecord& answer) noexcept {
  auto& asker = memory_.find(answer.commander);
  asker.last_sequence = std::max(asker.last_sequence, answer.sequence);
  asker.remember(answer);
}

// An answer that finds the ring full is lost; the commander repeats and gets it.
void ControlMemory::conclude(const ControlAnswerRecord& answer) noexcept {
  memory_.find(answer.commander).remember(answer);
  answers_.push(answer);
}

}  // namespace adstar::runtime
