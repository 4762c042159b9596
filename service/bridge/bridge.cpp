#include "service/bridge/bridge.hpp"

#include <chrono>
#include <cstring>
#include <deque>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "service/bridge/command_intake.hpp"
#include "service/bridge/directory.hpp"
#include "service/bridge/follower.hpp"
#include "service/bridge/other_services.hpp"
#include "service/bridge/primary_voice.hpp"
#include "service/bridge/process.hpp"
#include "service/bridge/publisher.hpp"
#include "service/bridge/roster.hpp"
#include "service/bridge/status_writer.hpp"
#include "service/dds/rate_limit.hpp"

namespace adstar::bridge {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr std::string_view kStandbySuffix = ".standby";
constexpr auto kMeetOthers = 500ms;
// A bridge that was ready before was past the question who came first: only learn the rosters.
constexpr auto kMeetOthersAgain = 50ms;
constexpr auto kCommanderSilence = 60s;
constexpr auto kLastAcks = 500ms;
// Rings are bounded, but adstard may still push while we empty them.
constexpr auto kLastDrain = 2s;

bool stopping(const runtime::SharedSegment& segment) {
  return segment.stop_requested.load() != 0 || end_requested();
}

void set_state(runtime::SharedSegment& segment, runtime::BridgeState state) {
  segment.bridge_state.store(static_cast<std::uint32_t>(state));
}

std::string conflict_message(const Rival& rival, const scene::Dds& dds) {
  return fmt::format(
      "spacecraft '{}' is already flown by service '{}' on domain {}; stop it, or choose another "
      "partition or name",
      rival.spacecraft, rival.service, dds.domain);
}

// An older rival ends it; a younger one will refuse itself.
std::optional<Rival> meet_others(OtherServices& others, runtime::SharedSegment& segment,
                                 bool reattached) {
  const auto until = Clock::now() + (reattached ? kMeetOthersAgain : kMeetOthers);
  while (Clock::now() < until && !stopping(segment)) {
    const auto rival = others.poll();
    if (rival && rival->older && !reattached) {
      return rival;
    }
    runtime::sleep_until_woken(segment, segment.wake_count.load(), 5);
  }
  return std::nullopt;
}

void warn_of_rival(const std::optional<Rival>& rival, const scene::Dds& dds) {
  static dds::RateLimit limit(1);
  if (rival && limit.admit()) {
    spdlog::warn(
        "service '{}' claims spacecraft '{}' too, on domain {}: its telemetry mixes with ours; "
        "stop one "
        "of the two, or choose another partition or name",
        rival->service, rival->spacecraft, dds.domain);
  }
}

/// Commands in what the kernel dropped are nobody's to count, but that something was lost is.
void warn_of_drops(const dds::Participant& participant) {
  static std::uint64_t told = 0;
  const std::uint64_t dropped = participant.datagrams_dropped();
  static dds::RateLimit limit(1);
  if (dropped > told && limit.admit()) {
    spdlog::warn(
        "{} datagrams lost before they were read: more came than the bridge can take; commanders "
        "repeat theirs until they are answered",
        dropped - told);
    told = dropped;
  }
}

void carry(const dds::Participant& participant, runtime::SharedSegment& segment,
           Publisher& publisher, OtherServices& others, AnswerWriters& answers,
           const CommandIntake& intake, std::optional<PrimaryVoice>& voice, const scene::Dds& dds) {
  auto next_chore = Clock::now();
  auto drained_by = Clock::time_point::max();
  while (true) {
    const std::uint32_t seen = segment.wake_count.load();
    segment.bridge_rounds.fetch_add(1);
    // Read before the rings: adstard asks to stop only after its last push.
    const bool last_round = stopping(segment);
    if (voice) {
      voice->speak();
    }
    const Publisher::Left left = publisher.publish_some();
    const auto now = Clock::now();
    if (last_round) {
      drained_by = std::min(drained_by, now + kLastDrain);
      if (left == Publisher::Left::nothing || now > drained_by) {
        return;
      }
    }
    if (now >= next_chore) {
      next_chore = now + 100ms;
      intake.check();
      warn_of_rival(others.poll(), dds);
      warn_of_drops(participant);
      if (voice) {
        voice->look_around();
      }
      answers.forget_silent(kCommanderSilence, now);
    }
    if (left != Publisher::Left::more) {
      runtime::sleep_until_woken(segment, seen, left == Publisher::Left::fleet ? 1 : 50);
    }
  }
}

/// The verdicts of the last two seconds of simulation time: a primary that is gone may not have said them.
void keep_verdicts(runtime::SharedSegment& segment, std::deque<runtime::VerdictRecord>& kept) {
  constexpr std::int64_t kYoung_ns = 2'000'000'000;
  constexpr std::size_t kMost = 4096;
  while (const auto verdict = segment.verdicts.pop()) {
    kept.push_back(*verdict);
  }
  while (kept.size() > kMost ||
         (!kept.empty() && kept.back().time_ns - kept.front().time_ns > kYoung_ns)) {
    kept.pop_front();
  }
}

/// Mute but for its status, until the primary is gone. False when it is to end before.
bool stand_by(runtime::SharedSegment& segment, Publisher& publisher, Follower& follower) {
  std::deque<runtime::VerdictRecord> kept;
  while (!stopping(segment)) {
    const std::uint32_t seen = segment.wake_count.load();
    segment.bridge_rounds.fetch_add(1);
    const bool gone = follower.primary_is_gone();
    keep_verdicts(segment, kept);
    publisher.publish_health();
    if (gone) {
      segment.standby.term.fetch_add(1);
      segment.standby.take_over.store(1);
      runtime::wake_tick(segment);
      for (const runtime::VerdictRecord& verdict : kept) {
        publisher.say(verdict);
      }
      return true;
    }
    runtime::sleep_until_woken(segment, seen, 1);
  }
  return false;
}

}  // namespace

void refuse(runtime::SharedSegment& segment, const std::string& message) {
  constexpr std::size_t kRoom = sizeof segment.bridge_message;
  const std::size_t length = std::min(message.size(), kRoom - 1);
  std::memcpy(segment.bridge_message, message.data(), length);
  std::memset(segment.bridge_message + length, 0, kRoom - length);
  set_state(segment, runtime::BridgeState::refused);
}

int run(const Options& options, const scene::Scene& scene, runtime::MappedSegment& segment) {
  const auto ready = static_cast<std::uint32_t>(runtime::BridgeState::ready);
  const bool reattached = segment->bridge_state.load() == ready;
  if (!reattached) {
    set_state(*segment, runtime::BridgeState::starting);
  }
  dds::Participant participant(
      {scene.dds.domain, scene.dds.interface, scene.dds.partition, scene.dds.security});
  const Directory directory(scene);
  dds::Writer<adstar_ServiceRoster> roster(participant);
  const bool stands_by = options.standby && segment->standby.take_over.load() == 0;
  if (!stands_by) {
    write_roster(roster, scene, options);
  }
  OtherServices others(participant, directory, options);
  if (scene.standby && (reattached || stands_by)) {
    others.tolerate_namesakes();
  }
  if (const auto rival = stands_by ? std::nullopt : meet_others(others, *segment, reattached)) {
    const std::string message = conflict_message(*rival, scene.dds);
    spdlog::error("{}", message);
    refuse(*segment, message);
    return kRefused;
  }

  AnswerWriters answers(participant);
  Publisher publisher(participant, segment, scene, directory, options, answers);
  std::optional<PrimaryVoice> voice;
  if (scene.standby) {
    others.tolerate_namesakes();  // the terms settle who flies
    voice.emplace(participant, *segment, *scene.standby, options);
  }
  if (stands_by) {
    Follower follower(participant, *segment, *scene.standby, options);
    participant.bind_sockets_to_interface();
    publisher.rename(options.service.substr(0, 63 - kStandbySuffix.size()) +
                     std::string(kStandbySuffix));
    set_state(*segment, runtime::BridgeState::ready);
    if (!stand_by(*segment, publisher, follower)) {
      return kDone;
    }
    publisher.rename(options.service);
    write_roster(roster, scene, options);
  }
  // What waited while nobody read is stale; verdicts are answers still owed.
  if (!stands_by) {
    if (const std::size_t stale = segment->telemetry.size(); reattached && stale > 0) {
      spdlog::warn("{} telemetry samples lost: they waited while there was no bridge", stale);
    }
    segment->telemetry.skip_all();
  }
  {
    const CommandIntake intake(participant, *segment, scene, directory, others, answers.commands,
                               options.service);
    const std::size_t sockets = participant.bind_sockets_to_interface();
    segment->snapshot_requested.store(1);
    set_state(*segment, runtime::BridgeState::ready);
    spdlog::info(
        "service '{}' on interface {} domain {} partition '{}', {} spacecraft, {} sockets, {}",
        options.service, scene.dds.interface, scene.dds.domain, scene.dds.partition,
        directory.size(), sockets,
        scene.dds.security ? "secured" : "open to whoever reaches the interface");
    carry(participant, *segment, publisher, others, answers, intake, voice, scene.dds);
    intake.check();
    const PublishedCounts& counts = publisher.counts();
    spdlog::info(
        "stopped: {} commands handed over, {} refused here, {} too old, {} lost; {} verdicts, {} "
        "telemetry "
        "records, {} fleet chunks published, {} samples unsent",
        intake.handed_over(), segment->commands_refused.load(), intake.stale(),
        segment->commands_lost.load(), counts.verdicts, counts.telemetry, counts.fleet_chunks,
        counts.unsent);
  }
  if (voice) {
    voice->wait_for_readers(kLastAcks);
  }
  if (!publisher.wait_for_readers(kLastAcks)) {
    spdlog::warn("not every reader acknowledged the last samples in {} ms", kLastAcks.count());
  }
  return kDone;
}

}  // namespace adstar::bridge
