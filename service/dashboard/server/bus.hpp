#pragma once
// The bus as the dashboard hears it: every reader it has, and the board that they fill.

#include <chrono>
#include <mutex>
#include <shared_mutex>

#include "service/dashboard/server/board.hpp"
#include "service/dds/participant.hpp"
#include "service/dds/reader.hpp"
#include "service/dds/wait_set.hpp"

namespace adstar::dashboard {

class Bus {
 public:
  explicit Bus(const dds::Participant& participant);

  /// Waits at most `patience` for something to come, and takes it. From one thread only.
  void listen(std::chrono::nanoseconds patience);

  /// look(const Board&) while nothing changes it; from any thread.
  template <class Look>
  auto with_board(Look&& look) const {
    const std::shared_lock lock(mutex_);
    return look(board_);
  }

 private:
  mutable std::shared_mutex mutex_;
  Board board_;
  dds::Reader<adstar_AttitudeState> attitudes_;
  dds::Reader<adstar_MomentumState> momenta_;
  dds::Reader<adstar_FleetState> fleets_;
  dds::Reader<adstar_ServiceStatus> statuses_;
  dds::Reader<adstar_StepTiming> timings_;
  dds::Reader<adstar_ServiceRoster> rosters_;
  dds::Reader<adstar_CommandStatus> verdicts_;
  dds::WaitSet wait_set_;
};

}  // namespace adstar::dashboard
