#include "service/dds/participant.hpp"

#include <atomic>

#include <fmt/format.h>

#include "service/dds/incompatible_qos.hpp"
#include "service/dds/log_sink.hpp"
#include "service/dds/qos.hpp"
#include "service/dds/security.hpp"
#include "service/scene/dds_domain.hpp"

namespace adstar::dds {
namespace {

std::atomic<int> g_library_users{0};

// Sizes: one datagram carries 500 fleet members. Lease: a dead peer is forgotten after two seconds,
// not ten. 507 bytes of a datagram are left to the signatures of DDS Security.
std::string domain_configuration(const std::string& interface) {
  return fmt::format(
      R"(<General><Interfaces><NetworkInterface name="{}" {}/></Interfaces>)"
      "<MaxMessageSize>65000B</MaxMessageSize><FragmentSize>64000B</FragmentSize></General>"
      "<Discovery><LeaseDuration>2s</LeaseDuration></Discovery>"
      "<Internal><MultipleReceiveThreads>false</MultipleReceiveThreads></Internal>",
      interface, interface == "lo" ? R"(multicast="true")" : "");
}

dds_entity_t create_domain(const ParticipantOptions& options) {
  install_log_sink();
  require_interface(options.interface);
  return dds_create_domain(options.domain, domain_configuration(options.interface).c_str());
}

std::string domain_subject(const ParticipantOptions& options) {
  return fmt::format("domain {} on interface '{}'{}", options.domain, options.interface,
                     options.security ? fmt::format(" with identity '{}'",
                                                    options.security->identity_certificate.string())
                                      : "");
}

std::string new_domain_subject(const ParticipantOptions& options) {
  return domain_subject(options) +
         (options.domain > scene::kMostSafeDomain
              ? fmt::format(
                    " (above {} Linux hands its ports to any program: \"in use\" may be that)",
                    scene::kMostSafeDomain)
              : "");
}

}  // namespace

Participant::LibraryUse::LibraryUse() { ++g_library_users; }

Participant::LibraryUse::~LibraryUse() {
  if (--g_library_users == 0) {
    const dds_return_t code = dds_delete(DDS_CYCLONEDDS_HANDLE);
    // The library may have gone already with its last domain.
    if (code != DDS_RETCODE_PRECONDITION_NOT_MET && code != DDS_RETCODE_BAD_PARAMETER) {
      check_quietly(code, "dds_delete", "the DDS library");
    }
  }
}

Participant::Participant(ParticipantOptions options)
    : options_(std::move(options)),
      foreign_sockets_(open_udp_sockets()),
      domain_(create_domain(options_), "dds_create_domain", new_domain_subject(options_)) {
  bind_sockets_to_interface();
  const ListenerHandle listener = make_incompatible_qos_listener();
  const QosHandle security = options_.security ? make_security_qos(*options_.security)
                                               : QosHandle(nullptr, &dds_delete_qos);
  const dds_entity_t created =
      dds_create_participant(options_.domain, security.get(), listener.get());
  if (created < 0 && options_.security) {
    // Whatever the code: files that do not hold together, or are not valid now.
    throw ConfigurationError(describe(created, "dds_create_participant", domain_subject(options_)));
  }
  participant_ = Entity(created, "dds_create_participant", domain_subject(options_));
  const QosHandle partition = make_partition_qos(options_.partition.c_str());
  const std::string subject = fmt::format("partition '{}'", options_.partition);
  publisher_ = Entity(dds_create_publisher(handle(), partition.get(), nullptr),
                      "dds_create_publisher", subject);
  subscriber_ = Entity(dds_create_subscriber(handle(), partition.get(), nullptr),
                       "dds_create_subscriber", subject);
  bind_sockets_to_interface();
}

Participant::~Participant() = default;

std::size_t Participant::bind_sockets_to_interface() {
  const std::size_t bound = bind_udp_sockets(options_.interface, foreign_sockets_);
  if (bound == 0) {
    throw Error(
        fmt::format("Cyclone DDS opened no UDP socket on {}; see its lines above in the log",
                    domain_subject(options_)));
  }
  return bound;
}

}  // namespace adstar::dds
