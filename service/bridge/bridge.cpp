#include "service/bridge/bridge.hpp"

#include <chrono>
#include <cstring>
#include <string_view>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "service/bridge/command_intake.hpp"
#include "service/bridge/directory.hpp"
#include "service/bridge/other_services.hpp"
#include "service/bridge/process.hpp"
#include "service/bridge/publisher.hpp"
#include "service/bridge/roster.hpp"
#include "service/bridge/status_writer.hpp"
#include "service/dds/rate_limit.hpp"

namespace adstar::bridge {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

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
           const CommandIntake& intake, const scene::Dds& dds) {
  auto next_chore = Clock::now();
  auto drained_by = Clock::time_point::max();
  while (true) {
    const std::uint32_t seen = segment.wake_count.load();
    segment.bridge_rounds.fetch_add(1);
    // Read before the rings: adstard asks to stop only after its last push.
    const bool last_round = stopping(segment);
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
      answers.forget_silent(kCommanderSilence, now);
    }
    if (left != Publisher::Left::more) {
      runtime::sleep_until_woken(segment, seen, left == Publisher::Left::fleet ? 1 : 50);
    }
  }
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
  write_roster(roster, scene, options);
  OtherServices others(participant, directory, options);
  if (const auto rival = meet_others(others, *segment, reattached)) {
    const std::string message = conflict_message(*rival, scene.dds);
    spdlog::error("{}", message);
    refuse(*segment, message);
    return kRefused;
  }

  AnswerWriters answers(participant);
  Publisher publisher(participant, segment, scene, directory, options, answers);
  // What waited while nobody read is stale; verdicts are answers still owed.
  if (const std::size_t stale = segment->telemetry.size(); reattached && stale > 0) {
    spdlog::warn("{} telemetry samples lost: they waited while there was no bridge", stale);
  }
  segment->telemetry.skip_all();
  {
    const CommandIntake intake(participant, *segment, directory, others, answers.commands,
                               options.service);
    const std::size_t sockets = participant.bind_sockets_to_interface();
    segment->snapshot_requested.store(1);
    set_state(*segment, runtime::BridgeState::ready);
    spdlog::info(
        "service '{}' on interface {} domain {} partition '{}', {} spacecraft, {} sockets, {}",
        options.service, scene.dds.interface, scene.dds.domain, scene.dds.partition,
        directory.size(), sockets,
        scene.dds.security ? "secured" : "open to whoever reaches the interface");
    carry(participant, *segment, publisher, others, answers, intake, scene.dds);
    intake.check();
    const PublishedCounts& counts = publisher.counts();
    spdlog::info(
        "stopped: {} commands handed over, {} refused here, {} too old, {} lost; {} verdicts, {} "
        "telemetry "
        "records, {} fleet chunks published, {} samples unsent",
        intake.handed_over(), intake.refused(), intake.stale(), segment->commands_lost.load(),
        counts.verdicts, counts.telemetry, counts.fleet_chunks, counts.unsent);
  }
  if (!publisher.wait_for_readers(kLastAcks)) {
    spdlog::warn("not every reader acknowledged the last samples in {} ms", kLastAcks.count());
  }
  return kDone;
}

}  // namespace adstar::bridge
