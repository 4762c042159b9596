#include "service/adstar/verdict_sentence.hpp"

#include <fmt/format.h>

#include "service/adstar/dds_options.hpp"
#include "service/dds/verdict_text.hpp"
#include "service/report/numbers.hpp"
#include "service/scene/scene.hpp"

namespace adstar::cli {
namespace {

using runtime::Verdict;

/// The number or numbers of an order or an answer.
template <class Given>
std::string value_of(const Given& given, Ordered what) {
  const auto& v = given.torque_n_m;
  switch (what) {
    case Ordered::torque:
      break;
    case Ordered::wheel_torque:
      return fmt::format("{}", v[0]);
    case Ordered::wheel_speed:
      return fmt::format("{}", given.speed_rad_s);
  }
  return fmt::format("[{}, {}, {}]", v[0], v[1], v[2]);
}

std::string in_force(const Answer& answer, Ordered what) {
  const bool speed = what == Ordered::wheel_speed;
  return fmt::format("from {} s to {} s, {} {} {}", report::seconds_text(answer.start_ns),
                     report::seconds_text(answer.end_ns),
                     speed                           ? "speed"
                     : what == Ordered::wheel_torque ? "motor torque"
                                                     : "torque",
                     value_of(answer, what), speed ? "rad/s" : "N m");
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
