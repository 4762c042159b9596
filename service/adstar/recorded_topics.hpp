#pragma once
// Every topic as a recorder sees it: how to read it off the bus, and what it is called in a
// recording. ROS 2 spells adstar::AttitudeState on adstar/attitude_state as adstar/msg/AttitudeState on
// /adstar/attitude_state; the bytes are the same.

#include <string>
#include <vector>

#include <dds/dds.h>

#include "service/bag/metadata.hpp"
#include "service/dds/qos.hpp"
#include "service/dds/topics.hpp"

namespace adstar::cli {

struct RecordedTopic {
  const dds_topic_descriptor_t* descriptor;
  std::string name;  ///< on the bus: "adstar/attitude_state"
  dds::Qos reader;
  bag::TopicInfo info;
};

/// In the order of topics.hpp.
std::vector<RecordedTopic> recorded_topics();

/// "/adstar/attitude_state"
template <class T>
std::string recorded_name() {
  return std::string("/") + dds::topic_of<T>().name;
}

}  // namespace adstar::cli
