#pragma once
// What the gate remembers of each stream of commands - one commander on one actuator - so that a
// repeated sequence number gets the same answer and changes nothing.
//
// Fixed memory: a set-associative table made at start, two sets to choose from for each stream
// (Azar, Broder, Karlin, Upfal 1999; with one, a few of 10,000 actuators would find theirs full). A
// new stream takes the place of the one that was silent longest and has no command in force or
// waiting; the choice depends on the command stream alone.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "service/runtime/records.hpp"

namespace adstar::runtime {

struct Stream {
  static constexpr std::size_t kRemembered = 8;

  bool used = false;
  CommanderId commander;
  std::uint32_t actuator = 0;                         ///< the gate's number of it
  std::uint32_t live = 0;                             ///< commands in force or waiting
  std::uint64_t last_sequence = 0;                    ///< the highest heard
  std::uint64_t last_heard = 0;                       ///< count of commands when it last spoke
  std::array<VerdictRecord, kRemembered> verdicts{};  ///< the last final ones, in turn
  std::size_t next_verdict = 0;

  void remember(const VerdictRecord& verdict) noexcept {
    verdicts[next_verdict] = verdict;
    next_verdict = (next_verdict + 1) % kRemembered;
  }
  const VerdictRecord* recall(std::uint64_t sequence) const noexcept {
    for (const VerdictRecord& verdict : verdicts) {
      if (verdict.sequence == sequence && sequence != 0) {
        return &verdict;
      }
    }
    return nullptr;
  }
};

class CommandMemory {
 public:
  explicit CommandMemory(std::size_t actuators) {
    std::size_t sets = 512;
    while (sets * kWays < 2 * actuators) {
      sets *= 2;
    }
    streams_.resize(sets * kWays);
  }

  /// The stream of that commander on that actuator; null when it was not heard, or is forgotten.
  Stream* find(const CommanderId& commander, std::uint32_t actuator) noexcept {
    const std::uint64_t hash = hash_of(commander, actuator);
    for (Stream* const set : {set_of(hash), set_of(hash >> 32)}) {
      for (std::size_t way = 0; way < kWays; ++way) {
        Stream& stream = set[way];
        if (stream.used && stream.commander == commander && stream.actuator == actuator) {
          return &stream;
        }
      }
    }
    return nullptr;
  }

  /// The same, made where there is none, heard `now`; null when both its sets are full of busy ones.
  Stream* find_or_make(const CommanderId& commander, std::uint32_t actuator,
                       std::uint64_t now) noexcept {
    Stream* place = find(commander, actuator);
    if (place == nullptr) {
      place = place_for(hash_of(commander, actuator));
      if (place == nullptr) {
        return nullptr;
      }
      *place = Stream{};
      place->used = true;
      place->commander = commander;
      place->actuator = actuator;
    }
    place->last_heard = now;
    return place;
  }

  std::uint32_t index_of(const Stream& stream) const noexcept {
    return static_cast<std::uint32_t>(&stream - streams_.data());
  }
  Stream& at(std::uint32_t index) noexcept { return streams_[index]; }
  const std::vector<Stream>& streams() const noexcept { return streams_; }

 private:
  static constexpr std::size_t kWays = 8;

  Stream* set_of(std::uint64_t choice) noexcept {
    return streams_.data() + kWays * (choice & (streams_.size() / kWays - 1));
  }

  /// The one to give up for a new stream; null when all are busy.
  Stream* place_for(std::uint64_t hash) noexcept {
    Stream* place = nullptr;
    for (Stream* const set : {set_of(hash), set_of(hash >> 32)}) {
      for (std::size_t way = 0; way < kWays; ++way) {
        Stream& stream = set[way];
        const bool free = !stream.used || stream.live == 0;
        if (free && (place == nullptr || rank(stream) < rank(*place))) {
          place = &stream;
        }
      }
    }
    return place;
  }

  /// Unused ones first, then the longest silent.
  static std::uint64_t rank(const Stream& stream) noexcept {
    return stream.used ? stream.last_heard + 1 : 0;
  }

  static std::uint64_t hash_of(const CommanderId& commander, std::uint32_t actuator) noexcept {
    // The finaliser of splitmix64 (Steele, Lea, Flood 2014).
    std::uint64_t z = commander.high ^ (commander.low * 0x9e3779b97f4a7c15U) ^
                      (static_cast<std::uint64_t>(actuator) << 32);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31);
  }

  std::vector<Stream> streams_;
};

}  // namespace adstar::runtime
