// A commander whose TorqueCommand knows no bounds: writes names of LENGTH characters, COUNT times,
// to whoever listens on loopback. Its type is made from idl/ with the bounds taken out, and does not
// describe itself: a reader would see that it does not fit.
//   wild_commander DOMAIN PARTITION LENGTH COUNT

#include <command.h>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include <dds/dds.h>

#include "service/dds/device_binding.hpp"

namespace {

constexpr const char* kLoopback =
    R"(<General><Interfaces><NetworkInterface name="lo" multicast="true"/></Interfaces></General>)";

dds_entity_t required(dds_entity_t entity, const char* what) {
  if (entity < 0) {
    std::fprintf(stderr, "wild_commander: %s: %s\n", what, dds_strretcode(entity));
    std::exit(1);
  }
  return entity;
}

dds_entity_t make_writer(dds_domainid_t domain, const char* partition) {
  required(dds_create_domain(domain, kLoopback), "domain");
  adstar::dds::bind_udp_sockets("lo", {});
  const dds_entity_t participant =
      required(dds_create_participant(domain, nullptr, nullptr), "participant");
  adstar::dds::bind_udp_sockets("lo", {});
  const dds_topic_descriptor_t& ours = adstar_TorqueCommand_desc;
  const dds_topic_descriptor_t type{
      .m_size = ours.m_size,
      .m_align = ours.m_align,
      .m_flagset = ours.m_flagset & ~static_cast<std::uint32_t>(DDS_TOPIC_XTYPES_METADATA),
      .m_nkeys = ours.m_nkeys,
      .m_typename = ours.m_typename,
      .m_keys = ours.m_keys,
      .m_nops = ours.m_nops,
      .m_ops = ours.m_ops,
      .m_meta = ours.m_meta,
      .type_information = {},
      .type_mapping = {},
      .restrict_data_representation = ours.restrict_data_representation};
  const dds_entity_t topic = required(
      dds_create_topic(participant, &type, "adstar/torque_command", nullptr, nullptr), "topic");
  dds_qos_t* const qos = dds_create_qos();
  dds_qset_partition1(qos, partition);
  const dds_entity_t publisher =
      required(dds_create_publisher(participant, qos, nullptr), "publisher");
  dds_delete_qos(qos);
  return required(dds_create_writer(publisher, topic, nullptr, nullptr), "writer");
}

bool is_heard(dds_entity_t writer) {
  for (int tries = 0; tries < 3000; ++tries) {
    dds_publication_matched_status_t status{};
    if (dds_get_publication_matched_status(writer, &status) == 0 && status.current_count > 0) {
      return true;
    }
    dds_sleepfor(DDS_MSECS(10));
  }
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) {
    std::fputs("usage: wild_commander DOMAIN PARTITION LENGTH COUNT\n", stderr);
    return 2;
  }
  const dds_entity_t writer =
      make_writer(static_cast<dds_domainid_t>(std::strtoul(argv[1], nullptr, 10)), argv[2]);
  if (!is_heard(writer)) {
    std::fputs("wild_commander: no reader matches\n", stderr);
    return 1;
  }
  std::string name(std::strtoul(argv[3], nullptr, 10), 'x');
  adstar_TorqueCommand command{};
  command.spacecraft = name.data();
  command.actuator = name.data();
  for (unsigned long count = std::strtoul(argv[4], nullptr, 10); count > 0; --count) {
    ++command.sequence_number;
    required(dds_write(writer, &command), "write");
  }
  dds_delete(DDS_CYCLONEDDS_HANDLE);
  return 0;
}
