#pragma once
// Torques of ROS 2 nodes: each WrenchStamped becomes a TorqueCommand in the name of this bridge, valid as
// long as the scene says, and is judged as any other.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "service/dds/convert.hpp"
#include "service/dds/reader.hpp"
#include "service/dds/ros2.hpp"
#include "service/dds/wait_set.hpp"
#include "service/scene/scene.hpp"

namespace adstar::bridge {

/// Whom a topic moves.
struct Ros2Target {
  std::string spacecraft;
  std::string body_frame;
  std::string body_actuator;      ///< for a torque in that frame; empty: none
  std::string inertial_actuator;  ///< for one in the inertial frame; empty: none
};

Ros2Target ros2_target(const scene::Spacecraft& spacecraft);

/// Which actuator a wrench asks for; null: `objection` says why none.
struct Ros2Wish {
  const std::string* actuator = nullptr;
  std::string objection;
};
Ros2Wish wish_of(const ros2::WrenchStamped& wrench, const Ros2Target& target);

/// The high half of the commander's id under which ROS 2 nodes are heard: "ros2" and zeros. The low half
/// is random.
inline constexpr std::uint64_t kRos2Commander = 0x726f'7332'0000'0000;

/// Of one thread.
class Ros2Torques {
 public:
  /// Listens for every watched spacecraft with a commanded torque.
  Ros2Torques(const dds::Participant& participant, const scene::Scene& scene);

  void attach_to(dds::WaitSet& wait_set) const;

  /// Calls on_wrench(const WrenchStamped&, const dds_sample_info_t&, const Ros2Target&) for what has come;
  /// returns how many.
  template <class OnWrench>
  std::size_t take(OnWrench&& on_wrench) {
    std::size_t taken = 0;
    for (Topic& topic : topics_) {
      taken +=
          topic.reader.take([&](const ros2::WrenchStamped& wrench, const dds_sample_info_t& info) {
            on_wrench(wrench, info, topic.target);
          });
    }
    return taken;
  }

  /// The next in sequence.
  adstar_TorqueCommand command(const ros2::WrenchStamped& wrench, const Ros2Target& target,
                               const std::string& actuator);

 private:
  struct Topic {
    Ros2Target target;
    dds::Reader<ros2::WrenchStamped> reader;
  };

  std::int64_t validity_ns_;
  adstar_CommanderId commander_;
  std::uint64_t sequence_ = 0;
  std::vector<Topic> topics_;
};

/// For the log, at most a line a second and spacecraft: who sends a wrench hears nothing of CommandStatus.
void log_refused_ros2(std::string_view spacecraft, std::string_view why);

/// The same when the gate would not have it, or not all of it.
void log_if_of_ros2(const runtime::VerdictRecord& record, std::string_view spacecraft);

}  // namespace adstar::bridge
