#include "service/dds/refusal_text.hpp"

namespace adstar::dds {

using runtime::ControlAction;
using runtime::ControlRefusal;
using runtime::StepRefusal;

const char* refusal_name(StepRefusal refusal) noexcept {
  switch (refusal) {
    case StepRefusal::none:
      return "none";
    case StepRefusal::old_sequence:
      return "old_sequence";
    case StepRefusal::busy:
      return "busy";
    case StepRefusal::too_many_steps:
      return "too_many_steps";
    case StepRefusal::not_standing:
      return "not_standing";
    case StepRefusal::halted:
      return "halted";
  }
  return "unknown refusal";
}

const char* refusal_text(StepRefusal refusal) noexcept {
  switch (refusal) {
    case StepRefusal::none:
      return "no objection";
    case StepRefusal::old_sequence:
      return "a request with this or a higher sequence number was heard before; count upwards from "
             "1";
    case StepRefusal::busy:
      return "the steps of another request are being taken; ask again when they are";
    case StepRefusal::too_many_steps:
      return "at most 1000000000 steps a request; ask for fewer, and again";
    case StepRefusal::not_standing:
      return "the clock runs by itself; pause it first (`adstar pause`), or set pace = "
             "\"lockstep\" in the scene";
    case StepRefusal::halted:
      return "the service's clock stands: a beat was over its budget; see its log, and start it "
             "anew";
  }
  return "a refusal that this program does not know; it is older than the service";
}

const char* refusal_name(ControlRefusal refusal) noexcept {
  switch (refusal) {
    case ControlRefusal::none:
      return "none";
    case ControlRefusal::not_allowed:
      return "not_allowed";
    case ControlRefusal::unknown_spacecraft:
      return "unknown_spacecraft";
    case ControlRefusal::bad_state:
      return "bad_state";
    case ControlRefusal::bad_inertia:
      return "bad_inertia";
    case ControlRefusal::not_now:
      return "not_now";
    case ControlRefusal::old_sequence:
      return "old_sequence";
    case ControlRefusal::unknown_action:
      return "unknown_action";
    case ControlRefusal::not_recorded:
      return "not_recorded";
    case ControlRefusal::no_target:
      return "no_target";
  }
  return "unknown refusal";
}

const char* refusal_text(ControlRefusal refusal) noexcept {
  switch (refusal) {
    case ControlRefusal::none:
      return "no objection";
    case ControlRefusal::not_allowed:
      return "the service's scene does not allow it; set run_control = true in its [service]";
    case ControlRefusal::unknown_spacecraft:
      return "the service flies no spacecraft of that name; see `adstar list --all`";
    case ControlRefusal::bad_state:
      return "the attitude, and of set_state the rate, must be finite, and the quaternion not zero";
    case ControlRefusal::bad_inertia:
      return "expected a positive definite tensor whose largest principal moment is at most the "
             "sum "
             "of the other two, in kg m^2 about the centre of mass";
    case ControlRefusal::not_now:
      return "the clock stands for good (see the service's log), or is not the service's to resume";
    case ControlRefusal::old_sequence:
      return "a request with this or a higher sequence number was heard before; count upwards from "
             "1";
    case ControlRefusal::unknown_action:
      return "an action that the service does not know; it is older than this program";
    case ControlRefusal::not_recorded:
      return "the run is recorded, and its journal takes no more; see the service's log: is the "
             "disk full?";
    case ControlRefusal::no_target:
      return "the scene gives this spacecraft no target to replace; add [spacecraft.pointing]";
  }
  return "a refusal that this program does not know; it is older than the service";
}

const char* action_name(ControlAction action) noexcept {
  switch (action) {
    case ControlAction::pause:
      return "pause";
    case ControlAction::resume:
      return "resume";
    case ControlAction::reset:
      return "reset";
    case ControlAction::set_state:
      return "set_state";
    case ControlAction::set_inertia:
      return "set_inertia";
    case ControlAction::set_target:
      return "set_target";
  }
  return "unknown action";
}

}  // namespace adstar::dds
