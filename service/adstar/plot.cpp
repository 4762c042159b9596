// adstar plot: a recording's momentum, rates and residuals over time, as SVG.

#include "service/plot/plot.hpp"

#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <set>

#include <fmt/format.h>

#include "service/adstar/failure.hpp"
#include "service/adstar/output.hpp"
#include "service/adstar/recorded_runs.hpp"
#include "service/adstar/recording_input.hpp"
#include "service/adstar/services.hpp"
#include "service/adstar/thinned.hpp"
#include "service/adstar/usage.hpp"
#include "service/adstar/verbs.hpp"
#include "service/bag/sqlite.hpp"
#include "service/dds/convert.hpp"
#include "service/samples/recorded_topics.hpp"
#include "service/scene/nearest.hpp"

namespace adstar::cli {
namespace {

constexpr const char* kVerb = "plot";
constexpr std::size_t kMostDrawn = 8;         ///< spacecraft, unless they are named
constexpr std::size_t kMostStretches = 1000;  ///< more than the pixels of an axis
constexpr double kNanosecond_s = 1e-9;

struct Options {
  std::string recording, output;
  std::vector<std::string> spacecraft;
};

constexpr double seconds(std::int64_t time_ns) {
  return static_cast<double>(time_ns) * kNanosecond_s;
}

/// For simulation time over one run [s].
Thinned series_over(const RunSpan& run) {
  return {seconds(run.first_ns), seconds(run.last_ns), kMostStretches};
}

/// Three components.
using Vector = std::array<Thinned, 3>;
Vector vector_over(const RunSpan& run) {
  return {series_over(run), series_over(run), series_over(run)};
}

/// What is drawn of one spacecraft, over simulation time [s].
struct History {
  History(const RunSpan& momentum, const RunSpan& attitude)
      : momentum_run(momentum),
        attitude_run(attitude),
        momentum_I(vector_over(momentum)),
        omega_B(vector_over(attitude)),
        momentum_residual_I(vector_over(momentum)),
        energy_residual(series_over(momentum)) {}

  RunReader momentum_run, attitude_run;
  Vector momentum_I, omega_B, momentum_residual_I;
  Thinned energy_residual;
};

void add(Vector& series, double t, const adstar_Vector3& v) {
  series[0].add({t, v.x});
  series[1].add({t, v.y});
  series[2].add({t, v.z});
}

using Histories = std::map<std::string, History, std::less<>>;

using Names = std::set<std::string>;

/// Those asked for, or the first of them. Throws Failure when somebody asked for is not there.
Names drawn(const Names& known, const Options& options) {
  for (const std::string& name : options.spacecraft) {
    if (!known.contains(name)) {
      throw Failure(kUsage, fmt::format("there is no '{}' in the recording; `adstar export {} --to "
                                        "csv` shows who is",
                                        name, options.recording));
    }
  }
  if (!options.spacecraft.empty()) {
    return {options.spacecraft.begin(), options.spacecraft.end()};
  }
  if (known.size() <= kMostDrawn) {
    return known;
  }
  fmt::print(stderr,
             "adstar plot: the first {} of {} spacecraft are drawn; --spacecraft chooses others\n",
             kMostDrawn, known.size());
  return {known.begin(), std::next(known.begin(), kMostDrawn)};
}

/// Of those who are drawn, still empty.
Histories chosen_histories(const bag::Recording& recording, const Options& options) {
  const NewVoices voices = new_voices_in(recording);
  const Runs momentum = runs_of<adstar_MomentumState>(recording, voices);
  const Runs attitude = runs_of<adstar_AttitudeState>(recording, voices);
  Names known;
  for (const Runs* runs : {&momentum, &attitude}) {
    for (const auto& [name, run] : *runs) {
      known.insert(name);
    }
  }
  if (known.empty()) {
    require_motion(recording);
    throw Failure(kFailed,
                  "no attitude or momentum in the recording can be read; was it made by another "
                  "version of adstar?");
  }
  const auto last_run = [](const Runs& runs, const std::string& name) {
    const auto found = runs.find(name);
    return found == runs.end() ? RunSpan{} : found->second.last_run();
  };
  Histories histories;
  for (const std::string& name : drawn(known, options)) {
    histories.try_emplace(name, last_run(momentum, name), last_run(attitude, name));
  }
  return histories;
}

Histories read_histories(const bag::Recording& recording, const Options& options) {
  Histories histories = chosen_histories(recording, options);
  std::uint64_t unreadable = samples::for_each_sample<adstar_MomentumState>(
      recording, [&](const adstar_MomentumState& s, std::int64_t /*received_ns*/) {
        const auto known = histories.find(dds::text_of(s.spacecraft));
        if (known != histories.end() && known->second.momentum_run.takes(s.time_ns)) {
          History& h = known->second;
          add(h.momentum_I, seconds(s.time_ns), s.momentum_inertial_n_m_s);
          add(h.momentum_residual_I, seconds(s.time_ns), s.momentum_residual_inertial_n_m_s);
          h.energy_residual.add({seconds(s.time_ns), s.energy_residual_j});
        }
      });
  unreadable += samples::for_each_sample<adstar_AttitudeState>(
      recording, [&](const adstar_AttitudeState& s, std::int64_t /*received_ns*/) {
        const auto known = histories.find(dds::text_of(s.spacecraft));
        if (known != histories.end() && known->second.attitude_run.takes(s.time_ns)) {
          add(known->second.omega_B, seconds(s.time_ns), s.angular_velocity_body_rad_s);
        }
      });
  say_unreadable(unreadable, kVerb);
  LeftOut left_out;
  for (const auto& [name, history] : histories) {
    left_out.add(history.momentum_run);
    left_out.add(history.attitude_run);
  }
  say_left_out(left_out, kVerb);
  return histories;
}

plot::Panel panel(const std::string& title, const std::string& label, const Vector& vector) {
  constexpr std::array<const char*, 3> kNames{"x", "y", "z"};
  plot::Panel panel{title, {"simulation time [s]"}, {label}, {}};
  for (std::size_t i = 0; i < vector.size(); ++i) {
    panel.series.push_back({kNames[i], vector[i].points(), false});
  }
  return panel;
}

std::vector<plot::Panel> panels_of(const std::string& name, const History& h) {
  std::vector<plot::Panel> panels;
  if (h.momentum_run.heard()) {
    panels.push_back(
        panel(name + ": angular momentum, inertial frame", "H_I [N m s]", h.momentum_I));
  }
  if (h.attitude_run.heard()) {
    panels.push_back(panel(name + ": angular velocity, body frame", "omega_B [rad/s]", h.omega_B));
  }
  if (h.momentum_run.heard()) {
    plot::Panel energy{
        name + ": energy residual", {"simulation time [s]"}, {"E - E_0 - W [J]"}, {}};
    energy.series.push_back({"energy residual", h.energy_residual.points(), false});
    panels.push_back(std::move(energy));
    panels.push_back(panel(name + ": momentum residual, inertial frame",
                           "H_I - H_0 - impulse [N m s]", h.momentum_residual_I));
  }
  return panels;
}

int plot_recording(const Options& options) {
  const bag::Recording recording = open_recording(options.recording, kVerb);
  Histories histories;
  try {
    histories = read_histories(recording, options);
  } catch (const bag::Error& error) {
    throw Failure(kFailed, error.what());
  }
  std::vector<plot::Panel> panels;
  for (const auto& [name, history] : histories) {
    for (plot::Panel& panel : panels_of(printable(name), history)) {
      panels.push_back(std::move(panel));
    }
  }
  Output output = options.output.empty() ? Output::to_stdout() : Output::to_file(options.output);
  output.buffer() = plot::svg("Recording " + printable(options.recording), panels);
  output.commit();
  return kDone;
}

}  // namespace

Verb add_plot(CLI::App& program) {
  const auto options = std::make_shared<Options>();
  CLI::App* verb =
      program.add_subcommand("plot", "A recording's momentum, rates and residuals as SVG");
  add_recording(*verb, options->recording);
  verb->add_option("--output", options->output,
                   "Write there, whole or not at all (default: stdout)")
      ->type_name("FILE");
  verb->add_option("--spacecraft", options->spacecraft,
                   "This one, and others given so (default: the first 8)")
      ->type_name("NAME")
      ->take_all()
      ->allow_extra_args(false);
  verb->footer("Example:\n  adstar plot runs/monday --spacecraft sat1 --output monday.svg");
  return {verb, [options] { return plot_recording(*options); }};
}

}  // namespace adstar::cli
