// adstar wheel: command the motor of a wheel, and say what became of the command.

#include <memory>

#include "service/adstar/dds_options.hpp"
#include "service/adstar/order_run.hpp"
#include "service/adstar/usage.hpp"
#include "service/adstar/verbs.hpp"

namespace adstar::cli {
namespace {

struct Options {
  OrderOptions common;
  std::optional<double> torque_n_m, speed_rad_s;
};

int wheel(const Options& options) {
  if (options.torque_n_m.has_value() == options.speed_rad_s.has_value()) {
    throw Failure(kUsage,
                  "expected one of --torque-n-m and --speed-rad-s; try --torque-n-m 0.01 --for 5s");
  }
  require_an_end(options.common);
  Order order = options.common.order();
  order.what = options.speed_rad_s ? Ordered::wheel_speed : Ordered::wheel_torque;
  order.torque_n_m = {options.torque_n_m.value_or(0), 0, 0};
  order.speed_rad_s = options.speed_rad_s.value_or(0);
  return send_order("wheel", order, options.common);
}

}  // namespace

Verb add_wheel(CLI::App& program) {
  const auto options = std::make_shared<Options>();
  CLI::App* verb = program.add_subcommand(
      "wheel", "Command the motor of a wheel over DDS and print the verdict");
  verb->add_option("--torque-n-m", options->torque_n_m,
                   "Motor torque on the wheel about its axis [N m]; the body gets the opposite")
      ->type_name("U");
  verb->add_option("--speed-rad-s", options->speed_rad_s,
                   "Speed relative to the body for the motor to reach and hold [rad/s]")
      ->type_name("SPEED");
  add_order_options(*verb, options->common);
  add_name(*verb, "wheel", options->common.target.actuator, "Which of its wheels")
      ->type_name("WHEEL")
      ->required();
  verb->footer(order_footer("adstar wheel sat1 wheel1 --torque-n-m 0.01 --for 5s"));
  return {verb, [options] { return wheel(*options); }};
}

}  // namespace adstar::cli
