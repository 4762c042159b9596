// adstar set-inertia: give a spacecraft another mass distribution, as a deployment does.

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
  std::vector<double> inertia_body_kg_m2;
  RequestOptions request;
};

int set_inertia(const Options& options) {
  std::vector<double> J = options.inertia_body_kg_m2;
  J.resize(6);
  adstar_RunControl request{};
  request.action = adstar_CONTROL_SET_INERTIA;
  dds::set_text(request.spacecraft, options.spacecraft);
  request.inertia_body_kg_m2 = {J[0], J[1], J[2], J[3], J[4], J[5]};
  return control_run("set-inertia", request, options.request);
}

}  // namespace

Verb add_set_inertia(CLI::App& program) {
  const auto options = std::make_shared<Options>();
  CLI::App* verb = program.add_subcommand(
      "set-inertia", "Give a spacecraft another inertia; its momentum stays, its rate changes");
  add_name(*verb, "spacecraft", options->spacecraft, "Which spacecraft")
      ->type_name("SPACECRAFT")
      ->required();
  add_numbers(*verb, "--inertia", options->inertia_body_kg_m2, {3, 6}, "JXX,JYY,JZZ[,JXY,JXZ,JYZ]",
              "Tensor about the centre of mass in body axes [kg m2]; left out: zero", "0.9,1.1,1.6")
      ->required();
  add_request_options(*verb, options->request);
  verb->footer(
      "The spacecraft's residual accounts begin anew: no torque did this.\n"
      "The scene must say [service] run_control = true.\n"
      "Exit code: 0 done, 3 refused, 4 no answer.\n"
      "Example:\n"
      "  adstar set-inertia sat1 --inertia 1.2,1.4,2.1");
  return {verb, [options] { return set_inertia(*options); }};
}

}  // namespace adstar::cli
