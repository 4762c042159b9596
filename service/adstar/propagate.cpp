// adstar propagate: the scene as fast as the machine allows, without DDS, as CSV.

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "service/adstar/failure.hpp"
#include "service/adstar/output.hpp"
#include "service/adstar/progress_bar.hpp"
#include "service/adstar/propagate_plan.hpp"
#include "service/adstar/row.hpp"
#include "service/adstar/side_rows.hpp"
#include "service/adstar/stop_signal.hpp"
#include "service/adstar/unresolved.hpp"
#include "service/adstar/usage.hpp"
#include "service/adstar/verbs.hpp"
#include "service/report/numbers.hpp"
#include "service/runtime/fleet.hpp"
#include "service/scene/scene.hpp"

namespace adstar::cli {
namespace {

struct Options {
  std::string scene;
  std::string output, wheels, pointing, bodies, joints;
  std::size_t threads = 1;
  PropagateRequest request;
};

void set(Row& row, const runtime::Vehicle& vehicle) {
  const runtime::TelemetryRecord s = runtime::sample(vehicle);
  const auto put = [&](std::size_t first, const auto& values) {
    std::copy(values.begin(), values.end(),
              row.values.begin() + static_cast<std::ptrdiff_t>(first));
  };
  put(kAttitude, s.q_IB);
  put(kAngularVelocity, s.omega_B_rad_s);
  put(kMomentumInertial, s.H_I_n_m_s);
  put(kMomentumBody, s.Pi_B_n_m_s);
  row.values[kEnergy] = s.rotational_energy_j;
  row.values[kWork] = s.work_j;
}

void write_rows(Output& output, const scene::Scene& scene, const runtime::Fleet& fleet,
                std::uint64_t step, std::int64_t time_ns) {
  Row row;
  row.step = step;
  row.time_ns = time_ns;
  for (std::size_t i = 0; i < scene.spacecraft.size(); ++i) {
    row.spacecraft = scene.spacecraft[i].name;
    set(row, fleet.vehicles()[i]);
    append_csv(output.buffer(), row);
    output.flush_if_full();
  }
}

/// The files beside the motion, those that were asked for.
class SideOutputs {
 public:
  SideOutputs(const Options& options, const scene::Scene& scene) {
    open(wheels_, "--wheels", options.wheels, kWheelColumns,
         scene::first_with_wheels(scene.spacecraft) != nullptr, "the scene has no wheels");
    open(pointing_, "--pointing", options.pointing, kPointingColumns,
         scene::first_with_reference(scene.spacecraft) != nullptr,
         "no spacecraft of the scene has an orbit or a target");
    const bool linked = scene::first_linked(scene.spacecraft) != nullptr;
    const char* const none = "no spacecraft of the scene has linked bodies";
    open(bodies_, "--bodies", options.bodies, kBodyColumns, linked, none);
    open(joints_, "--joints", options.joints, kJointColumns, linked, none);
  }

  void write(const scene::Scene& scene, runtime::Fleet& fleet, std::uint64_t step,
             std::int64_t time_ns) {
    if (wheels_) {
      write_wheels(*wheels_, scene, fleet, step, time_ns);
    }
    if (pointing_) {
      write_pointing(*pointing_, scene, fleet, step, time_ns);
    }
    if (bodies_) {
      write_bodies(*bodies_, scene, fleet, step, time_ns);
    }
    if (joints_) {
      write_joints(*joints_, scene, fleet, step, time_ns);
    }
  }

  void commit() {
    for (std::optional<Output>* const output : {&wheels_, &pointing_, &bodies_, &joints_}) {
      if (*output) {
        (*output)->commit();
      }
    }
  }

 private:
  static void open(std::optional<Output>& output, const char* option, const std::string& file,
                   const char* columns, bool there_are_some, const char* none) {
    if (file.empty()) {
      return;
    }
    if (!there_are_some) {
      throw Failure(kUsage, fmt::format("{}: {}; leave it out", option, none));
    }
    output.emplace(Output::to_file(file));
    output->buffer() = columns;
  }

  std::optional<Output> wheels_, pointing_, bodies_, joints_;
};

/// Nobody commands here: an actuator of the scene is still.
void say_that_actuators_rest(const scene::Scene& scene) {
  std::size_t count = 0;
  std::string first;
  for (const scene::Spacecraft& craft : scene.spacecraft) {
    for (const scene::Actuator& actuator : craft.actuators) {
      if (count++ == 0) {
        first = fmt::format("'{}' of '{}'", actuator.name, craft.name);
      }
    }
  }
  if (count > 0) {
    const std::string more =
        count > 1 ? fmt::format(" and {} more", report::counted(count - 1)) : "";
    fmt::print(stderr,
               "adstar propagate: nobody commands {}{} here; to command it, run adstard, and "
               "`adstar torque`, `wheel`, `dipole`, `fire` or `joint`\n",
               first, more);
  }
}

int propagate(const Options& options) {
  const scene::Scene scene = scene::load(options.scene);
  const PropagatePlan plan = make_plan(scene, options.request);
  catch_stop_signals();
  Output output = options.output.empty() ? Output::to_stdout() : Output::to_file(options.output);
  runtime::Fleet fleet(scene.spacecraft, plan.scheme, scene.simulation.limits,
                       runtime::Lanewise::automatic, options.threads);
  say_that_actuators_rest(scene);

  SideOutputs beside(options, scene);
  const auto write = [&](std::uint64_t step, std::int64_t time_ns) {
    write_rows(output, scene, fleet, step, time_ns);
    beside.write(scene, fleet, step, time_ns);
  };
  append_csv_header(output.buffer());
  write(0, 0);
  Unresolved unresolved(scene.spacecraft.size());
  {
    ProgressBar progress(plan.steps);
    // Asking the clock costs as much as some steps.
    const std::uint64_t look_every = std::max<std::uint64_t>(1, 4096 / scene.spacecraft.size());
    for (std::uint64_t n = 0; n < plan.steps; ++n) {
      const auto t_ns = static_cast<std::int64_t>(n) * plan.step_ns;
      if (fleet.step(t_ns, plan.step_ns) > 0) {
        unresolved.note(fleet, t_ns + plan.step_ns);
      }
      const std::uint64_t done = n + 1;
      if (done == plan.steps || (plan.every > 0 && done % plan.every == 0)) {
        write(done, t_ns + plan.step_ns);
      }
      if (done % look_every == 0) {
        progress.show(done);
        if (stop_requested()) {
          throw Failure(kFailed, fmt::format("interrupted at {} s; no output file was written",
                                             report::seconds_text(t_ns + plan.step_ns)));
        }
      }
    }
  }
  output.commit();
  beside.commit();
  if (const std::string warning = unresolved.warning(scene, plan.step_ns); !warning.empty()) {
    fmt::print(stderr, "adstar propagate: {}\n", warning);
  }
  return kDone;
}

}  // namespace

Verb add_propagate(CLI::App& program) {
  const auto options = std::make_shared<Options>();
  CLI::App* verb = program.add_subcommand(
      "propagate", "Run a scene as fast as possible, without DDS, and print CSV");
  add_scene(*verb, options->scene);
  add_duration(*verb, "--duration", options->request.duration_ns,
               "How long, whole steps (default: the scene's)");
  add_duration(*verb, "--step", options->request.step_ns,
               "Step instead of the scene's, whole nanoseconds");
  verb->add_option("--scheme", options->request.scheme, "Integrator instead of the scene's")
      ->type_name("SCHEME");
  add_duration(*verb, "--every", options->request.every_ns,
               "A row that often, whole steps (default: first and last only)");
  verb->add_option("--threads", options->threads,
                   "Step parts of a large fleet at once; the bits are the same (default: 1)")
      ->type_name("COUNT")
      ->check(whole_number(1, 256));
  verb->add_option("--output", options->output,
                   "Write there, whole or not at all (default: stdout)")
      ->type_name("FILE");
  verb->add_option("--wheels", options->wheels, "Write the wheels' rows there, whole or not at all")
      ->type_name("FILE");
  verb->add_option("--pointing", options->pointing,
                   "Write there how they point against orbit and target, whole or not at all")
      ->type_name("FILE");
  verb->add_option("--bodies", options->bodies,
                   "Write the rows of linked bodies there, whole or not at all")
      ->type_name("FILE");
  verb->add_option("--joints", options->joints,
                   "Write the rows of their joints there, loads too, whole or not at all")
      ->type_name("FILE");
  verb->footer(
      "Example:\n"
      "  adstar propagate configs/scenes/paper_free.toml --duration 100s --every 1s --output "
      "run.csv");
  return {verb, [options] { return propagate(*options); }};
}

}  // namespace adstar::cli
