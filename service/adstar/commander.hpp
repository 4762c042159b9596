#pragma once
// The client's end of a command's life: every order is repeated under its sequence number until the
// service answers, and asked after again while it waits for its start.

#include <array>
#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "service/dds/participant.hpp"
#include "service/dds/reader.hpp"
#include "service/dds/wait_set.hpp"
#include "service/dds/writer.hpp"
#include "service/runtime/records.hpp"

namespace adstar::cli {

enum class Ordered { torque, wheel_torque, wheel_speed, dipole, thrust, joint_torque };

struct Order {
  Ordered what = Ordered::torque;
  std::int32_t priority = 0;
  std::int64_t start_ns = runtime::kStartAtNextBeat;
  std::int64_t end_ns = 0;              ///< exclusive; 0 with a duration
  std::int64_t duration_ns = 0;         ///< 0 with an end
  std::array<double, 3> torque_n_m{};   ///< of a wheel or a joint: x
  double speed_rad_s = 0;               ///< of a wheel
  std::array<double, 3> dipole_a_m2{};  ///< of a magnetorquer, in B
};

struct Answer {
  runtime::Verdict verdict = runtime::Verdict::refused;
  runtime::Reason reason = runtime::Reason::none;
  std::string service;
  std::uint64_t step = 0;
  std::int64_t time_ns = 0;
  std::int64_t start_ns = 0;
  std::int64_t end_ns = 0;
  std::array<double, 3> torque_n_m{};
  double speed_rad_s = 0;
  std::array<double, 3> dipole_a_m2{};
  bool forgotten = false;  ///< it was accepted once, and the service has forgotten how it ended

  bool is_final() const;
};

class Commander {
 public:
  using Clock = std::chrono::steady_clock;

  struct Target {
    std::string spacecraft;
    std::string actuator;  ///< of whatever kind
    std::string service;   ///< hear this one only; empty: any
  };

  /// One order on its way.
  struct Dispatch {
    Order order;
    std::optional<Answer> answer;
    std::optional<Answer> provisional;  ///< "I do not fly it": another service may
    Clock::time_point provisional_until;
    Clock::time_point heard;     ///< when it was given, then when the last answer came
    Clock::time_point answered;  ///< when the first answer came
    Clock::time_point next_send;

    bool ended() const { return answer && answer->is_final(); }
  };

  /// Draws the random identity of this commander.
  Commander(const dds::Participant& participant, Target target);

  /// Returns its sequence number.
  std::uint64_t give(const Order& order);

  /// Sends what is due and takes what comes in, for at most `patience`; returns early when an
  /// answer came. Throws Failure for an answer that this program does not understand.
  void work(std::chrono::milliseconds patience);

  const Dispatch& at(std::uint64_t sequence) const { return dispatches_.at(sequence); }
  void forget(std::uint64_t sequence) { dispatches_.erase(sequence); }

  /// Nothing was heard of it for so long; what waits for its start is asked after only now and
  /// then.
  bool silent(std::uint64_t sequence, std::chrono::nanoseconds timeout) const;

  /// It was accepted a while ago and is not final. Of an immediate order, which is final within a
  /// beat, this tells that the clock stands: it begins with the next step.
  bool waits(std::uint64_t sequence) const;

  /// Some service listens to commands.
  bool heard_by_anyone() const;

 private:
  void send_due(Clock::time_point now);
  void send(std::uint64_t sequence, const Order& order);
  template <class Command>
  Command header_of(std::uint64_t sequence, const Order& order) const;
  bool take_answers(Clock::time_point now);
  bool receive(const adstar_CommandStatus& status, Clock::time_point now);
  bool confirm_provisional(Clock::time_point now);
  Clock::time_point next_event(Clock::time_point limit) const;

  Target target_;
  runtime::CommanderId id_;
  std::uint64_t last_sequence_ = 0;
  std::map<std::uint64_t, Dispatch> dispatches_;
  const dds::Participant& participant_;
  std::optional<dds::Writer<adstar_TorqueCommand>>
      torques_;  ///< each made for the first order of its kind
  std::optional<dds::Writer<adstar_WheelTorqueCommand>> wheel_torques_;
  std::optional<dds::Writer<adstar_WheelSpeedCommand>> wheel_speeds_;
  std::optional<dds::Writer<adstar_DipoleCommand>> dipoles_;
  std::optional<dds::Writer<adstar_ThrusterCommand>> thrusters_;
  std::optional<dds::Writer<adstar_JointTorqueCommand>> joints_;
  dds::Reader<adstar_CommandStatus> reader_;
  dds::WaitSet wait_set_;
};

}  // namespace adstar::cli
