#pragma once
// What is remembered of those who ask the tick for something, so that a repeated sequence number gets
// the same answer and does nothing again.
//
// Fixed memory: a few askers, each with its last answers. A new asker takes the place of the one that
// was silent longest; whose place was taken starts anew.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "service/runtime/records.hpp"

namespace adstar::runtime {

/// `Answer` has a member `sequence`; 0 is no sequence number.
template <class Answer>
class RequestMemory {
 public:
  static constexpr std::size_t kAskers = 16;
  static constexpr std::size_t kRemembered = 4;

  struct Asker {
    bool used = false;
    CommanderId id;
    std::uint64_t last_sequence = 0;  ///< the highest heard
    std::uint64_t last_heard = 0;
    std::array<Answer, kRemembered> answers{};
    std::size_t next_answer = 0;

    void remember(const Answer& answer) noexcept {
      answers[next_answer] = answer;
      next_answer = (next_answer + 1) % kRemembered;
    }
    const Answer* recall(std::uint64_t sequence) const noexcept {
      const auto found =
          std::find_if(answers.begin(), answers.end(),
                       [sequence](const Answer& answer) { return answer.sequence == sequence; });
      return sequence != 0 && found != answers.end() ? &*found : nullptr;
    }
  };

  /// Known or new.
  Asker& find(const CommanderId& id) noexcept {
    ++heard_;
    auto asker = std::find_if(askers_.begin(), askers_.end(),
                              [&id](const Asker& a) { return a.used && a.id == id; });
    if (asker == askers_.end()) {
      asker = std::min_element(askers_.begin(), askers_.end(), [](const Asker& a, const Asker& b) {
        return a.last_heard < b.last_heard;  // never used: 0
      });
      *asker = Asker{};
      asker->used = true;
      asker->id = id;
    }
    asker->last_heard = heard_;
    return *asker;
  }

 private:
  std::array<Asker, kAskers> askers_{};
  std::uint64_t heard_ = 0;
};

}  // namespace adstar::runtime
