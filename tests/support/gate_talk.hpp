#pragma once
// Words in which the tests of the gate speak: commands told apart by their torque, the verdicts on
// one of them, the window of an actuator.

#include <vector>

#include <gtest/gtest.h>

#include "tests/support/gate_harness.hpp"

namespace adstar::test {

/// Sequence n of that commander: n tenths of a newton metre about x, so that torques tell commands
/// apart.
inline runtime::CommandRecord command(const runtime::CommanderId& commander, std::uint64_t sequence,
                                      std::int64_t start_ns, std::int64_t end_ns,
                                      std::int32_t priority = 0) {
  runtime::CommandRecord record;
  record.commander = commander;
  record.sequence = sequence;
  record.priority = priority;
  record.start_ns = start_ns;
  record.end_ns = end_ns;
  record.value = {0.1 * static_cast<double>(sequence), 0, 0};
  return record;
}

inline runtime::Verdict only(const std::vector<runtime::VerdictRecord>& verdicts) {
  EXPECT_EQ(verdicts.size(), 1U);
  return verdicts.empty() ? runtime::Verdict::refused : verdicts.front().verdict;
}

/// The verdicts on one command, in the order they were given.
inline std::vector<runtime::Verdict> story(const std::vector<runtime::VerdictRecord>& verdicts,
                                           const runtime::CommanderId& commander,
                                           std::uint64_t sequence) {
  std::vector<runtime::Verdict> result;
  for (const runtime::VerdictRecord& v : verdicts) {
    if (v.commander == commander && v.sequence == sequence) {
      result.push_back(v.verdict);
    }
  }
  return result;
}

using Verdicts = std::vector<runtime::Verdict>;

struct Interval {
  std::int64_t start_ns, end_ns;
  double x;
  friend bool operator==(const Interval&, const Interval&) = default;
};

inline std::vector<Interval> in_window(const GateHarness& gate, std::size_t torque = 0) {
  std::vector<Interval> result;
  const Commanded<double>& commanded = gate.window(0, torque);
  for (std::size_t i = 0; i < commanded.intervals; ++i) {
    const auto& w = commanded.window[i];
    result.push_back({w.start_ns, w.end_ns, w.torque_n_m.x});
  }
  return result;
}

using Window = std::vector<Interval>;

}  // namespace adstar::test
