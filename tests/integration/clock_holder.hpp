#pragma once
// Whoever holds a daemon's clock from outside: asks for steps and controls the run, over the bus.

#include <cstdint>
#include <optional>
#include <string>

#include "service/dds/reader.hpp"
#include "service/dds/wait_set.hpp"
#include "tests/integration/daemon_harness.hpp"
#include "tests/support/text.hpp"

namespace adstar::testing {

/// The paper's body in lock-step.
inline std::string lockstep_scene(const dds::ParticipantOptions& where, SceneOptions options = {},
                                  const std::string& timeout = "10s", bool run_control = true) {
  const std::string scene = replaced(
      paper_scene(where, options), fmt::format("pace = \"clock\"\nrate = {:f}\n", options.rate),
      fmt::format("pace = \"lockstep\"\nlockstep_timeout = \"{}\"\n", timeout));
  return run_control ? replaced(scene, "[service]\n", "[service]\nrun_control = true\n") : scene;
}

class ClockHolder {
 public:
  explicit ClockHolder(const dds::Participant& participant, std::uint64_t id = 1)
      : id_{0x5678'0000 + id, static_cast<std::uint64_t>(getpid())},
        steps_(participant),
        replies_(participant),
        controls_(participant),
        statuses_(participant),
        wait_set_(participant) {
    wait_set_.attach(replies_);
    wait_set_.attach(statuses_);
  }

  adstar_StepRequest request(std::uint64_t steps) {
    adstar_StepRequest request{};
    dds::set_text(request.service, "fly");
    request.requester = id_;
    request.sequence_number = ++sequence_;
    request.steps = steps;
    return request;
  }

  /// Repeats it until its final answer.
  std::optional<adstar_StepReply> ask(const adstar_StepRequest& request) {
    std::optional<adstar_StepReply> answer;
    repeat([&] { steps_.write(request); },
           [&] {
             replies_.take([&](const adstar_StepReply& reply, const dds_sample_info_t&) {
               if (reply.requester.low == id_.low && reply.requester.high == id_.high &&
                   reply.sequence_number == request.sequence_number &&
                   reply.outcome != adstar_STEP_ACCEPTED) {
                 answer = reply;
               }
             });
             return answer.has_value();
           });
    return answer;
  }
  std::optional<adstar_StepReply> step(std::uint64_t steps) { return ask(request(steps)); }
  void write(const adstar_StepRequest& request) { steps_.write(request); }

  adstar_RunControl control(adstar_ControlAction action, const std::string& spacecraft = "") {
    adstar_RunControl control{};
    dds::set_text(control.service, "fly");
    control.commander = id_;
    control.sequence_number = ++sequence_;
    control.action = action;
    dds::set_text(control.spacecraft, spacecraft);
    return control;
  }

  std::optional<adstar_RunControlStatus> ask(const adstar_RunControl& control) {
    std::optional<adstar_RunControlStatus> answer;
    repeat([&] { controls_.write(control); },
           [&] {
             statuses_.take([&](const adstar_RunControlStatus& status, const dds_sample_info_t&) {
               if (status.commander.low == id_.low && status.commander.high == id_.high &&
                   status.sequence_number == control.sequence_number) {
                 answer = status;
               }
             });
             return answer.has_value();
           });
    return answer;
  }
  std::optional<adstar_RunControlStatus> ask(adstar_ControlAction action) {
    return ask(control(action));
  }

 private:
  template <class Send, class Heard>
  void repeat(Send&& send, Heard&& heard) {
    const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    auto next_send = std::chrono::steady_clock::now();
    while (!heard() && std::chrono::steady_clock::now() < until) {
      if (std::chrono::steady_clock::now() >= next_send) {
        send();
        next_send = std::chrono::steady_clock::now() + std::chrono::milliseconds(50);
      }
      wait_set_.wait(std::chrono::milliseconds(50));
    }
  }

  adstar_CommanderId id_;
  std::uint64_t sequence_ = 0;
  dds::Writer<adstar_StepRequest> steps_;
  dds::Reader<adstar_StepReply> replies_;
  dds::Writer<adstar_RunControl> controls_;
  dds::Reader<adstar_RunControlStatus> statuses_;
  dds::WaitSet wait_set_;
};

}  // namespace adstar::testing
