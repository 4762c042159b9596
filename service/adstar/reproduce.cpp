// adstar reproduce paper: Figures 1 to 3 of the paper, from this library's own runs.

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "service/adstar/failure.hpp"
#include "service/adstar/output.hpp"
#include "service/adstar/usage.hpp"
#include "service/adstar/verbs.hpp"
#include "service/scene/scene.hpp"
#include "service/trade/paper_figures.hpp"

namespace adstar::cli {
namespace {

struct Options {
  std::string what;
  std::optional<std::int64_t> step_ns = 100'000'000, duration_ns = 100'000'000'000;
  std::string directory = ".";
};

void write(const std::filesystem::path& file, const std::string& text) {
  Output output = Output::to_file(file);
  output.buffer() = text;
  output.commit();
  fmt::print("{}\n", file.string());
}

/// What the figures claim, in numbers.
std::string summary(const std::vector<trade::PaperSample>& samples) {
  double orthogonality = 0, determinant = 0;
  std::array<double, trade::kPaperSchemes.size()> drift{};
  for (const trade::PaperSample& s : samples) {
    orthogonality = std::max({orthogonality, std::fabs(s.orthogonality.x),
                              std::fabs(s.orthogonality.y), std::fabs(s.orthogonality.z)});
    determinant = std::max(determinant, std::fabs(s.determinant));
    for (std::size_t i = 0; i < drift.size(); ++i) {
      drift[i] = std::max(drift[i], norm(s.drift[i]));
    }
  }
  std::string text = fmt::format(
      "largest |diag(R R^T) - 1| {:.2e}, |det R - 1| {:.2e}; largest momentum drift [N m s]:",
      orthogonality, determinant);
  for (std::size_t i = 0; i < drift.size(); ++i) {
    text += fmt::format("{} {} {:.2e}", i == 0 ? "" : ",", trade::kPaperSchemes[i], drift[i]);
  }
  return text;
}

int reproduce(const Options& options) {
  constexpr std::int64_t kMostSteps = 1'000'000;
  const std::int64_t step_ns = *options.step_ns, duration_ns = *options.duration_ns;
  if (duration_ns % step_ns != 0 || duration_ns / step_ns > kMostSteps) {
    throw Failure(kUsage,
                  fmt::format("--duration: got {}, expected whole steps of {}, at most a "
                              "million; try {}",
                              scene::format_duration(duration_ns), scene::format_duration(step_ns),
                              scene::format_duration(1000 * step_ns)));
  }
  std::error_code error;
  std::filesystem::create_directories(options.directory, error);
  if (error) {
    throw Failure(kFailed,
                  fmt::format("--output: cannot make {}: {}; name a directory that you may "
                              "write to",
                              options.directory, error.message()));
  }
  const std::vector<trade::PaperSample> samples = trade::paper_run(step_ns, duration_ns);
  for (const trade::Figure& figure : trade::paper_figures(samples, step_ns)) {
    write(std::filesystem::path(options.directory) / (figure.name + ".csv"), figure.csv);
    write(std::filesystem::path(options.directory) / (figure.name + ".svg"), figure.svg);
  }
  fmt::print("{}\n", summary(samples));
  return kDone;
}

}  // namespace

Verb add_reproduce(CLI::App& program) {
  const auto options = std::make_shared<Options>();
  CLI::App* verb =
      program.add_subcommand("reproduce", "Compute published figures anew, as CSV and SVG");
  verb->add_option("WHAT", options->what, "Figures 1 to 3 of Terze, Müller and Zlatar")
      ->required()
      ->check(CLI::IsMember({"paper"}))
      ->type_name("paper");
  add_duration(*verb, "--step", options->step_ns, "Step of all three schemes (default: 100ms)");
  add_duration(*verb, "--duration", options->duration_ns, "How long (default: 100s)");
  verb->add_option("--output", options->directory, "Directory (default: the present one)")
      ->type_name("DIRECTORY");
  verb->footer("Example:\n  adstar reproduce paper --output figures");
  return {verb, [options] { return reproduce(*options); }};
}

}  // namespace adstar::cli
