// adstar fire: switch a thruster on, and say what became of the command.

#include <memory>

#include "service/adstar/dds_options.hpp"
#include "service/adstar/order_run.hpp"
#include "service/adstar/usage.hpp"
#include "service/adstar/verbs.hpp"

namespace adstar::cli {

Verb add_fire(CLI::App& program) {
  const auto options = std::make_shared<OrderOptions>();
  CLI::App* verb =
      program.add_subcommand("fire", "Switch a thruster on over DDS and print the verdict");
  add_order_options(*verb, *options);
  add_name(*verb, "thruster", options->target.actuator, "Which of its thrusters")
      ->type_name("THRUSTER")
      ->required();
  verb->footer(order_footer("adstar fire sat1 roll_plus --for 200ms"));
  return {verb, [options] {
            require_an_end(*options);
            Order order = options->order();
            order.what = Ordered::thrust;
            return send_order("fire", order, *options);
          }};
}

}  // namespace adstar::cli
