#pragma once
// Typed writer of one topic; name and QoS come from topics.hpp, or from who has topics of its own. Its
// calls may be made from several threads.

#include <chrono>
#include <cstdint>
#include <string>

#include <dds/dds.h>

#include "service/dds/entity.hpp"
#include "service/dds/participant.hpp"
#include "service/dds/qos.hpp"
#include "service/dds/topics.hpp"

namespace adstar::dds {

/// Error messages call it "topic 'name'".
inline Entity make_topic(const Participant& participant, const dds_topic_descriptor_t& descriptor,
                         const char* name) {
  return {dds_create_topic(participant.handle(), &descriptor, name, nullptr, nullptr),
          "dds_create_topic", std::string("topic '") + name + "'"};
}

template <class T>
class Writer {
 public:
  explicit Writer(const Participant& participant) : Writer(participant, topic_of<T>().writer) {}

  /// With a QoS of the scene's instead of the topic's.
  Writer(const Participant& participant, const Qos& qos)
      : Writer(participant, *topic_of<T>().descriptor, topic_of<T>().name, qos) {}

  Writer(const Participant& participant, const dds_topic_descriptor_t& descriptor, const char* name,
         const Qos& qos)
      : topic_(make_topic(participant, descriptor, name)),
        writer_(dds_create_writer(participant.publisher(), topic_.handle(), make_qos(qos).get(),
                                  nullptr),
                "dds_create_writer", topic_.subject()) {}

  /// False when Cyclone's send window is full: the sample is lost, nobody waited. Throws Error on
  /// anything else.
  bool write(const T& sample) {
    const dds_return_t code = dds_write(writer_.handle(), &sample);
    if (code == DDS_RETCODE_TIMEOUT) {
      return false;
    }
    check(code, "dds_write", writer_.subject());
    return true;
  }

  /// Makes the first write of this key as cheap as the later ones.
  void register_instance(const T& key) {
    dds_instance_handle_t instance = 0;
    check(dds_register_instance(writer_.handle(), &instance, &key), "dds_register_instance",
          writer_.subject());
  }

  /// Tells readers that this key is over, and forgets it.
  void unregister_instance(const T& key) {
    check(dds_unregister_instance(writer_.handle(), &key), "dds_unregister_instance",
          writer_.subject());
  }

  /// False when some reliable reader has not acknowledged in time.
  bool wait_for_acks(std::chrono::nanoseconds timeout) {
    const dds_return_t code = dds_wait_for_acks(writer_.handle(), timeout.count());
    if (code == DDS_RETCODE_TIMEOUT) {
      return false;
    }
    check(code, "dds_wait_for_acks", writer_.subject());
    return true;
  }

  /// Readers that match now.
  std::uint32_t matched() const {
    dds_publication_matched_status_t status{};
    check(dds_get_publication_matched_status(writer_.handle(), &status),
          "dds_get_publication_matched_status", writer_.subject());
    return status.current_count;
  }

  dds_entity_t handle() const noexcept { return writer_.handle(); }

 private:
  Entity topic_;
  Entity writer_;
};

}  // namespace adstar::dds
