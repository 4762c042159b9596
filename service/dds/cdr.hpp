#pragma once
// Samples out of their CDR bytes, without a bus: for what was recorded. The bytes may come from
// anywhere: they are checked against the type before anything is read.

#include <cstddef>
#include <span>
#include <vector>

#include <dds/dds.h>

#include "service/dds/topics.hpp"

namespace adstar::dds {

/// Into a zeroed sample of that type; false when they are none of its samples. Afterwards, and only when
/// it was true, free_sample() must be called.
bool read_sample(const dds_topic_descriptor_t& descriptor, std::span<const std::byte> payload,
                 void* sample);
void free_sample(const dds_topic_descriptor_t& descriptor, void* sample) noexcept;

/// Calls use(const T&); false when the bytes are no T.
template <class T, class Use>
bool with_sample(std::span<const std::byte> payload, Use&& use) {
  const dds_topic_descriptor_t& descriptor = *topic_of<T>().descriptor;
  T sample{};
  if (!read_sample(descriptor, payload, &sample)) {
    return false;
  }
  struct Freed {
    const dds_topic_descriptor_t& descriptor;
    T& sample;
    ~Freed() { free_sample(descriptor, &sample); }
  } const freed{descriptor, sample};
  use(static_cast<const T&>(sample));
  return true;
}

}  // namespace adstar::dds
