// [budget]: how long the parts of a beat may take, and what follows when they take longer.

#include <algorithm>
#include <array>

#include "service/scene/duration_key.hpp"
#include "service/scene/sections.hpp"

namespace adstar::scene {
namespace {

/// The parts of a beat one after the other must fit between two beats.
void refuse_more_than_a_beat(const Keys& keys, const Value& step, const Budget& budget,
                             const Simulation& simulation) {
  const std::int64_t beat = beat_ns(simulation);
  const std::int64_t work_ns = budget.commands_ns + budget.step_ns + budget.hand_over_ns;
  if (work_ns <= beat) {
    return;
  }
  const std::string sum = format_duration(work_ns) + " for commands, step and hand_over together";
  const std::string rule = "at most a beat, " + format_duration(beat);
  if (step) {
    step.refuse_as(sum, rule, in_quotes(format_duration(std::max<std::int64_t>(1, beat / 2))));
  } else {
    keys.complaints().add(keys.place(), keys.path(), sum, rule, "smaller budgets");
  }
}

}  // namespace

Budget read_budget(Keys& root, const Simulation& simulation) {
  Keys keys = root.section("budget", "[budget] on a line of its own");
  Budget budget;
  budget.wake_up_ns = read_duration(keys.optional("wake_up"), "200us").value_or(0);
  budget.commands_ns = read_duration(keys.optional("commands"), "50us").value_or(0);
  const Value step = keys.optional("step");
  budget.step_ns = read_duration(step, "500us").value_or(0);
  budget.hand_over_ns = read_duration(keys.optional("hand_over"), "100us").value_or(0);
  constexpr std::array<std::string_view, 3> kPolicies{"skip", "catch_up", "halt"};
  const Value policy = keys.optional("on_overrun");
  if (const auto chosen = read_choice(policy, kPolicies)) {
    budget.on_overrun = static_cast<Overrun>(*chosen);
  }
  const Value bound = keys.optional("catch_up_beats");
  const Want beats{"an integer from 1 to 1000000", "100"};
  budget.catch_up_beats =
      read_integer(bound, {1, 1'000'000}, beats).value_or(budget.catch_up_beats);
  if (bound && budget.on_overrun != Overrun::catch_up) {
    bound.refuse("no bound beside on_overrun = \"skip\" or \"halt\"",
                 "removing it, or on_overrun = \"catch_up\"");
  }
  constexpr std::array<std::string_view, 2> kAdmissions{"refuse", "warn"};
  budget.refuse_at_start = read_choice(keys.optional("admission"), kAdmissions).value_or(0) == 0;
  if (simulation.pace == Pace::clock && simulation.step_ns > 0) {
    refuse_more_than_a_beat(keys, step, budget, simulation);
  }
  keys.refuse_unknown();
  return budget;
}

}  // namespace adstar::scene
