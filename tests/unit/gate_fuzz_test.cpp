// Random streams of commands against the painted schedule, and against what must hold of any gate.

#include <limits>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include "service/runtime/gate.hpp"
#include "tests/support/gate_harness.hpp"
#include "tests/support/gate_invariants.hpp"
#include "tests/support/painted_schedule.hpp"
#include "tests/support/random_motion.hpp"

namespace adstar::runtime {
namespace {

using test::GateHarness;
using test::Generator;
using test::kMs;
using test::make_craft;

std::int64_t between(Generator& random, std::int64_t low, std::int64_t high) {
  return std::uniform_int_distribution<std::int64_t>(low, high)(random);
}

/// Torque of a command, so that nobody's is anybody else's.
double torque_of(std::uint64_t commander, std::uint64_t sequence) {
  return 1e-3 * static_cast<double>(commander) + 1e-5 * static_cast<double>(sequence);
}

// ---- against the model ----

constexpr std::int64_t kPerStep = 10;
constexpr std::int64_t kBeats = 250;
constexpr std::int64_t kSlot = kMs;

test::SlotCommand draw(Generator& random, std::int64_t now, std::uint64_t& next_sequence) {
  test::SlotCommand c;
  c.sequence = next_sequence;
  if (between(random, 0, 9) == 0 && next_sequence > 1) {
    c.sequence = static_cast<std::uint64_t>(
        between(random, std::max<std::int64_t>(0, static_cast<std::int64_t>(next_sequence) - 14),
                static_cast<std::int64_t>(next_sequence) - 1));
  } else {
    next_sequence += static_cast<std::uint64_t>(between(random, 1, 2));
  }
  c.priority = static_cast<std::int32_t>(between(random, 0, 11) / 5);  // 2 is rare
  c.start = std::max<std::int64_t>(1, now + between(random, -25, 70));
  c.end = c.start + between(random, 1, between(random, 0, 1) == 0 ? 4 : 40);
  const std::int64_t oddity = between(random, 0, 29);
  c.refusal = oddity == 0 ? Reason::not_finite : oddity == 1 ? Reason::bad_interval : Reason::none;
  return c;
}

CommandRecord to_record(const test::SlotCommand& c, std::uint32_t spacecraft,
                        std::uint32_t actuator) {
  CommandRecord record;
  record.commander = {9, c.commander};
  record.sequence = c.sequence;
  record.spacecraft = spacecraft;
  record.actuator = actuator;
  record.priority = c.priority;
  record.start_ns = c.start * kSlot;
  record.end_ns = c.end * kSlot;
  record.value = {torque_of(c.commander, c.sequence), 0, 0};
  if (c.refusal == Reason::not_finite) {
    record.value[1] = std::numeric_limits<double>::infinity();
  } else if (c.refusal == Reason::bad_interval) {
    record.end_ns = record.start_ns - 1;
  }
  return record;
}

test::Told to_told(const VerdictRecord& v) {
  const bool in_force = v.verdict == Verdict::applied || v.verdict == Verdict::applied_late;
  return {v.commander.low,
          v.sequence,
          v.verdict,
          v.reason,
          in_force ? v.start_ns / kSlot : 0,
          in_force ? v.end_ns / kSlot : 0};
}

void expect_window(const Commanded<double>& got, const test::PaintedSchedule& model,
                   std::int64_t now) {
  const auto wanted = model.window(now);
  ASSERT_EQ(got.intervals, wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const test::SlotCommand& c = model.commands()[wanted[i].command];
    ASSERT_EQ(got.window[i].start_ns, wanted[i].start * kSlot);
    ASSERT_EQ(got.window[i].end_ns, wanted[i].end * kSlot);
    ASSERT_EQ(got.window[i].torque_n_m.x, torque_of(c.commander, c.sequence));
  }
}

class GateAgainstModel : public testing::TestWithParam<int> {};

TEST_P(GateAgainstModel, answers_and_acts_as_the_painted_schedule_does) {
  Generator random(static_cast<std::uint64_t>(GetParam()));
  GateHarness gate({make_craft(2, Frame::inertial), make_craft(1, Frame::inertial)},
                   kPerStep * kSlot);
  struct Place {
    std::uint32_t spacecraft, actuator;
    test::PaintedSchedule model;
    std::map<std::uint64_t, std::uint64_t> next_sequence;
  };
  constexpr std::int64_t kSlots = (kBeats + 20) * kPerStep;
  std::vector<Place> places;
  for (const auto& [spacecraft, actuator] : {std::pair{0U, 0U}, {0U, 1U}, {1U, 0U}}) {
    places.push_back({spacecraft, actuator, test::PaintedSchedule(kSlots, kPerStep), {}});
  }
  std::map<Verdict, int> seen;
  for (std::int64_t beat = 0; beat < kBeats + 15; ++beat) {
    const std::int64_t now = beat * kPerStep;
    std::vector<std::vector<test::Told>> wanted(places.size()), got(places.size());
    const std::int64_t commands = beat < kBeats ? between(random, 0, 6) : 0;
    for (std::int64_t n = 0; n < commands; ++n) {
      const auto p = static_cast<std::size_t>(between(random, 0, 2));
      const auto commander = static_cast<std::uint64_t>(between(random, 1, 4));
      std::uint64_t& next = places[p].next_sequence.try_emplace(commander, 1).first->second;
      test::SlotCommand c = draw(random, now, next);
      c.commander = commander;
      places[p].model.receive(c, now, wanted[p]);
      gate.receive(to_record(c, places[p].spacecraft, places[p].actuator));
    }
    for (std::size_t p = 0; p < places.size(); ++p) {
      places[p].model.begin_step(now, wanted[p]);
    }
    for (const VerdictRecord& v : gate.beat()) {
      ++seen[v.verdict];
      got[v.spacecraft == 1 ? 2 : v.actuator].push_back(to_told(v));
    }
    for (std::size_t p = 0; p < places.size(); ++p) {
      std::sort(wanted[p].begin(), wanted[p].end());
      std::sort(got[p].begin(), got[p].end());
      ASSERT_TRUE(wanted[p] == got[p]) << "seed " << GetParam() << " beat " << beat << " place "
                                       << p << ": " << got[p].size() << " answers";
      expect_window(gate.window(places[p].spacecraft, places[p].actuator), places[p].model, now);
      ASSERT_FALSE(HasFatalFailure()) << "seed " << GetParam() << " beat " << beat;
    }
  }
  for (const Verdict verdict :
       {Verdict::accepted, Verdict::applied, Verdict::applied_late, Verdict::superseded,
        Verdict::expired, Verdict::outranked, Verdict::refused}) {
    EXPECT_GT(seen[verdict], 5) << "the stream is too tame: " << static_cast<int>(verdict);
  }
  // Steps once computed were never rewritten: the momentum holds what is painted, slot by slot.
  for (const std::uint32_t spacecraft : {0U, 1U}) {
    double impulse = 0;
    for (const Place& place : places) {
      for (std::int64_t slot = 0; place.spacecraft == spacecraft && slot < kSlots; ++slot) {
        if (place.model.at(slot) != test::PaintedSchedule::kBare) {
          const auto& c = place.model.commands()[static_cast<std::size_t>(place.model.at(slot))];
          impulse += torque_of(c.commander, c.sequence) * 1e-3;
        }
      }
    }
    const Vehicle& vehicle = gate.fleet().vehicles()[spacecraft];
    EXPECT_NEAR(vehicle.state.H_I.value().x - vehicle.H_0.x, impulse, 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(seeds, GateAgainstModel, testing::Range(1, 25));

// ---- whatever comes ----

using Key = std::array<std::uint64_t, 4>;

/// Anything at all, good and bad, in nanoseconds.
CommandRecord anything(Generator& random, std::int64_t now) {
  constexpr std::int64_t kTimes[] = {std::numeric_limits<std::int64_t>::min(),
                                     std::numeric_limits<std::int64_t>::max(),
                                     -1,
                                     0,
                                     1,
                                     kStartAtNextBeat};
  const auto time = [&] {
    return between(random, 0, 19) == 0 ? kTimes[between(random, 0, 5)]
                                       : now + between(random, -30 * kMs, 90 * kMs);
  };
  CommandRecord c;
  c.commander = {0, static_cast<std::uint64_t>(between(random, 1, 6))};
  c.spacecraft =
      static_cast<std::uint32_t>(between(random, 0, 60) == 0 ? 7 : between(random, 0, 1));
  c.actuator = static_cast<std::uint32_t>(between(random, 0, 60) == 0 ? -1 : between(random, 0, 1));
  c.priority = static_cast<std::int32_t>(between(random, -1, 8) / 4);
  c.start_ns = time();
  if (between(random, 0, 1) == 0) {
    c.duration_ns = between(random, -1, 9) == -1 ? time() : between(random, 1, 20 * kMs);
  } else {
    c.end_ns = between(random, 0, 3) == 0 ? time() : c.start_ns / 2 + now / 2 + 40 * kMs;
  }
  for (double& x : c.value) {
    x = between(random, 0, 50) == 0 ? std::numeric_limits<double>::quiet_NaN()
                                    : test::uniform(random, -1.2, 1.2);
  }
  return c;
}

struct Outcome {
  std::vector<VerdictRecord> verdicts;
  std::vector<State<double>> states;
  bool operator==(const Outcome&) const = default;
};

void expect_orderly(const GateHarness& gate, const Beat& beat) {
  for (std::size_t spacecraft = 0; spacecraft < 2; ++spacecraft) {
    for (std::size_t torque = 0; torque < 2; ++torque) {
      ASSERT_EQ(test::window_breach(gate.window(spacecraft, torque), beat, 1.0), "");
    }
  }
}

Outcome fly(std::uint64_t seed, std::size_t pool) {
  Generator random(seed);
  const Vec3<double> limit{1, 1, 1};
  GateHarness gate({make_craft(2, Frame::body, limit), make_craft(2, Frame::inertial, limit)},
                   10 * kMs, pool);
  std::map<Key, std::uint64_t> next;
  test::GateWitness witness;
  Outcome outcome;
  const auto hear = [&](const std::vector<VerdictRecord>& verdicts, bool repeats) {
    for (const VerdictRecord& v : verdicts) {
      outcome.verdicts.push_back(v);
      if (!repeats) {
        witness.heard(v);
      }
    }
  };
  for (int beat = 0; beat < 420; ++beat) {
    for (std::int64_t n = beat < 400 ? between(random, 0, 12) : 0; n > 0; --n) {
      CommandRecord c = anything(random, gate.now_ns());
      std::uint64_t& sequence = next[{c.commander.high, c.commander.low, c.spacecraft, c.actuator}];
      const bool repeats = sequence > 0 && between(random, 0, 7) == 0;
      hear(gate.take(), false);
      c.sequence = repeats ? sequence : ++sequence;
      if (c.spacecraft < 2 && c.actuator < 2) {
        EXPECT_EQ(witness.sent(c), !repeats);
      }
      gate.receive(c);
      if (repeats) {
        hear(gate.take(), true);
      }
    }
    hear(gate.take(), false);
    const Beat now = gate.now();
    hear(gate.beat(), false);
    expect_orderly(gate, now);
  }
  witness.all_told();
  EXPECT_EQ(witness.breach(), "") << "seed " << seed;
  for (const Vehicle& vehicle : gate.fleet().vehicles()) {
    outcome.states.push_back(vehicle.state);
    EXPECT_TRUE(std::isfinite(norm(vehicle.state.H_I.value())));
  }
  return outcome;
}

TEST(GateUnderAnything,
     ends_every_command_in_exactly_one_final_verdict_and_keeps_windows_in_order) {
  for (std::uint64_t seed = 1; seed <= 15; ++seed) {
    const Outcome outcome = fly(seed, 16384);
    EXPECT_GT(outcome.verdicts.size(), 1000U);
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
  }
}

TEST(GateUnderAnything, holds_to_that_when_the_pool_is_far_too_small) {
  for (std::uint64_t seed = 101; seed <= 110; ++seed) {
    const Outcome outcome = fly(seed, 5);
    const auto short_of_room =
        std::count_if(outcome.verdicts.begin(), outcome.verdicts.end(),
                      [](const VerdictRecord& v) { return v.reason == Reason::capacity; });
    EXPECT_GT(short_of_room, 10);
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
  }
}

TEST(GateUnderAnything, gives_the_same_verdicts_and_bits_for_the_same_stream) {
  for (std::uint64_t seed = 201; seed <= 204; ++seed) {
    EXPECT_TRUE(fly(seed, 64) == fly(seed, 64)) << "seed " << seed;
  }
  EXPECT_FALSE(fly(201, 64) == fly(202, 64));
}

TEST(GateUnderAnything, gives_every_place_in_the_pool_back) {
  constexpr std::size_t kPool = 40;
  Generator random(7);
  GateHarness gate({make_craft(1)}, 10 * kMs, kPool);
  std::uint64_t sequence = 0;
  for (int beat = 0; beat < 500; ++beat) {
    for (std::int64_t n = between(random, 0, 10); n > 0; --n) {
      CommandRecord c = anything(random, gate.now_ns());
      c.commander = test::kAlice;
      c.sequence = ++sequence;
      gate.receive(c);
    }
    gate.beat();
  }
  gate.receive([&] {  // clears the schedule: newest, highest, at once
    CommandRecord c;
    c.commander = test::kBob;
    c.sequence = 1;
    c.priority = 100;
    c.duration_ns = 1;
    return c;
  }());
  gate.beat();
  gate.beat();
  for (std::uint64_t n = 1; n <= kPool + 1; ++n) {
    CommandRecord c;
    c.commander = test::kCarol;
    c.sequence = n;
    c.priority = 100;
    c.start_ns = gate.now_ns() + static_cast<std::int64_t>(20 * n) * kMs;
    c.duration_ns = kMs;
    EXPECT_EQ(gate.ask(c).at(0).reason, n <= kPool ? Reason::none : Reason::capacity) << n;
  }
}

}  // namespace
}  // namespace adstar::runtime
