#include "service/bridge/follower.hpp"

#include <algorithm>
#include <span>
#include <time.h>

#include <spdlog/spdlog.h>

#include "service/dds/convert.hpp"
#include "service/dds/rate_limit.hpp"
#include "service/run/checkpoint.hpp"
#include "service/run/files.hpp"
#include "service/run/run_directory.hpp"

namespace adstar::bridge {
namespace {

dds::Qos with_lease(dds::Qos qos, std::int64_t lease_ns) {
  qos.lease_ns = lease_ns;
  return qos;
}

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::size_t kMostWaiting = 65'536;

std::int64_t monotonic_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * kSecond + now.tv_nsec;
}

}  // namespace

Follower::Follower(const dds::Participant& participant, runtime::SharedSegment& segment,
                   const scene::Standby& standby, const Options& options)
    : segment_(segment),
      link_(segment.standby),
      options_(options),
      beats_(participant, with_lease(dds::kBeats, standby.lease_ns)),
      records_(participant),
      states_(participant),
      patience_ends_ns_(monotonic_ns() + std::max(kSecond, 3 * standby.lease_ns)) {}

bool Follower::is_primary(std::uint64_t high, std::uint64_t low) const noexcept {
  return primary_ && primary_->claim.instance == runtime::CommanderId{high, low};
}

bool Follower::primary_is_gone() {
  hear_beats();
  if (!primary_) {
    // A bridge that was started again may have missed the primary's end.
    return link_.following.load() != 0 && monotonic_ns() > patience_ends_ns_;
  }
  hear_records();
  hear_states();
  if (link_.following.load() == 0) {
    hand_over_state();
  } else {
    hand_over_records();
    if (link_.lost_track.load() == 0) {
      link_.primary_beat.write(primary_->beat);
    }
    runtime::wake_tick(segment_);
  }
  if (!primary_->gone) {
    return false;
  }
  if (link_.following.load() == 0) {
    spdlog::warn("the primary went before its state was here; waiting for another one");
    primary_.reset();
    return false;
  }
  return link_.lost_track.load() == 0 && waiting_.empty();
}

void Follower::hear_beats() {
  beats_.take(
      [&](const adstar_StandbyBeat& beat, const dds_sample_info_t&) {
        const Claim claim{beat.term, {beat.instance_high, beat.instance_low}};
        if (dds::text_of(beat.service) != options_.service || claim.instance == options_.instance) {
          return;
        }
        if (beat.layout != runtime::kLayout) {
          static dds::RateLimit limit(1);
          if (limit.admit()) {
            spdlog::error(
                "the primary of '{}' is of another build of adstar: it cannot be followed",
                options_.service);
          }
          return;
        }
        const bool known = primary_ && primary_->claim.instance == claim.instance;
        if (!known && primary_ && !primary_->gone && !goes_before(claim, primary_->claim)) {
          return;
        }
        if (!known) {
          spdlog::info("follows the primary of '{}' in term {}", options_.service, claim.term);
          parts_ = {};
          state_.reset();
          waiting_.clear();
        }
        link_.term.store(claim.term);
        primary_ = Primary{claim, {beat.step, beat.next_number, monotonic_ns(), 0}, beat.ended};
      },
      [&](const adstar_StandbyBeat& key, const dds_sample_info_t&) {
        if (is_primary(key.instance_high, key.instance_low)) {
          primary_->gone = true;
        }
      });
}

void Follower::hear_records() {
  const auto hear = [&](const adstar_StandbyRecord& sample, const dds_sample_info_t&) {
    if (is_primary(sample.instance_high, sample.instance_low)) {
      runtime::JournalRecord record{
          sample.number, sample.step, runtime::JournalKind::command, 0, {}};
      std::copy(std::begin(sample.payload), std::end(sample.payload), record.payload.begin());
      waiting_.push_back(record);
    }
  };
  while (records_.take(hear) > 0) {}
  // Before there is a state they only wait for one: the oldest are in the next checkpoint.
  while (link_.following.load() == 0 && waiting_.size() > kMostWaiting) {
    waiting_.pop_front();
  }
}

void Follower::hear_states() {
  const auto hear = [&](const adstar_StandbyState& sample, const dds_sample_info_t&) {
    if (!is_primary(sample.instance_high, sample.instance_low) || link_.following.load() != 0) {
      return;
    }
    auto whole = parts_.add(sample.checkpoint, sample.part, sample.parts,
                            {sample.bytes._buffer, sample.bytes._length});
    if (!whole) {
      return;
    }
    try {
      next_number_ = run::checkpoint_from(whole->bytes).next_number;
      state_ = std::move(whole);
    } catch (const run::RunError& error) {
      spdlog::error("the primary's state {}", error.what());
    }
  };
  while (states_.take(hear) > 0) {}
}

/// As soon as it and the records since go together without a gap.
void Follower::hand_over_state() {
  if (!state_ || link_.state_received.load() != 0) {
    return;
  }
  std::erase_if(waiting_, [&](const auto& record) { return record.number < next_number_; });
  const std::uint64_t first =
      waiting_.empty() ? primary_->beat.next_number : waiting_.front().number;
  if (first > next_number_) {
    return;  // the next checkpoint will do
  }
  run::replace_file(run::RunDirectory::received_path(options_.run), state_->bytes);
  link_.next_followed.store(next_number_);
  link_.state_received.store(1);
}

void Follower::hand_over_records() {
  std::uint64_t next = link_.next_followed.load();
  while (!waiting_.empty() && link_.lost_track.load() == 0) {
    const runtime::JournalRecord& record = waiting_.front();
    if (record.number > next) {
      spdlog::error("records {} to {} of the primary are missing: what follows cannot be trusted",
                    next, record.number - 1);
      link_.lost_track.store(1);
      return;
    }
    if (record.number == next) {
      if (!link_.followed.push(record)) {
        break;  // the tick has a backlog; next round
      }
      link_.next_followed.store(++next);
    }
    waiting_.pop_front();
  }
}

}  // namespace adstar::bridge
