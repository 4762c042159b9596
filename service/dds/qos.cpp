#include "service/dds/qos.hpp"

#include <new>

namespace adstar::dds {
namespace {

QosHandle empty_qos() {
  QosHandle qos(dds_create_qos(), &dds_delete_qos);
  if (!qos) {
    throw std::bad_alloc();
  }
  return qos;
}

}  // namespace

QosHandle make_qos(const Qos& qos) {
  QosHandle made = empty_qos();
  dds_qset_reliability(made.get(),
                       qos.reliability == Reliability::reliable ? DDS_RELIABILITY_RELIABLE
                                                                : DDS_RELIABILITY_BEST_EFFORT,
                       0);
  dds_qset_durability(made.get(), qos.durability == Durability::transient_local
                                      ? DDS_DURABILITY_TRANSIENT_LOCAL
                                      : DDS_DURABILITY_VOLATILE);
  dds_qset_history(made.get(), DDS_HISTORY_KEEP_LAST, qos.depth);
  dds_qset_resource_limits(made.get(), qos.limit, qos.limit, DDS_LENGTH_UNLIMITED);
  if (qos.durability == Durability::transient_local) {
    dds_qset_durability_service(made.get(), 0, DDS_HISTORY_KEEP_LAST, qos.late_depth,
                                DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
  }
  // Nodes of ROS 2 since Iron look here for a hash of the type, and warn of each endpoint that has no user data at all
  // (rmw_dds_common, pull request 74); without the key "typehash" they are content.
  dds_qset_userdata(made.get(), ";", 1);
  // Shared ownership, and automatic liveliness but between daemons: every other setting silently fails
  // to match a default peer.
  dds_qset_ownership(made.get(), DDS_OWNERSHIP_SHARED);
  if (qos.lease_ns > 0) {
    dds_qset_liveliness(made.get(), DDS_LIVELINESS_MANUAL_BY_TOPIC, qos.lease_ns);
  } else {
    dds_qset_liveliness(made.get(), DDS_LIVELINESS_AUTOMATIC, DDS_INFINITY);
  }
  return made;
}

QosHandle make_partition_qos(const char* partition) {
  QosHandle made = empty_qos();
  if (partition != nullptr && *partition != '\0') {
    dds_qset_partition1(made.get(), partition);
  }
  return made;
}

}  // namespace adstar::dds
