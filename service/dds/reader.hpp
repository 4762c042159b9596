#pragma once
// Typed reader of one topic; name and QoS come from topics.hpp, or from who has topics of its own.
// Samples are lent for the length of a callback.

#include <array>
#include <cstddef>
#include <cstdint>

#include <dds/dds.h>

#include "service/dds/entity.hpp"
#include "service/dds/participant.hpp"
#include "service/dds/qos.hpp"
#include "service/dds/topics.hpp"
#include "service/dds/writer.hpp"

namespace adstar::dds {

template <class T>
class Reader {
 public:
  /// Most samples that one take() hands out.
  static constexpr std::size_t kBatch = 64;

  explicit Reader(const Participant& participant) : Reader(participant, topic_of<T>().reader) {}

  /// With a QoS of the scene's instead of the topic's.
  Reader(const Participant& participant, const Qos& qos)
      : Reader(participant, *topic_of<T>().descriptor, topic_of<T>().name, qos) {}

  Reader(const Participant& participant, const dds_topic_descriptor_t& descriptor, const char* name,
         const Qos& qos)
      : topic_(make_topic(participant, descriptor, name)),
        reader_(dds_create_reader(participant.subscriber(), topic_.handle(), make_qos(qos).get(),
                                  nullptr),
                "dds_create_reader", topic_.subject()) {}

  /// Calls on_sample(const T&, const dds_sample_info_t&) for each sample with data, and
  /// on_gone(const T& key, const dds_sample_info_t&) when a key was disposed or lost its last
  /// writer (only the key fields are set). Returns how many were taken; 0: there was nothing. Never
  /// waits.
  template <class OnSample, class OnGone>
  std::size_t take(OnSample&& on_sample, OnGone&& on_gone) {
    Loan loan{reader_, {}, 0};
    std::array<dds_sample_info_t, kBatch> infos;
    loan.count =
        check(dds_take(reader_.handle(), loan.samples.data(), infos.data(), kBatch, kBatch),
              "dds_take", reader_.subject());
    const auto count = static_cast<std::size_t>(loan.count);
    for (std::size_t i = 0; i < count; ++i) {
      const T& sample = *static_cast<const T*>(loan.samples[i]);
      if (infos[i].valid_data) {
        on_sample(sample, infos[i]);
      }
      // Samples that nobody took yet carry the end of their key themselves: the last of them
      // counts.
      if (infos[i].instance_state != DDS_IST_ALIVE && infos[i].sample_rank == 0) {
        on_gone(sample, infos[i]);
      }
    }
    return count;
  }

  template <class OnSample>
  std::size_t take(OnSample&& on_sample) {
    return take(on_sample, [](const T&, const dds_sample_info_t&) {});
  }

  /// Writers that match now.
  std::uint32_t matched() const {
    dds_subscription_matched_status_t status{};
    check(dds_get_subscription_matched_status(reader_.handle(), &status),
          "dds_get_subscription_matched_status", reader_.subject());
    return status.current_count;
  }

  dds_entity_t handle() const noexcept { return reader_.handle(); }

 private:
  struct Loan {
    const Entity& reader;
    std::array<void*, kBatch> samples;
    dds_return_t count;
    ~Loan() {
      if (count > 0) {
        check_quietly(dds_return_loan(reader.handle(), samples.data(), count), "dds_return_loan",
                      reader.subject());
      }
    }
  };

  Entity topic_;
  Entity reader_;
};

}  // namespace adstar::dds
