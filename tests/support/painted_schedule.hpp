#pragma once
// What the gate ought to answer, from a model that has nothing of its lists: time is an array of
// slots, and an accepted command paints its own, over whatever lies there from its start on.

#include <algorithm>
#include <array>
#include <compare>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <vector>

#include "service/runtime/records.hpp"

namespace adstar::test {

/// One answer, as far as the model knows it; intervals in slots, only for what is in force.
struct Told {
  std::uint64_t commander = 0, sequence = 0;
  runtime::Verdict verdict = runtime::Verdict::refused;
  runtime::Reason reason = runtime::Reason::none;
  std::int64_t start = 0, end = 0;
  auto operator<=>(const Told&) const = default;
};

/// A command on the grid. NaN and the like: `refusal` says what the gate has to find.
struct SlotCommand {
  std::uint64_t commander = 0, sequence = 0;
  std::int32_t priority = 0;
  std::int64_t start = 0, end = 0;
  runtime::Reason refusal = runtime::Reason::none;
};

struct Painted {
  std::size_t command = 0;  ///< index into commands()
  std::int64_t start = 0, end = 0;
};

/// One actuator.
class PaintedSchedule {
 public:
  PaintedSchedule(std::int64_t slots, std::int64_t per_step)
      : slots_(static_cast<std::size_t>(slots), kBare), per_step_(per_step) {}

  void receive(const SlotCommand& c, std::int64_t now, std::vector<Told>& told) {
    using runtime::Reason;
    using runtime::Verdict;
    Stream& stream = streams_[c.commander];
    if (c.sequence <= stream.last) {
      told.push_back(repeated(stream, c));
      return;
    }
    stream.last = c.sequence;
    const auto finish = [&](Verdict verdict, Reason reason = Reason::none) {
      conclude({c.commander, c.sequence, verdict, reason, 0, 0}, told);
    };
    if (c.refusal != Reason::none) {
      return finish(Verdict::refused, c.refusal);
    }
    if (c.end <= now) {
      return finish(Verdict::expired);
    }
    for (std::int64_t slot = now; slot < size(); ++slot) {
      if (at(slot) != kBare && commands_[index(slot)].priority > c.priority) {
        return finish(Verdict::outranked);
      }
    }
    const std::int64_t start = std::max(c.start, now);
    for (std::size_t i = 0; i < commands_.size(); ++i) {
      if (status_[i] != Status::waiting) {
        continue;
      }
      const bool below = commands_[i].priority < c.priority;
      if (below || extent(i)->start >= start) {
        erase(i, 0);
        status_[i] = Status::done;
        conclude({commands_[i].commander, commands_[i].sequence,
                  below ? Verdict::outranked : Verdict::superseded, Reason::none, 0, 0},
                 told);
      }
    }
    std::fill(slots_.begin() + start, slots_.end(), kBare);
    std::fill(slots_.begin() + start, slots_.begin() + c.end, static_cast<int>(commands_.size()));
    commands_.push_back(c);
    late_.push_back(c.start < now);
    status_.push_back(Status::waiting);
    if (start >= now + per_step_) {
      told.push_back({c.commander, c.sequence, Verdict::accepted, Reason::none, 0, 0});
    }
  }

  void begin_step(std::int64_t now, std::vector<Told>& told) {
    using runtime::Verdict;
    for (std::size_t i = 0; i < commands_.size(); ++i) {
      if (status_[i] == Status::waiting && extent(i)->start < now + per_step_) {
        status_[i] = Status::done;
        conclude({commands_[i].commander, commands_[i].sequence,
                  late_[i] ? Verdict::applied_late : Verdict::applied, runtime::Reason::none,
                  extent(i)->start, extent(i)->end},
                 told);
      }
    }
  }

  /// What has a slot in the step that begins at `now`, ascending, each with its whole extent.
  std::vector<Painted> window(std::int64_t now) const {
    std::vector<Painted> result;
    for (std::int64_t slot = now; slot < now + per_step_; ++slot) {
      if (at(slot) != kBare && (result.empty() || result.back().command != index(slot))) {
        result.push_back(*extent(index(slot)));
      }
    }
    return result;
  }

  const std::vector<SlotCommand>& commands() const { return commands_; }
  std::int64_t size() const { return static_cast<std::int64_t>(slots_.size()); }
  int at(std::int64_t slot) const { return slots_[static_cast<std::size_t>(slot)]; }
  static constexpr int kBare = -1;

 private:
  enum class Status { waiting, done };
  struct Stream {
    std::uint64_t last = 0;
    std::deque<Told> finals;
  };

  Told repeated(const Stream& stream, const SlotCommand& c) const {
    for (std::size_t i = 0; i < commands_.size(); ++i) {
      if (commands_[i].commander == c.commander && commands_[i].sequence == c.sequence &&
          status_[i] == Status::waiting) {
        return {c.commander, c.sequence, runtime::Verdict::accepted, runtime::Reason::none, 0, 0};
      }
    }
    for (const Told& final : stream.finals) {
      if (final.sequence == c.sequence) {
        return final;
      }
    }
    return {c.commander, c.sequence, runtime::Verdict::refused, runtime::Reason::old_sequence,
            0,           0};
  }

  void conclude(const Told& final, std::vector<Told>& told) {
    constexpr std::size_t kRemembered = 8;
    std::deque<Told>& finals = streams_[final.commander].finals;
    finals.push_back(final);
    if (finals.size() > kRemembered) {
      finals.pop_front();
    }
    told.push_back(final);
  }

  std::size_t index(std::int64_t slot) const { return static_cast<std::size_t>(at(slot)); }
  void erase(std::size_t command, std::int64_t from) {
    std::replace(slots_.begin() + from, slots_.end(), static_cast<int>(command), kBare);
  }
  std::optional<Painted> extent(std::size_t command) const {
    const auto first = std::find(slots_.begin(), slots_.end(), static_cast<int>(command));
    if (first == slots_.end()) {
      return std::nullopt;
    }
    const auto past =
        std::find_if(first, slots_.end(), [&](int c) { return c != static_cast<int>(command); });
    return Painted{command, first - slots_.begin(), past - slots_.begin()};
  }

  std::vector<int> slots_;
  std::int64_t per_step_;
  std::vector<SlotCommand> commands_;
  std::vector<bool> late_;
  std::vector<Status> status_;
  std::map<std::uint64_t, Stream> streams_;
};

}  // namespace adstar::test
