#pragma once
// Answers on a topic with an instance for everybody who asked: each is forgotten when that one falls
// silent.

#include <chrono>
#include <cstddef>
#include <list>
#include <mutex>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "service/bridge/answer_keys.hpp"
#include "service/dds/writer.hpp"

namespace adstar::bridge {

/// Any thread. answer_keys.hpp has a key_text() for each kind of sample.
template <class Sample>
class AnswerWriter {
 public:
  using Clock = std::chrono::steady_clock;

  /// Most instances kept at once; the one that was silent longest goes first.
  static constexpr std::size_t kMost = 65'536;

  explicit AnswerWriter(const dds::Participant& participant, std::size_t most = kMost)
      : writer_(participant), most_(most) {}

  /// False when it could not be sent.
  bool write(const Sample& sample, Clock::time_point now = Clock::now()) {
    std::string text = key_text(sample);
    const std::lock_guard lock(mutex_);
    if (const auto found = by_key_.find(text); found != by_key_.end()) {
      found->second->last = now;
      uses_.splice(uses_.end(), uses_, found->second);
    } else {
      if (uses_.size() >= most_) {
        forget_oldest();
      }
      uses_.push_back({sample, std::move(text), now});
      by_key_.emplace(uses_.back().text, std::prev(uses_.end()));
    }
    return writer_.write(sample);
  }

  /// Ends the instances that were not written to for `silence`; at most a thousand a call.
  void forget_silent(std::chrono::seconds silence, Clock::time_point now = Clock::now()) {
    const std::lock_guard lock(mutex_);
    for (int i = 0; i < 1000 && !uses_.empty() && now - uses_.front().last > silence; ++i) {
      forget_oldest();
    }
  }

  std::size_t instances() const {
    const std::lock_guard lock(mutex_);
    return uses_.size();
  }

  dds::Writer<Sample>& writer() noexcept { return writer_; }

 private:
  struct Use {
    Sample key;
    std::string text;
    Clock::time_point last;
  };
  void forget_oldest() {
    writer_.unregister_instance(uses_.front().key);
    by_key_.erase(uses_.front().text);
    uses_.pop_front();
  }

  dds::Writer<Sample> writer_;
  std::size_t most_;
  mutable std::mutex mutex_;
  std::list<Use> uses_;  ///< the oldest first
  std::unordered_map<std::string_view, typename std::list<Use>::iterator>
      by_key_;  ///< views Use::text
};

}  // namespace adstar::bridge
