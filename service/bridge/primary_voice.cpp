#include "service/bridge/primary_voice.hpp"

#include <algorithm>

#include <spdlog/spdlog.h>

#include "service/dds/convert.hpp"
#include "service/dds/rate_limit.hpp"

namespace adstar::bridge {
namespace {

constexpr std::size_t kPartBytes = 32'768;

adstar_StandbyRecord to_sample(const runtime::JournalRecord& record, const Options& options) {
  adstar_StandbyRecord sample{
      options.instance.high, options.instance.low, record.number, record.step, {}};
  static_assert(sizeof sample.payload == sizeof record.payload);
  std::copy(record.payload.begin(), record.payload.end(), sample.payload);
  return sample;
}

}  // namespace

PrimaryVoice::PrimaryVoice(const dds::Participant& participant, runtime::SharedSegment& segment,
                           const scene::Standby& standby, const Options& options)
    : link_(segment.standby),
      options_(options),
      records_(participant),
      beats_(participant, dds::with_lease(dds::kBeats, standby.lease_ns)),
      states_(participant),
      others_(participant, dds::with_lease(dds::kBeats, standby.lease_ns)),
      checkpoints_(options.run) {}

void PrimaryVoice::speak() {
  static dds::RateLimit limit(1);
  while (const auto record = link_.relayed.pop()) {
    if (!records_.write(to_sample(*record, options_)) && limit.admit()) {
      spdlog::warn("a command could not be relayed: a standby, if there is one, has lost track");
    }
  }
  runtime::StandbyBeatRecord beat;
  const std::uint64_t count = link_.beat.read(beat);
  if (count == 0 || count == beats_seen_) {
    return;
  }
  beats_seen_ = count;
  adstar_StandbyBeat sample{};
  sample.instance_high = options_.instance.high;
  sample.instance_low = options_.instance.low;
  dds::set_text(sample.service, options_.service);
  sample.layout = runtime::kLayout;
  sample.term = link_.term.load();
  sample.step = beat.step;
  sample.next_number = beat.next_number;
  sample.ended = beat.ended != 0;
  beats_.write(sample);
}

void PrimaryVoice::look_around() {
  if (const auto checkpoint = checkpoints_.newer()) {
    const std::size_t parts = (checkpoint->bytes.size() + kPartBytes - 1) / kPartBytes;
    for (std::size_t part = 0; part < parts; ++part) {
      const std::size_t first = part * kPartBytes;
      const std::size_t length = std::min(kPartBytes, checkpoint->bytes.size() - first);
      adstar_StandbyState sample{};
      sample.instance_high = options_.instance.high;
      sample.instance_low = options_.instance.low;
      sample.part = static_cast<std::uint32_t>(part);
      sample.parts = static_cast<std::uint32_t>(parts);
      sample.checkpoint = checkpoint->number;
      sample.bytes._length = sample.bytes._maximum = static_cast<std::uint32_t>(length);
      // Cyclone only reads what is lent to it.
      sample.bytes._buffer =
          reinterpret_cast<std::uint8_t*>(const_cast<std::byte*>(checkpoint->bytes.data() + first));
      states_.write(sample);
    }
  }
  const Claim own{link_.term.load(), options_.instance};
  others_.take([&](const adstar_StandbyBeat& beat, const dds_sample_info_t&) {
    const Claim claim{beat.term, {beat.instance_high, beat.instance_low}};
    if (dds::text_of(beat.service) == options_.service && claim.instance != own.instance &&
        !beat.ended && goes_before(claim, own)) {
      link_.outranked_by.store(beat.term);
    }
  });
}

bool PrimaryVoice::wait_for_readers(std::chrono::nanoseconds timeout) {
  const bool records = records_.wait_for_acks(timeout);
  return beats_.wait_for_acks(timeout) && records;
}

}  // namespace adstar::bridge
