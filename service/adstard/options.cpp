#include "service/adstard/options.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "service/run/hot_journal_file.hpp"

namespace adstar::adstard {

std::optional<Options> parse_options(int argc, char** argv, int& exit_code) {
  Options options;
  CLI::App app{
      "adstard - propagates the attitude of the spacecraft of a scene in real time.\n"
      "Takes TorqueCommand over DDS, publishes attitude, momentum and timing. Ctrl-C ends the run.",
      "adstard"};
  auto* const scene = app.add_option("SCENE", options.scene_file, "the scene, a TOML file");
  auto* const run = app.add_option(
      "--run", options.run, "keep checkpoints and a journal of the commands in this new directory");
  auto* const resume =
      app.add_option("--resume", options.resume,
                     "go on with the run in this directory, with the bits it would have had");
  scene->excludes(resume);
  run->excludes(resume);
  app.add_flag("--accept-loss", options.accept_loss,
               "with --resume: go on even where part of the journal is missing")
      ->needs(resume);
  app.add_flag(
         "--standby", options.standby,
         "follow the primary of this scene's [standby] in silence, and go on in its place when "
         "it is gone")
      ->excludes(resume);
  app.add_option("--memory", options.memory,
                 "a directory of a tmpfs, for the commands of a run that are not in a file yet")
      ->capture_default_str()
      ->check(CLI::Validator(
          [](std::string& directory) { return run::why_not_in_memory(directory); }, ""));
  app.add_option("--service", options.service,
                 "what this daemon calls itself (default: the scene's name, or the host's)");
  app.add_option("--duration", options.duration,
                 "simulated time to run for, e.g. 10min (default: the scene's)");
  app.set_version_flag("--version", ADSTAR_VERSION);
  app.footer(
      "Examples:\n  adstard configs/scenes/demo.toml\n  adstard configs/scenes/demo.toml --run "
      "runs/monday\n"
      "  adstard --resume runs/monday\n"
      "  adstard pair.toml --run runs/b --standby\n\n"
      "Exit codes: 0 done, 2 usage or scene, 3 refused (somebody flies these spacecraft already, "
      "or the "
      "step does not fit its beat, or the run cannot go on as it was), "
      "1 anything else.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    exit_code = app.exit(error) == 0 ? kDone : kUsage;
    return std::nullopt;
  }
  if (options.scene_file.empty() && options.resume.empty()) {
    fmt::print(stderr, "SCENE is required, or --resume DIRECTORY; try adstard --help\n");
    exit_code = kUsage;
    return std::nullopt;
  }
  return options;
}

void apply(const Options& options, scene::Scene& scene) {
  if (!options.service.empty()) {
    if (options.service.size() > 63) {
      throw scene::SceneError({"--service: got a name of more than 63 bytes; try a shorter one"});
    }
    scene.service.name = options.service;
  }
  if (options.duration.empty()) {
    return;
  }
  const auto duration = scene::parse_duration(options.duration);
  if (!duration || *duration <= 0) {
    throw scene::SceneError({fmt::format(
        "--duration: got '{}', expected a positive duration; try 10s or 2h", options.duration)});
  }
  const std::int64_t step = scene.simulation.step_ns;
  if (*duration % step != 0) {
    const std::int64_t below = *duration / step * step;
    throw scene::SceneError(
        {fmt::format("--duration: got '{}', expected whole steps of {}; try {} or {}",
                     options.duration, scene::format_duration(step), scene::format_duration(below),
                     scene::format_duration(below + step))});
  }
  scene.simulation.duration_ns = duration;
}

}  // namespace adstar::adstard
