// adstar dashboard: a page on loopback that shows what the daemons do, and may send torque pulses.

#include <chrono>
#include <cstdio>
#include <memory>
#include <thread>

#include <fmt/format.h>

#include "service/adstar/dds_options.hpp"
#include "service/adstar/failure.hpp"
#include "service/adstar/stop_signal.hpp"
#include "service/adstar/usage.hpp"
#include "service/adstar/verbs.hpp"
#include "service/dashboard/server/bus.hpp"
#include "service/dashboard/server/page.hpp"
#include "service/dashboard/server/pulse.hpp"
#include "service/dashboard/server/site.hpp"
#include "service/dds/error.hpp"
#include "service/dds/writer.hpp"

namespace adstar::cli {
namespace {

using namespace std::chrono_literals;

struct Options {
  int port = 8765;
  bool allow_commands = false;
  dds::ParticipantOptions place;
};

void require_permission_to_command(const dds::Participant& participant) {
  try {
    const dds::Writer<adstar_TorqueCommand> writer(participant);
  } catch (const dds::NotAllowed&) {
    const auto& security = participant.options().security;
    throw Failure(
        kRefused,
        fmt::format("--allow-commands: the permissions of '{}' do not let it write {}; give "
                    "--security keys of a commander (deploy/security/README.md), or leave "
                    "--allow-commands out: the page then only shows",
                    security ? security->permissions.parent_path().string() : "this client",
                    dds::topic_of<adstar_TorqueCommand>().name));
  }
}

int serve(const Options& options) {
  log_to_stderr("dashboard");
  catch_stop_signals();
  const dds::Participant participant(options.place);
  if (options.allow_commands) {
    require_permission_to_command(participant);
  }
  dashboard::Bus bus(participant);
  dashboard::PulseDesk desk(participant);
  const dashboard::Site site(bus, desk,
                             {options.port, options.allow_commands, place_of(options.place)});
  if (dashboard::page_files().empty()) {
    fmt::print(stderr,
               "adstar dashboard: built without the page, only /events, /fleet and /metrics are "
               "served; for the page, install nodejs and npm, configure with "
               "-DADSTAR_BUILD_DASHBOARD=ON and build again\n");
  }
  fmt::print("http://127.0.0.1:{}/ shows {}; {}\n", site.port(), place_of(options.place),
             options.allow_commands ? "whoever uses this machine can command"
                                    : "read-only (--allow-commands lets it command)");
  std::fflush(stdout);
  while (!stop_requested()) {
    bus.listen(50ms);
    // Readers keep what comes meanwhile: a fast daemon does not cost a processor.
    std::this_thread::sleep_for(20ms);
  }
  return kDone;
}

}  // namespace

Verb add_dashboard(CLI::App& program) {
  const auto options = std::make_shared<Options>();
  CLI::App* verb = program.add_subcommand(
      "dashboard", "A page on loopback: motion, momentum, timing, commands, fleet; /metrics");
  verb->add_option("--port", options->port, "TCP port on 127.0.0.1; 0: any that is free")
      ->type_name("N")
      ->check(whole_number(0, 65535))
      ->capture_default_str();
  verb->add_flag("--allow-commands", options->allow_commands,
                 "Let the page send torque pulses (default: it only shows)");
  add_dds_options(*verb, options->place);
  verb->footer(
      "Ctrl-C ends it with 0. Prometheus reads /metrics.\n"
      "Example:\n"
      "  adstar dashboard --port 8765 --allow-commands");
  return {verb, [options] { return serve(*options); }};
}

}  // namespace adstar::cli
