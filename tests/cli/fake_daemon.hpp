#pragma once
// adstard's side of the bus, played by the test: it answers as the test says.

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <unistd.h>
#include <vector>

#include "service/dds/convert.hpp"
#include "service/dds/participant.hpp"
#include "service/dds/reader.hpp"
#include "service/dds/wait_set.hpp"
#include "service/dds/writer.hpp"
#include "tests/cli/client.hpp"

namespace adstar::testing {

/// A place on the bus where no other test is, whatever runs beside it: a domain of its own in this
/// program, and a partition for the same test of another run.
inline dds::ParticipantOptions own_place(std::uint32_t domain) {
  return {domain, "lo", "cli-test-" + std::to_string(getpid())};
}

inline std::vector<std::string> at_place(std::vector<std::string> arguments,
                                         const dds::ParticipantOptions& place) {
  arguments.insert(arguments.end(),
                   {"--domain", std::to_string(place.domain), "--partition", place.partition});
  return client_argv(std::move(arguments));
}

/// The answer to a command; the test fills in what matters to it.
inline adstar_CommandStatus answer_to(const adstar_TorqueCommand& command, adstar_Verdict verdict,
                                      const std::string& service = "fake") {
  adstar_CommandStatus status{};
  dds::set_text(status.spacecraft, dds::text_of(command.spacecraft));
  dds::set_text(status.actuator, dds::text_of(command.actuator));
  dds::set_text(status.service, service);
  status.commander = command.commander;
  status.sequence_number = command.sequence_number;
  status.priority = command.priority;
  status.verdict = verdict;
  status.step = 1200;
  status.time_ns = 12'000'000'000;
  const bool at_once = command.start_time_ns == adstar_START_AT_NEXT_BEAT;
  status.effective_start_time_ns = at_once ? status.time_ns : command.start_time_ns;
  status.effective_end_time_ns = command.duration_ns > 0
                                     ? status.effective_start_time_ns + command.duration_ns
                                     : command.end_time_ns;
  status.torque_applied_n_m = command.torque_n_m;
  return status;
}

inline adstar_CommandStatus refusal_of(const adstar_TorqueCommand& command,
                                       adstar_RefusalReason reason) {
  adstar_CommandStatus status = answer_to(command, adstar_VERDICT_REFUSED);
  status.reason = reason;
  return status;
}

class FakeDaemon {
 public:
  using Answers = std::vector<adstar_CommandStatus>;
  using Reply = std::function<Answers(const adstar_TorqueCommand&)>;

  explicit FakeDaemon(const dds::ParticipantOptions& place)
      : participant_(place),
        commands_(participant_),
        statuses_(participant_),
        wait_set_(participant_) {
    wait_set_.attach(commands_);
  }

  /// Answers until the client ends; returns its exit code. Throws at the deadline.
  int serve(Process& client, const Reply& reply) {
    return serve(client, reply, [] {});
  }

  /// The same, doing something of its own every 10 ms or so.
  int serve(Process& client, const Reply& reply, const std::function<void()>& chore) {
    const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (!client.exit_code()) {
      if (std::chrono::steady_clock::now() > until) {
        throw std::runtime_error("the client still runs; it said:\n" + client.out() + client.err());
      }
      wait_set_.wait(std::chrono::milliseconds(10));
      commands_.take([&](const adstar_TorqueCommand& command, const dds_sample_info_t&) {
        heard.push_back(command);
        for (const adstar_CommandStatus& status : reply(command)) {
          statuses_.write(status);
        }
      });
      chore();
    }
    return *client.exit_code();
  }

  const dds::Participant& participant() const { return participant_; }

  std::vector<adstar_TorqueCommand> heard;

 private:
  dds::Participant participant_;
  dds::Reader<adstar_TorqueCommand> commands_;
  dds::Writer<adstar_CommandStatus> statuses_;
  dds::WaitSet wait_set_;
};

}  // namespace adstar::testing
