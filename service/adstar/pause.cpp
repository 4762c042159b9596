// adstar pause, resume, reset: hold the clock of a run, let it go, set it back.

#include <memory>

#include "service/adstar/run_control.hpp"
#include "service/adstar/verbs.hpp"

namespace adstar::cli {
namespace {

Verb add(CLI::App& program, const char* name, const char* description, adstar_ControlAction action,
         const char* more) {
  const auto options = std::make_shared<RequestOptions>();
  CLI::App* verb = program.add_subcommand(name, description);
  add_request_options(*verb, *options);
  verb->footer(std::string(more) +
               "The scene must say [service] run_control = true.\n"
               "Exit code: 0 done, 3 refused, 4 no answer.\n"
               "Example:\n"
               "  adstar " +
               name);
  return {verb, [name, action, options] {
            adstar_RunControl request{};
            request.action = action;
            return control_run(name, request, *options);
          }};
}

}  // namespace

Verb add_pause(CLI::App& program) {
  return add(program, "pause", "Hold the clock of a run", adstar_CONTROL_PAUSE,
             "Paused, the daemon still judges commands; `adstar step` takes single steps.\n");
}

Verb add_resume(CLI::App& program) {
  return add(program, "resume", "Let a paused clock go on", adstar_CONTROL_RESUME,
             "No beat is missed by a pause: the next one is due at once.\n");
}

Verb add_reset(CLI::App& program) {
  return add(program, "reset", "Set a run back to its scene's start", adstar_CONTROL_RESET,
             "Commands that wait are superseded. A paused clock stays paused.\n");
}

}  // namespace adstar::cli
