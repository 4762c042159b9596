#include "service/dds/raw_reader.hpp"

#include <array>

#include <dds/ddsi/ddsi_serdata.h>
#include <fmt/format.h>

namespace adstar::dds {
namespace {

constexpr std::uint32_t kBatch = 64;

/// Gives back what dds_takecdr lent.
struct Loan {
  std::array<ddsi_serdata*, kBatch> samples{};
  ~Loan() {
    for (ddsi_serdata* const sample : samples) {
      if (sample != nullptr) {
        ddsi_serdata_unref(sample);
      }
    }
  }
};

}  // namespace

RawReader::RawReader(const Participant& participant, const dds_topic_descriptor_t& descriptor,
                     const char* name, const Qos& qos)
    : topic_(dds_create_topic(participant.handle(), &descriptor, name, nullptr, nullptr),
             "dds_create_topic", fmt::format("topic '{}'", name)),
      reader_(dds_create_reader(participant.subscriber(), topic_.handle(), make_qos(qos).get(),
                                nullptr),
              "dds_create_reader", topic_.subject()) {}

std::size_t RawReader::take(const OnSample& on_sample) {
  Loan loan;
  std::array<dds_sample_info_t, kBatch> infos;
  const auto count = static_cast<std::size_t>(
      check(dds_takecdr(reader_.handle(), loan.samples.data(), kBatch, infos.data(), DDS_ANY_STATE),
            "dds_takecdr", reader_.subject()));
  for (std::size_t i = 0; i < count; ++i) {
    if (infos[i].valid_data) {
      ddsrt_iovec_t block{};
      const std::uint32_t size = ddsi_serdata_size(loan.samples[i]);
      ddsi_serdata* const lent = ddsi_serdata_to_ser_ref(loan.samples[i], 0, size, &block);
      on_sample({static_cast<const std::byte*>(block.iov_base), size}, infos[i]);
      ddsi_serdata_to_ser_unref(lent, &block);
    }
  }
  return count;
}

std::uint64_t RawReader::lost() const {
  dds_sample_lost_status_t status{};
  check(dds_get_sample_lost_status(reader_.handle(), &status), "dds_get_sample_lost_status",
        reader_.subject());
  return status.total_count;
}

}  // namespace adstar::dds
