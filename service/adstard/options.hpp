#pragma once
// The command line of adstard.

#include <cstdint>
#include <optional>
#include <string>

#include "service/scene/scene.hpp"

namespace adstar::adstard {

/// Of every program here.
enum ExitCode { kDone = 0, kFailed = 1, kUsage = 2, kRefused = 3, kNoAnswer = 4 };

struct Options {
  std::string scene_file;  ///< empty with resume
  std::string run;         ///< directory of a run to begin; empty: the scene's
  std::string resume;      ///< directory of a run to go on with
  bool accept_loss = false;
  std::string memory = "/dev/shm";  ///< where the end of the run's journal is to be
  bool standby = false;
  std::string service;   ///< empty: the scene's
  std::string duration;  ///< empty: the scene's
};

/// Parses or, for --help, --version and mistakes, prints what is to be said and gives the exit code
/// instead.
std::optional<Options> parse_options(int argc, char** argv, int& exit_code);

/// Lays the options over the scene. Throws scene::SceneError for a duration that is none.
void apply(const Options& options, scene::Scene& scene);

}  // namespace adstar::adstard
