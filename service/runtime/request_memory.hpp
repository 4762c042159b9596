#pragma once
// What is remembered of those who ask the tick for something, so that a repeated sequence number gets
// the same answer and does nothing again.
//
// Fixed memory: a few askers, each with its last answers. A new asker takes the place of the one that
// was silent longest; whose place was taken starts anew.

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

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

  /// All of it as words; load() gives false, and the memory is to be thrown away, for any others.
  std::vector<std::uint64_t> save() const {
    std::vector<std::uint64_t> words{heard_};
    for (const Asker& asker : askers_) {
      words.insert(words.end(), {asker.used ? 1U : 0U, asker.id.high, asker.id.low,
                                 asker.last_sequence, asker.last_heard, asker.next_answer});
      for (const Answer& answer : asker.answers) {
        const auto raw = std::bit_cast<AnswerWords>(answer);
        words.insert(words.end(), raw.begin(), raw.end());
      }
    }
    return words;
  }
  bool load(std::span<const std::uint64_t> words) {
    constexpr std::size_t kAsker = 6 + kRemembered * kAnswer;
    if (words.size() != 1 + kAskers * kAsker) {
      return false;
    }
    heard_ = words[0];
    words = words.subspan(1);
    for (Asker& asker : askers_) {
      asker.used = words[0] != 0;
      asker.id = {words[1], words[2]};
      asker.last_sequence = words[3];
      asker.last_heard = words[4];
      asker.next_answer = words[5] % kRemembered;
      for (std::size_t i = 0; i < kRemembered; ++i) {
        AnswerWords raw;
        std::copy_n(words.begin() + static_cast<std::ptrdiff_t>(6 + i * kAnswer), kAnswer,
                    raw.begin());
        asker.answers[i] = std::bit_cast<Answer>(raw);
      }
      words = words.subspan(kAsker);
    }
    return true;
  }

 private:
  static_assert(sizeof(Answer) % 8 == 0, "whole words");
  static constexpr std::size_t kAnswer = sizeof(Answer) / 8;
  using AnswerWords = std::array<std::uint64_t, kAnswer>;
  std::array<Asker, kAskers> askers_{};
  std::uint64_t heard_ = 0;
};

}  // namespace adstar::runtime
