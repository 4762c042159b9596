#pragma once
// What a ROS 2 node calls our states and torques: topics, types, frames, time. The wire is that of
// rmw_cyclonedds: topic "rt/name", type "pkg::msg::dds_::Name_", plain CDR, no key. Why each is as it is:
// service/decisions/0021-ros-2.md.

#include <cstdint>
#include <string>
#include <string_view>

#include <ros2.h>

#include "service/dds/topics.hpp"
#include "service/runtime/records.hpp"

namespace adstar::ros2 {

using Time = builtin_interfaces_msg_dds__Time_;
using QuaternionStamped = geometry_msgs_msg_dds__QuaternionStamped_;
using Vector3Stamped = geometry_msgs_msg_dds__Vector3Stamped_;
using WrenchStamped = geometry_msgs_msg_dds__WrenchStamped_;
using TransformStamped = geometry_msgs_msg_dds__TransformStamped_;
using Clock = rosgraph_msgs_msg_dds__Clock_;
using TfMessage = tf2_msgs_msg_dds__TFMessage_;

/// What ROS 2 gives a topic for which nobody asks otherwise.
inline constexpr dds::Qos kOut{dds::Reliability::reliable, dds::Durability::volatile_, 10};
/// What tf2 gives its own.
inline constexpr dds::Qos kTfOut{dds::Reliability::reliable, dds::Durability::volatile_, 100};
/// As for our own commands: it matches every publisher, and no forged heartbeat wedges it.
inline constexpr dds::Qos kIn{dds::Reliability::best_effort, dds::Durability::volatile_, 64,
                              65'536};

// Of a spacecraft: the last part of the name.
inline constexpr dds::Topic<QuaternionStamped> kAttitude{
    &geometry_msgs_msg_dds__QuaternionStamped__desc, "attitude", kOut, kIn};
inline constexpr dds::Topic<Vector3Stamped> kAngularMomentum{
    &geometry_msgs_msg_dds__Vector3Stamped__desc, "angular_momentum", kOut, kIn};
inline constexpr dds::Topic<WrenchStamped> kTorque{&geometry_msgs_msg_dds__WrenchStamped__desc,
                                                   "torque", kOut, kIn};
// Of everybody: the whole name.
inline constexpr dds::Topic<Clock> kClock{&rosgraph_msgs_msg_dds__Clock__desc, "rt/clock", kOut,
                                          kIn};
inline constexpr dds::Topic<TfMessage> kTf{&tf2_msgs_msg_dds__TFMessage__desc, "rt/tf", kTfOut,
                                           kIn};

/// "rt/sat1/attitude"
template <class T>
std::string name_of(std::string_view spacecraft, const dds::Topic<T>& topic) {
  return "rt/" + std::string(spacecraft) + '/' + topic.name;
}

inline constexpr const char* kInertialFrame = "inertial";
/// "sat1/body"
std::string body_frame(std::string_view spacecraft);

/// Simulation time; what seconds of 32 bits cannot count stays at the last that they can.
Time to_time(std::int64_t time_ns) noexcept;

// Samples, whose texts are lent.
QuaternionStamped to_attitude(const runtime::TelemetryRecord& record) noexcept;
Vector3Stamped to_angular_momentum(const runtime::TelemetryRecord& record) noexcept;
/// Attitude alone: the origins coincide.
TransformStamped to_transform(const runtime::TelemetryRecord& record,
                              const std::string& body_frame) noexcept;

}  // namespace adstar::ros2
