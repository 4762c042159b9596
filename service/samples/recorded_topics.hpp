#pragma once
// Every topic as a recorder sees it: how to read it off the bus, and what it is called in a
// recording. ROS 2 spells adstar::AttitudeState on adstar/attitude_state as adstar/msg/AttitudeState on
// /adstar/attitude_state; the bytes are the same.

#include <cstdint>
#include <string>
#include <vector>

#include <dds/dds.h>

#include "service/bag/metadata.hpp"
#include "service/bag/recording.hpp"
#include "service/dds/cdr.hpp"
#include "service/dds/qos.hpp"
#include "service/dds/topics.hpp"

namespace adstar::samples {

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

/// Calls use(const T&, received_ns) for each sample of T, in order; returns how many could not be read.
template <class T, class Use>
std::uint64_t for_each_sample(const bag::Recording& recording, Use&& use) {
  std::uint64_t unreadable = 0;
  recording.for_each({recorded_name<T>()}, [&](const bag::Message& message) {
    const bool read = dds::with_sample<T>(
        message.payload, [&](const T& sample) { use(sample, message.received_ns); });
    unreadable += read ? 0 : 1;
  });
  return unreadable;
}

}  // namespace adstar::samples
