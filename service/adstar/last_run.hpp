#pragma once
// The last run among the samples of one spacecraft on one topic, in the order of their recording.
//
// Where a daemon began anew, simulation time falls back and goes on from there. But not every fall is a
// new run: a daemon that had stood still says what is long past while another goes on, and whoever takes over
// or resumes repeats some steps. So samples that are older than the newest before them are a detour. It is a new
// run when
//   - it has two samples or more, in rising order,
//   - it begins before half of that newest time (a run begins at 0; what is repeated is near the newest), and
//   - it goes on from there: it does not end with a leap, longer than all of it, back to the newer times.

#include <cstdint>
#include <optional>

namespace adstar::cli {

/// Of the samples, counted from 0: [begin, end), and the simulation time that they span.
struct RunSpan {
  std::uint64_t begin = 0, end = 0;
  std::int64_t first_ns = 0, last_ns = 0;
};

class RunFinder {
 public:
  void add(std::int64_t time_ns);
  /// Of those so far; empty when there was none.
  RunSpan last_run() const;

 private:
  struct Detour {
    std::uint64_t begin = 0;
    std::int64_t first_ns = 0, last_ns = 0;
  };
  bool is_new_run(const Detour& detour) const;

  std::uint64_t count_ = 0;
  RunSpan run_;
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
