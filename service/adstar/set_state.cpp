// adstar set-state: put a spacecraft into an attitude and a rate.

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
  std::vector<double> attitude, rate_rad_s;
  RequestOptions request;
};

int set_state(const Options& options) {
  const auto& q = options.attitude;
  const auto& omega = options.rate_rad_s;
  adstar_RunControl request{};
  request.action = adstar_CONTROL_SET_STATE;
  dds::set_text(request.spacecraft, options.spacecraft);
  request.attitude_body_to_inertial = {q[0], q[1], q[2], q[3]};
  request.angular_velocity_body_rad_s = {omega[0], omega[1], omega[2]};
  return control_run("set-state", request, options.request);
}

}  // namespace

Verb add_set_state(CLI::App& program) {
  const auto options = std::make_shared<Options>();
  CLI::App* verb = program.add_subcommand(
      "set-state", "Put a spacecraft into an attitude and an angular velocity");
  add_name(*verb, "spacecraft", options->spacecraft, "Which spacecraft")
      ->type_name("SPACECRAFT")
      ->required();
  add_numbers(*verb, "--attitude", options->attitude, {4}, "W,X,Y,Z",
              "Quaternion from body to inertial, of any length but zero", "1,0,0,0")
      ->required();
  add_numbers(*verb, "--rate", options->rate_rad_s, {3}, "X,Y,Z",
              "Angular velocity in body axes [rad/s]", "0,0,0.1")
      ->required();
  add_request_options(*verb, options->request);
  verb->footer(
      "What was propagated is left: the spacecraft's residual accounts begin anew.\n"
      "The scene must say [service] run_control = true.\n"
      "Exit code: 0 done, 3 refused, 4 no answer.\n"
      "Example:\n"
      "  adstar set-state sat1 --attitude 1,0,0,0 --rate 0,0,0.1");
  return {verb, [options] { return set_state(*options); }};
}

}  // namespace adstar::cli
