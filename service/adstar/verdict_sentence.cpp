#include "service/adstar/verdict_sentence.hpp"

#include <fmt/format.h>

#include "service/adstar/dds_options.hpp"
#include "service/dds/verdict_text.hpp"
#include "service/report/numbers.hpp"
#include "service/scene/scene.hpp"

namespace adstar::cli {
namespace {

using runtime::Verdict;

std::string vector_text(const std::array<double, 3>& v) {
  return fmt::format("[{}, {}, {}]", v[0], v[1], v[2]);
}

/// What an order or an answer gives, with its unit.
template <class Given>
std::string value_of(const Given& given, Ordered what) {
  switch (what) {
    case Ordered::torque:
      return vector_text(given.torque_n_m) + " N m";
    case Ordered::wheel_torque:
    case Ordered::joint_torque:
      return fmt::format("{} N m", given.torque_n_m[0]);
    case Ordered::wheel_speed:
      return fmt::format("{} rad/s", given.speed_rad_s);
    case Ordered::dipole:
      return vector_text(given.dipole_a_m2) + " A m^2";
    case Ordered::thrust:
      break;
  }
  return {};
}

const char* name_of(Ordered what) {
  switch (what) {
    case Ordered::torque:
      return "torque ";
    case Ordered::wheel_torque:
    case Ordered::joint_torque:
      return "motor torque ";
    case Ordered::wheel_speed:
      return "speed ";
    case Ordered::dipole:
      return "dipole ";
    case Ordered::thrust:
      return "on";
  }
  return "";
}

std::string in_force(const Answer& answer, Ordered what) {
  return fmt::format("from {} s to {} s, {}{}", report::seconds_text(answer.start_ns),
                     report::seconds_text(answer.end_ns), name_of(what), value_of(answer, what));
}

std::string decided(const Answer& answer) {
  return fmt::format("at step {} ({} s)", answer.step, report::seconds_text(answer.time_ns));
}

}  // namespace

std::string verdict_sentence(const Answer& answer, const Order& asked) {
  const std::string by =
      fmt::format("{} by '{}'", dds::verdict_text(answer.verdict), answer.service);
  if (answer.forgotten) {
    return by + ", waited for its start; the service no longer remembers how it ended";
  }
  switch (answer.verdict) {
    case Verdict::accepted:
      return fmt::format("{} {}: waits, {}", by, decided(answer), in_force(answer, asked.what));
    case Verdict::applied:
      return fmt::format("{}: step {}, {}", by, answer.step, in_force(answer, asked.what));
    case Verdict::applied_late:
      return fmt::format("{}: step {}, {}; its start was past", by, answer.step,
                         in_force(answer, asked.what));
    case Verdict::clamped:
      return fmt::format("{} to the actuator's limit: step {}, {} instead of {}", by, answer.step,
                         in_force(answer, asked.what), value_of(asked, asked.what));
    case Verdict::superseded:
      return fmt::format("{} {}: a newer command took its place", by, decided(answer));
    case Verdict::expired:
      return fmt::format("{} {}: its end was past; give a later --at, --until or a longer --for",
                         by, decided(answer));
    case Verdict::outranked:
      return fmt::format("{} {}: a higher priority holds the actuator; wait, or raise --priority",
                         by, decided(answer));
    case Verdict::refused:
      return fmt::format("{} {}: {}: {}", by, decided(answer), dds::reason_name(answer.reason),
                         dds::reason_text(answer.reason));
  }
  return by;
}

ExitCode exit_code_of(const Answer& answer) {
  switch (answer.verdict) {
    case Verdict::accepted:
    case Verdict::applied:
    case Verdict::applied_late:
    case Verdict::clamped:
      return kDone;
    case Verdict::superseded:
    case Verdict::expired:
    case Verdict::outranked:
    case Verdict::refused:
      return kRefused;
  }
  return kFailed;
}

std::string no_answer_sentence(bool heard_by_anyone, std::int64_t timeout_ns,
                               const dds::ParticipantOptions& place, const std::string& service) {
  const std::string within = scene::format_duration(timeout_ns);
  const std::string from = service.empty() ? "" : " from service '" + service + "'";
  return heard_by_anyone
             ? fmt::format(
                   "no answer{} within {} on {}, though somebody listens to commands there; see "
                   "`adstar list`, and the log of adstard",
                   from, within, place_of(place))
             : fmt::format(
                   "no answer{} within {}: nobody listens to commands on {}; is adstard running, "
                   "and are domain, interface and partition those of its scene?{}",
                   from, within, place_of(place),
                   place.security ? " Do its authorities vouch for this client, and the other way?"
                                  : " A secured one hears only clients with --security.");
}

}  // namespace adstar::cli
