#pragma once
// The few quality-of-service choices that our topics make, as a plain struct.

#include <cstdint>
#include <memory>

#include <dds/dds.h>

namespace adstar::dds {

enum class Reliability { best_effort, reliable };
enum class Durability { volatile_, transient_local };

struct Qos {
  Reliability reliability = Reliability::reliable;
  Durability durability = Durability::volatile_;
  std::int32_t depth = 1;  ///< KEEP_LAST
  /// Bound on instances and on samples altogether; only for best-effort readers, because a reliable
  /// reader that rejects a sample stalls the receive thread.
  std::int32_t limit = DDS_LENGTH_UNLIMITED;
  std::int32_t late_depth = 1;  ///< of what a late joiner gets
  /// Above 0: liveliness is asserted by writing alone, and lost after so long [ns].
  std::int64_t lease_ns = 0;
};

/// The same, with liveliness asserted by writing alone.
inline Qos with_lease(Qos qos, std::int64_t lease_ns) {
  qos.lease_ns = lease_ns;
  return qos;
}

using QosHandle = std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)>;

/// max_blocking_time is 0: no write ever waits.
QosHandle make_qos(const Qos& qos);

/// For publishers and subscribers; an empty partition is DDS's default one.
QosHandle make_partition_qos(const char* partition);

}  // namespace adstar::dds
