#pragma once
// The last run among the samples of one spacecraft on one topic, in the order of their recording.
//
// Where a daemon began anew, simulation time falls back and goes on from there. But not every fall is a
// new run: a daemon that had stood still says what is long past while another goes on, and whoever takes over
// or resumes repeats some steps. So samples that are older than the newest before them are a detour. It is a new
// run when
//   - it has two samples or more, in rising order,
//   - it begins before half of that newest time (a run begins at 0; what is repeated is near the newest),
//   - about when it began somebody was first heard as the service that says it (new_voices.hpp): each begins one run, but
//     not whoever was there when the first sample came, and
//   - it goes on from there: it does not end with a leap, longer than all of it, back to the newer times.
// Where the service's status was never heard, the third is that it begins at about time 0.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "service/adstar/new_voices.hpp"

namespace adstar::cli {

/// Of the samples, counted from 0: [begin, end), and the simulation time that they span.
struct RunSpan {
  std::uint64_t begin = 0, end = 0;
  std::int64_t first_ns = 0, last_ns = 0;
};

/// What there is to know of a sample.
struct Heard {
  std::int64_t time_ns;      ///< simulation time
  std::string_view service;  ///< whoever said it
  std::int64_t received_ns;
};

class RunFinder {
 public:
  /// The voices, all of the recording, must outlive it.
  explicit RunFinder(const NewVoices& voices) : voices_(&voices) {}

  void add(const Heard& sample);
  /// Of those so far; empty when there was none.
  RunSpan last_run() const;

 private:
  struct Detour {
    std::uint64_t begin = 0;
    std::int64_t first_ns = 0, second_ns = 0, last_ns = 0;
    std::string service;
    std::int64_t before_received_ns = 0, received_ns = 0;  ///< of what came before it, of its first
  };
  bool is_new_run(const Detour& detour) const;
  bool has_new_voice(const Detour& detour) const;
  std::optional<std::uint64_t> new_voice(const Detour& detour) const;
  void begin_run_at(const Detour& detour);

  const NewVoices* voices_;
  std::uint64_t count_ = 0;
  std::uint64_t last_voice_ = 0;  ///< the number of the one that began this run
  RunSpan run_;
  std::int64_t listened_since_ns_ = 0, received_ns_ = 0;  ///< of the first and the newest sample
  std::optional<Detour> detour_;
};

/// Hears the samples once more, and tells which of them to take.
class RunReader {
 public:
  explicit RunReader(const RunSpan& run) : run_(run) {}

  /// It is of the run, and newer than all before it.
  bool takes(std::int64_t time_ns);

  /// There is any to take.
  bool heard() const { return run_.end > run_.begin; }
  /// Of earlier runs.
  std::uint64_t before() const { return run_.begin; }
  /// Of the run, but older than what had been said.
  std::uint64_t older() const { return older_; }

 private:
  RunSpan run_;
  std::uint64_t count_ = 0, older_ = 0;
  std::optional<std::int64_t> newest_ns_;
};

}  // namespace adstar::cli
