// A node of ROS 2 as the bus sees one: a participant with its own descriptors, in the default partition, with
// the type names and the QoS of rmw_cyclonedds. It hears what the native topics say, and moves the spacecraft.

#include <algorithm>
#include <map>
#include <set>
#include <stand_in.h>

#include <gtest/gtest.h>

#include "service/dds/raw_reader.hpp"
#include "service/runtime/fleet.hpp"
#include "tests/integration/clock_holder.hpp"

namespace adstar {
namespace {

using testing::ClockHolder;
using testing::Daemon;
using testing::eventually;
using testing::GroundStation;
using testing::TemporaryDirectory;

constexpr std::int64_t kMillisecond = 1'000'000;

/// What rclcpp asks for where nobody says otherwise, and what its clock does.
constexpr dds::Qos kRosDefault{dds::Reliability::reliable, dds::Durability::volatile_, 10};
constexpr dds::Qos kRosClock{dds::Reliability::best_effort, dds::Durability::volatile_, 1};

dds_topic_descriptor_t announced_as(dds_topic_descriptor_t descriptor, const char* name) {
  descriptor.m_typename = name;
  return descriptor;
}
const auto kFour = announced_as(stand_in_Four_desc, "geometry_msgs::msg::dds_::QuaternionStamped_");
const auto kThree = announced_as(stand_in_Three_desc, "geometry_msgs::msg::dds_::Vector3Stamped_");
const auto kWrench = announced_as(stand_in_Wrench_desc, "geometry_msgs::msg::dds_::WrenchStamped_");
const auto kClock = announced_as(stand_in_Clock_desc, "rosgraph_msgs::msg::dds_::Clock_");
const auto kTransform = announced_as(stand_in_Transform_desc, "tf2_msgs::msg::dds_::TFMessage_");

/// ROS 2 knows no other partition than the default one.
dds::ParticipantOptions ros_corner() {
  dds::ParticipantOptions where = testing::private_corner();
  where.partition.clear();
  return where;
}

std::int64_t nanoseconds(std::int32_t sec, std::uint32_t nanosec) {
  return sec * std::int64_t{1'000'000'000} + nanosec;
}

class Node {
 public:
  explicit Node(const dds::Participant& participant, const std::string& spacecraft = "sat1")
      : torque_(participant, kWrench, ("rt/" + spacecraft + "/torque").c_str(), kRosDefault),
        attitude_(participant, kFour, ("rt/" + spacecraft + "/attitude").c_str(), kRosDefault),
        momentum_(participant, kThree, ("rt/" + spacecraft + "/angular_momentum").c_str(),
                  kRosDefault),
        clock_(participant, kClock, "rt/clock", kRosClock),
        transform_(participant, kTransform, "rt/tf", kRosDefault) {}

  /// Takes everything that came; keeps it by its stamp.
  void listen() {
    attitude_.take([&](const stand_in_Four& s, const dds_sample_info_t&) {
      EXPECT_STREQ(s.frame_id, "inertial");
      attitude[nanoseconds(s.sec, s.nanosec)] = {s.w, s.x, s.y, s.z};
    });
    momentum_.take([&](const stand_in_Three& s, const dds_sample_info_t&) {
      EXPECT_STREQ(s.frame_id, "inertial");
      momentum[nanoseconds(s.sec, s.nanosec)] = {s.x, s.y, s.z};
    });
    clock_.take([&](const stand_in_Clock& s, const dds_sample_info_t&) {
      time_ns = nanoseconds(s.sec, s.nanosec);
      ++ticks;
    });
    transform_.take([&](const stand_in_Transform& s, const dds_sample_info_t&) {
      EXPECT_EQ(s.transforms, 1U);
      EXPECT_STREQ(s.frame_id, "inertial");
      EXPECT_STREQ(s.child_frame_id, "sat1/body");
      EXPECT_EQ(std::vector(s.translation, s.translation + 3), std::vector(3, 0.0));
      transform[nanoseconds(s.sec, s.nanosec)] = {s.rotation[3], s.rotation[0], s.rotation[1],
                                                  s.rotation[2]};
    });
  }

  void push(std::string frame, std::array<double, 3> torque, std::array<double, 3> force = {}) {
    torque_.write(
        {0, 0, frame.data(), {force[0], force[1], force[2]}, {torque[0], torque[1], torque[2]}});
  }
  bool is_heard() const { return torque_.matched() > 0; }

  std::map<std::int64_t, std::array<double, 4>> attitude;   ///< w, x, y, z by stamp
  std::map<std::int64_t, std::array<double, 3>> momentum;   ///< by stamp
  std::map<std::int64_t, std::array<double, 4>> transform;  ///< as attitude
  std::optional<std::int64_t> time_ns;
  std::size_t ticks = 0;

 private:
  dds::Writer<stand_in_Wrench> torque_;
  dds::Reader<stand_in_Four> attitude_;
  dds::Reader<stand_in_Three> momentum_;
  dds::Reader<stand_in_Clock> clock_;
  dds::Reader<stand_in_Transform> transform_;
};

constexpr const char* kEnabled = "[ros2]\nenabled = true\ntorque_validity = \"33ms\"\n";

/// The paper's body in lock-step, with an actuator in each frame.
std::string scene_for_ros(const dds::ParticipantOptions& where) {
  const std::string second =
      "[[spacecraft.torque]]\nmodel = \"commanded\"\nname = \"tug\"\nframe = \"inertial\"\n"
      "max_torque_n_m = [1.0, 1.0, 1.0]\n[telemetry]\n";
  return testing::replaced(testing::lockstep_scene(where, {.telemetry_hz = 100, .more = kEnabled}),
                           "[telemetry]\n", second);
}

/// What the scene's body would be after that many steps under a torque on that actuator.
std::array<double, 3> flown(const std::string& text, std::uint64_t steps, std::size_t actuator,
                            const TorqueInterval<double>& torque) {
  const scene::Scene scene = scene::parse(text, "test.toml");
  runtime::Fleet fleet(scene.spacecraft, scene.simulation.scheme, scene.simulation.limits);
  auto& commanded = std::get<Commanded<double>>(fleet.vehicles()[0].torques[actuator]);
  commanded.window[0] = torque;
  commanded.intervals = 1;
  for (std::uint64_t n = 0; n < steps; ++n) {
    fleet.step(static_cast<std::int64_t>(n) * scene.simulation.step_ns, scene.simulation.step_ns);
  }
  return runtime::sample(fleet.vehicles()[0]).H_I_n_m_s;
}

/// A daemon whose clock stands, a node of ROS 2, and a ground station beside it.
class Ros2 : public ::testing::Test {
 protected:
  /// Steps until the node hears everything: what was said before it was known is gone.
  void SetUp() override {
    ASSERT_TRUE(eventually([&] {
      const auto reply = holder_.step(1);
      reached_ns_ = reply ? reply->time_ns : 0;
      node_.listen();
      return node_.is_heard() && node_.attitude.contains(reached_ns_) &&
             node_.momentum.contains(reached_ns_) && node_.transform.contains(reached_ns_);
    })) << daemon_.log();
  }
  void TearDown() override { EXPECT_EQ(daemon_.stop(), 0) << daemon_.log(); }

  /// That many steps, and what is said of the last of them.
  bool step(std::uint64_t steps) {
    const auto reply = holder_.step(steps);
    reached_ns_ = reply ? reply->time_ns : 0;
    return reply && ground_.until([&] {
      node_.listen();
      return ground_.momentum["sat1"].step == reply->step &&
             ground_.attitude["sat1"].step == reply->step && node_.momentum.contains(reached_ns_) &&
             node_.attitude.contains(reached_ns_) && node_.transform.contains(reached_ns_) &&
             node_.time_ns == reached_ns_;
    });
  }
  std::uint64_t steps_taken() const {
    return static_cast<std::uint64_t>(reached_ns_ / (10 * kMillisecond));
  }

  std::array<double, 3> momentum() {
    const auto& H = ground_.momentum["sat1"].momentum_inertial_n_m_s;
    return {H.x, H.y, H.z};
  }

  /// Sends it, again and again until it is answered. While the clock stands they are one: the last is in force.
  std::optional<adstar_CommandStatus> push(const std::string& frame, std::array<double, 3> torque) {
    const std::size_t before = ground_.answers.size();
    auto next = std::chrono::steady_clock::now();
    const bool answered = ground_.until([&] {
      if (std::chrono::steady_clock::now() >= next) {
        node_.push(frame, torque);
        next = std::chrono::steady_clock::now() + std::chrono::milliseconds(200);
      }
      return ground_.answers.size() > before;
    });
    return answered ? std::optional(newest_answer()) : std::nullopt;
  }
  const adstar_CommandStatus& newest_answer() { return ground_.answers.rbegin()->second.back(); }

  /// Sends it until the log has these words.
  bool is_refused(const std::string& frame, std::array<double, 3> torque,
                  std::array<double, 3> force, const std::string& words) {
    return eventually([&] {
      node_.push(frame, torque, force);
      return daemon_.log().find(words) != std::string::npos;
    });
  }

  dds::ParticipantOptions where_ = ros_corner();
  Daemon daemon_{scene_for_ros(where_)};
  GroundStation ground_{where_};
  ClockHolder holder_{ground_.participant()};
  Node node_{ground_.participant()};
  std::int64_t reached_ns_ = 0;
};

TEST_F(Ros2, hears_what_the_native_topics_say_of_the_same_step) {
  for (const std::uint64_t steps : {1U, 9U, 290U}) {
    const std::uint64_t before = steps_taken();
    ASSERT_TRUE(step(steps)) << daemon_.log();
    EXPECT_EQ(steps_taken(), before + steps);
    const adstar_AttitudeState& attitude = ground_.attitude["sat1"];
    EXPECT_EQ(attitude.time_ns, reached_ns_) << "from zero at the scene's start";
    const auto& q = attitude.attitude_body_to_inertial;
    const std::array<double, 4> q_IB{q.w, q.x, q.y, q.z};
    EXPECT_EQ(node_.attitude[reached_ns_], q_IB);
    EXPECT_EQ(node_.transform[reached_ns_], q_IB);
    EXPECT_EQ(node_.momentum[reached_ns_], momentum());
  }
  const std::size_t ticks = node_.ticks;
  EXPECT_TRUE(eventually([&] {
    node_.listen();
    return node_.ticks > ticks;
  })) << "a clock that stands is told again";
  EXPECT_EQ(*node_.time_ns, reached_ns_);
}

TEST_F(Ros2, moves_the_spacecraft_by_its_torque_for_as_long_as_the_scene_says) {
  ASSERT_TRUE(step(1)) << daemon_.log();
  const auto before = momentum();
  const std::int64_t start_ns = reached_ns_;
  const auto accepted = push("inertial", {0.3, -0.7, 0.11});
  ASSERT_TRUE(accepted.has_value()) << daemon_.log();
  EXPECT_EQ(dds::text_of(accepted->actuator), "tug");
  ASSERT_TRUE(step(100)) << daemon_.log();
  const auto after = momentum();
  const std::array<double, 3> impulse{0.3 * 0.033, -0.7 * 0.033, 0.11 * 0.033};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(after[axis] - before[axis], impulse[axis], 1e-15) << axis;
  }
  const TorqueInterval<double> torque{start_ns, start_ns + 33 * kMillisecond, {0.3, -0.7, 0.11}};
  EXPECT_EQ(after, flown(scene_for_ros(where_), steps_taken(), 1, torque));
  ASSERT_TRUE(ground_.until([&] { return newest_answer().verdict == adstar_VERDICT_APPLIED; }));
  EXPECT_EQ(newest_answer().effective_start_time_ns, torque.start_ns);
  EXPECT_EQ(newest_answer().effective_end_time_ns, torque.end_ns);
}

TEST_F(Ros2, moves_it_in_the_body_frame_and_the_next_message_takes_the_place_of_the_last) {
  const std::int64_t start_ns = reached_ns_;
  const auto first = push("sat1/body", {0.3, -0.7, 0.11});
  ASSERT_TRUE(first.has_value()) << daemon_.log();
  EXPECT_EQ(dds::text_of(first->actuator), "body");
  const auto second = push("sat1/body", {0.1, 0.2, 0.3});
  ASSERT_TRUE(second.has_value()) << daemon_.log();
  EXPECT_EQ(second->commander.low, first->commander.low);
  EXPECT_GT(second->sequence_number, first->sequence_number);
  ASSERT_TRUE(step(50)) << daemon_.log();
  const TorqueInterval<double> torque{start_ns, start_ns + 33 * kMillisecond, {0.1, 0.2, 0.3}};
  EXPECT_EQ(momentum(), flown(scene_for_ros(where_), steps_taken(), 0, torque));
  EXPECT_TRUE(ground_.until([&] {
    return ground_.answers[first->sequence_number].back().verdict == adstar_VERDICT_SUPERSEDED &&
           newest_answer().verdict == adstar_VERDICT_APPLIED;
  }));
}

TEST_F(Ros2, moves_nothing_with_a_force_in_a_strange_frame_or_by_what_is_no_number) {
  EXPECT_TRUE(is_refused("map", {0.5, 0, 0}, {}, "its frame_id is \"map\"")) << daemon_.log();
  EXPECT_TRUE(is_refused("sat1/body", {0.5, 0, 0}, {0, 0, 1}, "it has a force")) << daemon_.log();
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const auto answer = push("sat1/body", {kNan, 0, 0});
  ASSERT_TRUE(answer.has_value()) << daemon_.log();
  EXPECT_EQ(answer->verdict, adstar_VERDICT_REFUSED);
  EXPECT_EQ(answer->reason, adstar_REASON_NOT_FINITE);
  EXPECT_TRUE(is_refused("sat1/body", {kNan, 0, 0}, {}, "the torque holds a NaN")) << daemon_.log();
  ASSERT_TRUE(step(50)) << daemon_.log();
  EXPECT_EQ(momentum(), flown(scene_for_ros(where_), steps_taken(), 0, {}));
  for (const auto& [sequence, answers] : ground_.answers) {
    EXPECT_EQ(answers.back().verdict, adstar_VERDICT_REFUSED) << sequence;
  }
}

TEST_F(Ros2, is_told_in_the_log_of_a_torque_that_the_actuator_cannot_give) {
  ASSERT_TRUE(push("sat1/body", {99, 0, 0})) << daemon_.log();
  ASSERT_TRUE(step(1)) << daemon_.log();
  EXPECT_TRUE(ground_.until([&] { return newest_answer().verdict == adstar_VERDICT_CLAMPED; }));
  EXPECT_TRUE(eventually([&] {
    return daemon_.log().find("a torque for 'sat1' is scaled to the actuator's limit: ") !=
           std::string::npos;
  })) << daemon_.log();
}

TEST_F(Ros2, is_heard_by_the_next_bridge_too) {
  ASSERT_TRUE(push("inertial", {0, 0, 0.5})) << daemon_.log();
  const adstar_CommanderId before = newest_answer().commander;
  const pid_t fallen = daemon_.bridge();
  ASSERT_EQ(kill(fallen, SIGKILL), 0);
  ground_.answers.clear();
  const auto accepted = push("inertial", {0, 0, 0.5});
  ASSERT_TRUE(accepted.has_value()) << daemon_.log();
  EXPECT_EQ(accepted->verdict, adstar_VERDICT_ACCEPTED);
  EXPECT_EQ(accepted->commander.high, before.high) << "the same name";
  EXPECT_NE(accepted->commander.low, before.low) << "another process";
}

/// What discovery says of a writer or reader.
struct Announced {
  std::string type;
  dds::QosHandle qos{nullptr, &dds_delete_qos};
  bool tells_type = false;  ///< beside its name
  std::string user_data;
  unsigned entity_kind = 0;  ///< last byte of its id
};
using AnnouncedTopics = std::map<std::string, Announced>;

/// Adds those that are not of our own participant.
void take_announced(const dds::Entity& reader, dds_instance_handle_t own, AnnouncedTopics& found) {
  void* sample = nullptr;
  dds_sample_info_t info;
  while (dds_take(reader.handle(), &sample, &info, 1, 1) == 1) {
    const auto& endpoint = *static_cast<const dds_builtintopic_endpoint_t*>(sample);
    if (info.valid_data && endpoint.participant_instance_handle != own) {
      Announced& each = found[endpoint.topic_name];
      each.type = endpoint.type_name;
      each.qos = dds::QosHandle(dds_create_qos(), &dds_delete_qos);
      dds_merge_qos(each.qos.get(), endpoint.qos);
      each.entity_kind = endpoint.key.v[15];
      const ddsi_typeinfo* told = nullptr;
      EXPECT_EQ(dds_builtintopic_get_endpoint_type_info(
                    const_cast<dds_builtintopic_endpoint_t*>(&endpoint), &told),
                DDS_RETCODE_OK);
      each.tells_type = told != nullptr;
      void* data = nullptr;
      std::size_t length = 0;
      dds_qget_userdata(endpoint.qos, &data, &length);
      each.user_data.assign(static_cast<const char*>(data), length);
      dds_free(data);
    }
    dds_return_loan(reader.handle(), &sample, 1);
    sample = nullptr;
  }
}

void expect_as_in_ros(const Announced& each, const std::string& type,
                      dds_reliability_kind_t reliability, unsigned entity_kind) {
  ASSERT_EQ(each.type, type);
  dds_reliability_kind_t reliable{};
  dds_durability_kind_t durable{};
  dds_ownership_kind_t ownership{};
  dds_liveliness_kind_t liveliness{};
  dds_duration_t deadline = 0, lease = 0, blocking = 0;
  EXPECT_TRUE(dds_qget_reliability(each.qos.get(), &reliable, &blocking));
  EXPECT_TRUE(dds_qget_durability(each.qos.get(), &durable));
  EXPECT_TRUE(dds_qget_ownership(each.qos.get(), &ownership));
  EXPECT_TRUE(dds_qget_liveliness(each.qos.get(), &liveliness, &lease));
  EXPECT_TRUE(dds_qget_deadline(each.qos.get(), &deadline));
  EXPECT_EQ(reliable, reliability) << type;
  EXPECT_EQ(durable, DDS_DURABILITY_VOLATILE) << type;
  EXPECT_EQ(ownership, DDS_OWNERSHIP_SHARED) << type;
  EXPECT_EQ(liveliness, DDS_LIVELINESS_AUTOMATIC) << type;
  EXPECT_EQ(lease, DDS_INFINITY) << type;
  EXPECT_EQ(deadline, DDS_INFINITY) << type;
  std::uint32_t partitions = 0;
  char** names = nullptr;
  dds_qget_partition(each.qos.get(), &partitions, &names);
  EXPECT_EQ(partitions, 0U) << type;
  EXPECT_EQ(each.entity_kind, entity_kind) << type;
  EXPECT_FALSE(each.tells_type) << type;
  EXPECT_EQ(each.user_data, ";") << "without any a node warns of it";
}

TEST_F(Ros2, finds_the_types_and_the_qos_of_ros_2_announced_without_keys) {
  const dds_entity_t us = ground_.participant().handle();
  dds_instance_handle_t own = 0;
  ASSERT_EQ(dds_get_instance_handle(us, &own), DDS_RETCODE_OK);
  const dds::Entity writers(
      dds_create_reader(us, DDS_BUILTIN_TOPIC_DCPSPUBLICATION, nullptr, nullptr), "reader", "");
  const dds::Entity readers(
      dds_create_reader(us, DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION, nullptr, nullptr), "reader", "");
  AnnouncedTopics out, in;
  const auto all = {"rt/sat1/attitude", "rt/sat1/angular_momentum", "rt/clock", "rt/tf",
                    "adstar/attitude_state"};
  ASSERT_TRUE(eventually([&] {
    take_announced(writers, own, out);
    take_announced(readers, own, in);
    return in.contains("rt/sat1/torque") &&
           std::all_of(all.begin(), all.end(),
                       [&](const char* name) { return out.contains(name); });
  }));
  // RTPS 2.5, table 9.1: user-defined, without a key.
  constexpr unsigned kWriterNoKey = 0x03, kReaderNoKey = 0x04;
  constexpr auto kReliable = DDS_RELIABILITY_RELIABLE;
  expect_as_in_ros(out["rt/sat1/attitude"], "geometry_msgs::msg::dds_::QuaternionStamped_",
                   kReliable, kWriterNoKey);
  expect_as_in_ros(out["rt/sat1/angular_momentum"], "geometry_msgs::msg::dds_::Vector3Stamped_",
                   kReliable, kWriterNoKey);
  expect_as_in_ros(out["rt/clock"], "rosgraph_msgs::msg::dds_::Clock_", kReliable, kWriterNoKey);
  expect_as_in_ros(out["rt/tf"], "tf2_msgs::msg::dds_::TFMessage_", kReliable, kWriterNoKey);
  EXPECT_TRUE(out["adstar/attitude_state"].tells_type) << "it would be seen";
  expect_as_in_ros(in["rt/sat1/torque"], "geometry_msgs::msg::dds_::WrenchStamped_",
                   DDS_RELIABILITY_BEST_EFFORT, kReaderNoKey);
}

TEST_F(Ros2, has_plain_cdr_on_the_wire) {
  dds::RawReader clock(ground_.participant(), kClock, "rt/clock", kRosDefault);
  ASSERT_LT(steps_taken(), 101U);
  ASSERT_TRUE(holder_.step(101 - steps_taken()).has_value());
  const std::vector<unsigned char> wanted{0x00, 0x01, 0,    0,   // plain CDR, little-endian
                                          1,    0,    0,    0,   // clock.sec
                                          0x80, 0x96, 0x98, 0};  // .nanosec: 10,000,000
  std::vector<unsigned char> newest;
  EXPECT_TRUE(eventually([&] {
    clock.take([&](std::span<const std::byte> bytes, const dds_sample_info_t&) {
      newest.clear();
      for (const std::byte byte : bytes) {
        newest.push_back(std::to_integer<unsigned char>(byte));
      }
    });
    return newest == wanted;
  })) << ::testing::PrintToString(newest);
}

TEST(Ros2Clock, comes_with_the_status_where_there_is_no_other_telemetry) {
  const auto where = ros_corner();
  const dds::Participant participant(where);
  Node node(participant);
  testing::BridgeUnderTest bridge(
      testing::two_spacecraft(where) + "[telemetry]\nattitude_hz = 0\nmomentum_hz = 0\n" + kEnabled,
      2);
  bridge.start();
  ASSERT_TRUE(bridge.becomes(runtime::BridgeState::ready)) << bridge.segment()->bridge_message;
  for (const std::int64_t time_ns : {7'500'000'000L, 8'000'000'000L, 1L}) {
    EXPECT_TRUE(eventually([&] {
      runtime::StatusRecord status;
      status.time_ns = time_ns;
      bridge.segment()->status.write(status);
      runtime::wake_bridge(*bridge.segment());
      node.listen();
      return node.time_ns == time_ns;
    })) << time_ns;
  }
}

/// At 200 Hz in real time, with whom to follow.
std::string pair_scene(const dds::ParticipantOptions& where) {
  return testing::paper_scene(
      where, {.step = "5ms",
              .telemetry_hz = 200,
              .more = std::string("[run]\ncheckpoint_every = \"3s\"\nhistory = \"whole\"\n"
                                  "[standby]\nlead = \"30ms\"\nlease = \"150ms\"\n") +
                      kEnabled});
}

TEST(Ros2Standby, is_mute_and_deaf_until_it_takes_over) {
  const auto where = ros_corner();
  const TemporaryDirectory home;
  const std::string scene = pair_scene(where);
  const auto begin = [&](const char* run, std::vector<std::string> words) {
    words.insert(words.end(), {"--run", (home.path() / run).string()});
    return std::make_unique<Daemon>(scene, words);
  };
  GroundStation ground(where);
  Node node(ground.participant());
  std::set<dds_instance_handle_t> said;  // by which writers
  dds::Reader<stand_in_Clock> clock(ground.participant(), kClock, "rt/clock", kRosDefault);
  const auto listen = [&] {
    node.listen();
    clock.take([&](const stand_in_Clock&, const dds_sample_info_t& info) {
      said.insert(info.publication_handle);
    });
  };
  auto primary = begin("first", {});
  ASSERT_TRUE(ground.until([&] { return node.is_heard(); })) << primary->log();
  auto standby = begin("second", {"--standby"});
  ASSERT_TRUE(ground.until([&] {
    listen();
    return standby->log().find("follows from step") != std::string::npos;
  })) << standby->log();
  const std::size_t heard = node.attitude.size();
  ASSERT_TRUE(ground.until([&] {
    listen();
    return node.attitude.size() > heard + 100;
  })) << primary->log();
  EXPECT_EQ(said.size(), 1U) << "of two daemons one has spoken";

  primary.reset();  // SIGKILL
  ASSERT_TRUE(ground.until([&] {
    listen();
    return said.size() == 2;
  })) << standby->log();
  EXPECT_TRUE(ground.until([&] {
    node.push("sat1/body", {0.2, 0, 0});
    return std::any_of(ground.answers.begin(), ground.answers.end(), [](const auto& of_one) {
      return of_one.second.back().verdict == adstar_VERDICT_APPLIED;
    });
  })) << standby->log();
  EXPECT_EQ(standby->stop(), 0) << standby->log();
}

}  // namespace
}  // namespace adstar
