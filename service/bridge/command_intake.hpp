#pragma once
// Commands of all actuators become CommandRecords in the ring. Only names are looked at here: adstard
// judges the rest. The requests to the clock are taken on the same thread.

#include <atomic>
#include <cstdint>
#include <exception>
#include <optional>
#include <string>
#include <thread>

#include "service/bridge/directory.hpp"
#include "service/bridge/other_services.hpp"
#include "service/bridge/request_intake.hpp"
#include "service/bridge/ros2_torques.hpp"
#include "service/bridge/status_writer.hpp"
#include "service/dds/reader.hpp"
#include "service/dds/wait_set.hpp"
#include "service/runtime/shared_segment.hpp"

namespace adstar::bridge {

/// Listens on a thread of its own from construction to destruction; the only producer of the
/// command ring, and of those of the requests.
class CommandIntake {
 public:
  CommandIntake(const dds::Participant& participant, runtime::SharedSegment& segment,
                const scene::Scene& scene, const Directory& directory, const OtherServices& others,
                StatusWriter& statuses, std::string service);
  ~CommandIntake();
  CommandIntake(const CommandIntake&) = delete;
  CommandIntake& operator=(const CommandIntake&) = delete;

  /// Rethrows what ended the thread before its time.
  void check() const;

  std::uint64_t handed_over() const noexcept { return handed_over_.load(); }
  std::uint64_t stale() const noexcept { return stale_.load(); }

 private:
  void listen() noexcept;
  bool take_commands();
  std::size_t take_from_ros2();
  template <class Command>
  std::size_t take_from(dds::Reader<Command>& reader);
  template <class Command>
  void take(const Command& command);
  template <class Command>
  void refuse(const Command& command, runtime::Reason reason);

  runtime::SharedSegment& segment_;
  const Directory& directory_;
  const OtherServices& others_;
  StatusWriter& statuses_;
  std::string service_;
  dds::Reader<adstar_TorqueCommand> torques_;
  dds::Reader<adstar_WheelTorqueCommand> wheel_torques_;
  dds::Reader<adstar_WheelSpeedCommand> wheel_speeds_;
  dds::Reader<adstar_DipoleCommand> dipoles_;
  dds::Reader<adstar_ThrusterCommand> thrusters_;
  dds::Reader<adstar_JointTorqueCommand> joints_;
  std::optional<Ros2Torques> ros2_;
  RequestIntake requests_;
  dds::WaitSet wait_set_;
  std::atomic<std::uint64_t> handed_over_{0};
  std::atomic<std::uint64_t> stale_{0};
  std::atomic<bool> ending_{false};
  std::atomic<bool> failed_{false};
  std::exception_ptr failure_;  ///< written before failed_
  std::thread thread_;
};

}  // namespace adstar::bridge
