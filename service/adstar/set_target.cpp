// adstar set-target: what the pointing error of a spacecraft is told against.

#include <memory>

#include "service/adstar/numbers_option.hpp"
#include "service/adstar/run_control.hpp"
#include "service/adstar/usage.hpp"
#include "service/adstar/verbs.hpp"
#include "service/dds/convert.hpp"

namespace adstar::cli {
namespace {

struct Options {
  std::string spacecraft;
  std::vector<double> attitude;
  RequestOptions request;
};

int set_target(const Options& options) {
  const auto& q = options.attitude;
  adstar_RunControl request{};
  request.action = adstar_CONTROL_SET_TARGET;
  dds::set_text(request.spacecraft, options.spacecraft);
  request.attitude_body_to_frame = {q[0], q[1], q[2], q[3]};
  return control_run("set-target", request, options.request);
}

}  // namespace

Verb add_set_target(CLI::App& program) {
  const auto options = std::make_shared<Options>();
  CLI::App* verb = program.add_subcommand(
      "set-target", "Tell a spacecraft's pointing error against another attitude");
  add_name(*verb, "spacecraft", options->spacecraft, "Which spacecraft")
      ->type_name("SPACECRAFT")
      ->required();
  add_numbers(*verb, "--attitude", options->attitude, {4}, "W,X,Y,Z",
              "Quaternion from body to the frame of its [spacecraft.pointing], of any length but "
              "zero",
              "1,0,0,0")
      ->required();
  add_request_options(*verb, options->request);
  verb->footer(
      "The motion is not changed: PointingState is. The scene must have a [spacecraft.pointing] "
      "to\n"
      "replace, and say [service] run_control = true.\n"
      "Exit code: 0 done, 3 refused, 4 no answer.\n"
      "Example:\n"
      "  adstar set-target sat1 --attitude 0.7071,0,0,0.7071");
  return {verb, [options] { return set_target(*options); }};
}

}  // namespace adstar::cli
