#pragma once
// A torque pulse as the page asks for it, and the verdict as it goes back.

#include <chrono>
#include <mutex>
#include <string>
#include <string_view>

#include "service/adstar/commander.hpp"
#include "service/dds/participant.hpp"

namespace adstar::dashboard {

struct Pulse {
  cli::Commander::Target target;
  cli::Order order;
};

/// {"spacecraft": "sat1", "actuator": "body", "torque_n_m": [0, 0, 0.05], "duration_s": 5}, from the
/// next beat. Throws std::invalid_argument that says what is wrong with it, and what to write instead.
Pulse pulse_of(std::string_view json);

struct PulseAnswer {
  int http_status = 200;
  std::string json;  ///< {"verdict": "applied", "sentence": "applied by 'fly': ..."}
};

/// Commands, one pulse after the other, from whichever thread asks.
class PulseDesk {
 public:
  explicit PulseDesk(const dds::Participant& participant) : participant_(participant) {}

  /// Until its verdict, or `accepted` while the clock stands, or 5 s.
  PulseAnswer send(const Pulse& pulse);

 private:
  const dds::Participant& participant_;
  std::timed_mutex busy_;
};

}  // namespace adstar::dashboard
