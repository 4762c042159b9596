// [ros2]: off unless enabled, and what cannot be a topic of ROS 2 is refused.
#include <gtest/gtest.h>

#include "scene_text.hpp"
#include "tests/support/text.hpp"

namespace adstar::scene {
namespace {

std::string with_ros2(const std::string& keys) { return in_section("ros2", keys); }

std::string named(const std::string& name, const std::string& more = "") {
  return testing::replaced(with_ros2("enabled = true\n" + more), "sat1", name);
}

TEST(SceneRos2, is_off_unless_enabled) {
  EXPECT_FALSE(parse(in_spacecraft(""), "scene.toml").ros2.has_value());
  EXPECT_FALSE(parse(with_ros2(""), "scene.toml").ros2.has_value());
  EXPECT_FALSE(parse(with_ros2("enabled = false\ntorque_validity = \"1s\""), "scene.toml").ros2);
  EXPECT_TRUE(parse(with_ros2("enabled = true"), "scene.toml").ros2.has_value());
}

TEST(SceneRos2, says_how_long_a_torque_holds_and_what_is_published) {
  const auto standard = parse(with_ros2("enabled = true"), "scene.toml").ros2;
  EXPECT_EQ(standard->torque_validity_ns, 500'000'000);
  EXPECT_TRUE(standard->clock);
  EXPECT_TRUE(standard->tf);
  const auto ros2 =
      parse(with_ros2("enabled = true\ntorque_validity = \"33ms\"\nclock = false\ntf = false"),
            "scene.toml")
          .ros2;
  EXPECT_EQ(ros2->torque_validity_ns, 33'000'000);
  EXPECT_FALSE(ros2->clock);
  EXPECT_FALSE(ros2->tf);
  EXPECT_FALSE(parse(with_ros2("enabled = true\ntorque_validity = \"off\""), "scene.toml")
                   .ros2->torque_validity_ns.has_value());
  EXPECT_NE(refusal(with_ros2("enabled = true\ntorque_validity = \"Off\""))
                .find("torque_validity: got \"Off\", expected a duration above zero in whole "
                      "nanoseconds (units ns, us, ms, s, min, h, d), or \"off\"; try \"500ms\""),
            std::string::npos);
}

TEST(SceneRos2, refuses_a_name_that_no_topic_may_have) {
  EXPECT_EQ(
      refusal(named("sat-1.a")),
      "scene.toml:7:11: ros2.enabled: got true, with a spacecraft \"sat-1.a\", expected names "
      "out of A-Z a-z 0-9 _ that begin with no digit and have no __: topics of ROS 2 allow no "
      "others; try the name \"sat_1_a\", or a [telemetry] spacecraft without it");
  EXPECT_NE(refusal(named("7")).find("try the name \"sat7\""), std::string::npos);
  EXPECT_NE(refusal(named("a--b__c")).find("try the name \"a_b_c\""), std::string::npos);
  EXPECT_EQ(refusal(named("_Sat_7")), "");
  EXPECT_EQ(refusal(testing::replaced(named("sat-1"), "enabled = true", "enabled = false")), "");
}

TEST(SceneRos2, asks_nothing_of_spacecraft_without_topics) {
  EXPECT_EQ(refusal(named("sat-1", "[telemetry]\nspacecraft = []\n")), "");
  const std::string fleet = testing::replaced(named("f-{:03}"), "inertia", "count = 100\ninertia");
  EXPECT_NE(refusal(fleet).find("\"f-000\" (and 63 others like it)"), std::string::npos)
      << refusal(fleet);
}

TEST(SceneRos2, refuses_a_partition_where_no_node_of_ros_2_is) {
  EXPECT_EQ(
      refusal(named("sat1", "[dds]\npartition = \"mine\"\n")),
      "scene.toml:7:11: ros2.enabled: got true, beside partition = \"mine\", expected the default "
      "partition, the only one where ROS 2 nodes are; try no partition in [dds]; another domain "
      "keeps runs apart too");
}

}  // namespace
}  // namespace adstar::scene
