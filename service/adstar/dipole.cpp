// adstar dipole: command the coils of a magnetorquer, and say what became of the command.

#include <memory>

#include "service/adstar/dds_options.hpp"
#include "service/adstar/order_run.hpp"
#include "service/adstar/usage.hpp"
#include "service/adstar/verbs.hpp"

namespace adstar::cli {
namespace {

struct Options {
  OrderOptions common;
  std::vector<double> dipole_a_m2;
};

int dipole(const Options& options) {
  require_an_end(options.common);
  Order order = options.common.order();
  order.what = Ordered::dipole;
  order.dipole_a_m2 = {options.dipole_a_m2[0], options.dipole_a_m2[1], options.dipole_a_m2[2]};
  return send_order("dipole", order, options.common);
}

}  // namespace

Verb add_dipole(CLI::App& program) {
  const auto options = std::make_shared<Options>();
  CLI::App* verb = program.add_subcommand(
      "dipole", "Command the dipole of a magnetorquer over DDS and print the verdict");
  verb->add_option("--dipole-a-m2", options->dipole_a_m2, "Magnetic dipole in the body [A m^2]")
      ->type_name("X Y Z")
      ->type_size(3)
      ->expected(1)
      ->required();
  add_order_options(*verb, options->common);
  add_name(*verb, "magnetorquer", options->common.target.actuator, "Which of its magnetorquers")
      ->type_name("MAGNETORQUER")
      ->required();
  verb->footer(order_footer("adstar dipole sat1 coils --dipole-a-m2 0 0.2 0 --for 30s"));
  return {verb, [options] { return dipole(*options); }};
}

}  // namespace adstar::cli
