// CommandGate::save and load: all that later judgements depend on, as words.
//
// Word by word, without the holes of a struct, so that equal gates give equal words. load() believes
// nothing: what it is given may be a file that somebody wrote.

#include <bit>
#include <cstring>
#include <type_traits>

#include "service/runtime/gate.hpp"

namespace adstar::runtime {
namespace {

constexpr std::size_t kVerdictWords = sizeof(VerdictRecord) / 8;
static_assert(sizeof(VerdictRecord) % 8 == 0 && std::is_trivially_copyable_v<VerdictRecord>,
              "whole words");

void append(std::vector<std::uint64_t>& words, const VerdictRecord& verdict) {
  const auto raw = std::bit_cast<std::array<std::uint64_t, kVerdictWords>>(verdict);
  words.insert(words.end(), raw.begin(), raw.end());
}

/// Takes words off the front; once they run out, `good` is false and everything is zero.
struct WordReader {
  std::span<const std::uint64_t> words;
  bool good = true;

  std::uint64_t next() {
    if (words.empty()) {
      good = false;
      return 0;
    }
    const std::uint64_t word = words.front();
    words = words.subspan(1);
    return word;
  }
  /// Below `limit`, or not good.
  std::uint64_t next_below(std::uint64_t limit) {
    const std::uint64_t word = next();
    good = good && word < limit;
    return good ? word : 0;
  }
  VerdictRecord next_verdict() {
    std::array<std::uint64_t, kVerdictWords> raw{};
    for (std::uint64_t& word : raw) {
      word = next();
    }
    const auto verdict = std::bit_cast<VerdictRecord>(raw);
    good = good && verdict.verdict <= Verdict::refused && verdict.reason <= Reason::not_recorded;
    return verdict;
  }
};

}  // namespace

std::vector<std::uint64_t> CommandGate::save() const {
  std::vector<std::uint64_t> words{heard_};
  const std::vector<Stream>& streams = memory_.streams();
  std::size_t used = 0;
  for (const Stream& stream : streams) {
    used += stream.used ? 1 : 0;
  }
  words.push_back(used);
  for (std::size_t i = 0; i < streams.size(); ++i) {
    const Stream& stream = streams[i];
    if (!stream.used) {
      continue;
    }
    words.insert(words.end(), {i, stream.commander.high, stream.commander.low, stream.actuator,
                               stream.last_sequence, stream.last_heard, stream.next_verdict});
    for (const VerdictRecord& verdict : stream.verdicts) {
      append(words, verdict);
    }
  }
  words.push_back(busy_.size());
  for (const std::uint32_t number : busy_) {
    words.push_back(number);
    const std::size_t count = words.size();
    words.push_back(0);
    for (std::uint32_t entry = actuators_[number].head; entry != kNone; entry = pool_[entry].next) {
      append(words, pool_[entry].verdict);
      words.push_back(pool_[entry].stream);
      words.push_back(pool_[entry].begun ? 1 : 0);
      ++words[count];
    }
  }
  return words;
}

bool CommandGate::load(std::span<const std::uint64_t> words) {
  WordReader in{words};
  heard_ = in.next();
  const std::size_t places = memory_.streams().size();
  for (std::uint64_t left = in.next_below(places + 1); in.good && left > 0; --left) {
    Stream& stream = memory_.at(static_cast<std::uint32_t>(in.next_below(places)));
    stream.used = true;
    stream.commander.high = in.next();
    stream.commander.low = in.next();
    stream.actuator = static_cast<std::uint32_t>(in.next_below(actuators_.size()));
    stream.last_sequence = in.next();
    stream.last_heard = in.next();
    stream.next_verdict = in.next_below(Stream::kRemembered);
    for (VerdictRecord& verdict : stream.verdicts) {
      verdict = in.next_verdict();
    }
  }
  for (std::uint64_t left = in.next_below(actuators_.size() + 1); in.good && left > 0; --left) {
    const auto number = static_cast<std::uint32_t>(in.next_below(actuators_.size()));
    Actuator& actuator = actuators_[number];
    if (!in.good || actuator.busy) {
      return false;
    }
    actuator.busy = true;
    busy_.push_back(number);
    std::uint32_t* link = &actuator.head;
    for (std::uint64_t entries = in.next_below(pool_.size() + 1); in.good && entries > 0;
         --entries) {
      if (free_ == kNone) {
        return false;
      }
      const std::uint32_t entry = free_;
      free_ = pool_[entry].next;
      Live& live = pool_[entry];
      live.verdict = in.next_verdict();
      live.stream = static_cast<std::uint32_t>(in.next_below(places));
      live.begun = in.next_below(2) == 1;
      live.next = kNone;
      *link = entry;
      link = &live.next;
      ++memory_.at(live.stream).live;
    }
  }
  return in.good && in.words.empty();
}

}  // namespace adstar::runtime
