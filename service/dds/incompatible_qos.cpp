#include "service/dds/incompatible_qos.hpp"

#include <array>
#include <exception>
#include <new>

#include <spdlog/spdlog.h>

#include "service/dds/rate_limit.hpp"

namespace adstar::dds {
namespace {

void report(dds_entity_t entity, const char* ours, const char* theirs, std::uint32_t policy) {
  if (policy == DDS_PARTITION_QOS_POLICY_ID) {
    return;  // another partition is meant to be out of hearing
  }
  static RateLimit limit(5);
  try {
    const auto dropped = limit.admit();
    if (!dropped) {
      return;
    }
    std::array<char, 128> name{"?"};
    const dds_entity_t topic = dds_get_topic(entity);
    if (topic > 0) {
      dds_get_name(topic, name.data(), name.size());
    }
    spdlog::warn(
        "dds: a {} on topic '{}' does not match our {}: its QoS policy {} is incompatible; set "
        "that policy to the "
        "default, or to what service/pages/commands.md (of rt/...: ros2.md) says of the topic",
        theirs, name.data(), ours, policy_name(policy));
    if (*dropped > 0) {
      spdlog::warn("dds: {} more incompatible peers", *dropped);
    }
  } catch (const std::exception&) {
    // Called from C: nothing may pass through.
  }
}

void on_offered(dds_entity_t writer, dds_offered_incompatible_qos_status_t status,
                void* /*unused*/) {
  report(writer, "writer", "reader", status.last_policy_id);
}

void on_requested(dds_entity_t reader, dds_requested_incompatible_qos_status_t status,
                  void* /*unused*/) {
  report(reader, "reader", "writer", status.last_policy_id);
}

}  // namespace

ListenerHandle make_incompatible_qos_listener() {
  ListenerHandle listener(dds_create_listener(nullptr), &dds_delete_listener);
  if (!listener) {
    throw std::bad_alloc();
  }
  dds_lset_offered_incompatible_qos(listener.get(), &on_offered);
  dds_lset_requested_incompatible_qos(listener.get(), &on_requested);
  return listener;
}

const char* policy_name(std::uint32_t policy_id) noexcept {
  switch (policy_id) {
    case DDS_DURABILITY_QOS_POLICY_ID:
      return "DURABILITY";
    case DDS_PRESENTATION_QOS_POLICY_ID:
      return "PRESENTATION";
    case DDS_DEADLINE_QOS_POLICY_ID:
      return "DEADLINE";
    case DDS_LATENCYBUDGET_QOS_POLICY_ID:
      return "LATENCY_BUDGET";
    case DDS_OWNERSHIP_QOS_POLICY_ID:
      return "OWNERSHIP";
    case DDS_LIVELINESS_QOS_POLICY_ID:
      return "LIVELINESS";
    case DDS_PARTITION_QOS_POLICY_ID:
      return "PARTITION";
    case DDS_RELIABILITY_QOS_POLICY_ID:
      return "RELIABILITY";
    case DDS_DESTINATIONORDER_QOS_POLICY_ID:
      return "DESTINATION_ORDER";
    case DDS_TYPE_CONSISTENCY_ENFORCEMENT_QOS_POLICY_ID:
      return "TYPE_CONSISTENCY_ENFORCEMENT";
    case DDS_DATA_REPRESENTATION_QOS_POLICY_ID:
      return "DATA_REPRESENTATION";
    default:
      return "(of another kind)";
  }
}

}  // namespace adstar::dds
