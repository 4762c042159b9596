#pragma once
// CommandStatus: one instance per spacecraft, actuator and commander, forgotten when that commander
// falls silent.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <list>
#include <mutex>
#include <string>
#include <string_view>
#include <unordered_map>

#include "service/dds/writer.hpp"

namespace adstar::bridge {

/// Any thread.
class StatusWriter {
 public:
  using Clock = std::chrono::steady_clock;

  /// Most instances kept at once; the one that was silent longest goes first.
  static constexpr std::size_t kMost = 65'536;

  explicit StatusWriter(const dds::Participant& participant, std::size_t most = kMost)
      : writer_(participant), most_(most) {}

  /// False when it could not be sent.
  bool write(const adstar_CommandStatus& status, Clock::time_point now = Clock::now());

  /// Ends the instances that were not written to for `silence`; at most a thousand a call.
  void forget_silent(std::chrono::seconds silence, Clock::time_point now = Clock::now());

  std::size_t instances() const;
  dds::Writer<adstar_CommandStatus>& writer() noexcept { return writer_; }

 private:
  struct Use {
    adstar_CommandStatus key;
    std::string text;
    Clock::time_point last;
  };
  void forget_oldest();

  dds::Writer<adstar_CommandStatus> writer_;
  std::size_t most_;
  mutable std::mutex mutex_;
  std::list<Use> uses_;                                                    ///< the oldest first
  std::unordered_map<std::string_view, std::list<Use>::iterator> by_key_;  ///< views Use::text
};

}  // namespace adstar::bridge
