// adstar check: is the scene good, what will be modelled, what is left out.

#include <memory>

#include <fmt/format.h>

#include "service/adstar/failure.hpp"
#include "service/adstar/output.hpp"
#include "service/adstar/usage.hpp"
#include "service/adstar/verbs.hpp"
#include "service/report/cost_report.hpp"
#include "service/report/scene_report.hpp"

namespace adstar::cli {

Verb add_check(CLI::App& program) {
  const auto file = std::make_shared<std::string>();
  CLI::App* verb =
      program.add_subcommand("check", "Validate a scene and say what it models and leaves out");
  add_scene(*verb, *file);
  verb->footer("Example:\n  adstar check configs/scenes/demo.toml");
  return {verb, [file] {
            const scene::Scene scene = scene::load(*file);
            Output output = Output::to_stdout();
            output.buffer() = fmt::format("{}: good\n\n{}{}", *file, report::scene_report(scene),
                                          report::cost_report(scene));
            output.flush();
            return static_cast<int>(kDone);
          }};
}

}  // namespace adstar::cli
