#pragma once
// The verbs, one file each. To add one: its file, a line here and a line in main.cpp.

#include <functional>

#include <CLI/CLI.hpp>

namespace adstar::cli {

struct Verb {
  CLI::App* command = nullptr;  ///< its options, in the tree of the program
  std::function<int()> run;  ///< returns the exit code; may throw Failure, ReaderGone, SceneError
};

Verb add_propagate(CLI::App& program);
Verb add_check(CLI::App& program);
Verb add_trade(CLI::App& program);
Verb add_reproduce(CLI::App& program);
Verb add_torque(CLI::App& program);
Verb add_wheel(CLI::App& program);
Verb add_dipole(CLI::App& program);
Verb add_fire(CLI::App& program);
Verb add_joint(CLI::App& program);
Verb add_monitor(CLI::App& program);
Verb add_list(CLI::App& program);
Verb add_timing(CLI::App& program);
/// In service/dashboard/server/verb.cpp.
Verb add_dashboard(CLI::App& program);
Verb add_replay(CLI::App& program);
Verb add_step(CLI::App& program);
Verb add_pause(CLI::App& program);
Verb add_resume(CLI::App& program);
Verb add_reset(CLI::App& program);
Verb add_set_state(CLI::App& program);
Verb add_set_inertia(CLI::App& program);
Verb add_set_target(CLI::App& program);
Verb add_record(CLI::App& program);
Verb add_export(CLI::App& program);
Verb add_plot(CLI::App& program);
/// Reads the finished option tree when it runs.
Verb add_completion(CLI::App& program);

}  // namespace adstar::cli
