#pragma once
// A standby's ear: what the primaries of its service say on the bus, for Pursuit to judge.

#include "service/bridge/options.hpp"
#include "service/bridge/pursuit.hpp"
#include "service/bridge/standby_checkpoints.hpp"
#include "service/dds/reader.hpp"
#include "service/runtime/shared_segment.hpp"
#include "service/scene/scene.hpp"

namespace adstar::bridge {

class Follower {
 public:
  Follower(const dds::Participant& participant, runtime::SharedSegment& segment,
           const scene::Standby& standby, const Options& options);

  /// Takes what came. True once the primary is gone, and this daemon can go on in its place.
  bool primary_is_gone();

 private:
  void hear_beats();
  void hear_records();
  void hear_states();
  void hear(const adstar_StandbyBeat& beat);

  runtime::SharedSegment& segment_;
  const Options& options_;
  dds::Reader<adstar_StandbyBeat> beats_;
  dds::Reader<adstar_StandbyRecord> records_;
  dds::Reader<adstar_StandbyState> states_;
  Pursuit pursuit_;
  CheckpointParts parts_;
  bool said_lost_ = false;
};

}  // namespace adstar::bridge
