// adstar trade: what each scheme and step costs on this machine, and how close it stays.

#include <algorithm>
#include <memory>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "adstar/integrators/all.hpp"
#include "service/adstar/angle.hpp"
#include "service/adstar/failure.hpp"
#include "service/adstar/output.hpp"
#include "service/adstar/progress_bar.hpp"
#include "service/adstar/stop_signal.hpp"
#include "service/adstar/usage.hpp"
#include "service/adstar/verbs.hpp"
#include "service/propagation/plan.hpp"
#include "service/report/numbers.hpp"
#include "service/trade/campaign.hpp"
#include "service/trade/front.hpp"
#include "service/trade/grid.hpp"
#include "service/trade/present.hpp"
#include "service/trade/stability_map.hpp"

namespace adstar::cli {
namespace {

constexpr std::size_t kSpacecraft = 8;

struct Options {
  std::string scene;
  std::optional<std::int64_t> horizon_ns, budget_ns;
  std::string accuracy;
  std::vector<std::string> schemes, steps;
  std::string format = "table";
  std::string svg;
  bool map = false;
};

/// Of a fleet, a few drawn evenly: errors and cost are a spacecraft's.
void thin_out(scene::Scene& scene) {
  const std::size_t all = scene.spacecraft.size();
  if (all <= kSpacecraft) {
    return;
  }
  std::vector<scene::Spacecraft> few;
  for (std::size_t i = 0; i < kSpacecraft; ++i) {
    few.push_back(scene.spacecraft[i * all / kSpacecraft]);
  }
  scene.spacecraft = std::move(few);
  fmt::print(stderr,
             "adstar trade: {} of the scene's {} spacecraft, drawn evenly; the cost is theirs\n",
             kSpacecraft, report::counted(all));
}

std::int64_t horizon_of(const scene::Scene& scene, const Options& options) {
  constexpr std::int64_t kDefault = 100'000'000'000;
  return options.horizon_ns.value_or(scene.simulation.duration_ns.value_or(kDefault));
}

std::vector<std::int64_t> steps_of(const scene::Scene& scene, const Options& options,
                                   std::int64_t horizon_ns) {
  const std::vector<std::int64_t> instants = trade::instants_of(horizon_ns);
  std::vector<std::int64_t> steps;
  for (const std::string& text : options.steps) {
    const auto step = scene::parse_duration(text);
    if (!step || *step <= 0 || instants.front() % *step != 0) {
      throw Failure(kUsage, fmt::format("--steps: got '{}', expected durations that divide {} (the "
                                        "errors are looked at that often); try 10ms",
                                        text, scene::format_duration(instants.front())));
    }
    steps.push_back(*step);
  }
  if (options.steps.empty()) {
    steps = trade::steps_of(scene.spacecraft, instants);
  }
  if (steps.empty()) {
    throw Failure(kUsage, fmt::format("no step of round digits divides {} and turns the fastest "
                                      "spacecraft by 3 mrad to 6 rad; try another --horizon, for "
                                      "example 100s, or --steps",
                                      scene::format_duration(instants.front())));
  }
  std::sort(steps.rbegin(), steps.rend());
  steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
  return steps;
}

std::vector<std::string> schemes_of(const scene::Scene& scene, const Options& options) {
  const std::vector<std::string> usable = trade::usable_schemes(scene);
  if (options.schemes.empty()) {
    return usable;
  }
  for (const std::string& name : options.schemes) {
    propagation::require_scheme(name, "--schemes", scene);
  }
  return options.schemes;
}

/// What to do, in a sentence and the two lines for the scene.
std::string answer(const trade::Trade& trade, double accuracy_rad,
                   std::optional<std::int64_t> budget_ns) {
  const auto budget_us =
      budget_ns ? std::optional(static_cast<double>(*budget_ns) * 1e-3) : std::nullopt;
  const auto best = trade::cheapest(trade.points, accuracy_rad, budget_us);
  const std::string within =
      budget_ns ? fmt::format(" with at most {} a step", scene::format_duration(*budget_ns)) : "";
  if (!best) {
    throw Failure(kFailed,
                  fmt::format("no scheme and step tried holds {:.3g} rad over {}{}; allow more, or "
                              "name smaller --steps",
                              accuracy_rad, scene::format_duration(trade.horizon_ns), within));
  }
  const trade::Measured& point = trade.points[*best];
  return fmt::format(
      "\n{:.3g} rad over {}{}: cheapest is {} at {}\n"
      "  error {:.2e} rad, {:.3g} times closer than asked; {:.4g} us for a simulated second, "
      "{:.4g} "
      "us a step\n\n"
      "step = \"{}\"\nscheme = \"{}\"\n",
      accuracy_rad, scene::format_duration(trade.horizon_ns), within, point.scheme,
      scene::format_duration(point.step_ns), point.errors.attitude_rad,
      accuracy_rad / point.errors.attitude_rad, point.cost.median_us, point.step_cost_us(),
      scene::format_duration(point.step_ns), point.scheme);
}

/// Runs it under a progress bar; Ctrl-C ends it.
template <class Run>
auto with_progress(const Run& run) {
  constexpr std::uint64_t kParts = 1000;
  catch_stop_signals();
  ProgressBar bar(kParts);
  try {
    return run([&](double done) {
      bar.show(static_cast<std::uint64_t>(done * static_cast<double>(kParts)));
      return !stop_requested();
    });
  } catch (const trade::Interrupted&) {
    throw Failure(kFailed, "interrupted; nothing was written");
  }
}

void write_file(const std::string& file, const std::string& text) {
  Output output = Output::to_file(file);
  output.buffer() = text;
  output.commit();
}

int draw_map(const Options& options) {
  std::vector<std::string> schemes = options.schemes;
  if (schemes.empty()) {
    for (const std::string_view name : scheme_names()) {
      schemes.emplace_back(name);
    }
  }
  for (const std::string& name : schemes) {
    propagation::require_scheme(name, "--schemes", scene::Scene{});
  }
  const trade::StabilityMap map = with_progress([&](const trade::Progress& progress) {
    return trade::map_stability(schemes, trade::all_extremes(trade::Detail::full), progress);
  });
  if (!options.svg.empty()) {
    write_file(options.svg, trade::picture(map));
  }
  Output output = Output::to_stdout();
  output.buffer() = options.format == "json" ? trade::json(map) : trade::table(map);
  output.commit();
  return kDone;
}

int trade_off(const Options& options) {
  if (options.map) {
    return draw_map(options);
  }
  if (options.scene.empty()) {
    throw Failure(kUsage,
                  "a scene is missing; name one, or --map for the stability of all schemes");
  }
  std::optional<double> accuracy_rad;
  if (!options.accuracy.empty()) {
    accuracy_rad = parse_angle(options.accuracy);
    if (!accuracy_rad) {
      throw Failure(kUsage, fmt::format("--accuracy: got '{}', expected an angle above zero; try "
                                        "1e-6rad, 0.5deg or 1arcsec",
                                        options.accuracy));
    }
  }
  if (options.budget_ns && !accuracy_rad) {
    throw Failure(kUsage,
                  "--budget: says what a step may cost; say with --accuracy what it shall "
                  "hold, for example --accuracy 1e-6rad");
  }
  scene::Scene scene = scene::load(options.scene);
  thin_out(scene);
  trade::Campaign campaign;
  campaign.horizon_ns = horizon_of(scene, options);
  campaign.schemes = schemes_of(scene, options);
  campaign.steps_ns = steps_of(scene, options, campaign.horizon_ns);
  campaign.accuracy_rad = accuracy_rad;
  const trade::Trade trade = with_progress(
      [&](const trade::Progress& progress) { return trade::run(scene, campaign, progress); });
  if (!options.svg.empty()) {
    write_file(options.svg, trade::picture(trade, options.scene));
  }
  Output output = Output::to_stdout();
  output.buffer() =
      options.format == "json" ? trade::json(trade, options.scene) : trade::table(trade);
  if (accuracy_rad && options.format != "json") {
    output.flush();
    output.buffer() = answer(trade, *accuracy_rad, options.budget_ns);
  }
  output.commit();
  return kDone;
}

}  // namespace

Verb add_trade(CLI::App& program) {
  const auto options = std::make_shared<Options>();
  CLI::App* verb = program.add_subcommand(
      "trade", "Measure accuracy against cost: the scene under every scheme and many steps");
  add_scene(*verb, options->scene)->required(false);
  verb->add_flag("--map", options->map,
                 "No scene: one step of every scheme at the extremes, and who is wrong there");
  add_duration(*verb, "--horizon", options->horizon_ns,
               "How long the accuracy shall hold (default: the scene's duration, or 100s)");
  verb->add_option("--accuracy", options->accuracy,
                   "Answer with the cheapest scheme and step that hold this")
      ->type_name("ANGLE");
  add_duration(*verb, "--budget", options->budget_ns,
               "With --accuracy: what one step of the whole scene may cost");
  verb->add_option("--schemes", options->schemes, "Only these, separated by commas")
      ->delimiter(',')
      ->type_name("SCHEME");
  verb->add_option("--steps", options->steps, "Only these, separated by commas")
      ->delimiter(',')
      ->type_name("DURATIONS");
  verb->add_option("--format", options->format, "For people or for machines")
      ->check(CLI::IsMember({"table", "json"}))
      ->type_name("table|json");
  verb->add_option("--svg", options->svg, "Draw it there")->type_name("FILE");
  verb->footer(
      "Example:\n"
      "  adstar trade configs/scenes/paper_forced.toml --accuracy 1e-6rad --horizon 1h --svg "
      "trade.svg\n"
      "How to read it: service/adstar/trade.md");
  return {verb, [options] { return trade_off(*options); }};
}

}  // namespace adstar::cli
