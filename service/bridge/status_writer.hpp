#pragma once
// The answers that the bridge writes, by topic.

#include <chrono>

#include "service/bridge/answer_writer.hpp"

namespace adstar::bridge {

using StatusWriter = AnswerWriter<adstar_CommandStatus>;
using StepReplyWriter = AnswerWriter<adstar_StepReply>;
using ControlStatusWriter = AnswerWriter<adstar_RunControlStatus>;

/// All of them.
struct AnswerWriters {
  explicit AnswerWriters(const dds::Participant& participant)
      : commands(participant), steps(participant), controls(participant) {}

  void forget_silent(std::chrono::seconds silence, StatusWriter::Clock::time_point now) {
    commands.forget_silent(silence, now);
    steps.forget_silent(silence, now);
    controls.forget_silent(silence, now);
  }

  StatusWriter commands;
  StepReplyWriter steps;
  ControlStatusWriter controls;
};

}  // namespace adstar::bridge
