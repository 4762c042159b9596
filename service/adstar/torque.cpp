// adstar torque: command an actuator, and say what became of the command.

#include <memory>

#include "service/adstar/dds_options.hpp"
#include "service/adstar/order_run.hpp"
#include "service/adstar/profile_run.hpp"
#include "service/adstar/stop_signal.hpp"
#include "service/adstar/usage.hpp"
#include "service/adstar/verbs.hpp"

namespace adstar::cli {
namespace {

struct Options {
  OrderOptions common;
  std::vector<double> torque_n_m;
  std::string profile;
};

void require_consistent(const Options& options) {
  const bool profile = !options.profile.empty();
  if (profile == !options.torque_n_m.empty()) {
    throw Failure(kUsage,
                  "expected one of --torque-n-m and --profile; try --torque-n-m 0 0 0.05 --for 5s");
  }
  if (!profile) {
    require_an_end(options.common);
  } else if (options.common.for_ns || options.common.until_ns) {
    throw Failure(kUsage,
                  "--profile takes no --for and no --until: its rows say how long; leave them out");
  }
}

int torque(const Options& options) {
  require_consistent(options);
  std::vector<ProfileRow> rows;
  if (!options.profile.empty()) {
    rows = read_profile(options.profile);
  }
  const OrderOptions& common = options.common;
  if (!rows.empty()) {
    log_to_stderr("torque");
    catch_stop_signals();
    const dds::Participant participant(common.place);
    Commander commander(participant, common.target);
    ProfileRun run(commander, std::move(rows),
                   {common.at_ns, common.priority, common.wait, common.timeout()});
    return answered(run.run(), commander, common);
  }
  Order order = common.order();
  order.torque_n_m = {options.torque_n_m[0], options.torque_n_m[1], options.torque_n_m[2]};
  return send_order("torque", order, common);
}

}  // namespace

Verb add_torque(CLI::App& program) {
  const auto options = std::make_shared<Options>();
  options->common.target.actuator = "body";
  CLI::App* verb =
      program.add_subcommand("torque", "Command a torque over DDS and print the verdict");
  verb->add_option("--torque-n-m", options->torque_n_m, "Torque in the actuator's frame [N m]")
      ->type_name("X Y Z")
      ->type_size(3)
      ->expected(1);
  verb->add_option("--profile", options->profile,
                   "Rows time_s,torque_x_n_m,torque_y_n_m,torque_z_n_m, each held until the next, "
                   "the last one ends it; times count from --at, or from a moment after now")
      ->type_name("FILE");
  add_name(*verb, "--actuator", options->common.target.actuator, "Which actuator of the spacecraft")
      ->capture_default_str();
  add_order_options(*verb, options->common);
  verb->footer(order_footer("adstar torque sat1 --torque-n-m 0 0 0.05 --for 5s"));
  return {verb, [options] { return torque(*options); }};
}

}  // namespace adstar::cli
