// adstar list: which daemons are on the bus, and what they fly.

#include <algorithm>
#include <chrono>
#include <memory>

#include <fmt/format.h>

#include "service/adstar/dds_options.hpp"
#include "service/adstar/failure.hpp"
#include "service/adstar/output.hpp"
#include "service/adstar/service_state.hpp"
#include "service/adstar/services.hpp"
#include "service/adstar/stop_signal.hpp"
#include "service/adstar/usage.hpp"
#include "service/adstar/verbs.hpp"
#include "service/dds/convert.hpp"
#include "service/report/numbers.hpp"
#include "service/scene/scene.hpp"

namespace adstar::cli {
namespace {

using namespace std::chrono_literals;

struct Options {
  std::optional<std::int64_t> timeout_ns;
  bool all = false;
  dds::ParticipantOptions place;
};

constexpr std::int64_t kDefaultTimeout_ns = 1'000'000'000;
constexpr std::size_t kShown = 20;

std::string status_lines(const adstar_ServiceStatus& status) {
  std::string text = fmt::format(
      "{}, step {} ({} s), step of {}, {}, pace {}\n"
      "  commands: {} received, {} refused, {} lost; worst momentum residual {:.1e} of |H|\n",
      state_text(status.state), report::counted(status.step), report::seconds_text(status.time_ns),
      scene::format_duration(status.step_length_ns), dds::text_of(status.scheme),
      dds::text_of(status.pace), report::counted(status.commands_received),
      report::counted(status.commands_refused), report::counted(status.commands_lost),
      status.worst_momentum_residual_relative);
  if (status.run > 0) {
    text += fmt::format("  set back to its start {} times\n", report::counted(status.run));
  }
  if (status.unresolved_spacecraft > 0) {
    text += fmt::format("  WARNING: {} spacecraft turn too fast for their step; see its log\n",
                        report::counted(status.unresolved_spacecraft));
  }
  if (status.bridge_restarts > 0 || status.telemetry_lost > 0 || status.verdicts_lost > 0) {
    text +=
        fmt::format("  WARNING: {} bridge restarts, {} telemetry and {} verdicts lost\n",
                    report::counted(status.bridge_restarts), report::counted(status.telemetry_lost),
                    report::counted(status.verdicts_lost));
  }
  return text;
}

std::string actuators_text(const ListedSpacecraft& spacecraft) {
  std::string text;
  for (const std::string& actuator : spacecraft.actuators) {
    text += (text.empty() ? "" : ", ") + actuator;
  }
  return text.empty() ? "no actuators" : "actuators: " + text;
}

std::string service_text(const ListedService& service, bool all) {
  std::string text = fmt::format("service '{}': ", service.name);
  text += service.status ? status_lines(*service.status) : "no status yet\n";
  const std::size_t count = service.size();
  // Mute but for its status: there is no roster to wait for.
  if (count == 0 && service.status && service.status->state == adstar_SERVICE_STANDBY) {
    return text + "  spacecraft: none until it goes on in the primary's place\n";
  }
  text += fmt::format("  spacecraft: {}{}\n", report::counted(count),
                      service.roster_complete() ? "" : " heard so far; try a longer --timeout");
  std::size_t shown = 0;
  for (const auto& [first, members] : service.chunks) {
    for (const ListedSpacecraft& spacecraft : members) {
      if (all || shown < kShown) {
        ++shown;
        text += fmt::format("    {}  {}\n", spacecraft.name, actuators_text(spacecraft));
      }
    }
  }
  if (shown < count) {
    text += fmt::format("    ... {} more; --all shows them\n", report::counted(count - shown));
  }
  return text;
}

int list(const Options& options) {
  log_to_stderr("list");
  catch_stop_signals();
  const dds::Participant participant(options.place);
  Services services(participant);
  dds::WaitSet wait_set(participant);
  services.attach_to(wait_set);
  using Clock = std::chrono::steady_clock;
  const std::int64_t timeout_ns = options.timeout_ns.value_or(kDefaultTimeout_ns);
  const auto until = Clock::now() + std::chrono::nanoseconds(timeout_ns);
  for (auto now = Clock::now(); now < until && !stop_requested(); now = Clock::now()) {
    wait_set.wait(std::min<Clock::duration>(until - now, 50ms));
    services.take();
  }
  if (services.empty()) {
    throw Failure(kNoAnswer,
                  fmt::format("no service answers within {} on {}; is adstard running, and are "
                              "domain, interface and partition those of its scene?",
                              scene::format_duration(timeout_ns), place_of(options.place)));
  }
  Output output = Output::to_stdout();
  for (const ListedService* service : services.all()) {
    output.buffer() += service_text(*service, options.all);
  }
  output.flush();
  return kDone;
}

}  // namespace

Verb add_list(CLI::App& program) {
  const auto options = std::make_shared<Options>();
  CLI::App* verb = program.add_subcommand("list", "Which daemons are out there, and what they fly");
  add_duration(*verb, "--timeout", options->timeout_ns, "How long to listen (default: 1s)");
  verb->add_flag("--all", options->all, "Every spacecraft of a fleet, not only the first 20");
  add_dds_options(*verb, options->place);
  verb->footer("Exit code: 4 when nobody answers.\nExample:\n  adstar list --timeout 2s");
  return {verb, [options] { return list(*options); }};
}

}  // namespace adstar::cli
