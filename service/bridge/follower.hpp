#pragma once
// A standby's ear: finds the primary of its service, hands its state and its commands to adstard, and
// says when that primary is gone.

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "service/bridge/options.hpp"
#include "service/bridge/primary_voice.hpp"
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
  struct Primary {
    Claim claim;
    runtime::StandbyBeatRecord beat;
    bool gone = false;
  };
  void hear_beats();
  void hear_records();
  void hear_states();
  void hand_over_state();
  void hand_over_records();
  bool is_primary(std::uint64_t high, std::uint64_t low) const noexcept;

  runtime::SharedSegment& segment_;
  runtime::StandbyLink& link_;
  const Options& options_;
  dds::Reader<adstar_StandbyBeat> beats_;
  dds::Reader<adstar_StandbyRecord> records_;
  dds::Reader<adstar_StandbyState> states_;
  std::optional<Primary> primary_;
  CheckpointParts parts_;
  std::optional<NumberedBytes> state_;          ///< the newest that is whole
  std::uint64_t next_number_ = 0;               ///< of the first record that is not in state_
  std::deque<runtime::JournalRecord> waiting_;  ///< ascending
  std::int64_t patience_ends_ns_;
};

}  // namespace adstar::bridge
