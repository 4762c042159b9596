#pragma once
// AttitudeState and MomentumState of one spacecraft and step become one row.
//
// A half waits for the other until something later of that spacecraft has come: each topic keeps
// its order, but the two are taken one after the other, so that is judged at the end of a round.
//
// A half that comes after its row went without it is left out: its step has one row. It is kept for a
// while, though: when the other half comes once more, it was the first word of a new run, and both are a row.
//
// Other samples that are older than what their topic had said, of whoever had hung, took over or began anew, are joined among
// themselves: each goes to the first line of rising steps that it continues, and ends none of the others.

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <telemetry.h>
#include <vector>

#include "service/report/row.hpp"

namespace adstar::samples {

class Joiner {
 public:
  /// Rows come late rather than halved: a half waits until the other topic, if there is one, has gone past
  /// its step (or 4,096 more came). For recordings, where the halves may stand far apart.
  enum class Patience { rounds, both_topics };
  explicit Joiner(Patience patience = Patience::rounds) : patience_(patience) {}

  void add(const adstar_AttitudeState& sample);
  void add(const adstar_MomentumState& sample);
  /// Of spacecraft that have no topics of their own; the others are told by their halves.
  void add(std::string_view spacecraft, const adstar_FleetState& fleet,
           const adstar_FleetMember& member);

  /// After both topics were taken: the rows that are ready, by spacecraft, then by step of each line.
  std::vector<report::Row> end_round() { return ready(false); }
  /// At the end of it all: what still waits, too.
  std::vector<report::Row> rest() { return ready(true); }

  bool has_own_topics(std::string_view spacecraft) const;

 private:
  enum Half : unsigned { kAttitudeHalf = 1, kMomentumHalf = 2, kBoth = 3 };

  struct Waiting {
    report::Row row;
    unsigned halves = 0;
    std::uint64_t came = 0;  ///< the track's samples then
  };
  /// Steps that rise.
  struct Line {
    std::uint64_t first = 0;                   ///< step
    std::map<std::uint64_t, Waiting> waiting;  ///< by step
    std::map<Half, std::uint64_t> newest;      ///< step of each topic
    bool begun = false;
    std::uint64_t done = 0;  ///< the last step given out, once begun
    std::uint64_t fed = 0;   ///< the track's samples, when it got its newest
  };
  /// A row that went with one half.
  struct Halved {
    std::uint64_t step = 0;
    unsigned halves = 0;
    std::unique_ptr<Waiting> late;  ///< the other one, where it came since
  };
  struct Track {
    std::vector<Line> lines;     ///< none gets what one before it would take, but for an other half
    std::vector<Halved> halved;  ///< the last 32 of them, in a ring
    std::size_t oldest_halved = 0;
    std::uint64_t samples = 0;
  };

  template <class Sample>
  report::Row* place(const Sample& sample, Half half);
  void leave_lines(Track& track);
  Waiting* waiting_of(Track& track, Half half, std::uint64_t step);
  static Halved* halved_at(Track& track, std::uint64_t step);
  static Line* line_that_waits_for(Track& track, Half half, std::uint64_t step);
  Line* line_of(Track& track, Half half, std::uint64_t step);
  Line& new_line(Track& track, std::uint64_t first);
  static std::vector<Line*> waiting_lines(Track& track);
  std::vector<report::Row> ready(bool everything);
  void give_out(Track& track, Line& line, std::vector<report::Row>& rows, bool everything) const;
  static void remember_halved(Track& track, std::uint64_t step, unsigned halves);
  bool is_overtaken(const Line& line) const;

  Patience patience_;
  std::map<std::string, Track, std::less<>> tracks_;
  std::map<std::string, std::uint64_t, std::less<>> fleet_steps_;
  std::vector<report::Row> left_;  ///< of lines that nobody continues
  std::vector<report::Row> fleet_rows_;
};

}  // namespace adstar::samples
