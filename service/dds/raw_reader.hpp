#pragma once
// Reader of a topic as bytes: CDR with its encapsulation header, as Cyclone keeps what came over the wire.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include <dds/dds.h>

#include "service/dds/entity.hpp"
#include "service/dds/participant.hpp"
#include "service/dds/qos.hpp"

namespace adstar::dds {

class RawReader {
 public:
  RawReader(const Participant& participant, const dds_topic_descriptor_t& descriptor,
            const char* name, const Qos& qos);

  using OnSample = std::function<void(std::span<const std::byte>, const dds_sample_info_t&)>;
  /// Calls it for each sample with data; the bytes are lent. Returns how many were taken, 0: there
  /// was nothing. Never waits.
  std::size_t take(const OnSample& on_sample);

  /// Samples that Cyclone knows it has missed.
  std::uint64_t lost() const;

  dds_entity_t handle() const noexcept { return reader_.handle(); }

 private:
  Entity topic_;
  Entity reader_;
};

}  // namespace adstar::dds
