#include "service/bridge/follower.hpp"

#include <algorithm>
#include <time.h>

#include <spdlog/spdlog.h>

#include "service/dds/convert.hpp"
#include "service/dds/rate_limit.hpp"
#include "service/run/checkpoint.hpp"
#include "service/run/run_directory.hpp"

namespace adstar::bridge {
namespace {

std::int64_t monotonic_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * 1'000'000'000 + now.tv_nsec;
}

template <class Sample>
runtime::CommanderId instance_of(const Sample& sample) {
  return {sample.instance_high, sample.instance_low};
}

}  // namespace

Follower::Follower(const dds::Participant& participant, runtime::SharedSegment& segment,
                   const scene::Standby& standby, const Options& options)
    : segment_(segment),
      options_(options),
      beats_(participant, dds::with_lease(dds::kBeats, standby.lease_ns)),
      records_(participant),
      states_(participant),
      pursuit_(segment.standby, standby, monotonic_ns()) {}

bool Follower::primary_is_gone() {
  hear_beats();
  if (pursuit_.follows_somebody()) {  // till then the reader keeps what came
    hear_records();
    hear_states();
  }
  if (const run::Bytes* const state = pursuit_.state_to_hand_over()) {
    run::replace_file(run::RunDirectory::received_path(options_.run), *state);
    pursuit_.state_is_handed_over();
  }
  const Pursuit::Verdict verdict = pursuit_.go_on(monotonic_ns());
  if (verdict == Pursuit::Verdict::lost_track && !said_lost_) {
    said_lost_ = true;
    spdlog::error("cannot follow any more: {}", pursuit_.why_lost());
  }
  runtime::wake_tick(segment_);
  return verdict == Pursuit::Verdict::take_over;
}

void Follower::hear_beats() {
  beats_.take([&](const adstar_StandbyBeat& beat, const dds_sample_info_t&) { hear(beat); },
              [&](const adstar_StandbyBeat& key, const dds_sample_info_t&) {
                pursuit_.hear_end(instance_of(key));
              });
}

void Follower::hear(const adstar_StandbyBeat& beat) {
  if (dds::text_of(beat.service) != options_.service || instance_of(beat) == options_.instance) {
    return;
  }
  if (beat.layout != runtime::kLayout) {
    static dds::RateLimit limit(1);
    if (limit.admit()) {
      spdlog::error("the primary of '{}' is of another build of adstar: it cannot be followed",
                    options_.service);
    }
    return;
  }
  if (pursuit_.hear_beat({beat.term, instance_of(beat)},
                         {beat.step, beat.next_number, monotonic_ns(), beat.ended ? 1U : 0U})) {
    spdlog::info("follows the primary of '{}' in term {}", options_.service, beat.term);
    parts_ = {};
  }
}

void Follower::hear_records() {
  const auto hear = [&](const adstar_StandbyRecord& sample, const dds_sample_info_t&) {
    runtime::JournalRecord record{sample.number, sample.step, runtime::JournalKind::command, 0, {}};
    std::copy(std::begin(sample.payload), std::end(sample.payload), record.payload.begin());
    pursuit_.hear_record(instance_of(sample), record);
  };
  while (records_.take(hear) > 0) {}
}

void Follower::hear_states() {
  const auto hear = [&](const adstar_StandbyState& sample, const dds_sample_info_t&) {
    if (!pursuit_.follows(instance_of(sample))) {
      return;
    }
    auto whole = parts_.add(sample.checkpoint, sample.part, sample.parts,
                            {sample.bytes._buffer, sample.bytes._length});
    if (!whole) {
      return;
    }
    try {
      const std::uint64_t next_number = run::checkpoint_from(*whole).next_number;
      pursuit_.hear_state(instance_of(sample), std::move(*whole), next_number);
    } catch (const run::RunError& error) {
      spdlog::error("the primary's state {}", error.what());
    }
  };
  while (states_.take(hear) > 0) {}
}

}  // namespace adstar::bridge
