// ROS 2's messages: bytes as the CDR rules lay them out, names and types as rmw_cyclonedds has them, and
// which wrenches are obeyed.

#include <initializer_list>
#include <limits>
#include <sstream>

#include <dds/ddsi/ddsi_cdrstream.h>
#include <gtest/gtest.h>

#include "service/bridge/ros2_torques.hpp"
#include "service/dds/cdr.hpp"

namespace adstar {
namespace {

using ros2::kAttitude, ros2::kAngularMomentum, ros2::kTorque, ros2::kClock, ros2::kTf;

// Plain CDR, little-endian (OMG Common Data Representation, XTypes 1.3, 7.4.1): a number is aligned to its
// size, counted from behind the header of four bytes; a string is its length with the terminating zero, then
// its characters and the zero; a sequence is its length, then its elements.
using Bytes = std::vector<unsigned char>;

/// What stands in hexadecimal, line by line.
Bytes laid_out(std::initializer_list<const char*> lines) {
  Bytes bytes;
  for (const char* const line : lines) {
    std::istringstream text(line);
    for (std::string byte; text >> byte;) {
      bytes.push_back(static_cast<unsigned char>(std::stoul(byte, nullptr, 16)));
    }
  }
  return bytes;
}

/// As Cyclone puts it on the wire, behind the header.
template <class T>
Bytes written(const dds::Topic<T>& topic, const T& sample) {
  dds_ostreamLE_t stream;
  dds_ostreamLE_init(&stream, 0, 1);
  dds_stream_writeLE(&stream, reinterpret_cast<const char*>(&sample), topic.descriptor->m_ops);
  const auto* const begin = stream.x.m_buffer;
  Bytes bytes(begin, begin + stream.x.m_index);
  dds_ostreamLE_fini(&stream);
  return bytes;
}

runtime::TelemetryRecord some_record() {
  runtime::TelemetryRecord record;
  record.time_ns = 3'000'000'258;
  record.q_IB = {1.0, 0.5, -2.0, 0.25};  // w, x, y, z
  record.H_I_n_m_s = {-2.0, 1.0, 0.5};
  return record;
}

TEST(Ros2Wire, an_attitude_is_a_header_and_then_x_y_z_w) {
  EXPECT_EQ(written(kAttitude, ros2::to_attitude(some_record())),
            laid_out({"03 00 00 00",                 // header.stamp.sec
                      "02 01 00 00",                 // header.stamp.nanosec: 258
                      "09 00 00 00",                 // header.frame_id: eight characters and zero
                      "69 6e 65 72 74 69 61 6c 00",  // "inertial"
                      "00 00 00",                    // to the next multiple of 8: 24
                      "00 00 00 00 00 00 e0 3f",     // quaternion.x 0.5
                      "00 00 00 00 00 00 00 c0",     // .y -2
                      "00 00 00 00 00 00 d0 3f",     // .z 0.25
                      "00 00 00 00 00 00 f0 3f"}));  // .w 1
}

TEST(Ros2Wire, an_angular_momentum_is_a_header_and_then_x_y_z) {
  EXPECT_EQ(written(kAngularMomentum, ros2::to_angular_momentum(some_record())),
            laid_out({"03 00 00 00  02 01 00 00",                           // header.stamp
                      "09 00 00 00  69 6e 65 72 74 69 61 6c 00  00 00 00",  // header.frame_id
                      "00 00 00 00 00 00 00 c0",                            // vector.x -2
                      "00 00 00 00 00 00 f0 3f",                            // .y 1
                      "00 00 00 00 00 00 e0 3f"}));                         // .z 0.5
}

TEST(Ros2Wire, a_clock_is_two_numbers_of_four_bytes) {
  EXPECT_EQ(written(kClock, ros2::Clock{ros2::to_time(3'000'000'258)}),
            laid_out({"03 00 00 00", "02 01 00 00"}));
}

TEST(Ros2Wire, a_transform_turns_and_does_not_move) {
  const std::string frame = "sat1/body";
  ros2::TransformStamped transform = ros2::to_transform(some_record(), frame);
  EXPECT_EQ(written(kTf, ros2::TfMessage{{1, 1, &transform, false}}),
            laid_out({"01 00 00 00",                              // one transform
                      "03 00 00 00  02 01 00 00",                 // header.stamp
                      "09 00 00 00  69 6e 65 72 74 69 61 6c 00",  // header.frame_id, to 25
                      "00 00 00",                                 // to the next multiple of 4: 28
                      "0a 00 00 00  73 61 74 31 2f 62 6f 64 79 00",  // child_frame_id, to 42
                      "00 00 00 00 00 00",           // to the next multiple of 8: 48
                      "00 00 00 00 00 00 00 00",     // transform.translation.x
                      "00 00 00 00 00 00 00 00",     // .y
                      "00 00 00 00 00 00 00 00",     // .z
                      "00 00 00 00 00 00 e0 3f",     // .rotation.x 0.5
                      "00 00 00 00 00 00 00 c0",     // .y -2
                      "00 00 00 00 00 00 d0 3f",     // .z 0.25
                      "00 00 00 00 00 00 f0 3f"}));  // .w 1
}

TEST(Ros2Wire, a_wrench_is_read_force_first) {
  const Bytes bytes = laid_out(
      {"00 01 00 00",                                 // plain CDR, little-endian
       "ff ff ff 7f  01 00 00 00",                    // header.stamp
       "0a 00 00 00  73 61 74 31 2f 62 6f 64 79 00",  // header.frame_id: "sat1/body", to 22
       "00 00",                                       // to the next multiple of 8: 24
       "00 00 00 00 00 00 f0 3f",                     // wrench.force.x 1
       "00 00 00 00 00 00 00 c0",                     // .y -2
       "00 00 00 00 00 00 00 80",                     // .z -0
       "00 00 00 00 00 00 d0 3f",                     // wrench.torque.x 0.25
       "00 00 00 00 00 00 e0 3f",                     // .y 0.5
       "00 00 00 00 00 00 f8 7f"});                   // .z NaN
  ros2::WrenchStamped wrench{};
  ASSERT_TRUE(dds::read_sample(*kTorque.descriptor, std::as_bytes(std::span(bytes)), &wrench));
  EXPECT_EQ(wrench.header.stamp.sec, std::numeric_limits<std::int32_t>::max());
  EXPECT_EQ(wrench.header.stamp.nanosec, 1U);
  EXPECT_STREQ(wrench.header.frame_id, "sat1/body");
  EXPECT_EQ(wrench.wrench.force.x, 1.0);
  EXPECT_EQ(wrench.wrench.force.y, -2.0);
  EXPECT_EQ(wrench.wrench.torque.x, 0.25);
  EXPECT_EQ(wrench.wrench.torque.y, 0.5);
  EXPECT_TRUE(std::isnan(wrench.wrench.torque.z));
  dds::free_sample(*kTorque.descriptor, &wrench);
}

TEST(Ros2Types, are_called_as_rmw_cyclonedds_calls_them_and_have_no_key) {
  const std::pair<const dds_topic_descriptor_t*, const char*> types[]{
      {kAttitude.descriptor, "geometry_msgs::msg::dds_::QuaternionStamped_"},
      {kAngularMomentum.descriptor, "geometry_msgs::msg::dds_::Vector3Stamped_"},
      {kTorque.descriptor, "geometry_msgs::msg::dds_::WrenchStamped_"},
      {kClock.descriptor, "rosgraph_msgs::msg::dds_::Clock_"},
      {kTf.descriptor, "tf2_msgs::msg::dds_::TFMessage_"}};
  for (const auto& [descriptor, name] : types) {
    EXPECT_STREQ(descriptor->m_typename, name);
    EXPECT_EQ(descriptor->m_nkeys, 0U) << name;
    EXPECT_EQ(descriptor->m_flagset & DDS_TOPIC_XTYPES_METADATA, 0U)
        << name << ": a peer could compare its own type with what we tell, and not match";
  }
}

/// History is not announced, so nobody outside could tell.
TEST(Ros2Topics, keep_as_many_samples_as_rclcpp_and_tf2_do) {
  EXPECT_EQ(kAttitude.writer.depth, 10);
  EXPECT_EQ(kAngularMomentum.writer.depth, 10);
  EXPECT_EQ(kClock.writer.depth, 10);
  EXPECT_EQ(kTf.writer.depth, 100);
}

TEST(Ros2Topics, are_a_spacecrafts_own_or_everybodys) {
  EXPECT_EQ(ros2::name_of("sat1", kAttitude), "rt/sat1/attitude");
  EXPECT_EQ(ros2::name_of("sat1", kAngularMomentum), "rt/sat1/angular_momentum");
  EXPECT_EQ(ros2::name_of("sat1", kTorque), "rt/sat1/torque");
  EXPECT_STREQ(kClock.name, "rt/clock");
  EXPECT_STREQ(kTf.name, "rt/tf");
}

TEST(Ros2Time, counts_from_zero_and_stays_where_its_seconds_end) {
  const auto parts = [](std::int64_t ns) {
    const ros2::Time time = ros2::to_time(ns);
    return std::pair(time.sec, time.nanosec);
  };
  constexpr std::int64_t kSecond = 1'000'000'000;
  EXPECT_EQ(parts(0), std::pair(0, 0U));
  EXPECT_EQ(parts(kSecond - 1), std::pair(0, 999'999'999U));
  EXPECT_EQ(parts(kSecond), std::pair(1, 0U));
  EXPECT_EQ(parts(2'147'483'647 * kSecond + 5), std::pair(2'147'483'647, 5U));
  EXPECT_EQ(parts(2'147'483'648 * kSecond), std::pair(2'147'483'647, 999'999'999U));
}

/// Two commanded torques in the body frame, one in I behind them.
scene::Scene scene_with_three() {
  const auto actuator = [](const std::string& name, const std::string& frame) {
    return "[[spacecraft.torque]]\nmodel = \"commanded\"\nname = \"" + name + "\"\nframe = \"" +
           frame + "\"\nmax_torque_n_m = [1, 1, 1]\n";
  };
  return scene::parse(
      "[simulation]\nstep = \"10ms\"\n[[spacecraft]]\nname = \"sat1\"\n"
      "inertia_body_kg_m2 = [1, 1, 1]\n" +
          actuator("jets", "body") + actuator("body", "body") + actuator("tugs", "inertial"),
      "scene.toml");
}

TEST(Ros2Target, of_linked_bodies_is_the_hub) {
  const auto linked = [](const std::string& body) {
    return scene::parse(
        "[simulation]\nstep = \"10ms\"\n[[spacecraft]]\nname = \"sat1\"\nmass_kg = 200.0\n"
        "inertia_body_kg_m2 = [40, 55, 50]\n[[spacecraft.body]]\nname = \"panel\"\nmass_kg = 12.0\n"
        "inertia_body_kg_m2 = [2.3, 9.0, 11.3]\n[[spacecraft.joint]]\nname = \"hinge\"\n"
        "kind = \"revolute\"\nfrom = \"hub\"\nto = \"panel\"\npoint_from_body_m = [0, 0.6, 0]\n"
        "point_to_body_m = [0, -1.5, 0]\naxis_body = [1, 0, 0]\n[[spacecraft.torque]]\n"
        "model = \"commanded\"\nname = \"jets\"\nmax_torque_n_m = [1, 1, 1]\nbody = \"" +
            body + "\"\n",
        "scene.toml");
  };
  EXPECT_EQ(bridge::ros2_target(linked("hub").spacecraft.front()).body_actuator, "jets");
  EXPECT_EQ(bridge::ros2_target(linked("panel").spacecraft.front()).body_actuator, "")
      << "a torque in the frame of the panel is not one in that of the spacecraft";
}

class Ros2Wish : public ::testing::Test {
 protected:
  /// What is asked of it, or why that cannot be.
  std::string answer(std::string frame, std::array<double, 3> force = {}) {
    ros2::WrenchStamped wrench{};
    wrench.header.frame_id = frame.data();
    wrench.wrench.force = {force[0], force[1], force[2]};
    const bridge::Ros2Wish wish = bridge::wish_of(wrench, target_);
    return wish.actuator != nullptr ? "moves " + *wish.actuator : wish.objection;
  }

  bridge::Ros2Target target_ = bridge::ros2_target(scene_with_three().spacecraft.front());
};

TEST_F(Ros2Wish, goes_to_the_first_commanded_torque_of_its_frame) {
  EXPECT_EQ(answer("sat1/body"), "moves jets");
  EXPECT_EQ(answer("inertial"), "moves tugs");
}

TEST_F(Ros2Wish, is_refused_in_another_frame) {
  const std::string remedy = "; send \"sat1/body\" or \"inertial\"";
  EXPECT_EQ(answer("map"), "its frame_id is \"map\"" + remedy);
  EXPECT_EQ(answer(""), "its frame_id is \"\"" + remedy);
  EXPECT_EQ(answer("sat2/body"), "its frame_id is \"sat2/body\"" + remedy);
  EXPECT_EQ(answer("a\nb"), "its frame_id is \"a\\x0ab\"" + remedy) << "one line of a log";
  EXPECT_LT(answer(std::string(100'000, 'x')).size(), 200U);
}

TEST_F(Ros2Wish, is_refused_in_a_frame_that_nothing_moves_in) {
  target_.inertial_actuator.clear();
  EXPECT_EQ(
      answer("inertial"),
      "the spacecraft has no commanded torque in the frame \"inertial\"; see `adstar check`, or "
      "add one to the scene");
}

TEST_F(Ros2Wish, is_refused_with_a_force) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const std::string said = "it has a force, and nothing here moves by one; send force 0, 0, 0";
  EXPECT_EQ(answer("sat1/body", {0, 0, 1e-300}), said);
  EXPECT_EQ(answer("sat1/body", {kNan, 0, 0}), said);
  EXPECT_EQ(answer("sat1/body", {-0.0, 0, 0}), "moves jets");
}

}  // namespace
}  // namespace adstar
