#pragma once
// Every topic, a row each: C++ type, descriptor, name, QoS of the writer, QoS of the reader.
// To add a topic, add its IDL type and a row. Why each QoS is as it is: service/pages/commands.md.

#include <command.h>
#include <health.h>
#include <run.h>
#include <standby.h>
#include <telemetry.h>
#include <tuple>

#include <dds/dds.h>

#include "service/dds/qos.hpp"

namespace adstar::dds {

template <class T>
struct Topic {
  const dds_topic_descriptor_t* descriptor;
  const char* name;
  Qos writer;
  Qos reader;
};

/// The newest value, for late joiners too.
inline constexpr Qos kLatest{Reliability::reliable, Durability::transient_local, 1};
/// As a reader of a time series wants it: what comes between two looks is kept, up to a limit.
inline constexpr Qos kSeries{Reliability::reliable, Durability::transient_local, 64};
/// Answers: none may be displaced by the next one on its way; a late joiner gets the last.
inline constexpr Qos kAnswers{Reliability::reliable, Durability::transient_local, 64};
inline constexpr Qos kCommandsOut{Reliability::reliable, Durability::volatile_, 64};
/// Best effort matches reliable writers too, and cannot be wedged by a forged heartbeat. Bounded
/// against floods of random keys; room for several commanders of every spacecraft in a fleet of
/// 10,000.
inline constexpr Qos kCommandsIn{Reliability::best_effort, Durability::volatile_, 64, 65'536};

/// All records since the last checkpoint, for a standby that comes late.
inline constexpr Qos kRelay{Reliability::reliable, Durability::transient_local, 4096,
                            DDS_LENGTH_UNLIMITED, 4096};
/// The scene's lease is laid over it.
inline constexpr Qos kBeats{Reliability::reliable, Durability::volatile_, 1};

inline constexpr std::tuple kTopics{
    Topic<adstar_TorqueCommand>{&adstar_TorqueCommand_desc, "adstar/torque_command", kCommandsOut,
                                kCommandsIn},
    Topic<adstar_WheelTorqueCommand>{&adstar_WheelTorqueCommand_desc, "adstar/wheel_torque_command",
                                     kCommandsOut, kCommandsIn},
    Topic<adstar_WheelSpeedCommand>{&adstar_WheelSpeedCommand_desc, "adstar/wheel_speed_command",
                                    kCommandsOut, kCommandsIn},
    Topic<adstar_DipoleCommand>{&adstar_DipoleCommand_desc, "adstar/dipole_command", kCommandsOut,
                                kCommandsIn},
    Topic<adstar_ThrusterCommand>{&adstar_ThrusterCommand_desc, "adstar/thruster_command",
                                  kCommandsOut, kCommandsIn},
    Topic<adstar_JointTorqueCommand>{&adstar_JointTorqueCommand_desc, "adstar/joint_torque_command",
                                     kCommandsOut, kCommandsIn},
    Topic<adstar_CommandStatus>{&adstar_CommandStatus_desc, "adstar/command_status", kAnswers,
                                kAnswers},
    Topic<adstar_AttitudeState>{&adstar_AttitudeState_desc, "adstar/attitude_state", kLatest,
                                kSeries},
    Topic<adstar_MomentumState>{&adstar_MomentumState_desc, "adstar/momentum_state", kLatest,
                                kSeries},
    Topic<adstar_WheelState>{&adstar_WheelState_desc, "adstar/wheel_state", kLatest, kSeries},
    Topic<adstar_PointingState>{&adstar_PointingState_desc, "adstar/pointing_state", kLatest,
                                kSeries},
    Topic<adstar_BodyState>{&adstar_BodyState_desc, "adstar/body_state", kLatest, kSeries},
    Topic<adstar_JointState>{&adstar_JointState_desc, "adstar/joint_state", kLatest, kSeries},
    Topic<adstar_FleetState>{&adstar_FleetState_desc, "adstar/fleet_state", kLatest, kLatest},
    Topic<adstar_ServiceStatus>{&adstar_ServiceStatus_desc, "adstar/service_status", kLatest,
                                kLatest},
    Topic<adstar_StepTiming>{&adstar_StepTiming_desc, "adstar/step_timing", kLatest, kLatest},
    Topic<adstar_ServiceRoster>{&adstar_ServiceRoster_desc, "adstar/service_roster", kLatest,
                                kLatest},
    Topic<adstar_StepRequest>{&adstar_StepRequest_desc, "adstar/step_request", kCommandsOut,
                              kCommandsIn},
    Topic<adstar_StepReply>{&adstar_StepReply_desc, "adstar/step_reply", kAnswers, kAnswers},
    Topic<adstar_RunControl>{&adstar_RunControl_desc, "adstar/run_control", kCommandsOut,
                             kCommandsIn},
    Topic<adstar_RunControlStatus>{&adstar_RunControlStatus_desc, "adstar/run_control_status",
                                   kAnswers, kAnswers},
    Topic<adstar_StandbyBeat>{&adstar_StandbyBeat_desc, "adstar/standby_beat", kBeats, kBeats},
    Topic<adstar_StandbyRecord>{&adstar_StandbyRecord_desc, "adstar/standby_record", kRelay,
                                kRelay},
    Topic<adstar_StandbyState>{&adstar_StandbyState_desc, "adstar/standby_state", kLatest,
                               kLatest}};

template <class T>
constexpr const Topic<T>& topic_of() {
  return std::get<Topic<T>>(kTopics);
}

}  // namespace adstar::dds
