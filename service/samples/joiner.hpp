#pragma once
// AttitudeState and MomentumState of one spacecraft and step become one row.
//
// A half waits for the other until something later of that spacecraft has come: each topic keeps
// its order, but the two are taken one after the other, so that is judged at the end of a round.

#include <cstdint>
#include <map>
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

  /// After both topics were taken: the rows that are ready, by spacecraft, then by step.
  std::vector<report::Row> end_round() { return ready(false); }
  /// At the end of it all: what still waits, too.
  std::vector<report::Row> rest() { return ready(true); }

  bool has_own_topics(std::string_view spacecraft) const;

 private:
  enum Half : unsigned { kAttitudeHalf = 1, kMomentumHalf = 2, kBoth = 3 };

  struct Waiting {
    report::Row row;
    unsigned halves = 0;
  };
  struct Track {
    std::map<std::uint64_t, Waiting> waiting;  ///< by step
    std::map<Half, std::uint64_t> newest;      ///< step of each topic
    bool begun = false;
    std::uint64_t done = 0;  ///< the last step given out, once begun
  };

  template <class Sample>
  report::Row* place(const Sample& sample, Half half);
  std::vector<report::Row> ready(bool everything);
  void give_out(Track& track, std::vector<report::Row>& rows, bool everything) const;
  bool is_overtaken(const Track& track) const;

  Patience patience_;
  std::map<std::string, Track, std::less<>> tracks_;
  std::map<std::string, std::uint64_t, std::less<>> fleet_steps_;
  std::vector<report::Row> restarted_;  ///< of runs that ended before the present one
  std::vector<report::Row> fleet_rows_;
};

}  // namespace adstar::samples
