#pragma once
// What must hold of any command gate, whatever it is fed. Breaches come as words, so that tests and
// fuzzers can both use them.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <string>

#include <fmt/format.h>

#include "tests/support/gate_harness.hpp"

namespace adstar::test {

/// Every command with a new sequence number gets at most one `accepted`, then exactly one final
/// verdict; nothing else is answered but repeats.
class GateWitness {
 public:
  /// About to be received, on an actuator that exists. True when its sequence number is new.
  bool sent(const runtime::CommandRecord& command) {
    std::uint64_t& last = last_sequence_[key(command, 0)];
    if (command.sequence <= last) {
      return false;
    }
    last = command.sequence;
    stories_[key(command, command.sequence)];
    return true;
  }

  /// A verdict that is no answer to a repetition.
  void heard(const runtime::VerdictRecord& verdict) {
    const auto story = stories_.find(key(verdict, verdict.sequence));
    if (story == stories_.end()) {
      breach(verdict, "answers what nobody sent");
    } else if (is_final(verdict.verdict)) {
      if (++story->second.finals > 1) {
        breach(verdict, "is a second final verdict");
      }
    } else if (story->second.accepted || story->second.finals > 0) {
      breach(verdict, "accepts what was answered before");
    } else {
      story->second.accepted = true;
    }
  }

  /// Once nothing is left in the gate.
  void all_told() {
    for (const auto& [key, story] : stories_) {
      if (story.finals != 1) {
        breach_ = fmt::format("commander {} sequence {} on {}/{} got {} final verdicts", key[1],
                              key[4], key[2], key[3], story.finals);
      }
    }
  }

  /// Empty: none.
  const std::string& breach() const { return breach_; }

 private:
  using Key = std::array<std::uint64_t, 5>;
  struct Story {
    bool accepted = false;
    int finals = 0;
  };

  template <class Record>
  static Key key(const Record& r, std::uint64_t sequence) {
    return {r.commander.high, r.commander.low, r.spacecraft, r.actuator, sequence};
  }
  void breach(const runtime::VerdictRecord& v, const char* what) {
    breach_ = fmt::format("verdict {} on commander {} sequence {} at {}/{}, step {}, {}",
                          static_cast<int>(v.verdict), v.commander.low, v.sequence, v.spacecraft,
                          v.actuator, v.step, what);
  }

  std::map<Key, std::uint64_t> last_sequence_;
  std::map<Key, Story> stories_;
  std::string breach_;
};

/// What the step at `beat` is given: intervals within its reach, ascending, disjoint, their torque
/// within `limit_n_m` an axis. Empty when all that holds.
inline std::string window_breach(const Commanded<double>& commanded, const runtime::Beat& beat,
                                 double limit_n_m) {
  if (commanded.intervals > Commanded<double>::kWindow) {
    return "more intervals than a window holds";
  }
  std::int64_t reached = std::numeric_limits<std::int64_t>::min();
  for (std::size_t i = 0; i < commanded.intervals; ++i) {
    const auto& w = commanded.window[i];
    if (w.start_ns < reached || w.end_ns <= w.start_ns) {
      return fmt::format("interval {} [{}, {}) is not after {}", i, w.start_ns, w.end_ns, reached);
    }
    if (w.start_ns >= beat.t_ns + beat.h_ns || w.end_ns <= beat.t_ns) {
      return fmt::format("interval {} [{}, {}) is not of this step", i, w.start_ns, w.end_ns);
    }
    const Vec3<double>& tau = w.torque_n_m;
    if (!(std::max({std::fabs(tau.x), std::fabs(tau.y), std::fabs(tau.z)}) <= limit_n_m)) {
      return fmt::format("interval {} asks for ({}, {}, {}) N m", i, tau.x, tau.y, tau.z);
    }
    reached = w.end_ns;
  }
  return {};
}

}  // namespace adstar::test
