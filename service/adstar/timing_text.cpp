#include "service/adstar/timing_text.hpp"

#include <array>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "service/adstar/service_state.hpp"
#include "service/adstar/services.hpp"
#include "service/dds/convert.hpp"
#include "service/report/numbers.hpp"
#include "service/scene/scene.hpp"

namespace adstar::cli {
namespace {

struct Part {
  const char* name;
  const char* key;
  adstar_PhaseTiming adstar_StepTiming::*timing;
};

constexpr std::array<Part, 4> kParts{
    {{"wake-up lateness", "wake_up_lateness", &adstar_StepTiming::wake_up_lateness},
     {"commands", "command_phase", &adstar_StepTiming::command_phase},
     {"step", "step_phase", &adstar_StepTiming::step_phase},
     {"hand-over", "hand_over_phase", &adstar_StepTiming::hand_over_phase}}};

std::string microseconds(std::int64_t ns) {
  return fmt::format("{:.1f}", static_cast<double>(ns) * 1e-3);
}

std::string row(const char* name, const adstar_Quantiles& q) {
  return fmt::format("  {:<17}{:>14}{:>10}{:>10}{:>10}{:>10}", name, report::counted(q.count),
                     microseconds(q.p50_ns), microseconds(q.p99_ns), microseconds(q.p99_9_ns),
                     microseconds(q.max_ns));
}

nlohmann::ordered_json json_of(const adstar_Quantiles& q) {
  return {{"count", q.count},
          {"p50_ns", q.p50_ns},
          {"p99_ns", q.p99_ns},
          {"p99_9_ns", q.p99_9_ns},
          {"max_ns", q.max_ns}};
}

}  // namespace

std::string timing_table(const adstar_StepTiming& t) {
  std::string text = fmt::format(
      "service '{}': {}, step {} ({} s), {} behind the wall clock\n"
      "  {:<17}{:>14}{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}\n",
      printable(dds::text_of(t.service)), state_text(t.state), report::counted(t.step),
      report::seconds_text(t.time_ns), scene::format_duration(t.behind_wall_ns), "part of a beat",
      "beats", "p50 [us]", "p99", "p99.9", "max", "budget", "over");
  for (const Part& part : kParts) {
    const adstar_PhaseTiming& phase = t.*part.timing;
    text += row(part.name, phase.took);
    text +=
        fmt::format("{:>10}{:>10}\n", phase.budget_ns == 0 ? "-" : microseconds(phase.budget_ns),
                    report::counted(phase.over_budget));
  }
  text += row("the last three", t.tick_body) + "\n";
  text += fmt::format(
      "  beats: {} late ({} after our own work, {} after the processor was taken away, {} after "
      "the "
      "sleep)\n"
      "         {} missed, {} caught up, {} longer than the period\n"
      "  the tick's thread: {} minor and {} major page faults, {} involuntary switches\n"
      "  most waiting at once: {} commands, {} verdicts, {} samples\n",
      report::counted(t.late_beats), report::counted(t.late_after_work),
      report::counted(t.late_after_loss), report::counted(t.late_after_sleep),
      report::counted(t.missed_beats), report::counted(t.caught_up_beats),
      report::counted(t.overruns), report::counted(t.minor_page_faults),
      report::counted(t.major_page_faults), report::counted(t.involuntary_switches),
      report::counted(t.most_commands_waiting), report::counted(t.most_verdicts_waiting),
      report::counted(t.most_telemetry_waiting));
  if (t.phase_disciplined) {
    text += fmt::format("  beats {} ns from the whole periods of the reference clock\n",
                        t.phase_error_ns);
  }
  text += fmt::format("  in force: FIFO {}, memory lock {}, one processor {}\n",
                      t.fifo_scheduling ? "yes" : "NO", t.memory_locked ? "yes" : "NO",
                      t.cpu_pinned ? "yes" : "no");
  return text;
}

std::string timing_json(const adstar_StepTiming& t) {
  nlohmann::ordered_json line;
  line["service"] = printable(dds::text_of(t.service));
  line["state"] = state_word(t.state);
  line["step"] = t.step;
  line["time_ns"] = t.time_ns;
  for (const Part& part : kParts) {
    const adstar_PhaseTiming& phase = t.*part.timing;
    line[part.key] = json_of(phase.took);
    line[part.key]["sum_ns"] = phase.sum_ns;
    line[part.key]["quarter_octaves"] = phase.quarter_octaves;
    line[part.key]["budget_ns"] = phase.budget_ns;
    line[part.key]["over_budget"] = phase.over_budget;
  }
  line["tick_body"] = json_of(t.tick_body);
  line["late_beats"] = t.late_beats;
  line["late_after_work"] = t.late_after_work;
  line["late_after_loss"] = t.late_after_loss;
  line["late_after_sleep"] = t.late_after_sleep;
  line["overruns"] = t.overruns;
  line["missed_beats"] = t.missed_beats;
  line["caught_up_beats"] = t.caught_up_beats;
  line["behind_wall_ns"] = t.behind_wall_ns;
  line["phase_disciplined"] = t.phase_disciplined;
  line["phase_error_ns"] = t.phase_error_ns;
  line["minor_page_faults"] = t.minor_page_faults;
  line["major_page_faults"] = t.major_page_faults;
  line["involuntary_switches"] = t.involuntary_switches;
  line["most_commands_waiting"] = t.most_commands_waiting;
  line["most_verdicts_waiting"] = t.most_verdicts_waiting;
  line["most_telemetry_waiting"] = t.most_telemetry_waiting;
  line["fifo_scheduling"] = t.fifo_scheduling;
  line["memory_locked"] = t.memory_locked;
  line["cpu_pinned"] = t.cpu_pinned;
  return line.dump() + "\n";
}

}  // namespace adstar::cli
