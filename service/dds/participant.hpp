#pragma once
// One DDS domain participant with its publisher and subscriber, confined to one network interface.
//
// The configuration is given in code: CYCLONEDDS_URI is not read. Every socket is made with the
// domain, bound to the interface before there is a participant to talk to, and checked again on
// demand.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <dds/dds.h>

#include "service/dds/device_binding.hpp"
#include "service/dds/entity.hpp"
#include "service/scene/security_files.hpp"

namespace adstar::dds {

struct ParticipantOptions {
  std::uint32_t domain = 0;
  std::string interface = "lo";
  std::string partition = {};                         ///< empty: the default partition
  std::optional<scene::SecurityFiles> security = {};  ///< none: unauthenticated
};

/// At most one per domain and process. Must outlive its readers, writers and wait sets.
class Participant {
 public:
  /// Throws Error: no such interface, a domain out of range, a socket that cannot be confined, no
  /// resources, security files that cannot be used or do not hold together.
  explicit Participant(ParticipantOptions options);
  ~Participant();
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;

  /// Binds what sockets were opened since, and verifies all; returns how many. Call once the
  /// entities are made.
  std::size_t bind_sockets_to_interface();

  /// Datagrams that came faster than Cyclone read them, since the beginning.
  std::uint64_t datagrams_dropped() const { return dds::datagrams_dropped(foreign_sockets_); }

  dds_entity_t handle() const noexcept { return participant_.handle(); }
  dds_entity_t publisher() const noexcept { return publisher_.handle(); }
  dds_entity_t subscriber() const noexcept { return subscriber_.handle(); }
  const ParticipantOptions& options() const noexcept { return options_; }

 private:
  // The library goes when the last participant of the process has gone: a security plugin that is
  // alive when main returns can crash the process.
  struct LibraryUse {
    LibraryUse();
    ~LibraryUse();
    LibraryUse(const LibraryUse&) = delete;
    LibraryUse& operator=(const LibraryUse&) = delete;
  };

  ParticipantOptions options_;
  std::vector<SocketId> foreign_sockets_;
  LibraryUse library_;
  Entity domain_;
  Entity participant_;
  Entity publisher_;
  Entity subscriber_;
};

}  // namespace adstar::dds
