// adstar joint: command the motor of a joint, and say what became of the command.

#include <memory>

#include "service/adstar/dds_options.hpp"
#include "service/adstar/order_run.hpp"
#include "service/adstar/usage.hpp"
#include "service/adstar/verbs.hpp"

namespace adstar::cli {
namespace {

struct Options {
  OrderOptions common;
  double torque = 0;
};

}  // namespace

Verb add_joint(CLI::App& program) {
  const auto options = std::make_shared<Options>();
  CLI::App* verb = program.add_subcommand(
      "joint", "Command the motor of a joint over DDS and print the verdict");
  verb->add_option("--torque-n-m", options->torque,
                   "Torque [N m], of a prismatic joint force [N], on the body that it leads to")
      ->type_name("U")
      ->required();
  add_order_options(*verb, options->common);
  add_name(*verb, "joint", options->common.target.actuator,
           "Which of its joints; of several free coordinates NAME.1, NAME.2, ...")
      ->type_name("JOINT")
      ->required();
  verb->footer(order_footer("adstar joint sat1 hinge --torque-n-m 0.05 --for 5s"));
  return {verb, [options] {
            require_an_end(options->common);
            Order order = options->common.order();
            order.what = Ordered::joint_torque;
            order.torque_n_m = {options->torque, 0, 0};
            return send_order("joint", order, options->common);
          }};
}

}  // namespace adstar::cli
