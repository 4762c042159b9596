#pragma once
// When the next beat is due: pure arithmetic on a plain struct, so that the policy can be tested
// without a clock.
//
// Beat n is due at base + (n + missed)·period, from integers, never by adding periods up. Whoever
// comes a period late or more is behind: beats beyond those that may be caught up are missed. They are
// counted, the grid keeps its phase, and simulation time falls behind the wall's.

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace adstar::runtime {

struct BeatClock {
  std::int64_t base_ns = 0;  ///< monotonic time at which beat 0 is due
  std::int64_t step_ns = 1;
  std::int64_t rate_millionths = 1'000'000;  ///< the period is step_ns · 10⁶ / rate_millionths [ns]
  std::uint64_t missed = 0;                  ///< periods by which the grid was moved
};

/// The rate is taken to a millionth.
inline BeatClock make_beat_clock(std::int64_t base_ns, std::int64_t step_ns, double rate) {
  const std::int64_t millionths = std::llround(rate * 1e6);
  return {base_ns, step_ns, millionths > 0 ? millionths : 1, 0};
}

/// n·period, rounded down.
inline std::int64_t beats_to_ns(const BeatClock& clock, std::uint64_t n) {
  __extension__ using Wide = __int128;
  return static_cast<std::int64_t>(static_cast<Wide>(n) * clock.step_ns * 1'000'000 /
                                   clock.rate_millionths);
}

/// Monotonic time at which beat n is due [ns].
inline std::int64_t due_ns(const BeatClock& clock, std::uint64_t n) {
  return clock.base_ns + beats_to_ns(clock, n + clock.missed);
}

/// Whole periods between the moment beat n was due and `now_ns`.
inline std::uint64_t beats_behind(const BeatClock& clock, std::uint64_t n, std::int64_t now_ns) {
  const std::int64_t late_ns = now_ns - due_ns(clock, n);
  if (late_ns <= 0) {
    return 0;
  }
  __extension__ using Wide = __int128;
  return static_cast<std::uint64_t>(static_cast<Wide>(late_ns) * clock.rate_millionths /
                                    (static_cast<Wide>(clock.step_ns) * 1'000'000));
}

/// Moves the grid by the whole periods that beat n is late beyond `allowed`; returns how many.
inline std::uint64_t realign(BeatClock& clock, std::uint64_t n, std::int64_t now_ns,
                             std::uint64_t allowed = 0) {
  const std::uint64_t behind = beats_behind(clock, n, now_ns);
  const std::uint64_t missed = behind > allowed ? behind - allowed : 0;
  clock.missed += missed;
  return missed;
}

/// Beat n is due now, and the others around it: the clock stood still, and nothing was missed.
inline void restart(BeatClock& clock, std::uint64_t n, std::int64_t now_ns) {
  clock.base_ns += now_ns - due_ns(clock, n);
}

/// How far beat n comes after the nearest whole period of a reference clock, which shows `offset_ns` more than
/// the monotonic one: within half a period of zero.
inline std::int64_t phase_error_ns(const BeatClock& clock, std::uint64_t n,
                                   std::int64_t offset_ns) {
  const std::int64_t period = beats_to_ns(clock, 1);
  std::int64_t phase = (due_ns(clock, n) + offset_ns) % period;
  phase += phase < 0 ? period : 0;
  return phase > period / 2 ? phase - period : phase;
}

/// Moves the grid against that error, an eighth of it and at most a thousandth of a period: a reference that jumps
/// makes beats run towards it, never jump.
inline void steer(BeatClock& clock, std::int64_t error_ns) {
  const std::int64_t most = std::max<std::int64_t>(1, beats_to_ns(clock, 1) / 1000);
  clock.base_ns -= std::clamp(error_ns / 8, -most, most);
}

}  // namespace adstar::runtime
