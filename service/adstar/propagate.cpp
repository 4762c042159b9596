// adstar propagate: the scene as fast as the machine allows, without DDS, as CSV.

#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "service/adstar/failure.hpp"
#include "service/adstar/output.hpp"
#include "service/adstar/progress_bar.hpp"
#include "service/adstar/stop_signal.hpp"
#include "service/adstar/usage.hpp"
#include "service/adstar/verbs.hpp"
#include "service/propagation/fly.hpp"
#include "service/propagation/plan.hpp"
#include "service/propagation/side_rows.hpp"
#include "service/report/numbers.hpp"
#include "service/report/row.hpp"
#include "service/runtime/fleet.hpp"
#include "service/scene/scene.hpp"

namespace adstar::cli {
namespace {

struct Options {
  std::string scene;
  std::string output;
  std::map<std::string, std::string> beside;  ///< file by the name of its table
  std::size_t threads = 1;
  propagation::Request request;
};

const propagation::Words kWords{"--duration", "--step", "--every",
                                "--scheme",   " ",      scene::format_duration};

void set(report::Row& row, const runtime::Vehicle& vehicle) {
  const runtime::TelemetryRecord s = runtime::sample(vehicle);
  const auto put = [&](std::size_t first, const auto& values) {
    std::copy(values.begin(), values.end(),
              row.values.begin() + static_cast<std::ptrdiff_t>(first));
  };
  put(report::kAttitude, s.q_IB);
  put(report::kAngularVelocity, s.omega_B_rad_s);
  put(report::kMomentumInertial, s.H_I_n_m_s);
  put(report::kMomentumBody, s.Pi_B_n_m_s);
  row.values[report::kEnergy] = s.rotational_energy_j;
  row.values[report::kWork] = s.work_j;
}

void write_rows(Output& output, const scene::Scene& scene, const runtime::Fleet& fleet,
                std::uint64_t step, std::int64_t time_ns) {
  report::Row row;
  row.step = step;
  row.time_ns = time_ns;
  for (std::size_t i = 0; i < scene.spacecraft.size(); ++i) {
    row.spacecraft = scene.spacecraft[i].name;
    set(row, fleet.vehicles()[i]);
    report::append_csv(output.buffer(), row);
    output.flush_if_full();
  }
}

/// The files beside the motion, those that were asked for.
class SideOutputs {
 public:
  SideOutputs(const Options& options, const scene::Scene& scene) {
    for (const propagation::SideTable& table : propagation::side_tables()) {
      const std::string& file = options.beside.at(table.name);
      if (file.empty()) {
        continue;
      }
      if (table.first(scene.spacecraft) == nullptr) {
        throw Failure(kUsage, fmt::format("--{}: {}; leave it out", table.name, table.none));
      }
      outputs_.push_back({table, Output::to_file(file)});
      outputs_.back().output.buffer() = fmt::format("{}\n", table.columns);
    }
  }

  void write(const scene::Scene& scene, runtime::Fleet& fleet, std::uint64_t step,
             std::int64_t time_ns) {
    for (auto& [table, output] : outputs_) {
      table.rows(scene, fleet, step, time_ns, [&out = output](const report::Fields& row) {
        report::append_csv(out.buffer(), row);
        out.flush_if_full();
      });
    }
  }

  void commit() {
    for (auto& [table, output] : outputs_) {
      output.commit();
    }
  }

 private:
  struct Side {
    const propagation::SideTable& table;
    Output output;
  };
  std::vector<Side> outputs_;
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
  const propagation::Plan plan = propagation::make_plan(scene, options.request, kWords);
  catch_stop_signals();
  Output output = options.output.empty() ? Output::to_stdout() : Output::to_file(options.output);
  runtime::Fleet fleet(scene.spacecraft, plan.scheme, scene.simulation.limits,
                       runtime::Lanewise::automatic, options.threads);
  say_that_actuators_rest(scene);

  SideOutputs beside(options, scene);
  report::append_csv_header(output.buffer());
  std::optional<ProgressBar> progress(std::in_place, plan.steps);
  const propagation::Unresolved unresolved = propagation::fly(
      fleet, plan,
      {[&](std::uint64_t step, std::int64_t time_ns) {
         write_rows(output, scene, fleet, step, time_ns);
         beside.write(scene, fleet, step, time_ns);
       },
       [&](std::uint64_t done, std::int64_t time_ns) {
         progress->show(done);
         if (stop_requested()) {
           throw Failure(kFailed, fmt::format("interrupted at {} s; no output file was written",
                                              report::seconds_text(time_ns)));
         }
       }});
  progress.reset();
  output.commit();
  beside.commit();
  if (const std::string warning = unresolved.warning(scene, plan, kWords); !warning.empty()) {
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
  verb->add_option("--wheels", options->beside["wheels"],
                   "Write the wheels' rows there, whole or not at all")
      ->type_name("FILE");
  verb->add_option("--pointing", options->beside["pointing"],
                   "Write there how they point against orbit and target, whole or not at all")
      ->type_name("FILE");
  verb->add_option("--bodies", options->beside["bodies"],
                   "Write the rows of linked bodies there, whole or not at all")
      ->type_name("FILE");
  verb->add_option("--joints", options->beside["joints"],
                   "Write the rows of their joints there, loads too, whole or not at all")
      ->type_name("FILE");
  verb->footer(
      "Example:\n"
      "  adstar propagate configs/scenes/paper_free.toml --duration 100s --every 1s --output "
      "run.csv");
  return {verb, [options] { return propagate(*options); }};
}

}  // namespace adstar::cli
