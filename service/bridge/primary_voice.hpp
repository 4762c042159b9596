#pragma once
// What a primary tells its standbys, and what it hears of others who think that they are the primary.

#include <chrono>
#include <cstdint>

#include "service/bridge/claim.hpp"
#include "service/bridge/options.hpp"
#include "service/bridge/standby_checkpoints.hpp"
#include "service/dds/reader.hpp"
#include "service/dds/writer.hpp"
#include "service/runtime/shared_segment.hpp"
#include "service/scene/scene.hpp"

namespace adstar::bridge {

class PrimaryVoice {
 public:
  PrimaryVoice(const dds::Participant& participant, runtime::SharedSegment& segment,
               const scene::Standby& standby, const Options& options);

  /// Commands first, then how far the tick is: a standby never counts on what is not on its way.
  void speak();

  /// Once in a while: a checkpoint that is new; whoever flies in a higher term.
  void look_around();

  /// Gives standbys a moment to have it all.
  bool wait_for_readers(std::chrono::nanoseconds timeout);

 private:
  runtime::StandbyLink& link_;
  const Options& options_;
  dds::Writer<adstar_StandbyRecord> records_;
  dds::Writer<adstar_StandbyBeat> beats_;
  dds::Writer<adstar_StandbyState> states_;
  dds::Reader<adstar_StandbyBeat> others_;
  CheckpointWatch checkpoints_;
  std::uint64_t beats_seen_ = 0;
};

}  // namespace adstar::bridge
