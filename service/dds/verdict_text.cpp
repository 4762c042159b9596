#include "service/dds/verdict_text.hpp"

namespace adstar::dds {

using runtime::Reason;
using runtime::Verdict;

const char* verdict_text(Verdict verdict) noexcept {
  switch (verdict) {
    case Verdict::accepted:
      return "accepted";
    case Verdict::applied:
      return "applied";
    case Verdict::applied_late:
      return "applied_late";
    case Verdict::clamped:
      return "clamped";
    case Verdict::superseded:
      return "superseded";
    case Verdict::expired:
      return "expired";
    case Verdict::outranked:
      return "outranked";
    case Verdict::refused:
      return "refused";
  }
  return "unknown verdict";
}

const char* reason_name(Reason reason) noexcept {
  switch (reason) {
    case Reason::none:
      return "none";
    case Reason::unknown_spacecraft:
      return "unknown_spacecraft";
    case Reason::unknown_actuator:
      return "unknown_actuator";
    case Reason::not_finite:
      return "not_finite";
    case Reason::bad_interval:
      return "bad_interval";
    case Reason::old_sequence:
      return "old_sequence";
    case Reason::no_authority:
      return "no_authority";
    case Reason::schedule_full:
      return "schedule_full";
    case Reason::capacity:
      return "capacity";
    case Reason::halted:
      return "halted";
    case Reason::not_recorded:
      return "not_recorded";
  }
  return "unknown reason";
}

const char* reason_text(Reason reason) noexcept {
  switch (reason) {
    case Reason::none:
      return "no objection";
    case Reason::unknown_spacecraft:
      return "no service here flies a spacecraft of that name; see `adstar list`";
    case Reason::unknown_actuator:
      return "the spacecraft has no actuator of that name and kind; see `adstar list`, or add to "
             "the "
             "scene a torque with model = \"commanded\", or commanded = true to a wheel";
    case Reason::not_finite:
      return "the torque holds a NaN or an infinity; send finite numbers in N m";
    case Reason::bad_interval:
      return "the interval makes no sense; give an end after the start, or a positive duration, "
             "not both";
    case Reason::old_sequence:
      return "a command with this or a higher sequence number was heard before; count upwards from "
             "1";
    case Reason::no_authority:
      return "the actuator has no torque about one of the axes asked for; see max_torque_n_m in "
             "the scene";
    case Reason::schedule_full:
      return "64 commands wait on this actuator already; wait until some have begun";
    case Reason::capacity:
      return "the service's memory of commanders is full; use fewer commanding processes";
    case Reason::halted:
      return "the service's clock stands: a beat was over its budget; see its log, and start it "
             "anew";
    case Reason::not_recorded:
      return "the run is recorded, and its journal takes no more commands; see the service's log: "
             "is the "
             "disk full?";
  }
  return "a reason that this program does not know; it is older than the service";
}

}  // namespace adstar::dds
