#include "service/dashboard/server/metrics_text.hpp"

#include <array>
#include <cmath>
#include <iterator>
#include <vector>

#include <fmt/format.h>

#include "service/dashboard/server/frame_json.hpp"
#include "service/runtime/records.hpp"

namespace adstar::dashboard {
namespace {

constexpr std::chrono::seconds kSilent{3};

std::string escaped(std::string_view label) {
  std::string text;
  for (const char c : label) {
    if (c == '\\' || c == '"') {
      text += '\\';
    }
    text += c;
  }
  return text;
}

std::string number(double value) {
  if (std::isnan(value)) {
    return "NaN";
  }
  return std::isinf(value) ? (value > 0 ? "+Inf" : "-Inf") : fmt::format("{}", value);
}

double seconds(std::int64_t ns) { return static_cast<double>(ns) / 1e9; }

/// One metric: its head on the first sample, so that a metric without samples is not named.
class Metric {
 public:
  Metric(std::string& text, const char* name, const char* type, const char* help)
      : text_(text), name_(name), type_(type), help_(help) {}

  void add(const std::string& labels, const std::string& value, const char* suffix = "") {
    if (!begun_) {
      begun_ = true;
      text_ += fmt::format("# HELP {0} {1}\n# TYPE {0} {2}\n", name_, help_, type_);
    }
    text_ += fmt::format("{}{}{{{}}} {}\n", name_, suffix, labels, value);
  }

 private:
  std::string& text_;
  const char* name_;
  const char* type_;
  const char* help_;
  bool begun_ = false;
};

struct Phase {
  const char* name;
  adstar_PhaseTiming adstar_StepTiming::*timing;
};
constexpr std::array<Phase, 4> kPhases{{{"wake_up", &adstar_StepTiming::wake_up_lateness},
                                        {"commands", &adstar_StepTiming::command_phase},
                                        {"step", &adstar_StepTiming::step_phase},
                                        {"hand_over", &adstar_StepTiming::hand_over_phase}}};

/// The metrics of all services, one after the other, as the format demands.
class Writer {
 public:
  Writer(const Board& board, Clock::time_point now) : board_(board), now_(now) {}

  std::string text() {
    of_services();
    of_status();
    of_timing();
    of_phases();
    of_commands();
    of_spacecraft();
    return std::move(text_);
  }

 private:
  using Status = adstar_ServiceStatus;
  using Timing = adstar_StepTiming;

  static std::string service_label(const std::string& service) {
    return fmt::format("service=\"{}\"", escaped(service));
  }

  /// add(metric, service label, record) for every service.
  template <class Add>
  void metric(const char* name, const char* type, const char* help, Add&& add) {
    Metric metric(text_, name, type, help);
    for (const auto& [service, record] : board_.services()) {
      add(metric, service_label(service), record);
    }
  }
  template <class Value>
  void status(const char* name, const char* type, const char* help, Value&& value) {
    metric(name, type, help, [&](Metric& out, const std::string& labels, const ServiceRecord& r) {
      if (r.status) {
        out.add(labels, fmt::format("{}", value(*r.status)));
      }
    });
  }
  template <class Value>
  void timing(const char* name, const char* type, const char* help, Value&& value) {
    metric(name, type, help, [&](Metric& out, const std::string& labels, const ServiceRecord& r) {
      if (r.timing) {
        out.add(labels, fmt::format("{}", value(*r.timing)));
      }
    });
  }

  void of_services() {
    Metric up(text_, "adstar_up", "gauge",
              "1 while the daemon was heard within the last 3 seconds; 0 for ten minutes after it "
              "went without a word.");
    for (const auto& [service, record] : board_.services()) {
      up.add(service_label(service), now_ - record.heard < kSilent ? "1" : "0");
    }
    for (const std::string& service : board_.missed_services(now_)) {
      up.add(service_label(service), "0");
    }
    metric("adstar_running", "gauge", "1 while the daemon's clock runs.",
           [&](Metric& out, const std::string& labels, const ServiceRecord& r) {
             if (r.status) {
               out.add(labels, r.status->state == adstar_SERVICE_RUNNING ? "1" : "0");
             }
           });
  }

  void of_status() {
    status("adstar_steps_total", "counter", "Steps taken in this run.",
           [](const Status& s) { return s.step; });
    status("adstar_simulation_time_seconds", "gauge", "Simulation time since the scene's start.",
           [](const Status& s) { return seconds(s.time_ns); });
    status("adstar_step_length_seconds", "gauge", "Length of one step.",
           [](const Status& s) { return seconds(s.step_length_ns); });
    status("adstar_spacecraft", "gauge", "Spacecraft that the daemon flies.",
           [](const Status& s) { return s.spacecraft; });
    status("adstar_unresolved_spacecraft", "gauge",
           "Spacecraft whose last step could not be resolved.",
           [](const Status& s) { return s.unresolved_spacecraft; });
    status("adstar_worst_momentum_residual_ratio", "gauge",
           "Largest momentum residual of the fleet, relative to the momentum or the impulse.",
           [](const Status& s) { return number(s.worst_momentum_residual_relative); });
    status("adstar_bridge_restarts_total", "counter", "Bridges started anew.",
           [](const Status& s) { return s.bridge_restarts; });
    metric("adstar_lost_total", "counter", "What did not fit into a ring, by what it was.",
           [](Metric& out, const std::string& labels, const ServiceRecord& r) {
             if (r.status) {
               out.add(labels + ",what=\"commands\"", fmt::format("{}", r.status->commands_lost));
               out.add(labels + ",what=\"verdicts\"", fmt::format("{}", r.status->verdicts_lost));
               out.add(labels + ",what=\"telemetry\"", fmt::format("{}", r.status->telemetry_lost));
             }
           });
  }

  void of_timing() {
    metric("adstar_late_beats_total", "counter",
           "Beats begun a period late or more, by what made them late.",
           [](Metric& out, const std::string& labels, const ServiceRecord& r) {
             if (r.timing) {
               out.add(labels + ",cause=\"work\"", fmt::format("{}", r.timing->late_after_work));
               out.add(labels + ",cause=\"loss\"", fmt::format("{}", r.timing->late_after_loss));
               out.add(labels + ",cause=\"sleep\"", fmt::format("{}", r.timing->late_after_sleep));
             }
           });
    metric("adstar_late_beats_handled_total", "counter",
           "Beats that were late, by what became of them.",
           [](Metric& out, const std::string& labels, const ServiceRecord& r) {
             if (r.timing) {
               out.add(labels + ",outcome=\"missed\"", fmt::format("{}", r.timing->missed_beats));
               out.add(labels + ",outcome=\"caught_up\"",
                       fmt::format("{}", r.timing->caught_up_beats));
             }
           });
    timing("adstar_overruns_total", "counter", "Beats that took longer than a period.",
           [](const Timing& t) { return t.overruns; });
    timing("adstar_behind_wall_seconds", "gauge", "Simulation time behind the wall clock.",
           [](const Timing& t) { return seconds(t.behind_wall_ns); });
    metric("adstar_page_faults_total", "counter", "Page faults of the tick's thread.",
           [](Metric& out, const std::string& labels, const ServiceRecord& r) {
             if (r.timing) {
               out.add(labels + ",kind=\"minor\"", fmt::format("{}", r.timing->minor_page_faults));
               out.add(labels + ",kind=\"major\"", fmt::format("{}", r.timing->major_page_faults));
             }
           });
    timing("adstar_involuntary_switches_total", "counter",
           "Times the tick's thread was taken off the processor with work left.",
           [](const Timing& t) { return t.involuntary_switches; });
  }

  void of_phases() {
    metric("adstar_phase_seconds", "summary",
           "How long the parts of a beat took; wake_up: how late it began.",
           [](Metric& out, const std::string& labels, const ServiceRecord& r) {
             for (std::size_t i = 0; r.timing && i < kPhases.size(); ++i) {
               const adstar_Quantiles& q = ((*r.timing).*kPhases[i].timing).took;
               const std::string phase = fmt::format("{},phase=\"{}\"", labels, kPhases[i].name);
               out.add(phase + ",quantile=\"0.5\"", number(seconds(q.p50_ns)));
               out.add(phase + ",quantile=\"0.99\"", number(seconds(q.p99_ns)));
               out.add(phase + ",quantile=\"0.999\"", number(seconds(q.p99_9_ns)));
               out.add(phase + ",quantile=\"1\"", number(seconds(q.max_ns)));
               out.add(phase, fmt::format("{}", q.count), "_count");
             }
           });
    metric("adstar_phase_duration_seconds", "histogram",
           "The same, counted four times an octave from 256 ns to a second.",
           [](Metric& out, const std::string& labels, const ServiceRecord& r) {
             for (std::size_t i = 0; r.timing && i < kPhases.size(); ++i) {
               const adstar_PhaseTiming& p = (*r.timing).*kPhases[i].timing;
               const std::string phase = fmt::format("{},phase=\"{}\"", labels, kPhases[i].name);
               std::uint64_t below = 0;
               for (std::size_t k = 0; k < std::size(p.quarter_octaves); ++k) {
                 below += p.quarter_octaves[k];
                 const bool last = k + 1 == std::size(p.quarter_octaves);
                 const std::string le =
                     last ? "+Inf" : number(seconds(runtime::quarter_octave_edge_ns(k)));
                 out.add(phase + ",le=\"" + le + "\"", fmt::format("{}", below), "_bucket");
               }
               out.add(phase, number(static_cast<double>(p.sum_ns) / 1e9), "_sum");
               out.add(phase, fmt::format("{}", below), "_count");
             }
           });
    of_each_phase("adstar_phase_budget_seconds", "gauge",
                  "Budget of a part of the beat; 0: it has none.",
                  [](const adstar_PhaseTiming& p) { return number(seconds(p.budget_ns)); });
    of_each_phase("adstar_phase_over_budget_total", "counter",
                  "Beats in which a part took longer than its budget.",
                  [](const adstar_PhaseTiming& p) { return fmt::format("{}", p.over_budget); });
  }

  template <class Value>
  void of_each_phase(const char* name, const char* type, const char* help, Value&& value) {
    metric(name, type, help, [&](Metric& out, const std::string& labels, const ServiceRecord& r) {
      for (std::size_t i = 0; r.timing && i < kPhases.size(); ++i) {
        out.add(fmt::format("{},phase=\"{}\"", labels, kPhases[i].name),
                value((*r.timing).*kPhases[i].timing));
      }
    });
  }

  void of_commands() {
    status("adstar_commands_received_total", "counter", "Commands that came, repeats too.",
           [](const Status& s) { return s.commands_received; });
    status("adstar_commands_refused_total", "counter", "Commands that were refused.",
           [](const Status& s) { return s.commands_refused; });
    Metric verdicts(text_, "adstar_verdicts_total", "counter",
                    "Verdicts heard since the dashboard began.");
    for (const auto& [service, counts] : board_.verdict_counts()) {
      for (std::size_t i = 0; i < counts.size(); ++i) {
        verdicts.add(fmt::format("service=\"{}\",verdict=\"{}\"", escaped(service),
                                 verdict_word(static_cast<adstar_Verdict>(i))),
                     fmt::format("{}", counts[i]));
      }
    }
  }

  void of_spacecraft() {
    each_spacecraft("adstar_energy_residual_joules", "E - E_0 - work: zero in the exact flow.",
                    [](const Motion& m) { return m.energy_residual_j; });
    each_spacecraft("adstar_momentum_residual_newton_metre_seconds",
                    "Length of H_I - H_0 - impulse.", [](const Motion& m) {
                      return std::hypot(m.momentum_residual_I[0], m.momentum_residual_I[1],
                                        m.momentum_residual_I[2]);
                    });
  }

  template <class Value>
  void each_spacecraft(const char* name, const char* help, Value&& value) {
    Metric out(text_, name, "gauge", help);
    std::size_t shown = 0;
    for (const auto& [spacecraft, motion] : board_.own_topics()) {
      if (std::isfinite(value(motion)) && ++shown <= kMostMeasured) {
        out.add(fmt::format("service=\"{}\",spacecraft=\"{}\"", escaped(motion.service),
                            escaped(spacecraft)),
                number(value(motion)));
      }
    }
  }

  const Board& board_;
  Clock::time_point now_;
  std::string text_;
};

}  // namespace

std::string metrics_text(const Board& board, Clock::time_point now) {
  return Writer(board, now).text();
}

}  // namespace adstar::dashboard
